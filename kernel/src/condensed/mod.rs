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
//! [`panels`] hold S; [`sor`] sweeps over them; [`tableau`] and [`pivoting`] solve exactly; [`factor`] and
//! [`certificate`] bound the error; [`outputs`] are read off. `signorini bake` writes all of it.

pub mod certificate;
pub mod factor;
pub mod method;
pub mod outputs;
pub mod panels;
pub mod pivoting;
pub mod sor;
pub mod tableau;

use crate::certificate::Certificate;
use crate::error::{Array, Error, all_finite, same_length};
use crate::real::Real;
use certificate::{Answer, Form};
use method::{Ended, Method};
use outputs::Measure;
use panels::Panels;

/// A baked model (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Condensed<'a, R> {
    /// S, as [`Panels::new`] takes it.
    pub matrix: &'a [[R; panels::ROWS]],
    /// B by columns: n entries for each input, the constant first.
    pub load: &'a [R],
    /// The outputs.
    pub outputs: &'a [Measure<'a, R>],
    /// What bounds the error; absent where there is no bound, or nobody asks for it.
    pub certificate: Option<Form<'a, R>>,
}

/// Memory of a condensed model (borrowed): x stays from tick to tick, the rest is scratch.
#[derive(Debug)]
pub struct Memory<'a, R> {
    /// x, one entry a contact edge; zeros to begin with.
    pub x: &'a mut [R],
    /// B p, one entry a contact edge.
    pub load: &'a mut [R],
    /// Sx − Bp, one entry a contact edge.
    pub residual: &'a mut [R],
    /// One entry a contact edge.
    pub scratch: &'a mut [R],
    /// One entry a column of F; empty without a certificate.
    pub combination: &'a mut [R],
    /// One entry a column of F; empty without a certificate.
    pub sum: &'a mut [R],
}

/// Arrays that a solve works on, one entry a contact edge (borrowed).
#[derive(Debug)]
pub struct Iterate<'a, R> {
    /// Where it starts; becomes x ≥ 0, whatever ends the solve.
    pub x: &'a mut [R],
    /// Becomes Sx − b.
    pub residual: &'a mut [R],
    /// Scratch.
    pub scratch: &'a mut [R],
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
    /// Solves for the inputs p, p_0 = 1 among them, from the last x, and bounds the error.
    ///
    /// # Errors
    /// Inputs that are not finite: nothing is changed then. Arrays of the wrong length.
    pub fn tick<M: Method<R>>(
        &self,
        inputs: &[R],
        method: &mut M,
        memory: &mut Memory<R>,
    ) -> Result<Report<R>, Error> {
        all_finite(Array::Load, inputs)?;
        let order = memory.x.len();
        let matrix = Panels::new(self.matrix, order)?;
        self.combine(inputs, memory.load)?;
        let iterate = Iterate {
            x: &mut *memory.x,
            residual: &mut *memory.residual,
            scratch: &mut *memory.scratch,
        };
        let progress = method.solve(&matrix, memory.load, iterate)?;
        let answer = Answer { inputs, x: memory.x, residual: memory.residual };
        let certificate = match &self.certificate {
            Some(form) => form.certify(&answer, memory.combination, memory.sum)?,
            None => None,
        };
        let active = memory.x.iter().filter(|x| **x == R::ZERO).count() as u32;
        let method::Progress { ended, pivots, sweeps } = progress;
        Ok(Report { ended, pivots, sweeps, active, certificate })
    }

    /// Output `number` of the last tick.
    ///
    /// # Errors
    /// Arrays of the wrong length; no such output.
    pub fn output(
        &self,
        number: usize,
        inputs: &[R],
        x: &[R],
        report: &Report<R>,
    ) -> Result<R, Error> {
        let stray = Error::OutOfRange { of: Array::Scratch, at: number };
        self.outputs.get(number).ok_or(stray)?.value(inputs, x, report.certificate.as_ref())
    }

    /// `load` = B p
    fn combine(&self, inputs: &[R], load: &mut [R]) -> Result<(), Error> {
        same_length(Array::Load, self.load.len(), load.len() * inputs.len())?;
        load.fill(R::ZERO);
        for (column, &p) in self.load.chunks_exact(load.len().max(1)).zip(inputs) {
            load.iter_mut().zip(column).for_each(|(load, &entry)| *load += entry * p);
        }
        Ok(())
    }
}
