//! The kernel's certificate on a scene: its memory, and what of it depends on the mesh and A alone.

use signorini_bound::averages;
use signorini_bound::certificate::{self, Buffers, Certificate, Discretization, Verdict};
use signorini_bound::conforming;
use signorini_bound::equilibrium::Iterate;
use signorini_kernel::Error as KernelError;
use signorini_kernel::mesh::components::Support;

use super::admissible::{Admissible, Following};
use super::data::Data;
use super::forest::EquilibrationForest;
use super::metric::Metric;
use super::no_bound::NoBound;
use super::relaxed::relaxed;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Assembled, Parts, Problem};

/// A certificate in the making: one for each problem and scalar.
#[derive(Debug)]
pub struct Certifier<R: Scalar> {
    metric: Metric<R>,
    ways: EquilibrationForest<R>,
    /// Where contact alone holds a part, its way out leads through edges that are active.
    follows_contact: bool,
    /// Whether the last search has found ways.
    found_ways: bool,
    vertices: Vec<R>,
    bubbles: Vec<R>,
    tau: Vec<R>,
    indicators: Vec<R>,
    /// Why the last iterate has no bound, apart from its data.
    refusal: Option<NoBound>,
}

/// The admissible pair of a certificate, in f64.
#[derive(Debug, Clone, Default)]
pub struct CertifiedFields {
    /// s at the vertices.
    pub vertices: Vec<f64>,
    /// The bubbles of s, one an edge.
    pub bubbles: Vec<f64>,
    /// ∫_E τ·n of every edge, along its direction.
    pub tau: Vec<f64>,
    /// Each cell's part of gap², triangles first.
    pub indicators: Vec<f64>,
    /// Where s has extensions.
    pub following: Following,
}

impl CertifiedFields {
    /// S and τ as the exact norms take them.
    pub fn admissible(&self) -> Admissible<'_> {
        let Self { vertices, bubbles, tau, following, .. } = self;
        Admissible { vertices, bubbles, tau, following }
    }
}

/// A cell of a part that nothing holds.
fn floating(parts: &Parts) -> usize {
    let held_by_nothing = |&part: &usize| parts.support(part) == Support::None;
    parts.roots().find(held_by_nothing).unwrap_or(0)
}

impl<R: Scalar> Certifier<R> {
    /// Prepares certificates for `problem`.
    ///
    /// # Errors
    /// Never for a problem that was assembled.
    pub fn new(
        problem: &Problem,
        parts: &Parts,
        assembled: &Assembled<R>,
    ) -> Result<Self, KernelError> {
        let edges = problem.topology.counts.edges();
        let vertices = problem.mesh.vertices.len();
        let mut certifier = Self {
            metric: Metric::new(problem),
            ways: EquilibrationForest::new(problem),
            follows_contact: parts.counts.contact > 0,
            found_ways: false,
            vertices: vec![R::ZERO; vertices],
            bubbles: vec![R::ZERO; edges],
            tau: vec![R::ZERO; edges],
            indicators: vec![R::ZERO; problem.cells()],
            refusal: None,
        };
        if !certifier.follows_contact && parts.counts.floating == 0 {
            certifier.seek(assembled, |_| false)?;
        }
        Ok(certifier)
    }

    /// Bounds the error of the iterate `u`; `None` where there is no bound.
    ///
    /// # Errors
    /// Never for data of this problem.
    pub fn certify(
        &mut self,
        parts: &Parts,
        assembled: &Assembled<R>,
        data: &Data<R>,
        u: &[R],
    ) -> Result<Option<Certificate<R>>, KernelError> {
        if !self.has_ways(parts, assembled, u)? || !data.has_bound() {
            self.average(assembled, data, u)?;
            return Ok(None);
        }
        let verdict = self.verdict(assembled, data, u, |_, _| ())?;
        self.refusal = match verdict {
            Verdict::Certified(_) => None,
            Verdict::Pulled { edge } => Some(NoBound::pulled(assembled.problem(), edge)),
            Verdict::NotAsked => Some(NoBound::not_asked()),
            _ => Some(NoBound::overflow::<R>()),
        };
        Ok(verdict.certificate().copied())
    }

    /// The last certificate or, where s is worth moving off the average of u_h (`relaxed`), that with the better s. Each of
    /// both bounds the error of u_h.
    ///
    /// # Errors
    /// As for [`Certifier::certify`].
    pub fn relaxed(
        &mut self,
        assembled: &Assembled<R>,
        data: &Data<R>,
        u: &[R],
        last: Certificate<R>,
    ) -> Result<Certificate<R>, KernelError> {
        let forms = data.forms();
        let given = data.given(assembled, forms.as_slice())?;
        let Some(better) = relaxed(assembled.problem(), &given, &self.answer().admissible(), &last)
        else {
            return Ok(last);
        };
        let better = |vertices: &mut [R], bubbles: &mut [R]| {
            for (to, from) in [vertices, bubbles].into_iter().zip(&better) {
                to.iter_mut().zip(from).for_each(|(to, &value)| *to = R::narrow(value));
            }
        };
        let found = self.verdict(assembled, data, u, better)?.certificate().copied();
        if let Some(found) = found.filter(|found| found.total < last.total) {
            return Ok(Certificate { of_u: found.of_u.or_smaller(last.of_u), ..found });
        }
        self.verdict(assembled, data, u, |_, _| ())?;
        Ok(last)
    }

    fn verdict(
        &mut self,
        assembled: &Assembled<R>,
        data: &Data<R>,
        u: &[R],
        moved: impl FnOnce(&mut [R], &mut [R]),
    ) -> Result<Verdict<R>, KernelError> {
        let discretization = self.ways.discretization(assembled, &self.metric)?;
        let buffers = Buffers {
            vertices: &mut self.vertices,
            bubbles: &mut self.bubbles,
            tau: &mut self.tau,
            indicators: &mut self.indicators,
        };
        let forms = data.forms();
        let given = data.given(assembled, forms.as_slice())?;
        let iterate = Iterate { u, law: assembled.law() };
        certificate::certify_with(&discretization, &given, iterate, buffers, moved)
    }

    /// Why the last iterate has no bound, given these data.
    pub fn no_bound(&self, data: &Data<R>) -> Option<NoBound> {
        data.no_bound().or(self.refusal.as_ref()).cloned()
    }

    /// The fields of the last certificate.
    pub fn answer(&self) -> CertifiedFields {
        let wide = |numbers: &[R]| numbers.iter().map(|x| x.wide()).collect();
        CertifiedFields {
            vertices: wide(&self.vertices),
            bubbles: wide(&self.bubbles),
            tau: wide(&self.tau),
            indicators: wide(&self.indicators),
            following: Following::WhereNeeded,
        }
    }

    /// The discretization that a tick certifies on, whose surplus can leave every cell whatever the iterate.
    ///
    /// # Errors
    /// Never for a problem that was assembled.
    pub fn discretization<'a>(
        &'a self,
        assembled: &'a Assembled<R>,
    ) -> Result<Discretization<'a, R, u32>, KernelError> {
        self.ways.discretization(assembled, &self.metric)
    }

    /// Whether surplus can leave everywhere; finds the ways where they depend on u.
    fn has_ways(
        &mut self,
        parts: &Parts,
        assembled: &Assembled<R>,
        u: &[R],
    ) -> Result<bool, KernelError> {
        if parts.counts.floating > 0 {
            let cell = floating(parts);
            self.refusal = Some(NoBound::held_by_nothing(assembled.problem(), cell));
            return Ok(false);
        }
        if !self.follows_contact {
            // Found once and for all.
            return Ok(self.found_ways);
        }
        let edges = assembled.edges();
        let (free, law) = (edges.counts().free, assembled.law());
        let active = |edge: usize| {
            let contact = edge.checked_sub(free).filter(|&at| at < edges.counts().contact);
            let alone = || parts.support(parts.of_edge(edges, edge)) == Support::Contact;
            contact.is_some_and(|at| law.on(at).touches(u[edge]) && alone())
        };
        self.seek(assembled, active)
    }

    /// Finds ways out that may lead through these contact edges; whether there are any.
    fn seek(
        &mut self,
        assembled: &Assembled<R>,
        active: impl Fn(usize) -> bool,
    ) -> Result<bool, KernelError> {
        self.refusal = None;
        match self.ways.find(assembled, &self.metric, active) {
            Err(KernelError::NoWayOut { cell }) => {
                self.refusal = Some(NoBound::nothing_active(assembled.problem(), cell));
                self.found_ways = false;
            }
            found => found.map(|()| self.found_ways = true)?,
        }
        Ok(self.found_ways)
    }

    /// s alone, for the picture of a solution without a bound.
    fn average(
        &mut self,
        assembled: &Assembled<R>,
        data: &Data<R>,
        u: &[R],
    ) -> Result<(), KernelError> {
        self.ways.find(assembled, &self.metric, |_| true)?;
        let discretization = self.ways.discretization(assembled, &self.metric)?;
        let (s, law, given) = (&mut self.vertices, assembled.law(), data.given(assembled, &[])?);
        let distortions = discretization.metric.distortions;
        averages::fill(&discretization.cells, assembled.cells(), distortions, u, s, &mut self.tau)?;
        conforming::impose(&discretization.mesh, &discretization.edges, u, law, given.ends, s)
            .map(|_| ())
    }
}
