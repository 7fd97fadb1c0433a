//! Ticks of a full model in memory of its own: by the method that the memory is for.
//!
//! ```text
//!   inputs ─► units ─► Solver: sweeps, or a factor and sweeps ─► Full::tick ─► units ─► outputs
//! ```
//! The type of the [`Solver`] chooses the method when the program is compiled: an image has the code of that one alone.

use core::marker::PhantomData;

use super::{Full, Lengths, Memory, State, Storage, Units};
use crate::controller::{self, Answer, Outputs, Reading, Window};
use crate::sparse::{self, Exact, Factored};
use crate::tick::{Report, Substitutions, Sweeping};
use signorini_bound::certificate::Curved;
use signorini_contact::dense::blocks::Block;
use signorini_kernel::error::{Array, Error};
use signorini_kernel::limits::{Deadline, Limits};
use signorini_kernel::mesh::boundary::{Neumann, Robin};
use signorini_kernel::rows::LayOut;
use signorini_kernel::{Index, Real};

/// What a controller needs beside its scene (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Setup<'a, R, I> {
    /// [`Lengths::of`] the scene.
    pub lengths: &'a Lengths,
    /// Its factor, where one solves its ticks.
    pub factored: Option<&'a Factored<'a, R, I>>,
    /// What 1 stands for in it, where that is not 1.
    pub units: Option<Units<R>>,
}

/// One tick's task.
#[derive(Debug, Clone, Copy)]
pub struct Task<'t, R, I> {
    /// What the controller has beside its scene.
    pub setup: &'t Setup<'t, R, I>,
    /// One value a pattern.
    pub inputs: &'t [R],
    /// In the units of the scene.
    pub limits: Limits<R>,
}

/// A method with what it keeps from tick to tick.
pub trait Solver<R: Real, I: Index> {
    /// Solves by it: [`Full::tick`].
    ///
    /// # Errors
    /// Those of [`Full::tick`].
    fn tick<F: FnMut() -> u32, const WIDTH: usize>(
        &mut self,
        full: &Full<R, I>,
        task: Task<R, I>,
        deadline: &mut Deadline<F>,
        memory: Memory<R, I, WIDTH>,
        outputs: &mut [R],
    ) -> Result<Report<R>, Error>;
}

impl<R: Real, I: Index, S: Sweeping<R, I> + Copy> Solver<R, I> for S {
    #[inline(always)]
    fn tick<F: FnMut() -> u32, const WIDTH: usize>(
        &mut self,
        full: &Full<R, I>,
        Task { inputs, limits, setup }: Task<R, I>,
        deadline: &mut Deadline<F>,
        memory: Memory<R, I, WIDTH>,
        outputs: &mut [R],
    ) -> Result<Report<R>, Error> {
        full.tick(inputs, *self, (setup.units, limits), deadline, memory, outputs)
    }
}

/// Exchanges with a factor, and sweeps where it does not find the solution.
#[derive(Debug)]
pub struct ByFactor<E, S> {
    /// Memory of the exchanges: a [`sparse::Storage`].
    pub exchanges: E,
    /// What follows.
    pub sweeps: S,
}

impl<R, I, Tableau, Floats, Flags, S> Solver<R, I>
    for ByFactor<sparse::Storage<Tableau, Floats, Flags>, S>
where
    R: Real,
    I: Index,
    Tableau: AsMut<[Block<R>]>,
    Floats: AsMut<[R]>,
    Flags: AsMut<[u8]>,
    S: Sweeping<R, I> + Copy,
{
    #[inline(always)]
    fn tick<F: FnMut() -> u32, const WIDTH: usize>(
        &mut self,
        full: &Full<R, I>,
        Task { inputs, limits, setup }: Task<R, I>,
        deadline: &mut Deadline<F>,
        memory: Memory<R, I, WIDTH>,
        outputs: &mut [R],
    ) -> Result<Report<R>, Error> {
        let missing = Error::Length { of: Array::MatrixValues, found: 0, expected: 1 };
        let factored = setup.factored.ok_or(missing)?;
        let exact = &mut Exact::new(*factored, self.exchanges.memory(setup.lengths.active)?)?;
        let method = Substitutions { exact, sweeps: self.sweeps };
        full.tick(inputs, method, (setup.units, limits), deadline, memory, outputs)
    }
}

/// The memory of a controller: of its scene, in a [`Storage`], of its method, and of its outputs. `I` are positions in the
/// scene's arrays, `WIDTH` is that of its rows.
#[derive(Debug)]
pub struct ControllerStorage<Own, Method, Values, I, const WIDTH: usize> {
    /// Rows, iterate, and the data that inputs change.
    pub own: Own,
    /// A [`Solver`].
    pub solver: Method,
    outputs: Values,
    positions: PhantomData<I>,
}

impl<Own, Method, Values, I, const WIDTH: usize> ControllerStorage<Own, Method, Values, I, WIDTH> {
    /// Before the first tick; `outputs` has room for each output.
    pub const fn of(own: Own, solver: Method, outputs: Values) -> Self {
        Self { own, solver, outputs, positions: PhantomData }
    }
}

impl<R, I, Rows, Floats, Flags, Fluxes, Laws, Bends, M, Values, const WIDTH: usize>
    controller::Storage<R>
    for ControllerStorage<Storage<R, Rows, Floats, Flags, Fluxes, Laws, Bends>, M, Values, I, WIDTH>
where
    R: Real,
    I: Index,
    Rows: LayOut<R, I, WIDTH>,
    Floats: AsRef<[R]> + AsMut<[R]>,
    Flags: AsMut<[u8]>,
    Fluxes: AsMut<[Neumann<R, I>]>,
    Laws: AsMut<[Robin<R, I>]>,
    Bends: AsMut<[Curved<R, I>]>,
    M: Solver<R, I>,
    Values: AsMut<[R]>,
{
    type Model<'m> = Full<'m, R, I>;
    type Setup<'m> = Setup<'m, R, I>;

    fn reset(&mut self) {
        self.own.reset();
    }

    fn window(&self, full: &Self::Model<'_>, setup: &Self::Setup<'_>) -> Option<Window<R>> {
        let numbers = self.own.numbers(setup.lengths).filter(|_| self.own.has_begun());
        let window = full.storing.get()?.window(numbers.map(|numbers| numbers.carried))?;
        let unit = setup.units.map_or(R::ONE, |units| units.energy);
        Some(Window { energy: (window.energy * unit).or_larger(R::TINY), ..window })
    }

    #[inline(always)]
    fn tick<O: Outputs<R>, F: FnMut() -> u32>(
        &mut self,
        full: &Self::Model<'_>,
        setup: &Self::Setup<'_>,
        terms: &impl AsRef<[R]>,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Answer<O, R>, Error> {
        let task = Task { setup, inputs: terms.as_ref().get(1..).unwrap_or_default(), limits };
        let memory = self.own.memory(full, setup.lengths)?;
        let outputs = self.outputs.as_mut();
        let report = self.solver.tick(full, task, deadline, memory, outputs)?;
        let outputs = O::read(&Read(outputs))?;
        Ok(Answer { outputs, report: report.with(()) })
    }
}

impl<R, I, Rows, Floats, Flags, Fluxes, Laws, Bends, M, Values, const WIDTH: usize, const N: usize>
    controller::Saving<R, State<R, N>>
    for ControllerStorage<Storage<R, Rows, Floats, Flags, Fluxes, Laws, Bends>, M, Values, I, WIDTH>
where
    R: Real,
    Self: for<'m> controller::Storage<R, Setup<'m> = Setup<'m, R, I>>,
    Floats: AsRef<[R]> + AsMut<[R]>,
    Flags: AsRef<[u8]> + AsMut<[u8]>,
{
    fn save(&self, setup: &Self::Setup<'_>, scene: u64) -> State<R, N> {
        let mut numbers = [R::ZERO; N];
        self.own.hand_on(setup.lengths, &mut numbers);
        State::seal(scene, numbers)
    }

    fn restore(
        &mut self,
        setup: &Self::Setup<'_>,
        state: &State<R, N>,
        scene: u64,
    ) -> Result<(), Error> {
        self.own.take_over(setup.lengths, state.open(scene)?)
    }
}

/// The outputs of an answer.
struct Read<'r, R>(&'r [R]);

impl<R: Real> Reading<R> for Read<'_, R> {
    fn count(&self) -> usize {
        self.0.len()
    }

    #[inline(always)]
    fn value(&self, number: usize) -> Result<R, Error> {
        let stray = Error::OutOfRange { of: Array::Outputs, at: number };
        self.0.get(number).copied().ok_or(stray)
    }
}
