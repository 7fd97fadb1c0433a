//! A contact problem condensed to its contact edges: small, dense, and exact.
//!
//! Where mesh and A are fixed and all loads are combinations of patterns with weights p, the host
//! eliminates every unknown but the means on the n contact edges, once and in f64. With the openings
//! v = u_C − ψ ≥ 0, scaled so that the diagonal is 1 and the unit of energy is U,
//! ```text
//!   x_i = v_i / d_i,  d_i = U / √K_ii        x ≥ 0,  r = S x − B p ≥ 0,  xᵀr = 0
//!   outputs  y = Y_p p + Y_x x               bound   U ‖F (p, x, d)‖ + …
//! ```
//! K the Schur complement on the contact edges and S = K_ij / √(K_ii K_jj). p_0 = 1 stands for what does not
//! change. The mesh may be as fine as accuracy wants: the target never sees it.
//!
//! ```text
//!   inputs ─► load B p ─► Method: pivoting (exact) or sweeps ─► r ─► certificate ─► outputs
//! ```
//! [`blocks`] hold S; [`sor`] sweeps over them; [`tableau`] and [`pivoting`] solve exactly; [`factor`] and
//! [`certificate`] bound the error; [`outputs`] are read off; [`storage`] owns the memory. `signorini bake` writes all of it.

pub mod blocks;
pub mod certificate;
mod correction;
pub mod factor;
pub mod method;
pub mod outputs;
pub mod pivoting;
pub mod sor;
pub mod storage;
pub mod tableau;

use crate::certificate::Certificate;
use crate::error::{Array, Error, all_finite, same_length};
use crate::real::Real;
use blocks::{Block, Blocks};
use certificate::{Answer, Form};
use method::{Ended, Method};
use outputs::Measure;
use tableau::Start;

/// A baked model (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Condensed<'a, R> {
    /// n
    pub contact: usize,
    /// S, as [`Blocks::new`] takes it.
    pub matrix: &'a [Block<R>],
    /// x of the answer in which the first tick begins; zeros are assumed where it ends.
    pub x: &'a [R],
    /// Where the exact method begins; empty for sweeps alone.
    pub start: Start<'a, R>,
    /// B by columns: [`blocks::padded`] entries for each input, the constant first.
    pub load: &'a [R],
    /// The outputs.
    pub outputs: &'a [Measure<'a, R>],
    /// What bounds the error; absent where there is no bound, or nobody asks for it.
    pub certificate: Option<Form<'a, R>>,
}

/// Memory of a condensed model (borrowed).
#[derive(Debug)]
pub struct Memory<'a, R> {
    /// x stays from tick to tick, zeros to begin with; the rest is scratch.
    pub iterate: Iterate<'a, R>,
    /// B p, with [`blocks::padded`] entries.
    pub load: &'a mut [R],
    /// One entry a column of F; empty without a certificate.
    pub combination: &'a mut [R],
    /// One entry a column of F; empty without a certificate.
    pub sum: &'a mut [R],
}

/// Arrays that a solve works on, with [`blocks::padded`] entries each (borrowed).
#[derive(Debug)]
pub struct Iterate<'a, R> {
    /// Where it starts; becomes x ≥ 0, whatever ends the solve.
    pub x: &'a mut [R],
    /// Becomes Sx − b.
    pub residual: &'a mut [R],
    /// Scratch.
    pub scratch: &'a mut [R],
    /// Becomes true where x > 0.
    pub open: &'a mut [bool],
}

impl<R> Iterate<'_, R> {
    /// The same arrays, for a while.
    fn lend(&mut self) -> Iterate<'_, R> {
        Iterate { x: self.x, residual: self.residual, scratch: self.scratch, open: self.open }
    }
}

/// What a tick says beside its outputs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Report<R> {
    /// What ended it.
    pub ended: Ended,
    /// Exchanges of the exact method.
    pub pivots: u32,
    /// Sweeps.
    pub sweeps: u32,
    /// Edges that touch.
    pub active: u32,
    /// How wrong the answer can be, where that is known.
    pub certificate: Option<Certificate<R>>,
}

impl<R: Real> Condensed<'_, R> {
    /// S
    ///
    /// # Errors
    /// Another number of blocks than [`Condensed::contact`] asks for.
    pub fn matrix(&self) -> Result<Blocks<'_, R>, Error> {
        Blocks::new(self.matrix, self.contact)
    }

    /// Solves for the inputs p, p_0 = 1 among them, from the last x, and bounds the error.
    ///
    /// # Errors
    /// Inputs that are not finite, or loads that overflow: x is what it was then. Arrays of the wrong length.
    pub fn tick<M: Method<R>>(
        &self,
        inputs: &[R],
        method: &mut M,
        memory: &mut Memory<R>,
    ) -> Result<Report<R>, Error> {
        all_finite(Array::Load, inputs)?;
        let matrix = self.matrix()?;
        self.combine(inputs, memory.load)?;
        all_finite(Array::Load, memory.load)?;
        let progress = method.solve(&matrix, memory.load, memory.iterate.lend())?;
        let Iterate { x, residual, .. } = &memory.iterate;
        let (x, residual) = (self.unpadded(x), self.unpadded(residual));
        let answer = Answer { inputs, x, residual };
        let certificate = match &self.certificate {
            Some(form) => form.certify(&answer, memory.combination, memory.sum)?,
            None => None,
        };
        let active = x.iter().filter(|x| **x == R::ZERO).count() as u32;
        let method::Progress { ended, pivots, sweeps } = progress;
        Ok(Report { ended, pivots, sweeps, active, certificate })
    }

    /// Output `number` of the last tick, `x` being that of its memory.
    ///
    /// # Errors
    /// Arrays of the wrong length; no such output; a value that overflows.
    pub fn output(
        &self,
        number: usize,
        inputs: &[R],
        x: &[R],
        report: &Report<R>,
    ) -> Result<R, Error> {
        let stray = Error::OutOfRange { of: Array::Scratch, at: number };
        let measure = self.outputs.get(number).ok_or(stray)?;
        let value = measure.value(inputs, self.unpadded(x), report.certificate.as_ref())?;
        match measure {
            Measure::Linear { .. } if !value.finite() => {
                Err(Error::NotFinite { of: Array::Fluxes, at: number })
            }
            _ => Ok(value),
        }
    }

    fn unpadded<'x>(&self, vector: &'x [R]) -> &'x [R] {
        vector.get(..self.contact).unwrap_or(vector)
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
