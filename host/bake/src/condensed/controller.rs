//! What the baked module does, on this machine and on the same numbers.

use signorini_kernel::Error;
use signorini_kernel::device::condensed::Condensed;
use signorini_kernel::device::condensed::method::{Linear, Method};
use signorini_kernel::device::condensed::storage::{Storage, TableauStorage};
use signorini_kernel::device::limits::Deadline;
use signorini_kernel::device::ranges::check;
use signorini_kernel::device::report::Report;
use signorini_kernel::solve::dense::blocks::{Block, SIDE, count, padded};

use super::arrays::{Baked, Solver};
use super::visited::Visited;
use signorini_solve::scalar::Scalar;

/// The memory of a condensed scene.
type Owned<R> = Storage<Vec<R>, Vec<bool>, Vec<R>, Vec<R>>;

/// The controller of a condensed scene.
#[derive(Debug)]
pub struct Controller<'b, R: Scalar> {
    baked: &'b Baked<R>,
    storage: Owned<R>,
    tableau: TableauStorage<Vec<Block<R>>, Vec<bool>, Vec<R>>,
}

impl<'b, R: Scalar> Controller<'b, R> {
    /// Before the first tick.
    pub fn new(baked: &'b Baked<R>) -> Self {
        let zeros = |length| vec![R::ZERO; length];
        let n = padded(baked.contact);
        let blocks = vec![[[R::ZERO; SIDE]; SIDE]; count(baked.contact)];
        let mut storage = {
            let spans = zeros(baked.varying_spans());
            Storage::of(zeros(n), vec![false; n], zeros(baked.columns()), spans)
        };
        // x is what the first tick begins with, even if that is refused.
        baked.with_model(|model| _ = storage.memory(model));
        Self {
            baked,
            storage,
            tableau: TableauStorage::of(blocks, vec![false; n], [zeros(n), zeros(n)]),
        }
    }

    /// Answers for these values of the inputs: every output in order, and the report.
    ///
    /// # Errors
    /// Inputs outside their ranges, that are not finite, or so large that the answer or an output may overflow: the last answer stays.
    pub fn tick(&mut self, inputs: &[R]) -> Result<(Vec<R>, Report<R>), Error> {
        let baked = self.baked;
        check(inputs, &baked.ranges)?;
        if baked.cold {
            self.storage.reset();
            self.tableau.reset();
        }
        let inputs: Vec<R> = std::iter::once(R::ONE).chain(inputs.iter().copied()).collect();
        let storage = &mut self.storage;
        baked.with_model(|model| match baked.solver() {
            Solver::Linear => answer(model, &inputs, Linear, storage),
            Solver::Sweeps => answer(model, &inputs, baked.sweeps, storage),
            Solver::TwoPhases => {
                let method = self.tableau.two_phases(model)?;
                answer(model, &inputs, method, storage)
            }
            Solver::Exchanges(most) => {
                let method = self.tableau.method(model, most, baked.sweeps)?;
                answer(model, &inputs, method, storage)
            }
        })
    }

    /// What the last tick looked at.
    pub fn visited(&self) -> Visited {
        Visited::new::<R>(self.storage.open(), self.storage.combination())
    }

    /// The scaled openings of the last tick; before the first, those that it begins with.
    pub fn x(&self) -> &[R] {
        let x = self.storage.x();
        x.get(..self.baked.contact).unwrap_or(x)
    }
}

/// The outputs and the report of a tick.
fn answer<R: Scalar>(
    model: &Condensed<R>,
    inputs: &[R],
    mut method: impl Method<R>,
    storage: &mut Owned<R>,
) -> Result<(Vec<R>, Report<R>), Error> {
    let mut memory = storage.memory(model);
    let report = model.tick(inputs, &mut method, &mut Deadline::never(), &mut memory)?;
    let output = |number| model.output(number, inputs, &memory, &report);
    let outputs = (0..model.outputs.len()).map(output).collect::<Result<_, _>>()?;
    Ok((outputs, report))
}
