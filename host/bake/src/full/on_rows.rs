//! The kernel's controller on arrays of the desk, compiled for rows of each width.

use std::fmt::Debug;

use signorini_bound::certificate::Curved;
use signorini_device::controller::{self, Answer, Scene, Window};
use signorini_device::full::controller::{ControllerStorage, Setup};
use signorini_device::full::{Full, Lengths, Numbers, Storage};
use signorini_device::sparse::Solved;
use signorini_device::tick::{Deadline, Figures, Limits, Report};
use signorini_kernel::Error;
use signorini_kernel::mesh::boundary::{Neumann, Robin};
use signorini_kernel::rows::{QUADS, Row, TRIANGLES};

use super::arrays::Baked;
use super::solver::DeskSolver;
use crate::Bakes;
use crate::desk::{Terms, Values};
use signorini_solve::exchanges;

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

/// The kernel's controller, whatever the width of its rows: 4 entries on triangles alone and else 6.
pub trait OnRows<R: Bakes>: Debug {
    /// Outputs and report, both in the scene's units; how often the clock was asked is added to `looks`.
    ///
    /// # Errors
    /// Those of [`super::Controller::tick`].
    fn tick(
        &mut self,
        inputs: &[R],
        limits: Limits<R>,
        looks: &mut u32,
    ) -> Result<(Vec<R>, Report<R>), Error>;

    /// [`controller::Controller::window`]
    fn window(&self) -> Option<Window<R>>;

    /// [`controller::Controller::reset`]
    fn reset(&mut self);

    /// Work of the factor in the last tick, where no sweeps had to help.
    fn solved(&self) -> Option<Solved<R>>;

    /// The arrays of the last tick.
    fn numbers(&self, lengths: &Lengths) -> Numbers<&[R]>;

    /// The numbers that a state holds.
    fn hand_on(&self, lengths: &Lengths, numbers: &mut [R]);

    /// Goes on from the numbers of a state.
    ///
    /// # Errors
    /// Another number of them.
    fn take_over(&mut self, lengths: &Lengths, numbers: &[R]) -> Result<(), Error>;
}

/// The controller of a baked scene before its first tick.
pub(crate) fn on_rows<'b, R: Bakes>(baked: &'b Baked<R>) -> Box<dyn OnRows<R> + 'b> {
    match baked.has_quads() {
        true => Box::new(of_width::<R, QUADS>(baked)),
        false => Box::new(of_width::<R, TRIANGLES>(baked)),
    }
}

fn of_width<R: Bakes, const WIDTH: usize>(
    baked: &Baked<R>,
) -> controller::Controller<Desk<'_, R, WIDTH>> {
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
        figures: Figures::default(),
    };
    let storage = ControllerStorage::of(arrays, solver, vec![R::ZERO; baked.outputs.len()]);
    controller::Controller::of(Desk { baked, lengths, ranges: baked.face.ranges() }, storage)
}

impl<R: Bakes, const WIDTH: usize> OnRows<R> for controller::Controller<Desk<'_, R, WIDTH>> {
    fn tick(
        &mut self,
        inputs: &[R],
        limits: Limits<R>,
        looks: &mut u32,
    ) -> Result<(Vec<R>, Report<R>), Error> {
        let clock = || {
            *looks += 1;
            u32::MAX
        };
        let never = &mut Deadline { remaining: clock, sweep: 0, certificate: 0 };
        let answer = self.tick_within(Terms::new(inputs), limits, never)?;
        let Answer { outputs: Values(outputs), report } = answer;
        Ok((outputs, report.with(self.storage().solver.figures)))
    }

    fn window(&self) -> Option<Window<R>> {
        controller::Controller::window(self)
    }

    fn reset(&mut self) {
        controller::Controller::reset(self);
    }

    fn solved(&self) -> Option<Solved<R>> {
        self.storage().solver.solved
    }

    fn numbers(&self, lengths: &Lengths) -> Numbers<&[R]> {
        self.storage().own.numbers(lengths).unwrap_or_default()
    }

    fn hand_on(&self, lengths: &Lengths, numbers: &mut [R]) {
        self.storage().own.hand_on(lengths, numbers);
    }

    fn take_over(&mut self, lengths: &Lengths, numbers: &[R]) -> Result<(), Error> {
        self.storage_mut().own.take_over(lengths, numbers)
    }
}

/// A baked scene, for its controller.
#[derive(Debug)]
struct Desk<'b, R: Bakes, const WIDTH: usize> {
    baked: &'b Baked<R>,
    lengths: Lengths,
    ranges: Vec<[R; 2]>,
}

impl<R: Bakes, const WIDTH: usize> Scene for Desk<'_, R, WIDTH> {
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
