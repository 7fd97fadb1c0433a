//! The controller of a baked module, on this machine and on the same numbers.

use signorini_contact::dense::blocks::{Block, SIDE, count, padded};
use signorini_contact::modes::ModalStorage;
use signorini_contact::steps::StepStorage;
use signorini_contact::storage::{Storage, TableauStorage};
use signorini_device::condensed::{ControllerStorage, Effort};
use signorini_device::controller::{self, Answer, Outputs, Scene, Window};
use signorini_kernel::Error;
use signorini_kernel::limits::{Deadline, Limits};
use signorini_kernel::report::Report;

use super::arrays::Baked;
use super::solver::DeskSolver;
use super::visited::Visited;
use crate::desk::{Terms, Values};
use crate::{Bakes, state};

/// The controller of a condensed scene.
#[derive(Debug)]
pub struct Controller<'b, R: Bakes> {
    baked: &'b Baked<R>,
    own: controller::Controller<Desk<'b, R>>,
}

impl<'b, R: Bakes> Controller<'b, R> {
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
        R::answer(self, inputs)
    }

    pub(crate) fn answer(&mut self, inputs: &[R]) -> Result<(Vec<R>, Report<R>), Error> {
        let Answer { outputs: Values(outputs), report } = self.own.tick(Terms::new(inputs))?;
        Ok((outputs, report))
    }

    /// The edges that the last tick looked at.
    pub fn visited(&self) -> Visited {
        let shared = self.own.storage().shared();
        let visited = Visited::new::<R>(shared.open(), shared.combination());
        match self.own.storage() {
            DeskStorage::Plain(_) | DeskStorage::Stepped(_) => visited,
            DeskStorage::Modal(of) => Visited { follows: of.solver.has_begun_anew, ..visited },
        }
    }

    /// The numbers that the certificate of the last tick was drawn from.
    pub fn combination(&self) -> &[R] {
        self.own.storage().shared().combination()
    }

    /// Numbers that the last tick has left for the next one, in a model that steps in time.
    pub fn past(&self) -> &[R] {
        match (self.own.storage(), &self.baked.steps) {
            (DeskStorage::Stepped(of), Some(steps)) => {
                of.iterate.terms().map_or(&steps.begin, |terms| &terms[self.baked.inputs..])
            }
            _ => &[],
        }
    }

    /// The bound of the evolution until the end of the last tick, of steps in time that have one.
    pub fn window(&self) -> Option<Window<R>> {
        self.own.window()
    }

    /// The bytes of the `State` that firmware has after the last tick of `scene`, by its number; nothing where ticks are no steps in time.
    pub fn state(&self, scene: u64) -> Option<Vec<u8>> {
        let DeskStorage::Stepped(of) = self.own.storage() else { return None };
        let mut numbers = vec![R::ZERO; self.baked.handed_on()];
        of.hand_on(&mut numbers);
        Some(state::bytes(scene, &numbers))
    }

    /// Goes on from there.
    ///
    /// # Errors
    /// The bytes of a state of another scene, or damaged ones: nothing has changed then.
    pub fn restore(&mut self, scene: u64, bytes: &[u8]) -> Result<(), Error> {
        let numbers: Vec<R> = state::numbers(scene, bytes)?;
        match self.own.storage_mut() {
            DeskStorage::Stepped(of) if numbers.len() == self.baked.handed_on() => {
                of.take_over(&numbers);
                Ok(())
            }
            _ => Err(Error::ForeignState),
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
struct Desk<'b, R: Bakes>(&'b Baked<R>);

impl<R: Bakes> Scene for Desk<'_, R> {
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

    const TELLS_WINDOW: bool = true;

    fn tell(&self, Values(outputs): &mut Values<R>, window: R) {
        self.0.windows.iter().for_each(|&at| outputs[at] = window);
    }

    fn lend<T>(&self, take: impl FnOnce(&Baked<R>, &()) -> T) -> T {
        take(self.0, &())
    }
}

/// Iterate and scratch.
type Shared<R> = Storage<Vec<R>, Vec<u8>, Vec<R>, Vec<R>>;
type Step<R> = StepStorage<Vec<R>, Vec<u8>, Vec<R>, Vec<R>, Vec<R>>;
type Modal<R> = ModalStorage<Vec<R>, Vec<u8>, Vec<R>, Vec<R>, Vec<Block<R>>, Vec<R>, R>;

/// The memory of each kind of model.
#[derive(Debug)]
enum DeskStorage<R: Bakes> {
    Plain(ControllerStorage<Shared<R>, DeskSolver<R>>),
    Stepped(ControllerStorage<Step<R>, DeskSolver<R>>),
    Modal(ControllerStorage<Modal<R>, DeskSolver<R>>),
}

impl<R: Bakes> DeskStorage<R> {
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
        let terms = zeros(baked.terms());
        match (&baked.modes, &baked.steps) {
            (None, None) => Self::Plain(ControllerStorage { iterate: shared, solver }),
            (None, Some(_)) => {
                let iterate = StepStorage::of(shared, terms);
                Self::Stepped(ControllerStorage { iterate, solver })
            }
            (Some(_), _) => {
                let iterate = ModalStorage::of(shared, blocks, terms);
                Self::Modal(ControllerStorage { iterate, solver })
            }
        }
    }

    fn shared(&self) -> &Shared<R> {
        match self {
            Self::Plain(of) => &of.iterate,
            Self::Stepped(of) => of.iterate.shared(),
            Self::Modal(of) => of.iterate.shared(),
        }
    }
}

impl<R: Bakes> controller::Storage<R> for DeskStorage<R> {
    type Model<'m> = Baked<R>;
    type Setup<'m> = ();

    fn reset(&mut self) {
        match self {
            Self::Plain(of) => of.reset(),
            Self::Stepped(of) => of.reset(),
            Self::Modal(of) => of.reset(),
        }
    }

    fn window(&self, baked: &Baked<R>, (): &()) -> Option<Window<R>> {
        let Self::Stepped(of) = self else { return None };
        baked.with_model(|system| {
            let steps = baked.steps.as_ref()?.view(system);
            let [energy, seconds] = steps.window(of.iterate.terms())?;
            Some(Window { energy, seconds })
        })
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
        baked.with_model(|system| match (self, &baked.modes, &baked.steps) {
            (Self::Plain(of), ..) => of.tick(system, effort, terms, limits, deadline),
            (Self::Stepped(of), _, Some(steps)) => {
                of.tick(&steps.view(system), effort, terms, limits, deadline)
            }
            (Self::Modal(of), Some(modes), _) => {
                of.solver.has_begun_anew = false;
                let system = &modes.view(system);
                of.tick(system, effort, terms, limits, deadline)
            }
            (Self::Stepped(_) | Self::Modal(_), ..) => Err(Error::Relaxation),
        })
    }
}
