//! The controller of a baked scene: one set of methods, whatever its model.
//!
//! ```text
//!   Inputs ─► ranges ─► exclusions ─► cold start? ─► Storage::tick on the model ─► Answer { outputs, report }
//! ```
//! A module of `signorini bake` names its [`Scene`]: constants, types, and the memory that the model needs. The desk plays the
//! same controller on arrays that it owns. What a model does in a tick stands where its memory does: in
//! [`crate::condensed`] and in `device::full`'s `controller`.

pub use crate::window::Window;
use crate::{exclusions, ranges};
use signorini_kernel::limits::{Deadline, Limits};
use signorini_kernel::report::Report;
use signorini_kernel::{Error, Real};

/// A scene whose inputs are to be answered.
pub trait Scene {
    /// The type of every number.
    type Scalar: Real;
    /// What the controller is told.
    type Inputs: Inputs<Self::Scalar>;
    /// What is read off an answer.
    type Outputs: Outputs<Self::Scalar>;
    /// What stays from tick to tick.
    type Storage: Storage<Self::Scalar>;

    /// The range of each input; empty where none is declared.
    fn ranges(&self) -> &[[Self::Scalar; 2]];

    /// Rows that inputs without a range have to meet ([`crate::exclusions`]).
    fn exclusions(&self) -> &[Self::Scalar] {
        &[]
    }

    /// When a tick ends.
    fn limits(&self) -> Limits<Self::Scalar>;

    /// Whether every tick starts anew.
    fn is_cold(&self) -> bool;

    /// Whether an output is the bound of the evolution.
    const TELLS_WINDOW: bool = false;

    /// Puts the bound of the evolution, infinite where there is none, into the outputs that are it.
    fn tell(&self, _outputs: &mut Self::Outputs, _window: Self::Scalar) {}

    /// Lends the model, and how it is solved, to `take`.
    fn lend<T>(
        &self,
        take: impl FnOnce(
            &<Self::Storage as Storage<Self::Scalar>>::Model<'_>,
            &<Self::Storage as Storage<Self::Scalar>>::Setup<'_>,
        ) -> T,
    ) -> T;
}

/// A scene of a baked module, where all but the memory is constant.
pub trait Baked: Scene + Sized {
    /// The controller before its first tick: zeros, which take no room in flash.
    const CONTROLLER: Controller<Self>;
}

/// Values of the inputs of one tick.
pub trait Inputs<R> {
    /// The constant 1, then each value.
    type Terms: AsRef<[R]>;

    /// The factors of the model's columns.
    fn terms(self) -> Self::Terms;
}

/// Numbers that are read off an answer.
pub trait Outputs<R>: Sized {
    /// Each by its number.
    ///
    /// # Errors
    /// An output that overflows.
    fn read(of: &impl Reading<R>) -> Result<Self, Error>;
}

/// Outputs of which a bound tells how far they may be off.
pub trait Weighed<R>: Sized {
    /// How far each may be off ([`crate::intervals`]).
    fn plus_minus(report: &Report<R>) -> Self;
}

/// Outputs of which a tick tells where they lie.
pub trait Located<R>: Sized {
    /// The least and the largest value of each, from what the tick's certificate was drawn from ([`crate::intervals`]).
    fn between(&self, combination: &[R], report: &Report<R>) -> [Self; 2];
}

/// An answer as outputs are read off it.
pub trait Reading<R> {
    /// How many outputs there are.
    fn count(&self) -> usize;

    /// Output `number`.
    ///
    /// # Errors
    /// A value that overflows; no such output.
    fn value(&self, number: usize) -> Result<R, Error>;
}

/// The memory of a model, and how its ticks are solved.
pub trait Storage<R: Real> {
    /// What it solves (borrowed). By itself: within another struct its numbers would be no constants of a tick's code.
    type Model<'m>;

    /// How it is solved (borrowed).
    type Setup<'m>;

    /// Forgets all ticks.
    fn reset(&mut self);

    /// The numbers that the last tick's certificate was drawn from; none in a model whose intervals take its bound alone.
    fn combination(&self) -> &[R] {
        &[]
    }

    /// The bound of the evolution until now, of a model that steps in time.
    fn window(&self, _: &Self::Model<'_>, _: &Self::Setup<'_>) -> Option<Window<R>> {
        None
    }

    /// Answers for `terms`, the constant 1 and the inputs.
    ///
    /// # Errors
    /// Inputs that are not finite, or so large that data, answers or outputs may overflow: the last answer stays.
    fn tick<O: Outputs<R>, F: FnMut() -> u32>(
        &mut self,
        model: &Self::Model<'_>,
        setup: &Self::Setup<'_>,
        terms: &impl AsRef<[R]>,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Answer<O, R>, Error>;
}

/// Memory of which a part outlives the program.
pub trait Saving<R: Real, State>: Storage<R> {
    /// What one tick hands on to the next, sealed.
    fn save(&self, setup: &Self::Setup<'_>, scene: u64) -> State;

    /// Goes on from there.
    ///
    /// # Errors
    /// A state of another scene, or a damaged one: nothing has changed then.
    fn restore(&mut self, setup: &Self::Setup<'_>, state: &State, scene: u64) -> Result<(), Error>;
}

/// A scene that steps in time: what one tick hands on to the next may outlive the program.
pub trait Lasting: Scene {
    /// Plain numbers, sealed.
    type State;

    /// The number of the scene.
    const HASH: u64;
}

/// What a tick came to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answer<O, R> {
    /// What the controller reads.
    pub outputs: O,
    /// How the tick ended, what it took, and how wrong the answer can be.
    pub report: Report<R>,
}

impl<O: Weighed<R>, R> Answer<O, R> {
    /// How far each output may be from its value for the exact solution of the scene, in its own unit; infinite where nothing is
    /// guaranteed. Of a step in time that is the exact step from where the controller's last one ended. What the sum of an output rounds is not in it.
    #[inline(always)]
    pub fn plus_minus(&self) -> O {
        O::plus_minus(&self.report)
    }
}

/// A scene with all memory that its ticks take.
#[derive(Debug)]
pub struct Controller<S: Scene> {
    scene: S,
    storage: S::Storage,
}

impl<S: Scene> Controller<S> {
    /// Before the first tick, with the memory that `scene` needs.
    pub const fn of(scene: S, storage: S::Storage) -> Self {
        Self { scene, storage }
    }

    /// Before the first tick; can initialise a `static`.
    pub const fn new() -> Self
    where
        S: Baked,
    {
        S::CONTROLLER
    }

    /// Answers for these inputs, from where the last tick ended or, where the scene asks for a cold start, from its beginning.
    ///
    /// # Errors
    /// Inputs outside their ranges, with which boundary edges exclude each other, that are not finite, or so large that data, answers or
    /// outputs may overflow; the last answer stays.
    pub fn tick(&mut self, inputs: S::Inputs) -> Result<Answer<S::Outputs, S::Scalar>, Error> {
        let limits = self.scene.limits();
        self.tick_within(inputs, limits, &mut Deadline::never())
    }

    /// Answers within limits of the caller's and until a deadline. Whatever ends the tick, the answer is feasible and the
    /// report says how wrong it can be.
    ///
    /// # Errors
    /// As for [`Controller::tick`].
    #[inline(always)]
    pub fn tick_within<F: FnMut() -> u32>(
        &mut self,
        inputs: S::Inputs,
        limits: Limits<S::Scalar>,
        deadline: &mut Deadline<F>,
    ) -> Result<Answer<S::Outputs, S::Scalar>, Error> {
        // By its own type: the length of a slice would be no constant of the tick's code.
        let terms = &inputs.terms();
        ranges::check(terms.as_ref().get(1..).unwrap_or_default(), self.scene.ranges())?;
        exclusions::check(terms.as_ref(), self.scene.exclusions())?;
        if self.scene.is_cold() {
            self.storage.reset();
        }
        let Self { scene, storage } = self;
        let answer = scene.lend(|model, setup| storage.tick(model, setup, terms, limits, deadline));
        if !S::TELLS_WINDOW {
            return answer;
        }
        let mut answer = answer?;
        let energy = self.window().map_or(S::Scalar::INFINITY, |window| window.energy);
        self.scene.tell(&mut answer.outputs, energy);
        Ok(answer)
    }

    /// The least and the largest value that each output may have for the exact solution of the scene, in its own unit, where
    /// `answer` is that of the last tick; infinite where nothing is guaranteed. Of a step in time that is the exact step from where the
    /// controller's last one ended. Narrower than [`Answer::plus_minus`], which knows
    /// the bound alone.
    #[inline(always)]
    pub fn between(&self, answer: &Answer<S::Outputs, S::Scalar>) -> [S::Outputs; 2]
    where
        S::Outputs: Located<S::Scalar>,
    {
        answer.outputs.between(self.storage.combination(), &answer.report)
    }

    /// The bound of the evolution from the start until the last tick's end; nothing where ticks are no steps in time, or where there is
    /// no such bound.
    pub fn window(&self) -> Option<Window<S::Scalar>> {
        self.scene.lend(|model, setup| self.storage.window(model, setup))
    }

    /// Forgets all ticks: the next one is the first again, and a step in time begins from the start.
    pub fn reset(&mut self) {
        self.storage.reset();
    }

    /// All that the next tick takes from the last one. Before the first tick it is the start.
    pub fn state(&self) -> S::State
    where
        S: Lasting,
        S::Storage: Saving<S::Scalar, S::State>,
    {
        self.scene.lend(|_, setup| self.storage.save(setup, S::HASH))
    }

    /// Goes on from `state` with the bits that the controller would have had from which it was taken.
    ///
    /// # Errors
    /// [`Error::ForeignState`] of another scene, [`Error::DamagedState`] where numbers have changed: the controller has not.
    pub fn restore(&mut self, state: &S::State) -> Result<(), Error>
    where
        S: Lasting,
        S::Storage: Saving<S::Scalar, S::State>,
    {
        let Self { scene, storage } = self;
        scene.lend(|_, setup| storage.restore(setup, state, S::HASH))
    }

    /// What the last tick left.
    pub const fn storage(&self) -> &S::Storage {
        &self.storage
    }

    /// The memory of the next tick.
    pub const fn storage_mut(&mut self) -> &mut S::Storage {
        &mut self.storage
    }
}

impl<S: Baked> Default for Controller<S> {
    fn default() -> Self {
        Self::new()
    }
}
