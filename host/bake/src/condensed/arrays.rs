//! Everything of a condensed scene in the scalar of the target: what the module's statics will hold.

use signorini_contact::Condensed;
use signorini_contact::certificate::Corner;
use signorini_contact::dense::blocks::{Block, SIDE, padded};
use signorini_contact::dense::rule::{Phases, Rule as _};
use signorini_contact::method::Sweeps;
use signorini_contact::{outputs::Output, sides, spans::SpanColumns};
use signorini_kernel::{Error, error::Array};

use super::balance::Balance;
use super::bound::{Bound, Ends};
use super::modes::Modes;
use super::start::{InitialState, best_omega};
use super::steps::Steps;
use crate::Bakes;
use crate::narrow::{filled_up, is_monotone, matrix, narrow, pairs, spans};
use crate::room::Room;
use signorini_condense::CondensedModel;
use signorini_image::chosen::WorstCase;
use signorini_problem::inputs::ranges;
use signorini_problem::scalar::Scalar;
use signorini_scene::setting::{Omega, Setting, Start as From};

/// How much the solver of a baked model may do in a tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Work {
    /// Exchanges of the exact method; `None` leaves it out, with its memory.
    pub pivots: Option<u32>,
    /// Sweeps: all there is without the exact method, and what follows where its exchanges do not suffice.
    pub sweeps: u32,
}

/// The arrays that a tick solves with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Solver {
    /// Nothing: no edge is in contact.
    Linear,
    /// Sweeps alone.
    Sweeps,
    /// At most so many exchanges, and sweeps where they do not suffice.
    Exchanges(u32),
    /// Exchanges in two phases, which come to their end.
    TwoPhases,
}

/// A condensed scene in the scalar `R`.
#[derive(Debug, Clone)]
pub struct Baked<R: Scalar> {
    /// n
    pub contact: usize,
    /// m, the constant 1 included; amplitudes of modes are none.
    pub inputs: usize,
    /// The modes of the transfer coefficient that an input changes.
    pub modes: Option<Modes<R>>,
    /// What a step in time hands on to the next.
    pub steps: Option<Steps<R>>,
    /// The limits of the solver.
    pub work: Work,
    /// The factor of the sweeps and when they end.
    pub sweeps: Sweeps<R>,
    /// Whether every tick starts anew, from the answer to the scene's own inputs.
    pub cold: bool,
    /// Whether the data allow for a bound, even if it is left out.
    pub has_bound: bool,
    /// Whether exchanges in two phases come to an end from every state, for every load: the matrix as the target has it
    /// is positive definite, with no positive entry off the diagonal.
    pub is_monotone: bool,
    /// Instructions that no tick exceeds, where that is proved and they were counted.
    pub worst_instructions: Option<u64>,
    pub(super) matrix: Vec<Block<R>>,
    pub(super) start: InitialState<R>,
    pub(super) load: Vec<R>,
    pub(super) limits: Vec<[R; 2]>,
    /// By columns: one where no input changes a span, else one for each input; empty where no flux has a limit.
    pub(super) spans: Vec<R>,
    /// Room that inputs leave in spans that they change.
    pub(super) rooms: Vec<Room<R>>,
    /// Of parts that contact alone holds.
    pub(super) parts: Vec<Balance<R>>,
    /// Of the inputs without the constant; empty where no range is declared.
    pub(super) ranges: Vec<[R; 2]>,
    /// Rows that inputs without a range have to meet.
    pub(crate) exclusions: Vec<R>,
    /// Outputs that are the bound over time.
    pub(crate) windows: Vec<usize>,
    pub(super) outputs: Vec<Output<Vec<R>, R>>,
    pub(super) bound: Result<Bound<R>, String>,
}

impl<R: Bakes> Baked<R> {
    /// [`Baked::new`] from `x`, in which the first tick begins.
    pub(super) fn beginning(
        condensate: &CondensedModel,
        x: &[f64],
        work: Work,
        certified: bool,
    ) -> Result<Self, Error> {
        let n = condensate.contact;
        let bound = match &condensate.certificate {
            Err(reason) => Err(reason.clone()),
            Ok(_) if !certified => Err("certificate = false leaves it out".to_owned()),
            Ok(form) => Ok(Bound::new(condensate, form)),
        };
        let order = f64::from(u32::try_from(n.max(1)).unwrap_or(u32::MAX));
        let tolerance = R::narrow(4.0 * order.sqrt() * R::EPSILON.wide());
        let omega = R::narrow(best_omega(condensate, 1.0));
        let baked = Self {
            contact: n,
            inputs: condensate.inputs,
            modes: None,
            steps: None,
            work,
            sweeps: Sweeps { omega, tolerance, most: work.sweeps },
            cold: false,
            has_bound: condensate.certificate.is_ok(),
            is_monotone: is_monotone::<R>(condensate),
            worst_instructions: None,
            matrix: matrix(condensate),
            start: InitialState::new(condensate, x, n > 0 && work.pivots.is_some())?,
            load: condensate.load.iter().flat_map(|column| filled_up(column)).collect(),
            limits: pairs(&condensate.limits),
            spans: spans(condensate)?,
            rooms: condensate.rooms.iter().map(Room::new).collect(),
            parts: condensate.balances.iter().map(Balance::new).collect(),
            ranges: ranges(condensate.ranges.get(1..).unwrap_or_default()),
            exclusions: Vec::new(),
            windows: Vec::new(),
            outputs: condensate.outputs.iter().map(|of| of.map(|c| narrow(c), R::narrow)).collect(),
            bound,
        };
        baked.check().map(|()| baked)
    }

    pub(super) fn solver(&self) -> Solver {
        match self.work.pivots {
            _ if self.contact == 0 => Solver::Linear,
            None => Solver::Sweeps,
            // Fewer than may be needed leave something to sweeps.
            Some(most) if self.is_monotone && most >= self.worst() => Solver::TwoPhases,
            Some(most) => Solver::Exchanges(most),
        }
    }

    /// What the record of sizes calls images like this one. A matrix of a single block leaves out the loops over others; limits
    /// and modes are recorded together.
    pub fn kind(&self) -> &'static str {
        match self.solver() {
            _ if self.is_limited() || self.modes.is_some() => ", limits and modes",
            Solver::Linear => "linear, condensed",
            Solver::Sweeps => ", condensed, swept",
            _ if self.bound.as_ref().is_ok_and(|bound| bound.jump.is_some()) => {
                ", condensed, on quads"
            }
            _ if self.contact <= SIDE => "levee, condensed",
            _ => "unknowns, condensed",
        }
    }

    /// Exchanges that no tick exceeds, from whatever state and for whatever load; nothing where that is not proved.
    pub fn worst_exchanges(&self) -> Option<u32> {
        match self.solver() {
            Solver::Linear => Some(0),
            Solver::TwoPhases => Some(self.worst()),
            Solver::Sweeps | Solver::Exchanges(_) => None,
        }
    }

    /// What no tick exceeds, and whether that is proved. It is not where an input has no range, whose loads the scalar may not hold. Of
    /// steps in time it is, whatever the ranges: what a step begins from has none, and loads that the scalar cannot hold are refused
    /// before any exchange.
    pub fn worst_case(&self) -> WorstCase {
        let is_finite = |[lo, hi]: &[R; 2]| lo.finite() && hi.finite();
        let has_ranges = self.inputs == 1 || !self.ranges.is_empty();
        let is_bounded = has_ranges && self.ranges.iter().all(is_finite) || self.steps.is_some();
        match self.worst_exchanges() {
            Some(most) => WorstCase {
                exchanges: Some(most),
                instructions: self.worst_instructions,
                proven: is_bounded,
            },
            None => WorstCase { exchanges: self.work.pivots, ..WorstCase::default() },
        }
    }

    /// The same as a setting has it: its ω, its start, and where it gives a number of sweeps no end before
    /// them but at a fixed point.
    pub fn with_setting(self, setting: &Setting) -> Self {
        let mut sweeps = self.sweeps;
        if let Omega::Fixed(omega) = setting.omega {
            let diagonal = self.modes.as_ref().map_or(1.0, |modes| modes.diagonal);
            sweeps.omega = R::narrow(omega / diagonal);
        }
        if setting.sweeps.is_some() {
            sweeps.tolerance = R::ZERO;
        }
        Self { sweeps, cold: setting.start == From::Cold, ..self }
    }

    /// The same model with other limits, the exact method staying in or out.
    pub fn with_work(self, work: Work) -> Self {
        Self { work, sweeps: Sweeps { most: work.sweeps, ..self.sweeps }, ..self }
    }

    /// The features of the kernel that it needs.
    pub fn kernel_features(&self) -> Vec<&'static str> {
        let limited = self.is_limited().then_some("limited");
        limited.into_iter().chain(self.modes.is_some().then_some("transfer")).collect()
    }

    /// Exchanges in phases from whatever state.
    fn worst(&self) -> u32 {
        Phases::default().most(self.contact, self.is_limited()) as u32
    }

    /// Whether a flux has a limit.
    pub fn is_limited(&self) -> bool {
        !self.spans.is_empty()
    }

    /// Spans that a tick works out, padding included: none where no input changes one.
    pub fn varying_spans(&self) -> usize {
        let n = padded(self.contact);
        if self.spans.len() > n { n } else { 0 }
    }

    /// Columns of F.
    pub fn columns(&self) -> usize {
        self.bound.as_ref().map_or(0, |bound| bound.factor.norms.len())
    }

    /// Why there is no certificate, if so.
    pub fn without_bound(&self) -> Option<&str> {
        self.bound.as_ref().err().map(String::as_str)
    }

    /// Where s − ψ comes from at the ends of contact edges, where a flux has a limit.
    pub(super) fn sides(&self) -> Option<sides::Baked<'_, R>> {
        self.bound.as_ref().ok()?.sides.as_ref().map(Ends::view)
    }

    /// Lends the model, as the generated module has it.
    pub fn with_model<T>(&self, then: impl FnOnce(&Condensed<R>) -> T) -> T {
        let outputs: Vec<_> = self.outputs.iter().map(Output::view).collect();
        let corners = self.bound.as_ref().map(|bound| &bound.corners[..]).unwrap_or_default();
        let corners: Vec<_> = corners
            .iter()
            .map(|(edge, excess, energy)| Corner { edge: *edge, excess, energy: *energy })
            .collect();
        let rooms: Vec<_> = self.rooms.iter().map(Room::view).collect();
        let parts: Vec<_> = self.parts.iter().map(Balance::view).collect();
        then(&Condensed {
            contact: self.contact,
            matrix: &self.matrix,
            x: &self.start.x,
            start: self.start.view(),
            load: &self.load,
            limits: &self.limits,
            spans: SpanColumns::new(&self.spans).within(&rooms),
            parts: &parts,
            outputs: &outputs,
            certificate: self.bound.as_ref().ok().map(|bound| bound.form(&corners)),
            has_bound: self.has_bound,
        })
    }

    /// `Ok` where the scalar holds all numbers.
    pub(super) fn check(&self) -> Result<(), Error> {
        let finite = |of, numbers: &[R]| match numbers.iter().position(|x| !x.finite()) {
            Some(at) => Err(Error::NotFinite { of, at }),
            None => Ok(()),
        };
        finite(Array::Load, &self.load)?;
        let steps = self.steps.iter().flat_map(Steps::numbers);
        steps.into_iter().try_for_each(|numbers| finite(Array::Coefficients, numbers))?;
        for output in &self.outputs {
            for numbers in output.columns() {
                finite(Array::Fluxes, numbers)?;
            }
        }
        let Ok(bound) = &self.bound else { return Ok(()) };
        let laws = self.modes.iter().flat_map(|modes| &modes.laws);
        for form in std::iter::once(&bound.factor).chain(&bound.jump).chain(laws) {
            finite(Array::MatrixValues, &form.columns)?;
        }
        finite(Array::Coefficients, &[bound.unit, bound.stability, R::ONE / bound.unit])
    }
}
