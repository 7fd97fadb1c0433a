//! Ticks of a condensed model in memory of its own: by the method that the memory is for.
//!
//! ```text
//!   plain:   inputs ────────────────────────────► Solver ─► method on S    ─► Condensed::tick ─► outputs
//!   steps:   inputs ─► terms ───────────────────► Solver ─► method on S    ─► Stepped::tick   ─► outputs ─► advance
//!   modes:   inputs ─► set: S(t), new tableau? ─► Solver ─► method on S(t) ─► Modal::tick     ─► outputs
//! ```
//! The type of the [`Solver`] chooses the method when the program is compiled: an image has the code of that one alone.

mod steps;

use crate::controller::{self, Answer, Outputs, Reading};
use signorini_contact::dense::blocks::Block;
use signorini_contact::method::{Linear, Method, Pivots, Sweeps, TwoPhases};
#[cfg(feature = "transfer")]
use signorini_contact::modes::{Modal, ModalStorage};
use signorini_contact::storage::{Storage, TableauStorage};
use signorini_contact::{Condensed, Memory};
use signorini_kernel::limits::{Deadline, Limits};
use signorini_kernel::report::Report;
use signorini_kernel::{Error, Real};

/// How far a method may go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort<R> {
    /// Most exchanges of a tick.
    pub pivots: u32,
    /// The factor of sweeps, and when they end; their number is that of the limits.
    pub sweeps: Sweeps<R>,
}

impl<R: Real> Effort<R> {
    /// For methods that come to their end.
    pub const NONE: Self =
        Self { pivots: 0, sweeps: Sweeps { omega: R::ONE, tolerance: R::ZERO, most: 0 } };
}

/// A method with what it keeps from tick to tick.
pub trait Solver<R: Real> {
    /// The method of one tick.
    type Method<'a>: Method<R>
    where
        Self: 'a;

    /// Begins on `model`, with at most so many exchanges and these sweeps.
    ///
    /// # Errors
    /// A model of another size.
    fn method<'a>(
        &'a mut self,
        model: &Condensed<'a, R>,
        pivots: u32,
        sweeps: Sweeps<R>,
    ) -> Result<Self::Method<'a>, Error>;

    /// Forgets all ticks.
    fn reset(&mut self) {}

    /// Hands `put` all that the next tick takes of the last one.
    fn save(&self, _put: impl FnMut(R)) {}

    /// Takes that over, in the same order.
    fn restore(&mut self, _take: impl FnMut() -> R) {}
}

impl<R: Real> Solver<R> for Linear {
    type Method<'a> = Self;

    fn method(&mut self, _: &Condensed<R>, _: u32, _: Sweeps<R>) -> Result<Self, Error> {
        Ok(Self)
    }
}

/// Sweeps alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Swept;

impl<R: Real> Solver<R> for Swept {
    type Method<'a> = Sweeps<R>;

    fn method(&mut self, _: &Condensed<R>, _: u32, sweeps: Sweeps<R>) -> Result<Sweeps<R>, Error> {
        Ok(sweeps)
    }
}

/// Exchanges on a tableau, and sweeps where they do not suffice.
#[derive(Debug)]
pub struct Exchanges<T>(pub T);

impl<R, Blocks, Flags, Column> Solver<R> for Exchanges<TableauStorage<Blocks, Flags, Column>>
where
    R: Real,
    Blocks: AsRef<[Block<R>]> + AsMut<[Block<R>]>,
    Flags: AsRef<[u8]> + AsMut<[u8]>,
    Column: AsMut<[R]>,
{
    type Method<'a>
        = Pivots<'a, R>
    where
        Self: 'a;

    fn method<'a>(
        &'a mut self,
        model: &Condensed<'a, R>,
        pivots: u32,
        sweeps: Sweeps<R>,
    ) -> Result<Pivots<'a, R>, Error> {
        self.0.method(model, pivots, sweeps)
    }

    fn reset(&mut self) {
        self.0.reset();
    }

    fn save(&self, put: impl FnMut(R)) {
        self.0.save(put);
    }

    fn restore(&mut self, take: impl FnMut() -> R) {
        self.0.restore(take);
    }
}

/// Exchanges on a tableau in phases, which come to their end.
#[derive(Debug)]
pub struct Phased<T>(pub T);

impl<R, Blocks, Flags, Column> Solver<R> for Phased<TableauStorage<Blocks, Flags, Column>>
where
    R: Real,
    Blocks: AsRef<[Block<R>]> + AsMut<[Block<R>]>,
    Flags: AsRef<[u8]> + AsMut<[u8]>,
    Column: AsMut<[R]>,
{
    type Method<'a>
        = TwoPhases<'a, R>
    where
        Self: 'a;

    fn method<'a>(
        &'a mut self,
        model: &Condensed<'a, R>,
        _: u32,
        _: Sweeps<R>,
    ) -> Result<TwoPhases<'a, R>, Error> {
        self.0.two_phases(model)
    }

    fn reset(&mut self) {
        self.0.reset();
    }

    fn save(&self, put: impl FnMut(R)) {
        self.0.save(put);
    }

    fn restore(&mut self, take: impl FnMut() -> R) {
        self.0.restore(take);
    }
}

/// The memory of a controller: of its iterate, in a [`Storage`] or `ModalStorage`, and of its method.
#[derive(Debug)]
pub struct ControllerStorage<Iterate, Method> {
    /// Iterate and scratch.
    pub iterate: Iterate,
    /// A [`Solver`].
    pub solver: Method,
}

impl<R, Numbers, Flags, Columns, Spans, M> controller::Storage<R>
    for ControllerStorage<Storage<Numbers, Flags, Columns, Spans>, M>
where
    R: Real,
    Numbers: AsMut<[R]>,
    Flags: AsMut<[u8]>,
    Columns: AsMut<[R]> + AsRef<[R]>,
    Spans: AsMut<[R]>,
    M: Solver<R>,
{
    type Model<'m> = Condensed<'m, R>;
    type Setup<'m> = Effort<R>;

    fn reset(&mut self) {
        self.iterate.reset();
        self.solver.reset();
    }

    fn combination(&self) -> &[R] {
        self.iterate.combination()
    }

    #[inline(always)]
    fn tick<O: Outputs<R>, F: FnMut() -> u32>(
        &mut self,
        system: &Self::Model<'_>,
        &Effort { pivots, sweeps }: &Self::Setup<'_>,
        terms: &impl AsRef<[R]>,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Answer<O, R>, Error> {
        let sweeps = Sweeps { most: limits.sweeps, ..sweeps };
        let mut method = self.solver.method(system, pivots, sweeps)?;
        let memory = &mut self.iterate.memory(system);
        let report = &system.tick(terms.as_ref(), &mut method, deadline, memory)?;
        let terms = terms.as_ref();
        let outputs = O::read(&Read { system, terms, memory, report })?;
        Ok(Answer { outputs, report: *report })
    }
}

#[cfg(feature = "transfer")]
impl<R, Numbers, Flags, Columns, Spans, Matrix, Inputs, M> controller::Storage<R>
    for ControllerStorage<ModalStorage<Numbers, Flags, Columns, Spans, Matrix, Inputs, R>, M>
where
    R: Real,
    Numbers: AsMut<[R]>,
    Flags: AsMut<[u8]>,
    Columns: AsMut<[R]> + AsRef<[R]>,
    Spans: AsMut<[R]>,
    Matrix: AsRef<[Block<R>]> + AsMut<[Block<R>]>,
    Inputs: AsMut<[R]>,
    M: Solver<R>,
{
    type Model<'m> = Modal<'m, R>;
    type Setup<'m> = Effort<R>;

    fn reset(&mut self) {
        self.iterate.reset();
        self.solver.reset();
    }

    fn combination(&self) -> &[R] {
        self.iterate.shared().combination()
    }

    #[inline(always)]
    fn tick<O: Outputs<R>, F: FnMut() -> u32>(
        &mut self,
        modal: &Self::Model<'_>,
        &Effort { pivots, sweeps }: &Self::Setup<'_>,
        terms: &impl AsRef<[R]>,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Answer<O, R>, Error> {
        // A tableau belongs to one value of the coefficient.
        if self.iterate.set(modal, terms.as_ref())? {
            self.solver.reset();
        }
        let (system, mut memory) = self.iterate.at(modal);
        let sweeps = Sweeps { most: limits.sweeps, ..sweeps };
        let mut method = self.solver.method(&system, pivots, sweeps)?;
        let report = &modal.tick(&system, &mut method, deadline, &mut memory)?;
        let (system, terms, memory) = (&system, &*memory.inputs, &memory.shared);
        let outputs = O::read(&Read { system, terms, memory, report })?;
        Ok(Answer { outputs, report: *report })
    }
}

/// An answer of a condensed model.
struct Read<'r, R> {
    system: &'r Condensed<'r, R>,
    terms: &'r [R],
    memory: &'r Memory<'r, R>,
    report: &'r Report<R>,
}

impl<R: Real> Reading<R> for Read<'_, R> {
    fn count(&self) -> usize {
        self.system.outputs.len()
    }

    // Inlined for a number that is a constant: [`Condensed::output`].
    #[inline(always)]
    fn value(&self, number: usize) -> Result<R, Error> {
        self.system.output(number, self.terms, self.memory, self.report)
    }
}
