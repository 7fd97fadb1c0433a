//! How far it is from one end of a contact edge's flux to the other, as a linear form of the inputs.
//!
//! ```text
//!   span_i(p) = Σ_j p_j span_ij        in the unit of r; ±∞ in the constant column alone
//! ```
//! Where no input acts on an end there is one column, and a span has either sign ([`signorini_kernel::flux_range`]). Otherwise the load has
//! the lower end wherever that is finite, and a span may not fall below 0. Without the feature `limited` nothing is stored.

use core::marker::PhantomData;

use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::features;
use signorini_kernel::flux_range::Spans;

/// Spans by columns (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct SpanColumns<'a, R> {
    #[cfg(feature = "limited")]
    columns: &'a [R],
    lent: PhantomData<&'a R>,
}

/// Room for the spans of a tick, one for each contact edge and its padding where inputs change them (borrowed).
#[derive(Debug)]
pub struct SpanBuffer<'a, R> {
    #[cfg(feature = "limited")]
    spans: &'a mut [R],
    lent: PhantomData<&'a mut R>,
}

impl<'a, R: Real> SpanBuffer<'a, R> {
    /// Empty where no input changes a span.
    #[inline(always)]
    pub fn new(spans: &'a mut [R]) -> Self {
        #[cfg(not(feature = "limited"))]
        let _ = spans;
        Self {
            #[cfg(feature = "limited")]
            spans,
            lent: PhantomData,
        }
    }

    #[inline(always)]
    fn read(&self) -> &[R] {
        #[cfg(feature = "limited")]
        return self.spans;
        #[cfg(not(feature = "limited"))]
        &[]
    }

    #[inline(always)]
    fn write(&mut self) -> &mut [R] {
        #[cfg(feature = "limited")]
        return self.spans;
        #[cfg(not(feature = "limited"))]
        &mut []
    }
}

impl<'a, R: Real> SpanColumns<'a, R> {
    /// No flux has a limit.
    pub const UNLIMITED: Self = Self {
        #[cfg(feature = "limited")]
        columns: &[],
        lent: PhantomData,
    };

    /// One column for all inputs, or one for each input, the constant first; each has
    /// [`crate::dense::blocks::padded`] entries.
    #[cfg(feature = "limited")]
    pub const fn new(columns: &'a [R]) -> Self {
        Self { columns, lent: PhantomData }
    }

    /// How many spans a tick works out for so many edges with their padding: none where no input changes one.
    pub const fn buffered(&self, padded: usize) -> usize {
        #[cfg(feature = "limited")]
        return if self.columns.len() > padded { padded } else { 0 };
        #[cfg(not(feature = "limited"))]
        {
            let _ = padded;
            0
        }
    }

    /// Whether a flux has a limit.
    #[inline(always)]
    pub fn are_limited(&self) -> bool {
        !self.columns().is_empty()
    }

    #[inline(always)]
    fn columns(&self) -> &'a [R] {
        #[cfg(feature = "limited")]
        return self.columns;
        #[cfg(not(feature = "limited"))]
        &[]
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
        let are_varying = features::LIMITED && self.buffered(padded) > 0;
        if are_varying { self.sum_up(inputs, padded, buffer.write()) } else { Ok(()) }
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
        let rounding = R::from_count(inputs.len() as u32 + 4) * R::EPSILON;
        let is_reversed = |&at: &usize| {
            let (sum, size) = sums(at);
            size.finite() && sum < -(rounding * size)
        };
        // Nothing is written where an edge is refused.
        if let Some(contact) = (0..padded).find(is_reversed) {
            return Err(Error::EmptyRange { contact });
        }
        for (at, span) in spans.iter_mut().enumerate() {
            let (sum, size) = sums(at);
            *span = if size.finite() { sum.or_larger(R::ZERO) } else { sum };
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
        #[cfg(feature = "limited")]
        return Spans::baked(
            if self.buffered(padded) > 0 { buffer.read() } else { self.columns() },
            R::ZERO,
        );
        #[cfg(not(feature = "limited"))]
        {
            let _ = (padded, buffer.read());
            Spans::UNLIMITED
        }
    }
}
