//! The kernel's controller on arrays of the desk, compiled for rows of each width.

use signorini_bound::certificate::Curved;
use signorini_device::controller::{self, Scene};
use signorini_device::full::controller::{ControllerStorage, Setup};
use signorini_device::full::{Full, Lengths, Storage};
use signorini_device::tick::{Figures, Limits};
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

/// The kernel's controller by the width of its rows: 4 entries on triangles alone and else 6.
#[derive(Debug)]
pub(super) enum OnRows<'b, R: Bakes> {
    Triangles(controller::Controller<Desk<'b, R, TRIANGLES>>),
    Quads(controller::Controller<Desk<'b, R, QUADS>>),
}

/// Code that is the same for rows of either width.
macro_rules! on_rows {
    ($of:expr, $own:ident => $then:expr) => {
        match $of {
            OnRows::Triangles($own) => $then,
            OnRows::Quads($own) => $then,
        }
    };
}
pub(super) use on_rows;

impl<'b, R: Bakes> OnRows<'b, R> {
    /// Before the first tick.
    pub fn new(baked: &'b Baked<R>) -> Self {
        match baked.has_quads() {
            true => Self::Quads(of_width(baked)),
            false => Self::Triangles(of_width(baked)),
        }
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

/// A baked scene, for its controller.
#[derive(Debug)]
pub(super) struct Desk<'b, R: Bakes, const WIDTH: usize> {
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
        let (factored, units) = (factored.as_ref(), baked.kernel_units());
        baked.with(|full| take(full, &Setup { lengths, factored, units }))
    }
}
