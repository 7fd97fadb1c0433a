//! What the baked module does, on this machine and on the same numbers.

use signorini_kernel::Error;
use signorini_kernel::device::condensed::Memory;
use signorini_kernel::device::condensed::method::{Linear, Pivots};
use signorini_kernel::device::limits::Deadline;
use signorini_kernel::device::report::Report;
use signorini_kernel::solve::dense::Iterate;
use signorini_kernel::solve::dense::blocks::{Block, SIDE, count, padded};
use signorini_kernel::solve::dense::tableau::Tableau;

use super::arrays::{Baked, Solver};
use super::visited::Visited;
use signorini_solve::scalar::Scalar;

/// The controller of a condensed scene.
#[derive(Debug)]
pub struct Controller<'b, R: Scalar> {
    baked: &'b Baked<R>,
    x: Vec<R>,
    residual: Vec<R>,
    scratch: Vec<R>,
    open: Vec<bool>,
    load: Vec<R>,
    combination: Vec<R>,
    sum: Vec<R>,
    blocks: Vec<Block<R>>,
    exchanged: Vec<bool>,
    columns: [Vec<R>; 2],
    is_built: bool,
}

impl<'b, R: Scalar> Controller<'b, R> {
    /// Before the first tick.
    pub fn new(baked: &'b Baked<R>) -> Self {
        let zeros = |length| vec![R::ZERO; length];
        let n = padded(baked.contact);
        Self {
            baked,
            x: baked.start.x.clone(),
            residual: zeros(n),
            scratch: zeros(n),
            open: vec![false; n],
            load: zeros(n),
            combination: zeros(baked.columns()),
            sum: zeros(baked.columns()),
            blocks: vec![[[R::ZERO; SIDE]; SIDE]; count(baked.contact)],
            exchanged: vec![false; n],
            columns: [zeros(n), zeros(n)],
            is_built: false,
        }
    }

    /// Answers for these values of the inputs: every output in order, and the report.
    ///
    /// # Errors
    /// Inputs that are not finite, or so large that the answer or an output may overflow: the last answer stays.
    pub fn tick(&mut self, inputs: &[R]) -> Result<(Vec<R>, Report<R>), Error> {
        let baked = self.baked;
        if baked.cold {
            self.x.clone_from(&baked.start.x);
            self.is_built = false;
        }
        let inputs: Vec<R> = std::iter::once(R::ONE).chain(inputs.iter().copied()).collect();
        baked.with_model(|model| {
            let Self { x, residual, scratch, open, load, combination, sum, .. } = self;
            let iterate = Iterate { x, residual, scratch, open };
            let mut memory = Memory { iterate, load, combination, sum };
            let never = &mut Deadline::never();
            let report = match baked.solver() {
                Solver::Linear => model.tick(&inputs, &mut Linear, never, &mut memory)?,
                Solver::Sweeps => model.tick(&inputs, &mut { baked.sweeps }, never, &mut memory)?,
                Solver::Exchanges(most) => {
                    let [column, next] = &mut self.columns;
                    let mut tableau = Tableau::new(
                        model.contact,
                        &mut self.blocks,
                        &mut self.exchanged,
                        [column, next],
                    )?;
                    if !self.is_built {
                        tableau.reset(&model.start)?;
                        self.is_built = true;
                    }
                    let mut method =
                        Pivots { tableau, start: model.start, most, sweeps: baked.sweeps };
                    model.tick(&inputs, &mut method, never, &mut memory)?
                }
            };
            let outputs = (0..baked.outputs.len())
                .map(|number| model.output(number, &inputs, &memory.iterate, &report));
            Ok((outputs.collect::<Result<_, _>>()?, report))
        })
    }

    /// What the last tick looked at.
    pub fn visited(&self) -> Visited {
        Visited::new(&self.open, &self.combination)
    }

    /// The scaled openings of the last tick.
    pub fn x(&self) -> &[R] {
        self.x.get(..self.baked.contact).unwrap_or(&self.x)
    }
}
