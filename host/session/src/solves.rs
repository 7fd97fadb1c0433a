//! One solve per tick, where the kernel's tick cannot go.
//!
//! That is a domain that contact alone or nothing holds, whose parts have to be shifted, which the kernel's solver
//! does and its tick does not; and sweeps in f32 on residuals in f64. A cold session solves each tick from nothing, a warm one
//! from the last answer, with the relaxation factor found there.

mod sweeps;
mod touching;

use signorini_bound::certificate::Certificate;
use signorini_certify::{
    Certified, CertifiedFields, Certifier, Data, Enclosed, ErrorBound, NoBound,
};
use signorini_kernel::relaxation::{Relaxation, Search};
use signorini_kernel::solver::{Outcome, Settings, Status};
use signorini_problem::scalar::{Scalar, widened};
use signorini_problem::{Assembled, Parts, Problem};
use signorini_scene::error::{InputError, Result};
use signorini_scene::setting::{Omega, Precision, Setting};
use signorini_solve::{Mixed, Options, Solution, read_off, unfit};

use crate::saved::{SavedSession, check_length, narrowed};
use crate::{Session, Then, scalar_kind};
use sweeps::{Refused, Sweeps};

/// Sweeps before the first certificate, where certificates tell when to end.
const FIRST: u32 = 16;

/// A solve per tick.
pub(crate) struct Solves<R: Scalar, S> {
    parts: Parts,
    swept: S,
    /// `None` where no certificate is asked for.
    certifier: Option<(Certifier<R>, Data<R>)>,
    enclosed: Enclosed,
    settings: Settings<R>,
    /// The share of the bound that may be left to sweeps, where that ends a solve.
    share: Option<f64>,
    /// Whether a tick starts from the last one.
    is_warm: bool,
    /// Where the first one starts.
    start: Vec<R>,
    /// Whether `u` is an answer to start from.
    is_known: bool,
    u: Vec<R>,
    /// Whether a contact edge was at its gap in that answer; nothing before the first tick.
    active: Vec<bool>,
    /// `None` before the first tick.
    outcome: Option<Outcome<R>>,
    certificate: Option<Certificate<R>>,
    /// The ω that the last solve has found.
    omega: Option<R>,
}

/// Calls `then` with a session of cold solves, in the scalar of the setting.
pub(crate) fn with_solves(problem: &Problem, setting: &Setting, then: Then) -> Result<()> {
    let certificate = setting.certificate;
    match setting.scalar {
        Some(Precision::Mixed) => {
            let parts = Parts::examine(problem)?;
            let mixed = Mixed::new(problem, &parts).map_err(unfit::<f32>(&problem.scene))?;
            let by_share = certificate && setting.sweeps.is_none();
            let share = setting.share.unwrap_or(signorini_bake::full::SHARE);
            let solves = Solves::new(problem, mixed, settings(setting), certificate)?;
            then(&mut Solves { share: by_share.then_some(share), ..solves })
        }
        Some(Precision::F32) => then(&mut swept::<f32>(problem, settings(setting), certificate)?),
        _ => then(&mut swept::<f64>(problem, settings(setting), certificate)?),
    }
}

/// A session of certified warm solves. The first starts from the means that `start` leaves in its slice, one per edge.
///
/// # Errors
/// Numbers that the scalar type cannot hold; what `start` fails with.
pub(crate) fn warm<'p, R: Scalar>(
    problem: &'p Problem,
    settings: Settings<R>,
    start: impl FnOnce(&mut [R]) -> Result<()>,
) -> Result<Box<dyn Session + 'p>> {
    let mut solves = Solves { is_warm: true, ..swept(problem, settings, true)? };
    start(&mut solves.start)?;
    Ok(Box::new(solves))
}

fn swept<'p, R: Scalar>(
    problem: &'p Problem,
    settings: Settings<R>,
    is_certified: bool,
) -> Result<Solves<R, Assembled<'p, R>>> {
    let assembled = Assembled::<R>::new(problem).map_err(unfit::<R>(&problem.scene))?;
    Solves::new(problem, assembled, settings, is_certified)
}

/// The tolerance of `solve`, and the ω and sweeps of the setting.
fn settings<R: Scalar>(setting: &Setting) -> Settings<R> {
    let relaxation = match setting.omega {
        Omega::Auto => Relaxation::Adaptive(R::ONE),
        Omega::Fixed(omega) => Relaxation::Fixed(R::narrow(omega)),
    };
    let options =
        Options { scalar: scalar_kind::<R>(), max_sweeps: setting.sweeps, ..Options::default() };
    Settings { relaxation, ..options.settings() }
}

impl<'p, R: Scalar, S: Sweeps<'p, R>> Solves<R, S> {
    fn new(
        problem: &Problem,
        mut swept: S,
        settings: Settings<R>,
        is_certified: bool,
    ) -> Result<Self> {
        let parts = Parts::examine(problem)?;
        swept.assembled_mut().set_parts(&parts);
        let mut enclosed = Enclosed::default();
        let certifier = || certifier(problem, &parts, swept.assembled(), &mut enclosed);
        let certifier = is_certified.then(certifier).transpose()?;
        Ok(Self {
            parts,
            u: swept.assembled().start(),
            start: swept.assembled().start(),
            is_known: false,
            active: Vec::new(),
            swept,
            certifier,
            enclosed,
            settings,
            share: None,
            is_warm: false,
            outcome: None,
            certificate: None,
            omega: None,
        })
    }

    /// Sets u to where the next solve starts.
    fn begin(&mut self) {
        let assembled = self.swept.assembled();
        if !self.is_warm {
            self.u = assembled.start();
            return;
        }
        if !self.is_known {
            self.u.copy_from_slice(&self.start);
        }
        let unknowns = assembled.edges().counts().unknowns();
        self.u[unknowns..].copy_from_slice(assembled.dirichlet());
        touching::go_with_gaps(assembled, &mut self.u, &self.active);
    }

    fn advance(&mut self) -> Refused<u32> {
        let omega = self.omega.filter(|_| self.is_warm);
        let relaxation = omega.map_or(self.settings.relaxation, Relaxation::Adaptive);
        let settings = Settings { relaxation, ..self.settings };
        let outcome = match self.share {
            None => self.solve(settings)?,
            Some(share) => self.solve_to(share, settings)?,
        };
        self.outcome = Some(outcome);
        self.is_known = outcome.status != Status::NotFinite;
        self.active.clear();
        if self.is_known {
            self.omega = Some(outcome.omega);
            self.active = touching::edges(self.swept.assembled(), &self.u);
        }
        Ok(outcome.sweeps)
    }

    fn solve(&mut self, settings: Settings<R>) -> Refused<Outcome<R>> {
        let outcome = self.swept.run(settings, &mut self.u)?;
        self.certificate = match &mut self.certifier {
            Some((certifier, data)) if outcome.status != Status::NotFinite => {
                certifier.certify(&self.parts, self.swept.assembled(), data, &self.u)?
            }
            _ => None,
        };
        Ok(outcome)
    }

    /// Solves until certificates, each after as many sweeps as all before it, leave no more than a share to sweeps.
    fn solve_to(&mut self, share: f64, settings: Settings<R>) -> Refused<Outcome<R>> {
        let (mut settings, mut sweeps) = (Settings { max_sweeps: FIRST, ..settings }, 0);
        loop {
            let outcome = self.solve(settings)?;
            sweeps += outcome.sweeps;
            let left =
                self.certificate.as_ref().map(|known| known.algebraic.wide() / known.total.wide());
            let outcome = Outcome { sweeps, ..outcome };
            if left.is_some_and(|left| left <= share) {
                return Ok(Outcome { status: Status::Converged, ..outcome });
            }
            if outcome.status != Status::OutOfSweeps || sweeps >= self.settings.max_sweeps {
                return Ok(outcome);
            }
            if let Relaxation::Adaptive(_) = settings.relaxation {
                settings.relaxation = Relaxation::Adaptive(outcome.omega);
            }
            settings.max_sweeps = sweeps;
        }
    }

    /// The bound of the last tick, and the fields that it is about.
    fn certified(&self, status: Status) -> Certified {
        let without = |reason| Certified {
            bound: None,
            no_bound: Some(reason),
            answer: CertifiedFields::default(),
        };
        match &self.certifier {
            None => without(NoBound::not_asked()),
            Some(_) if status == Status::NotFinite => without(NoBound::overflow::<R>()),
            Some((certifier, data)) => Certified {
                bound: self.certificate.as_ref().map(ErrorBound::new),
                no_bound: certifier.no_bound(data),
                answer: certifier.answer(),
            },
        }
    }
}

/// Ways out and data for certificates of `problem`.
fn certifier<R: Scalar>(
    problem: &Problem,
    parts: &Parts,
    assembled: &Assembled<R>,
    enclosed: &mut Enclosed,
) -> Result<(Certifier<R>, Data<R>)> {
    let certifier = Certifier::new(problem, parts, assembled);
    Ok((certifier.map_err(unfit::<R>(&problem.scene))?, Data::again(problem, enclosed)?))
}

impl<'p, R: Scalar, S: Sweeps<'p, R>> Session for Solves<R, S> {
    fn pose(&mut self, at: &Problem) -> Result<()> {
        self.parts = Parts::examine(at)?;
        let assembled = self.swept.assembled_mut();
        assembled.set_parts(&self.parts);
        assembled.set_loads(&at.loads).map_err(unfit::<R>(&at.scene))?;
        if let Some(posed) = &mut self.certifier {
            *posed = certifier(at, &self.parts, assembled, &mut self.enclosed)?;
        }
        Ok(())
    }

    fn tick(&mut self, _: &[f64]) -> Result<u32> {
        self.begin();
        self.advance().map_err(unfit::<R>(&self.swept.assembled().problem().scene))
    }

    fn restart(&mut self) {
        (self.outcome, self.omega, self.is_known) = (None, None, false);
        self.active.clear();
    }

    fn saved(&self) -> Option<SavedSession> {
        self.outcome?;
        let u = if self.is_known { widened(&self.u) } else { Vec::new() };
        let active = self.active.clone();
        Some(SavedSession::Solve { u, active, omega: self.omega.map(R::wide) })
    }

    fn restore(&mut self, saved: &SavedSession) -> Result<()> {
        let SavedSession::Solve { u, active, omega } = saved else { return saved.foreign() };
        if !active.is_empty() {
            let contact = self.swept.assembled().edges().counts().contact;
            check_length("session.active", active.len(), contact)?;
        }
        let omega = narrowed("session.omega", omega.as_slice(), omega.iter().len())?.pop();
        let is_one = |omega| Search::checked(Relaxation::Adaptive(omega)).is_ok();
        if !omega.is_none_or(is_one) {
            return Err(InputError::new("session.omega: expected a number in [1, 2)").into());
        }
        if !u.is_empty() {
            self.u = narrowed("session.u", u, self.u.len())?;
            self.is_known = true;
        }
        self.omega = omega;
        self.active.clone_from(active);
        Ok(())
    }

    fn answer(&self, at: &Problem) -> Result<Solution> {
        let Some(outcome) = &self.outcome else { return Ok(Solution::default()) };
        let (assembled, u) = (self.swept.assembled(), [&self.u[..], &[]]);
        let certified = self.certified(outcome.status);
        let read = read_off(at, &self.parts, assembled, outcome, u, certified);
        let read = read.map_err(unfit::<R>(&at.scene))?;
        Ok(Solution { scalar: scalar_kind::<R>(), ..read })
    }
}
