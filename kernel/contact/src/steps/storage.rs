//! Owned memory of a model that steps in time.

use super::super::Memory;
use super::super::storage::Storage;
use super::Stepped;
use signorini_kernel::Real;

/// Storage of the model of one step, and its inputs: p, then what the last tick has left.
#[derive(Debug)]
pub struct StepStorage<Numbers, Flags, Columns, Spans, Terms> {
    shared: Storage<Numbers, Flags, Columns, Spans>,
    terms: Terms,
    /// 0 before the first tick; 2 where x is yet to follow a state that was restored.
    has_begun: u8,
}

/// [`StepStorage`] in arrays: P padded contact edges, C columns, T terms, S spans.
pub type ArrayStepStorage<R, const P: usize, const C: usize, const T: usize, const S: usize = 0> =
    StepStorage<[R; P], [u8; P], [R; C], [R; S], [R; T]>;

/// Memory of a tick (borrowed).
#[derive(Debug)]
pub struct StepMemory<'a, R> {
    /// Memory of the model.
    pub shared: Memory<'a, R>,
    /// p, p⁻, x⁻, y⁻ and d⁻.
    pub terms: &'a mut [R],
}

impl<R: Real, const P: usize, const C: usize, const T: usize, const S: usize>
    ArrayStepStorage<R, P, C, T, S>
{
    /// Zeros, which take no room in flash: the first tick begins at the start.
    pub const fn zeros() -> Self {
        Self { shared: Storage::zeros(), terms: [R::ZERO; T], has_begun: 0 }
    }
}

impl<Numbers, Flags, Columns, Spans, Terms> StepStorage<Numbers, Flags, Columns, Spans, Terms> {
    /// Before the first tick, with buffers of any contents.
    pub const fn of(shared: Storage<Numbers, Flags, Columns, Spans>, terms: Terms) -> Self {
        Self { shared, terms, has_begun: 0 }
    }

    /// The memory that [`Stepped::tick`] takes.
    pub fn memory<R: Real>(&mut self, of: &Stepped<R>) -> StepMemory<'_, R>
    where
        Numbers: AsMut<[R]>,
        Flags: AsMut<[u8]>,
        Columns: AsMut<[R]>,
        Spans: AsMut<[R]>,
        Terms: AsMut<[R]>,
    {
        let (shared, terms) = (self.shared.memory(&of.model), self.terms.as_mut());
        let first = terms.len().saturating_sub(of.begin.len());
        if self.has_begun == 0 {
            terms.iter_mut().skip(first).zip(of.begin).for_each(|(term, &given)| *term = given);
        }
        if self.has_begun == 2 {
            let openings = terms.iter().skip(2 * first.max(1) - 1);
            shared
                .iterate
                .x
                .iter_mut()
                .zip(openings)
                .take(of.model.contact)
                .for_each(|(x, &was)| *x = was);
        }
        self.has_begun = 1;
        StepMemory { shared, terms }
    }

    /// Storage of the model.
    pub fn shared(&self) -> &Storage<Numbers, Flags, Columns, Spans> {
        &self.shared
    }

    /// The terms where the next tick begins; nothing before the first.
    pub fn terms<R>(&self) -> Option<&[R]>
    where
        Terms: AsRef<[R]>,
    {
        (self.has_begun != 0).then(|| self.terms.as_ref())
    }

    /// Goes on from terms that were saved; from the start where there are none.
    pub fn restore<R: Real>(&mut self, terms: Option<impl Iterator<Item = R>>)
    where
        Terms: AsMut<[R]>,
    {
        self.reset();
        if let Some(saved) = terms {
            self.terms.as_mut().iter_mut().zip(saved).for_each(|(term, saved)| *term = saved);
            self.has_begun = 2;
        }
    }

    /// Forgets all ticks: the next one begins at the start.
    pub fn reset(&mut self) {
        self.shared.reset();
        self.has_begun = 0;
    }
}
