//! Found at the default inputs: the answer in which the first tick begins, and the relaxation factor of sweeps, by
//! trying.

use signorini_contact::dense::blocks::{Block, SIDE, count, padded};
use signorini_contact::dense::tableau::{self, Tableau};
use signorini_kernel::Error;

use crate::narrow::{filled_up, matrix};
use signorini_condense::CondensedModel;
use signorini_problem::scalar::Scalar;

/// Sweeps after which a factor counts as no good.
const MOST: u32 = 400;
/// The sum of changes at which a trial ends, relative to the largest b_i.
const SMALL: f64 = 1e-6;

/// x of the default inputs and, for the exact method, the tableau that belongs to it: exchanged in f64 and
/// rounded once, it is as good as a tableau can be.
#[derive(Debug, Clone)]
pub(super) struct InitialState<R> {
    pub x: Vec<R>,
    pub blocks: Vec<Block<R>>,
    pub exchanged: Vec<bool>,
}

impl<R: Scalar> InitialState<R> {
    /// Of `x`, with a tableau for the exact method.
    pub fn new(condensate: &CondensedModel, x: &[f64], is_exact: bool) -> Result<Self, Error> {
        let n = condensate.contact;
        if !is_exact {
            return Ok(Self::at(x));
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
        Ok(Self { x: filled_up(x), blocks, exchanged })
    }

    /// x alone: exchanges begin with the matrix.
    pub fn at(x: &[f64]) -> Self {
        Self { x: filled_up(x), blocks: Vec::new(), exchanged: Vec::new() }
    }

    pub fn view(&self) -> tableau::InitialTableau<'_, R> {
        tableau::InitialTableau { blocks: &self.blocks, exchanged: &self.exchanged }
    }
}

/// The ω with which sweeps from a cold start at the default inputs end first, `diagonal` being the largest entry on
/// that of the matrix: less than 2 over that.
pub(super) fn best_omega(condensate: &CondensedModel, diagonal: f64) -> f64 {
    let load = condensate.load_of(&condensate.defaults);
    let trial = |omega: f64| (sweeps(condensate, &load, omega), omega);
    let trials = (0..20).map(|step| trial((1.0 + 0.05 * f64::from(step)) / diagonal));
    let fewest = trials.min_by_key(|(sweeps, _)| *sweeps);
    fewest.map_or(1.0 / diagonal, |(_, omega)| omega)
}

fn sweeps(condensate: &CondensedModel, load: &[f64], omega: f64) -> u32 {
    let n = condensate.contact;
    let size = load.iter().fold(0.0, |most: f64, b| most.max(b.abs()));
    let mut x = vec![0.0; n];
    for sweep in 1..MOST {
        let mut moved = 0.0;
        for i in 0..n {
            let row = &condensate.matrix[i * n..(i + 1) * n];
            let product: f64 = row.iter().zip(&x).map(|(entry, x)| entry * x).sum();
            let next = (x[i] - omega * (product - load[i])).max(0.0);
            moved += (next - x[i]).abs();
            x[i] = next;
        }
        if moved <= SMALL * size {
            return sweep;
        }
    }
    MOST
}
