//! What the baked module does, on this machine and on the same numbers.

use signorini_contact::dense::blocks::{Block, SIDE, count, padded};
use signorini_contact::method::{Linear, Method};
use signorini_contact::modes::{Modal, ModalMemory, ModalStorage};
use signorini_contact::storage::{Storage, TableauStorage};
use signorini_contact::{Condensed, Memory};
use signorini_device::ranges::check;
use signorini_kernel::Error;
use signorini_kernel::limits::Deadline;
use signorini_kernel::report::Report;

use super::arrays::{Baked, Solver};
use super::visited::Visited;
use signorini_problem::scalar::Scalar;

/// The memory of a condensed scene; that of modes is empty where there are none.
type Owned<R> = ModalStorage<Vec<R>, Vec<bool>, Vec<R>, Vec<R>, Vec<Block<R>>, Vec<R>, R>;

/// The controller of a condensed scene.
#[derive(Debug)]
pub struct Controller<'b, R: Scalar> {
    baked: &'b Baked<R>,
    storage: Owned<R>,
    tableau: TableauStorage<Vec<Block<R>>, Vec<bool>, Vec<R>>,
    /// Whether the last tick had another coefficient than the one before.
    follows: bool,
}

impl<'b, R: Scalar> Controller<'b, R> {
    /// Before the first tick.
    pub fn new(baked: &'b Baked<R>) -> Self {
        let zeros = |length| vec![R::ZERO; length];
        let n = padded(baked.contact);
        let blocks = vec![[[R::ZERO; SIDE]; SIDE]; count(baked.contact)];
        let spans = zeros(baked.varying_spans());
        let shared = Storage::of(zeros(n), vec![false; n], zeros(baked.columns()), spans);
        let (matrix, terms) = match &baked.modes {
            Some(modes) => (blocks.clone(), baked.inputs + modes.count),
            None => (Vec::new(), 0),
        };
        let mut storage = ModalStorage::of(shared, matrix, zeros(terms));
        // x is what the first tick begins with, even if that is refused.
        baked.with_model(|model| _ = storage.shared_mut().memory(model));
        Self {
            baked,
            storage,
            tableau: TableauStorage::of(blocks, vec![false; n], [zeros(n), zeros(n)]),
            follows: false,
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
        let Self { storage, tableau, follows, .. } = self;
        baked.with_model(|model| {
            let Some(modes) = &baked.modes else {
                let memory = storage.shared_mut().memory(model);
                return solve(baked, model, tableau, Ticking::Plain(&inputs, memory));
            };
            let modal = &modes.view(model);
            *follows = storage.set(modal, &inputs)?;
            if *follows {
                tableau.reset();
            }
            let (model, memory) = storage.at(modal);
            solve(baked, &model, tableau, Ticking::Modal(modal, memory))
        })
    }

    /// What the last tick looked at.
    pub fn visited(&self) -> Visited {
        let shared = self.storage.shared();
        let visited = Visited::new::<R>(shared.open(), shared.combination());
        Visited { follows: self.follows, ..visited }
    }

    /// The amplitudes of the last tick, where there are modes.
    pub fn amplitudes(&self) -> &[R] {
        self.storage.inputs().get(self.baked.inputs..).unwrap_or_default()
    }

    /// The scaled openings of the last tick; before the first, those that it begins with.
    pub fn x(&self) -> &[R] {
        let x = self.storage.shared().x();
        x.get(..self.baked.contact).unwrap_or(x)
    }
}

/// What a tick works on.
enum Ticking<'m, R> {
    Plain(&'m [R], Memory<'m, R>),
    Modal(&'m Modal<'m, R>, ModalMemory<'m, R>),
}

/// A tick by the method of `baked`.
fn solve<R: Scalar>(
    baked: &Baked<R>,
    model: &Condensed<R>,
    tableau: &mut TableauStorage<Vec<Block<R>>, Vec<bool>, Vec<R>>,
    ticking: Ticking<R>,
) -> Result<(Vec<R>, Report<R>), Error> {
    match baked.solver() {
        Solver::Linear => answer(model, Linear, ticking),
        Solver::Sweeps => answer(model, baked.sweeps, ticking),
        Solver::TwoPhases => answer(model, tableau.two_phases(model)?, ticking),
        Solver::Exchanges(most) => {
            answer(model, tableau.method(model, most, baked.sweeps)?, ticking)
        }
    }
}

/// The outputs and the report of a tick.
fn answer<R: Scalar>(
    model: &Condensed<R>,
    mut method: impl Method<R>,
    ticking: Ticking<R>,
) -> Result<(Vec<R>, Report<R>), Error> {
    let deadline = &mut Deadline::never();
    let (report, inputs, memory) = match ticking {
        Ticking::Plain(inputs, mut memory) => {
            (model.tick(inputs, &mut method, deadline, &mut memory)?, inputs, memory)
        }
        Ticking::Modal(modal, mut memory) => {
            let report = modal.tick(model, &mut method, deadline, &mut memory)?;
            (report, &*memory.inputs, memory.shared)
        }
    };
    let output = |number| model.output(number, inputs, &memory, &report);
    let outputs = (0..model.outputs.len()).map(output).collect::<Result<_, _>>()?;
    Ok((outputs, report))
}
