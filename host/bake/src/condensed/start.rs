//! The answer to the default inputs, in which the first tick begins.

use signorini_contact::dense::blocks::{Block, SIDE, count, padded};
use signorini_contact::dense::tableau::{self, Tableau};
use signorini_kernel::Error;

use crate::narrow::{filled_up, matrix};
use signorini_condense::CondensedModel;
use signorini_problem::scalar::Scalar;

/// x of the default inputs and, for the exact method, the tableau that belongs to it: exchanged in f64 and
/// rounded once, it is as good as a tableau can be.
#[derive(Debug, Clone)]
pub(super) struct InitialState<R> {
    pub x: Vec<R>,
    pub blocks: Vec<Block<R>>,
    pub exchanged: Vec<bool>,
}

impl<R: Scalar> InitialState<R> {
    /// Where the default inputs have no solution, everything touches.
    pub fn new(condensate: &CondensedModel, is_exact: bool) -> Result<Self, Error> {
        let n = condensate.contact;
        let x = condensate.solve(&condensate.defaults).unwrap_or_else(|_| vec![0.0; n]);
        if !is_exact {
            return Ok(Self { x: filled_up(&x), blocks: Vec::new(), exchanged: Vec::new() });
        }
        let mut blocks = vec![[[0.0; SIDE]; SIDE]; count(n)];
        let mut exchanged = vec![false; padded(n)];
        let [mut column, mut next, mut answer] = [(); 3].map(|()| vec![0.0; padded(n)]);
        let nothing = exchanged.clone();
        let mut tableau = Tableau::new(n, &mut blocks, &mut exchanged, [&mut column, &mut next])?;
        let given = matrix::<f64>(condensate);
        tableau.reset(&tableau::InitialTableau { blocks: &given, exchanged: &nothing })?;
        for open in (0..n).filter(|&edge| x[edge] != 0.0) {
            tableau.exchange(open, &mut answer)?;
        }
        let narrow = |block: &Block<f64>| block.map(|row| row.map(R::narrow));
        let blocks = tableau.blocks().iter().map(narrow).collect();
        Ok(Self { x: filled_up(&x), blocks, exchanged })
    }

    /// x alone: exchanges begin with the matrix.
    pub fn at(x: &[f64]) -> Self {
        Self { x: filled_up(x), blocks: Vec::new(), exchanged: Vec::new() }
    }

    pub fn view(&self) -> tableau::InitialTableau<'_, R> {
        tableau::InitialTableau { blocks: &self.blocks, exchanged: &self.exchanged }
    }
}
