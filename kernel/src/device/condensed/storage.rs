//! Owned memory of exactly the size that a model needs; each can be a `static`.

use super::method::{Pivots, Sweeps};
use super::{Condensed, Memory};
use crate::error::Error;
use crate::real::Real;
use crate::solve::dense::Iterate;
use crate::solve::dense::blocks::{Block, SIDE};
use crate::solve::dense::tableau::Tableau;

/// Iterate and scratch: P = [`crate::solve::dense::blocks::padded`] contact edges, C columns of the bound's factor.
#[derive(Debug)]
pub struct Storage<R, const P: usize, const C: usize> {
    x: [R; P],
    residual: [R; P],
    scratch: [R; P],
    open: [bool; P],
    load: [R; P],
    combination: [R; C],
    sum: [R; C],
    has_begun: bool,
}

impl<R: Real, const P: usize, const C: usize> Storage<R, P, C> {
    /// Zeros, which take no room in flash: the first tick takes the model's x over.
    pub const fn new() -> Self {
        Self {
            x: [R::ZERO; P],
            residual: [R::ZERO; P],
            scratch: [R::ZERO; P],
            open: [false; P],
            load: [R::ZERO; P],
            combination: [R::ZERO; C],
            sum: [R::ZERO; C],
            has_begun: false,
        }
    }

    /// The view that [`Condensed::tick`] takes.
    pub fn memory(&mut self, model: &Condensed<R>) -> Memory<'_, R> {
        let Self { x, residual, scratch, open, load, combination, sum, has_begun } = self;
        if !*has_begun {
            x.iter_mut().zip(model.x).for_each(|(x, &given)| *x = given);
            *has_begun = true;
        }
        Memory { iterate: Iterate { x, residual, scratch, open }, load, combination, sum }
    }

    /// Back to [`Storage::new`]: the next tick takes the model's x over again.
    pub fn reset(&mut self) {
        self.has_begun = false;
    }
}

impl<R: Real, const P: usize, const C: usize> Default for Storage<R, P, C> {
    fn default() -> Self {
        Self::new()
    }
}

/// A tableau of B = [`crate::solve::dense::blocks::count`] blocks, for the exact method.
#[derive(Debug)]
pub struct TableauStorage<R, const P: usize, const B: usize> {
    blocks: [Block<R>; B],
    exchanged: [bool; P],
    columns: [[R; P]; 2],
    is_built: bool,
}

impl<R: Real, const P: usize, const B: usize> TableauStorage<R, P, B> {
    /// Nothing yet: the first tick takes the model's own over.
    pub const fn new() -> Self {
        Self {
            blocks: [[[R::ZERO; SIDE]; SIDE]; B],
            exchanged: [false; P],
            columns: [[R::ZERO; P]; 2],
            is_built: false,
        }
    }

    /// The exact method on `model`: at most so many exchanges a tick, and what follows where they do not
    /// suffice.
    ///
    /// # Errors
    /// A model of another size.
    pub fn method<'a>(
        &'a mut self,
        model: &Condensed<'a, R>,
        most: u32,
        sweeps: Sweeps<R>,
    ) -> Result<Pivots<'a, R>, Error> {
        let [column, next] = &mut self.columns;
        let blocks = &mut self.blocks;
        let mut tableau = Tableau::new(model.contact, blocks, &mut self.exchanged, [column, next])?;
        if !self.is_built {
            tableau.reset(&model.start)?;
            self.is_built = true;
        }
        Ok(Pivots { tableau, start: model.start, most, sweeps })
    }

    /// Back to [`TableauStorage::new`]: the next tick takes the model's tableau over again.
    pub fn reset(&mut self) {
        self.is_built = false;
    }
}

impl<R: Real, const P: usize, const B: usize> Default for TableauStorage<R, P, B> {
    fn default() -> Self {
        Self::new()
    }
}
