//! How far it is from one end of a contact edge's flux to the other, as a linear form of the inputs.
//!
//! ```text
//!   span_i(p) = Σ_j p_j span_ij        in the unit of r; ±∞ in the constant column alone
//! ```
//! Where no input acts on an end there is one column, and a span has either sign ([`signorini_kernel::flux_range`]). Otherwise the load has
//! the lower end wherever that is finite, and a span may not fall below 0. Without the feature `limited` all are ∞.

use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::features;
use signorini_kernel::flux_range::{Spans, settled};

/// Spans by columns (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct SpanColumns<'a, R> {
    columns: &'a [R],
}

/// Room for the spans of a tick, one for each contact edge and its padding where inputs change them (borrowed).
#[derive(Debug)]
pub struct SpanBuffer<'a, R> {
    spans: &'a mut [R],
}

impl<'a, R: Real> SpanBuffer<'a, R> {
    /// Empty where no input changes a span.
    #[inline(always)]
    pub fn new(spans: &'a mut [R]) -> Self {
        Self { spans }
    }
}

impl<'a, R: Real> SpanColumns<'a, R> {
    /// No flux has a limit.
    pub const UNLIMITED: Self = Self::new(&[]);

    /// One column for all inputs, or one for each input, the constant first; each has
    /// [`crate::dense::blocks::padded`] entries.
    pub const fn new(columns: &'a [R]) -> Self {
        Self { columns }
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

    /// Works out the spans for these inputs where inputs change them.
    ///
    /// # Errors
    /// Arrays of the wrong length; an edge whose limit is below its least flux by more than rounding.
    #[inline(always)]
    pub(super) fn combine(
        &self,
        inputs: &[R],
        padded: usize,
        buffer: &mut SpanBuffer<R>,
    ) -> Result<(), Error> {
        let are_varying = self.buffered(padded) > 0;
        if are_varying { self.sum_up(inputs, padded, buffer.spans) } else { Ok(()) }
    }

    #[inline(never)]
    fn sum_up(&self, inputs: &[R], padded: usize, spans: &mut [R]) -> Result<(), Error> {
        same_length(Array::ContactSpans, self.columns().len(), padded * inputs.len())?;
        same_length(Array::ContactSpans, spans.len(), padded)?;
        let sums = |at: usize| {
            let column = self.columns().iter().skip(at).step_by(padded.max(1));
            column.zip(inputs).fold((R::ZERO, R::ZERO), |(sum, size), (&entry, &p)| {
                (sum + entry * p, size + (entry * p).magnitude())
            })
        };
        let settled = |at: usize| {
            let (sum, size) = sums(at);
            if size.finite() { settled(sum, size, inputs.len()) } else { Some(sum) }
        };
        // Nothing is written where an edge is refused.
        if let Some(contact) = (0..padded).find(|&at| settled(at).is_none()) {
            return Err(Error::EmptyRange { contact });
        }
        for (at, span) in spans.iter_mut().enumerate() {
            *span = settled(at).unwrap_or(R::ZERO);
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
    }
}
