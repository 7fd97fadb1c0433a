//! One solve at a time, each from nothing and for the scene's own inputs: where no tick goes.
//!
//! That is a domain that contact alone or nothing holds, whose parts have to be shifted, which the kernel's solver
//! does and its tick does not; and sweeps in f32 on residuals in f64.

use signorini_bound::certificate::Certificate;
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::{QUADS, Row, Rows, TRIANGLES};
use signorini_kernel::solver::{Outcome, Settings, Solver, Status};
use signorini_kernel::{Error as KernelError, contact};

use super::{Engine, TickSolution, completed};
use signorini_certify::{Certifier, Data, ErrorBound, NoBound};
use signorini_problem::scalar::Scalar;
use signorini_problem::{Assembled, Parts, Problem};
use signorini_scene::error::Result;
use signorini_scene::setting::{Omega, Precision, Setting};
use signorini_solve::{Mixed, Options, Ran, ScalarKind, centre_floating, status_name, unfit};

type Refused<T> = std::result::Result<T, KernelError>;

/// Sweeps from where u stands.
type Sweep<'p, R> = Box<dyn FnMut(Settings<R>, &mut [R]) -> Refused<Outcome<R>> + 'p>;

/// Sweeps before the first certificate, where certificates tell when to end.
const FIRST: u32 = 16;

struct Single<'p, R: Scalar> {
    problem: &'p Problem,
    parts: Parts,
    assembled: Assembled<'p, R>,
    certifier: Option<(Certifier<R>, Data<R>)>,
    settings: Settings<R>,
    /// The share of the bound that may be left to sweeps, where that ends a solve.
    share: Option<f64>,
    sweep: Sweep<'p, R>,
    u: Vec<R>,
    outcome: Option<Outcome<R>>,
    certificate: Option<Certificate<R>>,
}

/// Lends it, in the scalar of the setting.
pub(super) fn with<T>(
    problem: &Problem,
    then: impl FnOnce(&mut dyn Engine) -> Result<T>,
) -> Result<T> {
    let setting = completed(&problem.scene);
    let parts = Parts::examine(problem)?;
    match setting.scalar {
        Some(Precision::F32) => then(&mut Single::<f32>::swept(problem, parts, &setting)?),
        Some(Precision::Mixed) => then(&mut Single::mixed(problem, parts, &setting)?),
        _ => then(&mut Single::<f64>::swept(problem, parts, &setting)?),
    }
}

impl<'p> Single<'p, f64> {
    fn mixed(problem: &'p Problem, parts: Parts, setting: &Setting) -> Result<Self> {
        let mut mixed = Mixed::new(problem, &parts).map_err(unfit::<f32>(&problem.scene))?;
        let sweep = move |settings, u: &mut [f64]| Ok(mixed.run(settings, u)?.outcome);
        let share = setting.share.unwrap_or(crate::full::SHARE);
        let asked = setting.certificate && setting.sweeps.is_none();
        let single = Self::new(problem, parts, setting, Box::new(sweep))?;
        Ok(Self { share: asked.then_some(share), ..single })
    }
}

impl<'p, R: Scalar> Single<'p, R> {
    /// By the kernel's solver, to the tolerance of `solve`.
    fn swept(problem: &'p Problem, parts: Parts, setting: &Setting) -> Result<Self> {
        let mut assembled = Assembled::<R>::new(problem).map_err(unfit::<R>(&problem.scene))?;
        assembled.set_parts(&parts);
        let run = match problem.mesh.quads.is_empty() {
            true => run::<R, TRIANGLES>,
            false => run::<R, QUADS>,
        };
        let sweep = move |settings, u: &mut [R]| run(&assembled, settings, u);
        Self::new(problem, parts, setting, Box::new(sweep))
    }

    fn new(
        problem: &'p Problem,
        parts: Parts,
        setting: &Setting,
        sweep: Sweep<'p, R>,
    ) -> Result<Self> {
        let unfit = unfit::<R>(&problem.scene);
        let mut assembled = Assembled::<R>::new(problem).map_err(&unfit)?;
        assembled.set_parts(&parts);
        let certifier = match setting.certificate {
            true => {
                let certifier = Certifier::new(problem, &parts, &assembled);
                Some((certifier.map_err(&unfit)?, Data::new(problem)?))
            }
            false => None,
        };
        Ok(Self {
            problem,
            parts,
            u: assembled.start(),
            assembled,
            certifier,
            settings: settings(setting),
            share: None,
            sweep,
            outcome: None,
            certificate: None,
        })
    }

    fn advance(&mut self) -> Refused<u32> {
        let Some(share) = self.share else {
            let outcome = (self.sweep)(self.settings, &mut self.u)?;
            self.certify()?;
            self.outcome = Some(outcome);
            return Ok(outcome.sweeps);
        };
        let (mut settings, mut sweeps) = (Settings { max_sweeps: FIRST, ..self.settings }, 0);
        loop {
            let outcome = (self.sweep)(settings, &mut self.u)?;
            sweeps += outcome.sweeps;
            self.certify()?;
            let left =
                self.certificate.as_ref().map(|known| known.algebraic.wide() / known.total.wide());
            let enough = left.is_some_and(|left| left <= share);
            let outcome = Outcome { sweeps, ..outcome };
            if enough || outcome.status != Status::OutOfSweeps || sweeps >= self.settings.max_sweeps
            {
                let status = if enough { Status::Converged } else { outcome.status };
                self.outcome = Some(Outcome { status, ..outcome });
                return Ok(sweeps);
            }
            if let Relaxation::Adaptive(_) = settings.relaxation {
                settings.relaxation = Relaxation::Adaptive(outcome.omega);
            }
            settings.max_sweeps = sweeps;
        }
    }

    fn certify(&mut self) -> Refused<()> {
        if let Some((certifier, data)) = &mut self.certifier {
            self.certificate = certifier.certify(&self.parts, &self.assembled, data, &self.u)?;
        }
        Ok(())
    }
}

fn run<R: Scalar, const WIDTH: usize>(
    assembled: &Assembled<R>,
    settings: Settings<R>,
    u: &mut [R],
) -> Refused<Outcome<R>> {
    let system = assembled.system()?;
    let mut memory = vec![Row::<R, u32, WIDTH>::EMPTY; system.counts().unknowns()];
    let mut rows = Rows::new(assembled.edges(), &mut memory)?;
    Solver::<R>::new(settings)?.run(&system, &mut rows, u)
}

/// The tolerance of `solve`, and the ω and sweeps of the setting.
fn settings<R: Scalar>(setting: &Setting) -> Settings<R> {
    let scalar = match setting.scalar {
        Some(Precision::F32) => ScalarKind::F32,
        _ => ScalarKind::F64,
    };
    let max_sweeps = setting.sweeps.unwrap_or(1_000_000);
    let relaxation = match setting.omega {
        Omega::Auto => Relaxation::Adaptive(R::ONE),
        Omega::Fixed(omega) => Relaxation::Fixed(R::narrow(omega)),
    };
    Settings { relaxation, ..Options { scalar, max_sweeps, ..Options::default() }.settings() }
}

impl<R: Scalar> Engine for Single<'_, R> {
    fn tick(&mut self, _: &[f64]) -> Result<u32> {
        self.restart();
        self.advance().map_err(unfit::<R>(&self.problem.scene))
    }

    fn restart(&mut self) {
        self.u = self.assembled.start();
    }

    fn answer(&self, problem: &Problem) -> Result<TickSolution> {
        let unfit = unfit::<R>(&self.problem.scene);
        let (assembled, counts) = (&self.assembled, problem.topology.counts);
        let mut fluxes = vec![R::ZERO; self.u.len()];
        assembled.recover(&self.u, &[], &mut fluxes).map_err(&unfit)?;
        let boundary = assembled.boundary().map_err(&unfit)?;
        let force = contact::force(counts, &boundary, assembled.law(), &self.u, &fluxes).wide();
        let touching = |at| contact::is_active(counts, assembled.law(), &self.u, at);
        let wide = |numbers: &[R]| -> Vec<f64> { numbers.iter().map(|x| x.wide()).collect() };
        let certified = self.certifier.as_ref().filter(|_| self.certificate.is_some());
        let certified = certified.map(|(certifier, _)| certifier.answer());
        let outcome = self.outcome.as_ref();
        let mut answer = TickSolution {
            status: outcome.map_or(Status::OutOfSweeps, |outcome| outcome.status),
            ended: outcome.map_or("out-of-sweeps", |outcome| status_name(outcome.status)),
            ran: Ran::Sweeps,
            factored: None,
            outputs: Vec::new(),
            sweeps: outcome.map_or(0, |outcome| outcome.sweeps),
            omega: outcome.map_or(0.0, |outcome| outcome.omega.wide()),
            residual: outcome.map_or(f64::MAX, |outcome| outcome.residual.scaled().wide()),
            u: wide(&self.u),
            flux: wide(&fluxes),
            force,
            active: (0..counts.contact).map(touching).collect(),
            bound: self.certificate.as_ref().map(ErrorBound::new),
            no_bound: match (&self.certificate, &self.certifier) {
                (Some(_), _) => None,
                (None, Some((certifier, data))) => certifier.no_bound(problem, &self.parts, data),
                (None, None) => Some(NoBound::NotAsked),
            },
            certified: certified.unwrap_or_default(),
        };
        if self.parts.counts.floating > 0 {
            centre_floating(problem, &self.parts, &mut answer.u, &mut answer.certified.vertices);
        }
        Ok(answer)
    }
}
