//! Owned memory of exactly the size that a model needs: arrays that can be a `static`, or whatever else lends slices. Of any
//! bits it is memory still: what a reset or a brown-out has left of it may make a tick wrong, and nothing worse.

use super::method::{Pivots, Sweeps, TwoPhases};
use super::spans::SpanBuffer;
use super::{Condensed, Memory};
use crate::dense::Iterate;
use crate::dense::blocks::{Block, SIDE};
use crate::dense::tableau::Tableau;
use signorini_kernel::Real;
use signorini_kernel::error::Error;
use signorini_kernel::flags::restored;

/// Iterate and scratch. Numbers and flags have [`crate::dense::blocks::padded`] contact edges, columns those of the
/// bound's factor; spans are as many as contact edges with padding where inputs change them, none elsewhere.
#[derive(Debug)]
pub struct Storage<Numbers, Flags, Columns, Spans> {
    x: Numbers,
    residual: Numbers,
    scratch: Numbers,
    open: Flags,
    load: Numbers,
    spans: Spans,
    combination: Columns,
    sum: Columns,
    /// 0 before the first tick.
    has_begun: u8,
}

/// [`Storage`] in arrays: P padded contact edges, C columns, S spans.
pub type ArrayStorage<R, const P: usize, const C: usize, const S: usize = 0> =
    Storage<[R; P], [u8; P], [R; C], [R; S]>;

impl<R: Real, const P: usize, const C: usize, const S: usize> ArrayStorage<R, P, C, S> {
    /// Zeros, which take no room in flash: the first tick takes the model's x over.
    pub const fn zeros() -> Self {
        Self {
            x: [R::ZERO; P],
            residual: [R::ZERO; P],
            scratch: [R::ZERO; P],
            open: [0; P],
            load: [R::ZERO; P],
            spans: [R::ZERO; S],
            combination: [R::ZERO; C],
            sum: [R::ZERO; C],
            has_begun: 0,
        }
    }
}

impl<Numbers: Clone, Flags, Columns: Clone, Spans> Storage<Numbers, Flags, Columns, Spans> {
    /// Before the first tick, with buffers like these, of any contents.
    pub fn of(numbers: Numbers, open: Flags, columns: Columns, spans: Spans) -> Self {
        Self {
            x: numbers.clone(),
            residual: numbers.clone(),
            scratch: numbers.clone(),
            open,
            load: numbers,
            spans,
            combination: columns.clone(),
            sum: columns,
            has_begun: 0,
        }
    }
}

impl<Numbers, Flags, Columns, Spans> Storage<Numbers, Flags, Columns, Spans> {
    /// The view that [`Condensed::tick`] takes.
    pub fn memory<R: Real>(&mut self, model: &Condensed<R>) -> Memory<'_, R>
    where
        Numbers: AsMut<[R]>,
        Flags: AsMut<[u8]>,
        Columns: AsMut<[R]>,
        Spans: AsMut<[R]>,
    {
        let x = self.x.as_mut();
        if self.has_begun == 0 {
            x.iter_mut().zip(model.x).for_each(|(x, &given)| *x = given);
            self.has_begun = 1;
        }
        let (residual, scratch) = (self.residual.as_mut(), self.scratch.as_mut());
        Memory {
            iterate: Iterate { x, residual, scratch, open: restored(self.open.as_mut()) },
            load: self.load.as_mut(),
            spans: SpanBuffer::new(self.spans.as_mut()),
            combination: self.combination.as_mut(),
            sum: self.sum.as_mut(),
        }
    }

    /// x of the last tick, padding included.
    pub fn x<R>(&self) -> &[R]
    where
        Numbers: AsRef<[R]>,
    {
        self.x.as_ref()
    }

    /// The edges that the last tick left open, as 1, padding included.
    pub fn open(&self) -> &[u8]
    where
        Flags: AsRef<[u8]>,
    {
        self.open.as_ref()
    }

    /// Factors by which the certificate of the last tick multiplied the columns of its factor.
    pub fn combination<R>(&self) -> &[R]
    where
        Columns: AsRef<[R]>,
    {
        self.combination.as_ref()
    }

    /// Forgets all ticks: the next one takes the model's x over again.
    pub fn reset(&mut self) {
        self.has_begun = 0;
    }
}

/// A tableau for the exact method, in [`crate::dense::blocks::count`] blocks; flags and columns have
/// [`crate::dense::blocks::padded`] contact edges.
#[derive(Debug)]
pub struct TableauStorage<Blocks, Flags, Column> {
    blocks: Blocks,
    exchanged: Flags,
    columns: [Column; 2],
    /// 0 where there is none.
    is_built: u8,
}

/// [`TableauStorage`] in arrays: P padded contact edges, B blocks.
pub type ArrayTableauStorage<R, const P: usize, const B: usize> =
    TableauStorage<[Block<R>; B], [u8; P], [R; P]>;

impl<R: Real, const P: usize, const B: usize> ArrayTableauStorage<R, P, B> {
    /// Nothing yet: the first tick takes the model's own over.
    pub const fn zeros() -> Self {
        Self::of([[[R::ZERO; SIDE]; SIDE]; B], [0; P], [[R::ZERO; P]; 2])
    }
}

impl<Blocks, Flags, Column> TableauStorage<Blocks, Flags, Column> {
    /// Before the first tick, in buffers of any contents.
    pub const fn of(blocks: Blocks, exchanged: Flags, columns: [Column; 2]) -> Self {
        Self { blocks, exchanged, columns, is_built: 0 }
    }

    /// The exact method on `model`: at most so many exchanges a tick, and what follows where they do not
    /// suffice.
    ///
    /// # Errors
    /// A model of another size.
    pub fn method<'a, R: Real>(
        &'a mut self,
        model: &Condensed<'a, R>,
        most: u32,
        sweeps: Sweeps<R>,
    ) -> Result<Pivots<'a, R>, Error>
    where
        Blocks: AsMut<[Block<R>]>,
        Flags: AsMut<[u8]>,
        Column: AsMut<[R]>,
    {
        Ok(Pivots { tableau: self.tableau(model)?, start: model.start, most, sweeps })
    }

    /// The exact method on a `model` whose matrix has no positive entry off the diagonal.
    ///
    /// # Errors
    /// A model of another size.
    pub fn two_phases<'a, R: Real>(
        &'a mut self,
        model: &Condensed<'a, R>,
    ) -> Result<TwoPhases<'a, R>, Error>
    where
        Blocks: AsMut<[Block<R>]>,
        Flags: AsMut<[u8]>,
        Column: AsMut<[R]>,
    {
        Ok(TwoPhases { tableau: self.tableau(model)? })
    }

    fn tableau<R: Real>(&mut self, model: &Condensed<R>) -> Result<Tableau<'_, R>, Error>
    where
        Blocks: AsMut<[Block<R>]>,
        Flags: AsMut<[u8]>,
        Column: AsMut<[R]>,
    {
        let columns = self.columns.each_mut().map(Column::as_mut);
        let (blocks, exchanged) = (self.blocks.as_mut(), restored(self.exchanged.as_mut()));
        let mut tableau = Tableau::new(model.contact, blocks, exchanged, columns)?;
        if self.is_built == 0 {
            tableau.reset(&model.start)?;
            self.is_built = 1;
        }
        Ok(tableau)
    }

    /// Hands `put` all that the next tick takes of the last one.
    pub fn save<R: Real>(&self, mut put: impl FnMut(R))
    where
        Blocks: AsRef<[Block<R>]>,
        Flags: AsRef<[u8]>,
    {
        let flag = |is_set: bool| if is_set { R::ONE } else { R::ZERO };
        put(flag(self.is_built != 0));
        self.blocks.as_ref().as_flattened().as_flattened().iter().for_each(|&entry| put(entry));
        self.exchanged.as_ref().iter().for_each(|&of| put(flag(of != 0)));
    }

    /// Takes that over, in the same order.
    pub fn restore<R: Real>(&mut self, mut take: impl FnMut() -> R)
    where
        Blocks: AsMut<[Block<R>]>,
        Flags: AsMut<[u8]>,
    {
        self.is_built = u8::from(take() != R::ZERO);
        let entries = self.blocks.as_mut().as_flattened_mut().as_flattened_mut();
        entries.iter_mut().for_each(|entry| *entry = take());
        self.exchanged.as_mut().iter_mut().for_each(|of| *of = u8::from(take() != R::ZERO));
    }

    /// Forgets all ticks: the next one takes the model's tableau over again.
    pub fn reset(&mut self) {
        self.is_built = 0;
    }
}
