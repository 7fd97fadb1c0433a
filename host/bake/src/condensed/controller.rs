//! What the baked module does, on this machine and on the same numbers.

use signorini_contact::Condensed;
use signorini_contact::dense::Iterate;
use signorini_contact::dense::blocks::{Block, Blocks, SIDE, count, padded};
use signorini_contact::dense::ranges::Given;
use signorini_contact::method::{Linear, Method, Pivots, SolveSummary, Sweeps, TwoPhases};
use signorini_contact::modes::ModalStorage;
use signorini_contact::storage::{Storage, TableauStorage};
use signorini_device::condensed::{ControllerStorage, Effort, Solver};
use signorini_device::controller::{self, Answer, Outputs, Scene};
use signorini_kernel::Error;
use signorini_kernel::limits::{Deadline, Limits};
use signorini_kernel::report::Report;

use super::arrays::{self, Baked};
use super::visited::Visited;
use crate::desk::{Terms, Values};
use signorini_problem::scalar::Scalar;

/// The controller of a condensed scene.
#[derive(Debug)]
pub struct Controller<'b, R: Scalar> {
    baked: &'b Baked<R>,
    own: controller::Controller<Desk<'b, R>>,
}

impl<'b, R: Scalar> Controller<'b, R> {
    /// Before the first tick.
    pub fn new(baked: &'b Baked<R>) -> Self {
        let storage = DeskStorage::new(baked);
        Self { baked, own: controller::Controller::of(Desk(baked), storage) }
    }

    /// Answers for these values of the inputs: every output in order, and the report.
    ///
    /// # Errors
    /// Inputs outside their ranges, that are not finite, or so large that the answer or an output may overflow: the last answer stays.
    pub fn tick(&mut self, inputs: &[R]) -> Result<(Vec<R>, Report<R>), Error> {
        let Answer { outputs: Values(outputs), report } = self.own.tick(Terms::new(inputs))?;
        Ok((outputs, report))
    }

    /// The edges that the last tick looked at.
    pub fn visited(&self) -> Visited {
        let shared = self.own.storage().shared();
        let visited = Visited::new::<R>(shared.open(), shared.combination());
        match self.own.storage() {
            DeskStorage::Plain(_) => visited,
            DeskStorage::Modal(of) => Visited { follows: of.solver.has_begun_anew, ..visited },
        }
    }

    /// The numbers that the certificate of the last tick was drawn from.
    pub fn combination(&self) -> &[R] {
        self.own.storage().shared().combination()
    }

    /// The amplitudes of the last tick, where there are modes.
    pub fn amplitudes(&self) -> &[R] {
        match self.own.storage() {
            DeskStorage::Plain(_) => &[],
            DeskStorage::Modal(of) => {
                of.iterate.inputs().get(self.baked.inputs..).unwrap_or_default()
            }
        }
    }

    /// The scaled openings of the last tick; before the first, those that it begins with.
    pub fn x(&self) -> &[R] {
        let x = self.own.storage().shared().x();
        x.get(..self.baked.contact).unwrap_or(x)
    }
}

/// A baked scene, for its controller.
#[derive(Debug)]
struct Desk<'b, R: Scalar>(&'b Baked<R>);

impl<R: Scalar> Scene for Desk<'_, R> {
    type Scalar = R;
    type Inputs = Terms<R>;
    type Outputs = Values<R>;
    type Storage = DeskStorage<R>;

    fn ranges(&self) -> &[[R; 2]] {
        &self.0.ranges
    }

    fn exclusions(&self) -> &[R] {
        &self.0.exclusions
    }

    fn limits(&self) -> Limits<R> {
        Limits { error: R::ZERO, share: R::ZERO, sweeps: self.0.sweeps.most }
    }

    fn is_cold(&self) -> bool {
        self.0.cold
    }

    fn lend<T>(&self, take: impl FnOnce(&Baked<R>, &()) -> T) -> T {
        take(self.0, &())
    }
}

/// Iterate and scratch.
type Shared<R> = Storage<Vec<R>, Vec<u8>, Vec<R>, Vec<R>>;
type Modal<R> = ModalStorage<Vec<R>, Vec<u8>, Vec<R>, Vec<R>, Vec<Block<R>>, Vec<R>, R>;

/// The memory of either kind of model.
#[derive(Debug)]
enum DeskStorage<R: Scalar> {
    Plain(ControllerStorage<Shared<R>, DeskSolver<R>>),
    Modal(ControllerStorage<Modal<R>, DeskSolver<R>>),
}

impl<R: Scalar> DeskStorage<R> {
    /// x is what the first tick begins with, even if that is refused.
    fn new(baked: &Baked<R>) -> Self {
        let zeros = |length| vec![R::ZERO; length];
        let n = padded(baked.contact);
        let blocks = vec![[[R::ZERO; SIDE]; SIDE]; count(baked.contact)];
        let spans = zeros(baked.varying_spans());
        let mut shared = Storage::of(zeros(n), vec![0; n], zeros(baked.columns()), spans);
        baked.with_model(|model| _ = shared.memory(model));
        let tableau = TableauStorage::of(blocks.clone(), vec![0; n], [zeros(n), zeros(n)]);
        let solver = DeskSolver { solver: baked.solver(), tableau, has_begun_anew: false };
        match &baked.modes {
            None => Self::Plain(ControllerStorage { iterate: shared, solver }),
            Some(modes) => {
                let terms = zeros(baked.inputs + modes.count);
                let iterate = ModalStorage::of(shared, blocks, terms);
                Self::Modal(ControllerStorage { iterate, solver })
            }
        }
    }

    fn shared(&self) -> &Shared<R> {
        match self {
            Self::Plain(of) => &of.iterate,
            Self::Modal(of) => of.iterate.shared(),
        }
    }
}

impl<R: Scalar> controller::Storage<R> for DeskStorage<R> {
    type Model<'m> = Baked<R>;
    type Setup<'m> = ();

    fn reset(&mut self) {
        match self {
            Self::Plain(of) => of.reset(),
            Self::Modal(of) => of.reset(),
        }
    }

    fn tick<O: Outputs<R>, F: FnMut() -> u32>(
        &mut self,
        baked: &Baked<R>,
        (): &(),
        terms: &impl AsRef<[R]>,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Answer<O, R>, Error> {
        let pivots = baked.work.pivots.unwrap_or(0);
        let effort = &Effort { pivots, sweeps: baked.sweeps };
        baked.with_model(|system| match (self, &baked.modes) {
            (Self::Plain(of), _) => of.tick(system, effort, terms, limits, deadline),
            (Self::Modal(of), Some(modes)) => {
                of.solver.has_begun_anew = false;
                let system = &modes.view(system);
                of.tick(system, effort, terms, limits, deadline)
            }
            (Self::Modal(_), None) => Err(Error::Relaxation),
        })
    }
}

/// The method that the module has, chosen at run time.
#[derive(Debug)]
struct DeskSolver<R: Scalar> {
    solver: arrays::Solver,
    tableau: TableauStorage<Vec<Block<R>>, Vec<u8>, Vec<R>>,
    /// Whether this tick has another matrix than the one before.
    has_begun_anew: bool,
}

impl<R: Scalar> Solver<R> for DeskSolver<R> {
    type Method<'a> = DeskMethod<'a, R>;

    fn method<'a>(
        &'a mut self,
        model: &Condensed<'a, R>,
        pivots: u32,
        sweeps: Sweeps<R>,
    ) -> Result<DeskMethod<'a, R>, Error> {
        let tableau = &mut self.tableau;
        Ok(match self.solver {
            arrays::Solver::Linear => DeskMethod::Linear,
            arrays::Solver::Sweeps => DeskMethod::Sweeps(sweeps),
            arrays::Solver::TwoPhases => DeskMethod::TwoPhases(tableau.two_phases(model)?),
            arrays::Solver::Exchanges(_) => {
                DeskMethod::Pivots(tableau.method(model, pivots, sweeps)?)
            }
        })
    }

    fn reset(&mut self) {
        self.tableau.reset();
        self.has_begun_anew = true;
    }
}

/// One of the methods.
enum DeskMethod<'a, R> {
    Linear,
    Sweeps(Sweeps<R>),
    Pivots(Pivots<'a, R>),
    TwoPhases(TwoPhases<'a, R>),
}

impl<R: Scalar> Method<R> for DeskMethod<'_, R> {
    fn solve<F: FnMut() -> u32>(
        &mut self,
        matrix: &Blocks<R>,
        given: Given<R>,
        iterate: Iterate<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<SolveSummary, Error> {
        match self {
            Self::Linear => Linear.solve(matrix, given, iterate, deadline),
            Self::Sweeps(method) => method.solve(matrix, given, iterate, deadline),
            Self::Pivots(method) => method.solve(matrix, given, iterate, deadline),
            Self::TwoPhases(method) => method.solve(matrix, given, iterate, deadline),
        }
    }
}
