//! How far it is from one end of a contact edge's flux to the other, as a linear form of the inputs.
//!
//! ```text
//!   span_i(p) = Σ_j p_j span_ij        in the unit of r; ±∞ in the constant column alone
//! ```
//! Where no input acts on an end there is one column, and a span has either sign ([`signorini_kernel::flux_range`]). Otherwise the load has
//! the lower end wherever that is finite, and a span may not fall below 0 by more than rounding ([`Room`]). Without the feature `limited` all are ∞.

use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::features;
use signorini_kernel::flux_range::{Room, Spans};

/// Spans by columns (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct SpanColumns<'a, R> {
    columns: &'a [R],
    rooms: &'a [Room<'a, R>],
}

/// Room for the spans of a tick, one for each contact edge and its padding where inputs change them (borrowed).
#[derive(Debug)]
pub struct SpanBuffer<'a, R> {
    spans: &'a mut [R],
    /// By how much ends of ranges were moved to their mean, at most.
    pub(super) moved: R,
}

impl<'a, R: Real> SpanBuffer<'a, R> {
    /// Empty where no input changes a span.
    #[inline(always)]
    pub fn new(spans: &'a mut [R]) -> Self {
        Self { spans, moved: R::ZERO }
    }
}

impl<'a, R: Real> SpanColumns<'a, R> {
    /// No flux has a limit.
    pub const UNLIMITED: Self = Self::new(&[]);

    /// One column for all inputs, or one for each input, the constant first; each has
    /// [`crate::dense::blocks::padded`] entries.
    pub const fn new(columns: &'a [R]) -> Self {
        Self { columns, rooms: &[] }
    }

    /// Spans with what inputs leave of ranges that they change.
    pub const fn within(self, rooms: &'a [Room<'a, R>]) -> Self {
        Self { rooms, ..self }
    }

    /// How many spans a tick works out for so many edges with their padding: none where no input changes one.
    pub const fn buffered(&self, padded: usize) -> usize {
        if features::LIMITED && self.columns.len() > padded { padded } else { 0 }
    }

    /// Whether a flux has a limit.
    #[inline(always)]
    pub fn are_limited(&self) -> bool {
        !self.columns().is_empty()
    }

    #[inline(always)]
    fn columns(&self) -> &'a [R] {
        if features::LIMITED { self.columns } else { &[] }
    }

    /// Works out the spans for these inputs where inputs change them. What rounding leaves below 0 becomes 0, and `load`,
    /// which contains the base, goes half of the way: both ends are their mean.
    ///
    /// # Errors
    /// Arrays of the wrong length; an input that brings a limit below the least flux by more than rounding.
    #[inline(always)]
    pub(super) fn combine(
        &self,
        inputs: &[R],
        load: &mut [R],
        buffer: &mut SpanBuffer<R>,
    ) -> Result<(), Error> {
        let are_varying = self.buffered(load.len()) > 0;
        if are_varying { self.sum_up(inputs, load, buffer) } else { Ok(()) }
    }

    #[inline(never)]
    fn sum_up(
        &self,
        inputs: &[R],
        load: &mut [R],
        SpanBuffer { spans, moved }: &mut SpanBuffer<R>,
    ) -> Result<(), Error> {
        let padded = load.len();
        same_length(Array::ContactSpans, self.columns().len(), padded * inputs.len())?;
        same_length(Array::ContactSpans, spans.len(), padded)?;
        // Nothing is written where an input is refused.
        let given = inputs.get(1..).unwrap_or_default();
        self.rooms.iter().try_for_each(|room| room.check(given))?;
        for (at, (span, load)) in spans.iter_mut().zip(load).enumerate() {
            let column = self.columns().iter().skip(at).step_by(padded.max(1));
            let terms = column.zip(inputs).map(|(&entry, &p)| entry * p);
            *span = terms.fold(R::ZERO, |sum, term| sum + term);
            if *span < R::ZERO && span.finite() {
                let half = R::HALF * *span;
                *load += half;
                (*span, *moved) = (R::ZERO, moved.or_larger(-half));
            }
        }
        Ok(())
    }

    /// The spans that the last tick with this `buffer` has worked out, or those that no input changes; `padded` is
    /// [`crate::dense::blocks::padded`] of the contact edges.
    #[inline(always)]
    pub fn of<'s>(&self, padded: usize, buffer: &'s SpanBuffer<'_, R>) -> Spans<'s, R>
    where
        'a: 's,
    {
        let is_varying = self.buffered(padded) > 0;
        Spans::baked(if is_varying { buffer.spans } else { self.columns() }, R::ZERO)
            .moved_by(buffer.moved)
    }
}
