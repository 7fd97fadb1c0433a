//! How fast outputs change with the inputs of the box, and what that says of where they lie.
//!
//! Where no off-diagonal entry of S is positive, x(p) is continuous and piecewise affine, on each piece with some set A
//! of open edges and those at their limit, O ⊆ A ⊆ O ∪ U: those always on one side and those that may change. There
//! ```text
//!   ∂x_A/∂p_j = S_AA⁻¹ B_Aj = f(A, B_j⁺) − f(A, B_j⁻),      f(O, b) ≤ f(A, b) ≤ f(O ∪ U, b) for b ≥ 0,
//! ```
//! since inverses of M-matrices have no negative entry and grow with A. An output a·p + c·x thus has slopes
//! g_j = a_j + c·∂x/∂p_j within known intervals. With p* at the end of each input where that makes y largest,
//! ```text
//!   y(p) ≤ y(p*) + Σ_j max(0, slope of the wrong sign) · width_j,
//! ```
//! which is y(p*) where no slope changes its sign. The same from below.

use super::affine::AffineOutput;
use super::enclosure::{Enclosure, EndBox};
use super::interval::{Interval, between, dot};
use super::split::Split;
use crate::CondensedModel;
use signorini_reference::ReferenceError;

/// ∂x/∂p_j for all inputs, and what solves the problem at a corner.
#[derive(Debug)]
pub(super) struct Slopes<'s> {
    model: &'s CondensedModel,
    inputs: &'s [[f64; 2]],
    /// Of all contact edges; nothing where there is none.
    split: Option<Split>,
    /// For each input, those of all unknowns.
    of_contact: Vec<Vec<Interval>>,
}

impl<'s> Slopes<'s> {
    /// Slopes of a model; `None` where an entry off the diagonal of S is positive.
    ///
    /// # Errors
    /// Loads that are not finite.
    pub fn new(
        model: &'s CondensedModel,
        enclosure: &Enclosure,
        inputs: &'s [[f64; 2]],
    ) -> Result<Option<Self>, ReferenceError> {
        let n = model.contact;
        let split = Split::new(&model.matrix, n).filter(|_| n > 0);
        if n > 0 && !split.as_ref().is_some_and(Split::has_all_signs) {
            return Ok(None);
        }
        let is_inactive = |at: &usize| enclosure.is_open(*at) || enclosure.is_saturated(*at);
        let open = (0..n).filter(is_inactive).collect();
        let not_touching = (0..n).filter(|&at| !enclosure.is_touching(at)).collect();
        let [Some(least), Some(most)] = [open, not_touching].map(|part| Part::new(model, part))
        else {
            return Ok(None);
        };
        let slopes = |j: usize| slopes(&least, &most, &column(model, enclosure, j));
        let of_contact = (0..model.inputs).map(slopes).collect::<Result<_, _>>()?;
        Ok(Some(Self { model, inputs, split, of_contact }))
    }

    /// Where an output lies for all inputs of the box.
    ///
    /// # Errors
    /// Loads that are not finite.
    pub fn range(&self, of: &AffineOutput) -> Result<Interval, ReferenceError> {
        let slope = |(a, x): (&Interval, &Vec<Interval>)| {
            *a + dot(of.of_contact.iter().copied(), x.iter().copied())
        };
        let rising: Vec<_> = of.of_inputs.iter().zip(&self.of_contact).map(slope).collect();
        let falling: Vec<_> = rising.iter().map(|&slope| Interval::ZERO - slope).collect();
        let most = self.at_end(of, &rising)? + self.beyond(&rising);
        let least = self.at_end(of, &falling)? - self.beyond(&falling);
        Ok(Interval { lo: least.lo, hi: most.hi })
    }

    /// y at p*, the end of each input that is the upper one where its slope is rather positive.
    fn at_end(&self, of: &AffineOutput, slopes: &[Interval]) -> Result<Interval, ReferenceError> {
        let ends = slopes.iter().zip(self.inputs);
        let corner: Vec<_> =
            ends.map(|(slope, range)| [range[usize::from(rises(slope))]; 2]).collect();
        let x = match &self.split {
            None => Vec::new(),
            Some(split) => Enclosure::new(split, &EndBox::new(self.model, &corner))?.map_or_else(
                || vec![Interval::between([f64::NEG_INFINITY, f64::INFINITY]); self.model.contact],
                |found| found.intervals(),
            ),
        };
        Ok(of.within(&between(&corner), &x))
    }

    /// By how much y may be above its value at p*.
    fn beyond(&self, slopes: &[Interval]) -> Interval {
        let wrong = slopes.iter().map(|slope| {
            let wrong = if rises(slope) { -slope.lo } else { slope.hi };
            Interval::point(wrong.max(0.0))
        });
        let widths = between(self.inputs)
            .into_iter()
            .map(|range| Interval::point(range.hi) - Interval::point(range.lo));
        dot(wrong, widths)
    }
}

/// Whether a slope is positive, or more so than negative.
fn rises(slope: &Interval) -> bool {
    slope.hi > -slope.lo
}

/// Contribution of an input to the load of each edge, which has the end of the edge's side in it.
fn column(model: &CondensedModel, enclosure: &Enclosure, j: usize) -> Vec<Interval> {
    let of_edge = |(at, &b): (usize, &f64)| {
        let sides = [!enclosure.is_saturated(at), !enclosure.is_open(at)];
        let ends = model.end_columns(at);
        let there = sides.into_iter().zip(&ends).filter(|(may, end)| *may && end[0].is_finite());
        let entries = there.map(|(_, end)| Interval::point(b) + Interval::point(end[j]));
        entries.reduce(Interval::hull).unwrap_or(Interval::point(b))
    };
    model.load[j].iter().enumerate().map(of_edge).collect()
}

/// ∂x/∂p for a column of B.
fn slopes(least: &Part, most: &Part, column: &[Interval]) -> Result<Vec<Interval>, ReferenceError> {
    let moved = |sign: f64| -> Result<Vec<Interval>, ReferenceError> {
        let [few, many] = [f64::min, f64::max].map(|of| {
            let parts = column.iter().map(|b| of((sign * b.lo).max(0.0), (sign * b.hi).max(0.0)));
            parts.collect::<Vec<f64>>()
        });
        let least = least.solved(&few, Split::below)?;
        let ends = least.into_iter().zip(most.solved(&many, Split::above)?);
        Ok(ends.map(|(lo, hi)| Interval { lo, hi }).collect())
    };
    let [up, down] = [moved(1.0)?, moved(-1.0)?];
    Ok(up.into_iter().zip(down).map(|(up, down)| up - down).collect())
}

/// The rows and columns of some edges.
#[derive(Debug)]
struct Part {
    unknowns: usize,
    edges: Vec<usize>,
    split: Option<Split>,
}

impl Part {
    /// Nothing where its matrix is not proved to be an M-matrix.
    fn new(model: &CondensedModel, edges: Vec<usize>) -> Option<Self> {
        let n = model.contact;
        let row = |&i: &usize| edges.iter().map(move |&j| (i, j)).collect::<Vec<_>>();
        let matrix: Vec<f64> =
            edges.iter().flat_map(row).map(|(i, j)| model.matrix[i * n + j]).collect();
        let split = match edges.is_empty() {
            true => None,
            false => Some(Split::new(&matrix, edges.len())?),
        };
        Some(Self { unknowns: n, edges, split })
    }

    /// S_AA⁻¹ b_A for b ≥ 0, with 0 elsewhere, as `side` bounds it: by the contact problem, whose solution it is.
    fn solved(
        &self,
        load: &[f64],
        side: impl Fn(&Split, &[f64], &[f64]) -> Result<Vec<f64>, ReferenceError>,
    ) -> Result<Vec<f64>, ReferenceError> {
        let mut x = vec![0.0; self.unknowns];
        if let Some(split) = &self.split {
            let own: Vec<f64> = self.edges.iter().map(|&at| load[at]).collect();
            let found = side(split, &own, &vec![f64::INFINITY; own.len()])?;
            self.edges.iter().zip(found).for_each(|(&at, value)| x[at] = value);
        }
        Ok(x)
    }
}
