//! The kernel's certificate on a scene: its memory, and what of it depends on the mesh and A alone.

mod step;

use signorini_bound::averages;
use signorini_bound::certificate::{self, Certificate, Discretization, Verdict};
use signorini_bound::conforming;
use signorini_bound::equilibrium::Iterate;
use signorini_kernel::Error as KernelError;
use signorini_kernel::mesh::components::Support;

use super::admissible::Following;
use super::data::Data;
use super::fields::CertifiedFields;
use super::forest::EquilibrationForest;
use super::metric::Metric;
use super::no_bound::NoBound;
use super::relaxed::relaxed;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Assembled, EdgeKind, Parts, Problem};

/// A certificate in the making: one for each problem and scalar.
#[derive(Debug)]
pub struct Certifier<R: Scalar> {
    metric: Metric<R>,
    ways: EquilibrationForest<R>,
    /// Where contact alone holds a part, its way out leads through edges that are active.
    follows_contact: bool,
    /// Whether the last search has found ways.
    found_ways: bool,
    /// Whether steps in time may hand on along the ways found.
    hands_on: bool,
    fields: CertifiedFields<R>,
    /// Why the last iterate has no bound, apart from its data.
    refusal: Option<NoBound>,
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
        let mut certifier = Self {
            metric: Metric::new(problem),
            ways: EquilibrationForest::new(problem),
            follows_contact: parts.counts.contact > 0,
            found_ways: false,
            hands_on: true,
            fields: CertifiedFields::new(problem),
            refusal: None,
        };
        if !certifier.follows_contact && parts.counts.floating == 0 {
            certifier.seek(assembled, |_| false)?;
        }
        if assembled.step().is_some() && !certifier.found_ways {
            // Cells that store keep what they lack: a way may end in any of them.
            certifier.hands_on = false;
            let edges = assembled.edges();
            let stores = |half: u32| {
                let cell = edges.cell_of(half as usize);
                cell.is_some_and(|cell| problem.capacities.get(cell).is_some_and(|&c| c > 0.0))
            };
            let kinds = &problem.kinds;
            certifier.seek(assembled, |edge| {
                kinds[edge] == EdgeKind::Contact || stores(edges.half_edges()[edge][0])
            })?;
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
        self.fields.following = match assembled.step() {
            Some(_) => Following::default(),
            None => Following::WhereNeeded,
        };
        self.fields.lifts = data.evaluated.lifts.clone();
        if !self.has_ways(parts, assembled, u)? || !data.has_bound() {
            self.average(assembled, data, u)?;
            return Ok(None);
        }
        let verdict = self.verdict(assembled, data, u, |_, _| ())?;
        self.refusal = NoBound::of_verdict(&verdict, assembled.problem(), || None);
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
        moved: impl Fn(&mut [R], &mut [R]),
    ) -> Result<Verdict<R>, KernelError> {
        if let Some(step) = assembled.step() {
            return self.of_step(assembled, (data, step), u, moved);
        }
        let discretization = self.ways.discretization(assembled, &self.metric)?;
        let forms = data.forms();
        let given = data.given(assembled, forms.as_slice())?;
        let iterate = Iterate { u, law: assembled.law() };
        let fields = &mut self.fields;
        let verdict =
            certificate::certify_with(&discretization, &given, iterate, fields.buffers(), moved)?;
        fields.open(&discretization, &given, iterate.law)?;
        Ok(verdict)
    }

    /// Why the last iterate has no bound, given these data.
    pub fn no_bound(&self, data: &Data<R>) -> Option<NoBound> {
        data.no_bound().or(self.refusal.as_ref()).cloned()
    }

    /// The fields of the last certificate.
    pub fn answer(&self) -> CertifiedFields {
        self.fields.widened()
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
            let cell = parts.roots().find(|&part| parts.support(part) == Support::None);
            let reason = NoBound::held_by_nothing(assembled.problem(), cell.unwrap_or(0));
            self.refusal = Some(reason);
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

    /// Whether what a cell lacks of balance leaves through a side of the domain: else cells that store keep it.
    pub fn hands_on(&self) -> bool {
        self.hands_on
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
        let CertifiedFields { vertices: s, tau, .. } = &mut self.fields;
        let (law, given) = (assembled.law(), data.given(assembled, &[])?);
        let distortions = discretization.metric.distortions;
        averages::fill(&discretization.cells, (assembled.cells(), None), distortions, u, s, tau)?;
        conforming::impose(&discretization.mesh, &discretization.edges, u, law, given.ends, s)?;
        self.fields.open(&discretization, &given, law)
    }
}
