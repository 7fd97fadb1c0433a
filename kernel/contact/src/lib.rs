#![no_std]
#![deny(clippy::indexing_slicing, clippy::unwrap_used, clippy::expect_used, clippy::panic)]
// `!(a < b)` is meant: it is true where a or b is NaN.
#![allow(clippy::neg_cmp_op_on_partial_ord)]
// Pages of a lean build name what it leaves out.
#![cfg_attr(not(feature = "transfer"), allow(rustdoc::broken_intra_doc_links))]
//! A contact problem condensed to its contact edges: small, dense, and exact.
//!
//! Where mesh and A are fixed and all loads are combinations of patterns with weights p, the host
//! eliminates every unknown but the means on the n contact edges, once and in f64. With the openings
//! v = u_C − ψ ≥ 0, scaled so that the diagonal is 1 and the unit of energy is U,
//! ```text
//!   x_i = v_i / d_i,  d_i = U / √K_ii        x ≥ 0,  r = S x − B p ≥ 0,  xᵀr = 0
//!   outputs  y = Y_p p + Y_x x + Y_r r⁺      bound   U ‖F (p, x, d)‖ + …
//! ```
//! K the Schur complement on the contact edges and S = K_ij / √(K_ii K_jj). p_0 = 1 stands for what does not
//! change. The mesh may be as fine as accuracy wants: the target never sees it. Where the flux of an edge has a limit, x has
//! either sign and r its range ([`spans`], [`crate::dense::ranges`]).
//!
//! ```text
//!   inputs ─► load B p ─► Method: pivoting (exact) or sweeps ─► r ─► certificate ─► outputs
//! ```
//! [`crate::dense`] holds S and solves; [`factor`] and [`certificate`] bound the error; [`outputs`] are read off;
//! [`balance`] tells loads that contact cannot hold; [`storage`] owns the memory; `modes` are for a transfer coefficient that changes,
//! [`steps`] for steps in time. `signorini bake` writes all of it.

pub mod balance;
pub mod candidate;
pub mod certificate;
pub mod dense;
pub mod factor;
pub mod method;
#[cfg(feature = "transfer")]
pub mod modes;
pub mod outputs;
pub mod sides;
pub mod spans;
pub mod steps;
pub mod storage;

use crate::dense::blocks::{self, Block, Blocks};
use crate::dense::pivoting::settle;
use crate::dense::ranges::Given;
use crate::dense::tableau::InitialTableau;
use crate::dense::{Iterate, sizes};
use balance::Balance;
use candidate::Candidate;
use certificate::Form;
use method::Method;
use outputs::Measure;
use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error, all_finite, same_length};
use signorini_kernel::limits::Deadline;
use signorini_kernel::report::Report;
use signorini_kernel::verdict::Verdict;
use spans::{SpanBuffer, SpanColumns};

/// A baked model (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Condensed<'a, R> {
    /// n
    pub contact: usize,
    /// S, as [`Blocks::new`] takes it.
    pub matrix: &'a [Block<R>],
    /// x of the answer in which the first tick begins; zeros are assumed where it ends.
    pub x: &'a [R],
    /// Where exchanges begin; empty where there are none.
    pub start: InitialTableau<'a, R>,
    /// B by columns: [`blocks::padded`] entries for each input, the constant first.
    pub load: &'a [R],
    /// x is kept within these, a pair per contact edge: there the edges that were taken out, since they never change
    /// sides within the ranges of the inputs, are on their sides. Empty where none was.
    pub limits: &'a [[R; 2]],
    /// How far it is to the other end of each flux.
    pub spans: SpanColumns<'a, R>,
    /// The parts that contact alone holds.
    pub parts: &'a [Balance<'a, R>],
    /// The outputs.
    pub outputs: &'a [Measure<'a, R>],
    /// Form that bounds the error; absent where there is no bound, or nobody asks for it.
    pub certificate: Option<Form<'a, R>>,
    /// Whether the data allow for a bound: where they do and it is absent, nobody asks for it.
    pub has_bound: bool,
}

/// Memory of a condensed model (borrowed).
#[derive(Debug)]
pub struct Memory<'a, R> {
    /// x stays from tick to tick, zeros to begin with; the rest is scratch.
    pub iterate: Iterate<'a, R>,
    /// B p, with [`blocks::padded`] entries.
    pub load: &'a mut [R],
    /// The spans for p.
    pub spans: SpanBuffer<'a, R>,
    /// One entry a column of F; empty without a certificate.
    pub combination: &'a mut [R],
    /// One entry a column of F; empty without a certificate.
    pub sum: &'a mut [R],
}

impl<R: Real> Condensed<'_, R> {
    /// S
    ///
    /// # Errors
    /// Another number of blocks than [`Condensed::contact`] asks for.
    pub fn matrix(&self) -> Result<Blocks<'_, R>, Error> {
        Blocks::new(self.matrix, self.contact)
    }

    /// Solves for the inputs p, p_0 = 1 among them, from the last x and until the deadline, and bounds the error.
    ///
    /// # Errors
    /// Inputs that are not finite, or so large that the answer or an output may overflow; inputs without a solution, or with
    /// more than one; arrays of the wrong length. In any case the last answer stays: x and the method are what they were, bit for bit.
    pub fn tick<M: Method<R>, F: FnMut() -> u32>(
        &self,
        inputs: &[R],
        method: &mut M,
        deadline: &mut Deadline<F>,
        memory: &mut Memory<R>,
    ) -> Result<Report<R>, Error> {
        self.prepare(inputs, memory)?;
        self.solve(inputs, method, deadline, memory)
    }

    /// Works out loads and spans for these inputs.
    ///
    /// # Errors
    /// As for [`Condensed::tick`].
    #[inline(always)]
    fn prepare(&self, inputs: &[R], memory: &mut Memory<R>) -> Result<(), Error> {
        all_finite(Array::Load, inputs)?;
        self.combine(inputs, memory.load)?;
        self.check_magnitude(inputs, memory.load)?;
        self.spans.combine(inputs, memory.load, &mut memory.spans)?;
        self.parts.iter().try_for_each(|part| part.check(inputs))
    }

    /// Solves for what [`Condensed::prepare`] has left.
    #[inline(always)]
    fn solve<M: Method<R>, F: FnMut() -> u32>(
        &self,
        inputs: &[R],
        method: &mut M,
        deadline: &mut Deadline<F>,
        memory: &mut Memory<R>,
    ) -> Result<Report<R>, Error> {
        let matrix = self.matrix()?;
        let spans = self.spans.of(memory.load.len(), &memory.spans);
        let given = Given::between(memory.load, spans, &[]);
        let progress = method.solve(&matrix, given, memory.iterate.reborrow(), deadline)?;
        self.clamp(&matrix, given, &mut memory.iterate)?;
        let Iterate { x, residual, .. } = &memory.iterate;
        let (x, residual) = (self.unpadded(x), self.unpadded(residual));
        let answer = Candidate { inputs, x, residual, ranges: given.ranges };
        let verdict = match &self.certificate {
            Some(form) => form.certify(&answer, memory.combination, memory.sum)?,
            None if self.has_bound => Verdict::NotAsked,
            None => Verdict::Unavailable,
        };
        Ok(progress.report(x, verdict))
    }

    /// Output `number` of the last tick with this memory.
    ///
    /// # Errors
    /// Arrays of the wrong length; no such output; a value that overflows.
    // Inlined for a number that is a constant: [`Measure::value`].
    #[inline(always)]
    pub fn output(
        &self,
        number: usize,
        inputs: &[R],
        memory: &Memory<R>,
        report: &Report<R>,
    ) -> Result<R, Error> {
        let stray = Error::OutOfRange { of: Array::Scratch, at: number };
        let measure = self.outputs.get(number).ok_or(stray)?;
        let answer = self.candidate(inputs, memory);
        let value = measure.value(&answer, report.certificate())?;
        match measure {
            Measure::Linear { .. } | Measure::Flux { .. } if !value.finite() => {
                Err(Error::NotFinite { of: Array::Fluxes, at: number })
            }
            _ => Ok(value),
        }
    }

    /// The last tick's answer to these inputs.
    #[inline(always)]
    fn candidate<'m>(&'m self, inputs: &'m [R], memory: &'m Memory<R>) -> Candidate<'m, R> {
        let Iterate { x, residual, .. } = &memory.iterate;
        let (x, residual) = (self.unpadded(x), self.unpadded(residual));
        let spans = self.spans.of(memory.load.len(), &memory.spans);
        Candidate { inputs, x, residual, ranges: Given::between(&[], spans, &[]).ranges }
    }

    /// x within [`Condensed::limits`]: solutions are, a tick that was cut off need not be.
    // Inlined, the matrix stays a constant of the controller's code, which then has no code for other orders.
    #[inline(always)]
    fn clamp(
        &self,
        matrix: &Blocks<R>,
        given: Given<R>,
        iterate: &mut Iterate<R>,
    ) -> Result<(), Error> {
        let Iterate { x, residual, open, .. } = iterate;
        let mut is_beyond = false;
        for (x, &[least, most]) in x.iter_mut().zip(self.limits) {
            if !(least <= *x && *x <= most) {
                (*x, is_beyond) = (if *x > most { most } else { least }, true);
            }
        }
        if is_beyond { settle(matrix, given, x, residual, open) } else { Ok(()) }
    }

    /// U; 1 without a certificate.
    fn unit(&self) -> R {
        self.certificate.as_ref().map_or(R::ONE, |form| form.unit)
    }

    fn unpadded<'x>(&self, vector: &'x [R]) -> &'x [R] {
        vector.get(..self.contact).unwrap_or(vector)
    }

    /// `Ok` where neither the answer to this load nor an output can overflow: what openings add is at most Σ|Y_x| times
    /// the largest x, and r is at most n times that. Without contact an output refuses by itself, and leaves nothing
    /// behind.
    fn check_magnitude(&self, inputs: &[R], load: &[R]) -> Result<(), Error> {
        if self.contact == 0 {
            return Ok(());
        }
        let room = sizes::room(sizes::of_load(load)?);
        let count = R::from_count(load.len() as u32 + 1);
        let size = |y: &[R]| y.iter().fold(R::ZERO, |sum, y| sum + y.magnitude());
        for (at, measure) in self.outputs.iter().enumerate() {
            let (of_inputs, of_contact, of_reaction): (_, _, &[R]) = match *measure {
                Measure::Linear { of_inputs, of_contact } => (of_inputs, of_contact, &[]),
                Measure::Flux { of_inputs, of_contact, of_reaction } => {
                    (of_inputs, of_contact, of_reaction)
                }
                Measure::Length { .. } | Measure::Saturated { .. } | Measure::Bound => continue,
            };
            let given = of_inputs.iter().zip(inputs);
            let given = given.fold(R::ZERO, |sum, (&y, &p)| sum + (y * p).magnitude());
            let most = (size(of_contact) + size(of_reaction) * count) * room;
            if !(given + most).finite() {
                return Err(Error::NotFinite { of: Array::Fluxes, at });
            }
        }
        Ok(())
    }

    /// `load` = B p
    fn combine(&self, inputs: &[R], load: &mut [R]) -> Result<(), Error> {
        same_length(Array::Load, load.len(), blocks::padded(self.contact))?;
        same_length(Array::Load, self.load.len(), load.len() * inputs.len())?;
        load.fill(R::ZERO);
        for (column, &p) in self.load.chunks_exact(load.len().max(1)).zip(inputs) {
            load.iter_mut().zip(column).for_each(|(load, &entry)| *load += entry * p);
        }
        Ok(())
    }
}
