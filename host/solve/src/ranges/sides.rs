//! Which contact edges can change sides within the ranges of the inputs.
//!
//! ```text
//!   always open       lo_i > 0          eliminated exactly: their openings are affine in what is left
//!   always touching   reaction_i > 0    dropped: x_i = 0
//!   may change        all else          kept
//! ```
//! What the enclosure proposes is checked on the affine maps themselves, for every p of the box and every x of what is
//! kept between 0 and hi, solutions or not: a tick that is cut off, or rounded, leaves them admissible too. An edge that
//! fails is kept.

use super::enclosure::{Enclosure, LoadBox};
use super::reduction::Reduction;
use super::split::Split;
use crate::condense::CondensedModel;
use crate::reference::ReferenceError;

/// The side of each contact edge, in the order of the model's unknowns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeSide {
    /// u > ψ for every input.
    Open,
    /// u = ψ for every input.
    Touching,
    /// Both may be, as far as is proved.
    MayChange,
}

/// The sides of all edges, with proof.
#[derive(Debug, Clone, PartialEq)]
pub struct Sides {
    /// One an unknown.
    pub of: Vec<EdgeSide>,
    /// At most so far each opens, scaled as x; infinite where nothing is proved.
    pub hi: Vec<f64>,
    /// Whether exchanges are proved to end: every entry off the diagonal is at most 0.
    pub has_all_signs: bool,
}

impl Sides {
    /// Finds the sides for all p within `ranges`, the constant 1 first.
    ///
    /// # Errors
    /// Loads that are not finite.
    pub fn new(model: &CondensedModel, ranges: &[[f64; 2]]) -> Result<Self, ReferenceError> {
        let n = model.contact;
        let Some(split) = Split::new(&model.matrix, n) else {
            let (of, hi) = (vec![EdgeSide::MayChange; n], vec![f64::INFINITY; n]);
            return Ok(Self { of, hi, has_all_signs: false });
        };
        let loads = LoadBox::new(&model.load, ranges, n);
        let Enclosure { lo, hi, reaction } = Enclosure::new(&split, &loads)?;
        let side = |(&lo, &reaction): (&f64, &f64)| match (lo > 0.0, reaction > 0.0) {
            (true, _) => EdgeSide::Open,
            (_, true) => EdgeSide::Touching,
            _ => EdgeSide::MayChange,
        };
        let of = lo.iter().zip(&reaction).map(side).collect();
        let mut sides = Self { of, hi, has_all_signs: split.has_all_signs() };
        sides.guard(model);
        while sides.demote(model, ranges)? {}
        Ok(sides)
    }

    /// Unknowns of one side.
    pub fn all(&self, side: EdgeSide) -> Vec<usize> {
        (0..self.of.len()).filter(|&at| self.of[at] == side).collect()
    }

    /// Keeps what the error bound must see move: the edges that tell s at a vertex beside one that may change, and
    /// those beside a Dirichlet value above ψ.
    fn guard(&mut self, model: &CondensedModel) {
        let Ok(form) = &model.certificate else { return };
        let may = |sides: &Self, at: usize| sides.of[at] == EdgeSide::MayChange;
        let mut kept: Vec<usize> = form.corners.iter().map(|corner| corner.edge).collect();
        for vertex in &form.vertices {
            let sees = vertex.edges.iter().chain(&vertex.beside);
            if sees.clone().any(|&edge| may(self, edge)) {
                kept.extend(sees.filter(|&&edge| self.of[edge] == EdgeSide::Open));
            }
        }
        kept.into_iter().for_each(|edge| self.of[edge] = EdgeSide::MayChange);
    }

    /// Keeps the edges for which the affine maps do not prove their side; whether there were any.
    fn demote(&mut self, model: &CondensedModel, ranges: &[[f64; 2]]) -> Result<bool, ReferenceError> {
        let Some(reduction) = Reduction::new(model, self) else {
            self.of.fill(EdgeSide::MayChange);
            return Ok(false);
        };
        let kept = self.all(EdgeSide::MayChange);
        let most: Vec<f64> = kept.iter().map(|&at| self.hi[at]).collect();
        let unproved = reduction.unproved(ranges, &most);
        unproved.iter().for_each(|&at| self.of[at] = EdgeSide::MayChange);
        Ok(!unproved.is_empty())
    }
}
