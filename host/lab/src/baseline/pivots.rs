//! The kernel's exact method on the condensed problem.

use signorini_contact::dense::Iterate;
use signorini_contact::dense::blocks::{Block, SIDE, count, padded};
use signorini_contact::dense::ranges::Given;
use signorini_contact::dense::tableau::{InitialTableau, Tableau};
use signorini_contact::method::{Method, Pivots as Exchanges, SolveSummary};
use signorini_kernel::Error as KernelError;
use signorini_kernel::flux_range::Spans;
use signorini_kernel::limits::Deadline;

use super::failed;
use super::quadratic::QuadraticLoads;
use super::series::{InitialGuess, Run, TimedSolver};
use crate::cycles::counted;
use signorini_bake::Bakes;
use signorini_bake::condensed::{Baked, Work};
use signorini_condense::CondensedModel;
use signorini_scene::Result;

/// Exchanges of a solve, and sweeps where these do not suffice: no limit that is reached.
const WORK: Work = Work { pivots: Some(100_000), sweeps: 100_000 };

/// The model, the loads of the ticks, and the memory of a controller.
pub(super) struct Pivots<R: Bakes> {
    baked: Baked<R>,
    loads: Vec<Vec<R>>,
    /// Nothing in a tick without limits.
    spans: Vec<Vec<R>>,
    x: Vec<R>,
    residual: Vec<R>,
    scratch: Vec<R>,
    open: Vec<bool>,
    blocks: Vec<Block<R>>,
    exchanged: Vec<bool>,
    columns: [Vec<R>; 2],
}

impl<R: Bakes> Pivots<R> {
    pub fn new(condensate: &CondensedModel, ticks: &[QuadraticLoads]) -> Result<Self> {
        let baked = Baked::new(condensate, WORK, false).map_err(failed)?;
        let n = padded(condensate.contact);
        let zeros = || vec![R::ZERO; n];
        let narrowed = |numbers: &[f64]| {
            let mut numbers: Vec<R> = numbers.iter().map(|&number| R::narrow(number)).collect();
            numbers.resize(if numbers.is_empty() { 0 } else { n }, R::ZERO);
            numbers
        };
        Ok(Self {
            baked,
            loads: ticks.iter().map(|tick| narrowed(&tick.load)).collect(),
            spans: ticks.iter().map(|tick| narrowed(&tick.spans)).collect(),
            x: zeros(),
            residual: zeros(),
            scratch: zeros(),
            open: vec![false; n],
            blocks: vec![[[R::ZERO; SIDE]; SIDE]; count(condensate.contact)],
            exchanged: vec![false; n],
            columns: [zeros(), zeros()],
        })
    }

    /// One solve; a cold one begins with nothing open.
    fn solve(
        &mut self,
        tick: usize,
        start: InitialGuess,
    ) -> std::result::Result<(f64, SolveSummary), KernelError> {
        let Self { baked, loads, spans, x, residual, scratch, open, blocks, exchanged, columns } =
            self;
        let (sweeps, [column, next]) = (baked.sweeps, columns);
        let nothing = vec![false; exchanged.len()];
        baked.with_model(|model| {
            let matrix = model.matrix()?;
            let (cycles, progress) = counted(|| {
                let begin = InitialTableau { blocks: model.matrix, exchanged: &nothing };
                let mut tableau = Tableau::new(model.contact, blocks, exchanged, [column, next])?;
                if start == InitialGuess::Cold {
                    x.fill(R::ZERO);
                    tableau.reset(&begin)?;
                }
                let iterate = Iterate { x, residual, scratch, open };
                let most = WORK.pivots.unwrap_or(0);
                let mut method = Exchanges { tableau, start: begin, most, sweeps };
                let given = Given::between(&loads[tick], Spans::baked(&spans[tick], R::ZERO), &[]);
                method.solve(&matrix, given, iterate, &mut Deadline::never())
            });
            progress.map(|progress| (cycles, progress))
        })
    }
}

impl<R: Bakes> TimedSolver for Pivots<R> {
    /// Exact: the tolerance has no say.
    fn run(&mut self, tick: usize, start: InitialGuess, _: f64) -> Result<Run> {
        let (cycles, progress) = self.solve(tick, start).map_err(failed)?;
        let u = self.x[..self.baked.contact].iter().map(|x| x.wide()).collect();
        Ok(Run { cycles, iterations: progress.pivots + progress.sweeps, u })
    }

    fn finest(&self) -> i32 {
        -1
    }
}
