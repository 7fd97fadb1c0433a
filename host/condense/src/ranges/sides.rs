//! Which contact edges can change sides within the ranges of the inputs.
//!
//! ```text
//!   always open       lo_i > 0          eliminated exactly: their openings are affine in what is left
//!   always at limit   hi_i < 0          eliminated in the same way
//!   always touching   reaction_i > 0    dropped: x_i = 0
//!   may change        all else          kept
//! ```
//! What the enclosure proposes is checked on the affine maps themselves, for every p of the box and every x of what is
//! kept between its limits, solutions or not: a tick that is cut off, or rounded, leaves them admissible too. An edge that
//! fails may change. So that the error bound sees move what it must, an edge is kept as well that
//! ```text
//!   is open and tells e = s − ψ at a vertex where an edge that may change ends,     with x held above 0,
//!   ends at a Dirichlet value.
//! ```

use super::enclosure::{Enclosure, EndBox};
use super::reduction::Reduction;
use super::split::Split;
use crate::{CondensedModel, Form, Vertex};
use signorini_reference::ReferenceError;

/// Openings are kept below hi, this part of it and [`ROUNDING`] of the largest more.
const MARGIN: f64 = 1.0 / 1024.0;

/// Part of the largest opening that rounding in any scalar hardly reaches. Where it does, a solution is cut off so far,
/// and its bound counts that.
const ROUNDING: f64 = 1.0 / 65536.0;

/// Openings below this part of the largest may be rounding of the target's scalar.
const NEGLIGIBLE: f64 = 1e-6;

/// The side of a contact edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeSide {
    /// u > ψ for every input.
    Open,
    /// u = ψ for every input.
    Touching,
    /// u < ψ for every input, with the flux at its limit.
    Saturated,
    /// More than one may be, as far as is proved.
    MayChange,
}

/// The sides of all edges, with proof. Arrays have an entry per unknown.
#[derive(Debug, Clone, PartialEq)]
pub struct Sides {
    /// The box of p that it is proved for, the constant 1 first.
    pub inputs: Vec<[f64; 2]>,
    /// The side of each edge.
    pub of: Vec<EdgeSide>,
    /// Which edges a reduced model keeps: all that may change, and some for the error bound.
    pub kept: Vec<bool>,
    /// A tick keeps x within these, scaled as x; infinite where nothing is proved.
    pub limits: Vec<[f64; 2]>,
    /// Where every solution lies, where that is proved.
    pub enclosure: Option<Enclosure>,
}

/// Contribution of a contact vertex to the error bound.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum VertexSide {
    /// An edge beside it always touches: d = −e.
    Touching,
    /// Its edges are always open and e ≥ 0, or always at their limit and e ≤ 0: d = 0.
    Free,
    /// d depends on what is kept.
    MayChange,
}

impl Sides {
    /// Finds the sides for all inputs within their ranges. Where one has none, or N is no M-matrix, nothing is proved;
    /// nor where contact alone holds a part, whose matrix is singular whatever rounding makes of it.
    ///
    /// # Errors
    /// Loads that are not finite.
    pub fn new(model: &CondensedModel) -> Result<Self, ReferenceError> {
        let (n, inputs) = (model.contact, widened(&model.ranges));
        let is_bounded = inputs.iter().flatten().all(|end| end.is_finite());
        let is_held = model.held_by_contact.is_empty();
        let split = Split::new(&model.matrix, n).filter(|_| is_bounded && is_held && n > 0);
        let Some(split) = split else { return Ok(Self::unproved(model)) };
        let Some(enclosure) = Enclosure::new(&split, &EndBox::new(model, &inputs))? else {
            return Ok(Self::unproved(model));
        };
        let mut sides = Self::proposed(model, enclosure, inputs);
        while sides.demote(model) {}
        Ok(sides)
    }

    /// Every edge may change.
    pub fn unproved(model: &CondensedModel) -> Self {
        let (n, inputs) = (model.contact, widened(&model.ranges));
        let infinite = [f64::NEG_INFINITY, f64::INFINITY];
        let limits = (0..n).map(|at| there_is(model, at, infinite)).collect();
        Self {
            inputs,
            of: vec![EdgeSide::MayChange; n],
            kept: vec![true; n],
            limits,
            enclosure: None,
        }
    }

    /// Sides that the enclosure proposes.
    pub(super) fn proposed(
        model: &CondensedModel,
        enclosure: Enclosure,
        inputs: Vec<[f64; 2]>,
    ) -> Self {
        let Enclosure { lo, hi, reaction } = &enclosure;
        let sizes = lo.iter().chain(hi).map(|x| x.abs());
        let largest = sizes.fold(0.0, f64::max);
        let side = |at: usize| match () {
            // Its ends may have to go to their mean, which a tick finds out.
            () if may_cross(model, &inputs, at) => EdgeSide::MayChange,
            () if lo[at] > NEGLIGIBLE * largest => EdgeSide::Open,
            () if hi[at] < -NEGLIGIBLE * largest => EdgeSide::Saturated,
            () if reaction[at] > 0.0 => EdgeSide::Touching,
            () => EdgeSide::MayChange,
        };
        let of: Vec<_> = (0..lo.len()).map(side).collect();
        let beyond = |x: f64| x + MARGIN * x + ROUNDING * largest;
        let limits = |at: usize| {
            let [below, above] = [(-lo[at]).max(0.0), hi[at].max(0.0)].map(beyond);
            match of[at] {
                EdgeSide::Open => [0.5 * lo[at], above],
                EdgeSide::Saturated => [-below, 0.5 * hi[at]],
                _ => there_is(model, at, [-below, above]),
            }
        };
        let limits = (0..lo.len()).map(limits).collect();
        let kept = of.iter().map(|&side| side == EdgeSide::MayChange).collect();
        Self { inputs, of, kept, limits, enclosure: Some(enclosure) }
    }

    /// The maps that take out the edges which are not kept; nothing where their matrix is not positive definite.
    pub fn reduction(&self, model: &CondensedModel) -> Option<Reduction> {
        let all = |is: &dyn Fn(usize) -> bool| (0..self.of.len()).filter(|&at| is(at)).collect();
        let dropped = |side| all(&|at| !self.kept[at] && self.of[at] == side);
        let out = [EdgeSide::Open, EdgeSide::Saturated, EdgeSide::Touching].map(dropped);
        Reduction::new(model, all(&|at| self.kept[at]), out)
    }

    /// How many edges are on this side.
    pub fn count(&self, side: EdgeSide) -> usize {
        self.of.iter().filter(|&&of| of == side).count()
    }

    /// Keeps the edges for which the affine maps do not prove their side, and those that the bound needs; whether there
    /// were any.
    fn demote(&mut self, model: &CondensedModel) -> bool {
        let Some(reduction) = self.reduction(model) else {
            *self = Self::unproved(model);
            return false;
        };
        let unproved = reduction.unproved(model, &self.box_of(&reduction));
        for &at in &unproved {
            match self.of[at] {
                EdgeSide::Open => self.limits[at][0] = 0.0,
                EdgeSide::Saturated => self.limits[at][1] = 0.0,
                EdgeSide::Touching | EdgeSide::MayChange => {}
            }
            self.of[at] = EdgeSide::MayChange;
        }
        let form = model.certificate.as_ref().ok();
        let needed = form.map_or_else(Vec::new, |form| self.needed(form, &reduction));
        let any = !unproved.is_empty() || !needed.is_empty();
        unproved.into_iter().chain(needed).for_each(|at| self.kept[at] = true);
        any
    }

    /// The box of (p, x_U). A scalar may round limits outwards, as it may ranges.
    pub(super) fn box_of(&self, reduction: &Reduction) -> Vec<[f64; 2]> {
        let limits: Vec<_> = reduction.kept.iter().map(|&at| self.limits[at]).collect();
        // No scalar rounds over 0.
        let kept = |([lo, hi], limits): ([f64; 2], &[f64; 2])| {
            let lo = if limits[0] >= 0.0 { lo.max(0.0) } else { lo };
            [lo, if limits[1] <= 0.0 { hi.min(0.0) } else { hi }]
        };
        let of_kept = widened(&limits).into_iter().zip(&limits).map(kept);
        self.inputs.iter().copied().chain(of_kept).collect()
    }

    /// Edges that the error bound must see move and that are not kept yet.
    fn needed(&self, form: &Form, reduction: &Reduction) -> Vec<usize> {
        let mut needed: Vec<usize> = form.corners.iter().map(|corner| corner.edge).collect();
        for vertex in &form.vertices {
            if self.at(vertex, reduction) == VertexSide::MayChange {
                let edges = vertex.edges.iter().chain(&vertex.beside);
                let is_eliminated = |side| matches!(side, EdgeSide::Open | EdgeSide::Saturated);
                needed.extend(edges.filter(|&&edge| is_eliminated(self.of[edge])));
            }
        }
        needed.retain(|&edge| !self.kept[edge]);
        needed
    }

    /// Contribution of `vertex` to the bound.
    pub(super) fn at(&self, vertex: &Vertex, reduction: &Reduction) -> VertexSide {
        let beside = || vertex.beside.iter();
        if beside().any(|&at| self.of[at] == EdgeSide::Touching && !self.kept[at]) {
            return VertexSide::Touching;
        }
        let e = reduction.interpolated(vertex);
        let are = |side: EdgeSide, sign: f64| {
            beside().all(|&at| self.of[at] == side) && e.least(sign, &self.box_of(reduction)) >= 0.0
        };
        let is_free = are(EdgeSide::Open, 1.0) || are(EdgeSide::Saturated, -1.0);
        if is_free { VertexSide::Free } else { VertexSide::MayChange }
    }
}

/// Part of an interval of x that is on sides that exist.
fn there_is(model: &CondensedModel, at: usize, [lo, hi]: [f64; 2]) -> [f64; 2] {
    let [least, greatest] = model.end_columns(at);
    let lo = if greatest[0] == f64::INFINITY { lo.max(0.0) } else { lo };
    [lo, if least[0] == f64::NEG_INFINITY { hi.min(0.0) } else { hi }]
}

/// The box that any scalar rounds `ranges` into.
pub(crate) fn widened(ranges: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let noise = |end: f64| f64::from(f32::EPSILON) * end.abs() + f64::from(f32::MIN_POSITIVE);
    ranges.iter().map(|&[lo, hi]| [lo - noise(lo), hi + noise(hi)]).collect()
}

/// Whether inputs within these may put the upper end of an edge's flux below the lower one.
fn may_cross(model: &CondensedModel, inputs: &[[f64; 2]], at: usize) -> bool {
    if !model.is_varying() {
        return false;
    }
    let spans = model.spans.iter().map(|column| column[at]);
    let least = spans.zip(inputs).filter(|(span, _)| *span != 0.0);
    let least: f64 = least.map(|(span, [lo, hi])| (span * lo).min(span * hi)).sum();
    least < 0.0 && least.is_finite()
}
