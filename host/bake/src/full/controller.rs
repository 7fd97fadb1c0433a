//! The controller of a baked module, on this machine and on the same numbers.

use signorini_bound::certificate::Curved;
use signorini_device::controller::{self, Scene, Window};
use signorini_device::full::controller::{ControllerStorage, Setup, Solver, Task};
use signorini_device::full::{Full, Lengths, Memory, Numbers, Storage};
use signorini_device::sparse::{Exact, Solved};
use signorini_device::tick::{
    CertifiedSweeps, Deadline, Figures, Limits, Report, Substitutions, Sweeping, UncertifiedSweeps,
};
use signorini_kernel::mesh::boundary::{Neumann, Robin};
use signorini_kernel::rows::Row;
use signorini_kernel::{Error, Libm};

use super::arrays::Baked;
use crate::desk::{Terms, Values};
use crate::state;
use signorini_problem::scalar::Scalar;
use signorini_solve::{Exchanges, exchanges};

/// The arrays of a baked scene.
type Arrays<R, const WIDTH: usize> = Storage<
    R,
    Vec<Row<R, u32, WIDTH>>,
    Vec<R>,
    Vec<u8>,
    Vec<Neumann<R, u32>>,
    Vec<Robin<R, u32>>,
    Vec<Curved<R, u32>>,
>;

/// The controller of a baked scene; `WIDTH` is 4 on triangles alone and else 6.
#[derive(Debug)]
pub struct Controller<'b, R: Scalar, const WIDTH: usize> {
    baked: &'b Baked<R>,
    own: controller::Controller<Desk<'b, R, WIDTH>>,
    certificates: u32,
}

impl<'b, R: Scalar, const WIDTH: usize> Controller<'b, R, WIDTH> {
    /// Before the first tick.
    pub fn new(baked: &'b Baked<R>) -> Self {
        let lengths = baked.lengths();
        let arrays = Storage::of(
            vec![Row::EMPTY; lengths.rows],
            vec![R::ZERO; lengths.numbers.sum()],
            vec![0; lengths.active],
            vec![Neumann::default(); lengths.neumann],
            vec![Robin::default(); lengths.robin],
            vec![Curved::default(); lengths.curved],
        );
        let solver = DeskSolver {
            is_fast: baked.how.fast,
            is_certified: baked.how.certified,
            exchanges: baked.factored.as_ref().map(|_| exchanges(lengths.active)),
            solved: None,
            figures: None,
        };
        let outputs = vec![R::ZERO; baked.outputs.len()];
        let storage = ControllerStorage::of(arrays, solver, outputs);
        let scene = Desk { baked, lengths, ranges: baked.face.ranges() };
        Self { baked, own: controller::Controller::of(scene, storage), certificates: 0 }
    }

    /// Outputs and report for these inputs, within the limits of the baked module.
    ///
    /// # Errors
    /// Inputs outside their ranges, that are not finite, of another number, or so large that data or answers may overflow: the last answer
    /// stays. A `WIDTH` that is not that of the mesh.
    pub fn tick(&mut self, inputs: &[R]) -> Result<(Vec<R>, Report<R>), Error> {
        self.tick_within(inputs, self.baked.how.limits)
    }

    /// Outputs and report for these inputs, within other limits.
    ///
    /// # Errors
    /// As for [`Controller::tick`].
    pub fn tick_within(
        &mut self,
        inputs: &[R],
        limits: Limits<R>,
    ) -> Result<(Vec<R>, Report<R>), Error> {
        let mut looks: u32 = 0;
        let clock = || {
            looks += 1;
            u32::MAX
        };
        let never = &mut Deadline { remaining: clock, sweep: 0, certificate: 0 };
        let answer = self.own.tick_within(Terms::new(inputs), limits, never)?;
        let (Values(outputs), report) = (answer.outputs, answer.report);
        // The clock is asked before every sweep and once more at the end, at every certificate, and after each but the last.
        self.certificates = (looks.saturating_sub(report.sweeps) / 2).max(1);
        let figures = self.own.storage().solver.figures.unwrap_or_default();
        let units = self.baked.scale.map(|scale| scale.kernel);
        let figures = units.map_or(figures, |units| units.figures(figures));
        Ok((outputs, report.with(figures)))
    }

    /// The bound of the evolution until the end of the last tick, of steps in time that have one.
    pub fn window(&self) -> Option<Window<R>> {
        self.own.window()
    }

    /// The bytes of the `State` that firmware has after the last tick; nothing where ticks are no steps in time.
    pub fn state(&self) -> Option<Vec<u8>> {
        self.baked.stored.as_ref()?;
        let lengths = self.baked.lengths();
        let mut numbers = vec![R::ZERO; lengths.handed_on()];
        self.own.storage().own.hand_on(&lengths, &mut numbers);
        Some(state::bytes(self.baked.face.hash, &numbers))
    }

    /// Goes on from there.
    ///
    /// # Errors
    /// The bytes of a state of another scene, or damaged ones: nothing has changed then.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), Error> {
        let numbers = state::numbers(self.baked.face.hash, bytes)?;
        self.own.storage_mut().own.take_over(&self.baked.lengths(), &numbers)
    }

    /// Goes back to before the first tick.
    pub fn reset(&mut self) {
        self.own.reset();
    }

    /// Certificates of the last tick, where it was swept.
    pub fn certificates(&self) -> u32 {
        self.certificates
    }

    /// Work of the factor in the last tick; `None` without one, or where sweeps had to help.
    pub fn solved(&self) -> Option<Solved<R>> {
        self.own.storage().solver.solved
    }

    /// Whether the factor alone answers for these inputs.
    pub(super) fn solves(&mut self, inputs: &[R]) -> bool {
        self.tick(inputs)
            .is_ok_and(|(_, report)| report.sweeps == 0 && report.figures.residual.finite())
    }

    /// Means of u over the edges, in [`Baked::units`] as all arrays below.
    pub fn u(&self) -> &[R] {
        self.numbers().u
    }

    /// ∫τ·n of every edge along its direction: balanced, or of a tick without certificate σ_h of (15).
    pub fn tau(&self) -> &[R] {
        self.numbers().tau
    }

    /// Means of ψ over the contact edges in the last tick.
    pub fn lower(&self) -> &[R] {
        let own = self.numbers().gap;
        if own.is_empty() { &self.baked.data.gap } else { own }
    }

    /// s at the vertices; empty without a certificate.
    pub fn vertices(&self) -> &[R] {
        self.numbers().vertices
    }

    /// The bubbles of s, one an edge; empty without quads or certificate.
    pub fn bubbles(&self) -> &[R] {
        self.numbers().bubbles
    }

    fn numbers(&self) -> Numbers<&[R]> {
        let lengths = self.baked.lengths();
        self.own.storage().own.numbers(&lengths).unwrap_or_default()
    }
}

/// A baked scene, for its controller.
#[derive(Debug)]
struct Desk<'b, R: Scalar, const WIDTH: usize> {
    baked: &'b Baked<R>,
    lengths: Lengths,
    ranges: Vec<[R; 2]>,
}

impl<R: Scalar, const WIDTH: usize> Scene for Desk<'_, R, WIDTH> {
    type Scalar = R;
    type Inputs = Terms<R>;
    type Outputs = Values<R>;
    type Storage = ControllerStorage<Arrays<R, WIDTH>, DeskSolver<R>, Vec<R>, u32, WIDTH>;

    fn ranges(&self) -> &[[R; 2]] {
        &self.ranges
    }

    fn exclusions(&self) -> &[R] {
        &self.baked.exclusions
    }

    fn limits(&self) -> Limits<R> {
        self.baked.how.limits
    }

    fn is_cold(&self) -> bool {
        self.baked.how.cold
    }

    const TELLS_WINDOW: bool = true;

    fn tell(&self, Values(outputs): &mut Values<R>, window: R) {
        self.baked.face.windows.iter().for_each(|&at| outputs[at] = window);
    }

    fn lend<T>(&self, take: impl FnOnce(&Full<R, u32>, &Setup<R, u32>) -> T) -> T {
        let Self { baked, lengths, .. } = self;
        let factored = baked.factored.as_ref().map(|factored| factored.view());
        let (factored, units) = (factored.as_ref(), baked.scale.map(|scale| scale.kernel));
        baked.with(|full| take(full, &Setup { lengths, factored, units }))
    }
}

/// The method that the module has, chosen at run time; what it did last.
#[derive(Debug)]
struct DeskSolver<R: Scalar> {
    is_fast: bool,
    is_certified: bool,
    exchanges: Option<Exchanges<R>>,
    solved: Option<Solved<R>>,
    figures: Option<Figures<R>>,
}

impl<R: Scalar> Solver<R, u32> for DeskSolver<R> {
    fn tick<F: FnMut() -> u32, const WIDTH: usize>(
        &mut self,
        full: &Full<R, u32>,
        task: Task<R, u32>,
        deadline: &mut Deadline<F>,
        memory: Memory<R, u32, WIDTH>,
        outputs: &mut [R],
    ) -> Result<Report<R>, Error> {
        let report = match (self.is_fast, self.is_certified) {
            (true, true) => {
                self.by(CertifiedSweeps(R::FAST), full, task, deadline, memory, outputs)
            }
            (true, false) => {
                self.by(UncertifiedSweeps(R::FAST), full, task, deadline, memory, outputs)
            }
            (false, true) => self.by(CertifiedSweeps(Libm), full, task, deadline, memory, outputs),
            (false, false) => {
                self.by(UncertifiedSweeps(Libm), full, task, deadline, memory, outputs)
            }
        }?;
        self.solved = self.solved.filter(|_| report.sweeps == 0);
        self.figures = Some(report.figures);
        Ok(report)
    }
}

impl<R: Scalar> DeskSolver<R> {
    /// Ticks by these sweeps, after the factor where there is one.
    fn by<F: FnMut() -> u32, const WIDTH: usize>(
        &mut self,
        sweeps: impl Sweeping<R, u32> + Copy,
        full: &Full<R, u32>,
        Task { setup, inputs, limits }: Task<R, u32>,
        deadline: &mut Deadline<F>,
        memory: Memory<R, u32, WIDTH>,
        outputs: &mut [R],
    ) -> Result<Report<R>, Error> {
        let Some((factored, own)) = setup.factored.zip(self.exchanges.as_mut()) else {
            return full.tick(inputs, sweeps, (setup.units, limits), deadline, memory, outputs);
        };
        let exact = &mut Exact::new(*factored, own.memory(setup.lengths.active)?)?;
        let method = Substitutions { exact, sweeps };
        let report = full.tick(inputs, method, (setup.units, limits), deadline, memory, outputs)?;
        self.solved = exact.solved();
        Ok(report)
    }
}
