//! Owned memory of a model of modes.

use super::super::storage::Storage;
use super::super::{Condensed, Memory};
use super::Modal;
use crate::dense::blocks::{Block, SIDE};
use crate::dense::tableau::InitialTableau;
use signorini_kernel::Real;
use signorini_kernel::error::Error;

/// Storage of the model, with S(t) in [`crate::dense::blocks::count`] blocks, and inputs that p and y have room in.
#[derive(Debug)]
pub struct ModalStorage<Numbers, Flags, Columns, Spans, Matrix, Inputs, R> {
    shared: Storage<Numbers, Flags, Columns, Spans>,
    matrix: Matrix,
    inputs: Inputs,
    /// Of the matrix and the last load.
    t: R,
    /// By how much the last inputs have moved ends of fluxes.
    moved: R,
    /// 0 where there is no matrix.
    has_matrix: u8,
}

/// [`ModalStorage`] in arrays: P padded contact edges, C columns, B blocks, I inputs and modes, S spans.
pub type ArrayModalStorage<
    R,
    const P: usize,
    const C: usize,
    const B: usize,
    const I: usize,
    const S: usize = 0,
> = ModalStorage<[R; P], [u8; P], [R; C], [R; S], [Block<R>; B], [R; I], R>;

/// Memory of a tick (borrowed), once its inputs are set.
#[derive(Debug)]
pub struct ModalMemory<'a, R> {
    /// Memory of the model; its load is B(t) p.
    pub shared: Memory<'a, R>,
    /// p and, after the tick, y: the inputs of the model where t = 0, and of its outputs.
    pub inputs: &'a mut [R],
    /// t
    pub t: R,
}

impl<R: Real, const P: usize, const C: usize, const B: usize, const I: usize, const S: usize>
    ArrayModalStorage<R, P, C, B, I, S>
{
    /// Zeros, which take no room in flash.
    pub const fn zeros() -> Self {
        Self {
            shared: Storage::zeros(),
            matrix: [[[R::ZERO; SIDE]; SIDE]; B],
            inputs: [R::ZERO; I],
            t: R::ZERO,
            moved: R::ZERO,
            has_matrix: 0,
        }
    }
}

impl<Numbers, Flags, Columns, Spans, Matrix, Inputs, R: Real>
    ModalStorage<Numbers, Flags, Columns, Spans, Matrix, Inputs, R>
{
    /// Before the first tick, with buffers of any contents.
    pub const fn of(
        shared: Storage<Numbers, Flags, Columns, Spans>,
        matrix: Matrix,
        inputs: Inputs,
    ) -> Self {
        Self { shared, matrix, inputs, t: R::ZERO, moved: R::ZERO, has_matrix: 0 }
    }

    /// Takes the inputs p, p_0 = 1 among them. Returns whether the coefficient has changed: then tableaus of the last tick are no
    /// use.
    ///
    /// # Errors
    /// Inputs that are not finite, or so large that the answer or an output may overflow; arrays of the wrong length. The
    /// last answer stays.
    pub fn set(&mut self, modal: &Modal<R>, inputs: &[R]) -> Result<bool, Error>
    where
        Numbers: AsMut<[R]>,
        Flags: AsMut<[u8]>,
        Columns: AsMut<[R]>,
        Spans: AsMut<[R]>,
        Matrix: AsMut<[Block<R>]>,
        Inputs: AsMut<[R]>,
    {
        let mut memory = self.shared.memory(&modal.model);
        let t = modal.combine(inputs, self.inputs.as_mut(), memory.load)?;
        modal.model.spans.combine(inputs, memory.load, &mut memory.spans)?;
        self.moved = memory.spans.moved;
        if self.has_matrix != 0 && self.t == t {
            return Ok(false);
        }
        self.has_matrix = 0;
        modal.matrix(t, inputs.len(), self.matrix.as_mut())?;
        (self.t, self.has_matrix) = (t, 1);
        Ok(true)
    }

    /// The model with S(t) for the inputs that were set, where exchanges begin too, and the memory that [`Modal::tick`] takes.
    pub fn at<'m>(&'m mut self, modal: &Modal<'m, R>) -> (Condensed<'m, R>, ModalMemory<'m, R>)
    where
        Numbers: AsMut<[R]>,
        Flags: AsMut<[u8]>,
        Columns: AsMut<[R]>,
        Spans: AsMut<[R]>,
        Matrix: AsRef<[Block<R>]>,
        Inputs: AsMut<[R]>,
    {
        let matrix = self.matrix.as_ref();
        let start = InitialTableau { blocks: matrix, exchanged: &[] };
        let mut shared = self.shared.memory(&modal.model);
        shared.spans.moved = self.moved;
        let memory = ModalMemory { shared, inputs: self.inputs.as_mut(), t: self.t };
        (Condensed { matrix, start, ..modal.model }, memory)
    }

    /// Storage of the model.
    pub fn shared(&self) -> &Storage<Numbers, Flags, Columns, Spans> {
        &self.shared
    }

    /// p and y of the last tick.
    pub fn inputs(&self) -> &[R]
    where
        Inputs: AsRef<[R]>,
    {
        self.inputs.as_ref()
    }

    /// Forgets all ticks.
    pub fn reset(&mut self) {
        self.shared.reset();
        self.has_matrix = 0;
    }
}
