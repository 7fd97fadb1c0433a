//! A condensed model without the edges that never change sides: a condensed model again, for the box of its inputs.
//!
//! With s the diagonal of S′, unknowns are x′ = x_U √s and r′ = r_U/√s, so that its matrix has a unit diagonal. All that
//! the model has is affine in x_O and r_T, or a form in (p, x, d), and follows:
//! ```text
//!   outputs   Y_p p + Y_x x + Y_r τ      r_T is part of the affine terms, and so is the end of r_O, 0 where it has no limit
//!   bound     F (p, x, d) = F M (p, x′, d′) = Q F′ (p, x′, d′)
//! ```
//! d = −e at a vertex beside a touching edge, 0 at one whose edges are open and whose e is never below 0, and d′ elsewhere.
//! What F M loses to rounding, and what x_O leaves of r_O, is counted with what the columns of F had lost before.

use super::interval::Interval;
use super::reduction::Reduction;
use super::sides::Sides;
use crate::{CondensedModel, Measure};

/// A condensed model and where each number of the whole one has gone.
#[derive(Debug, Clone)]
pub struct Reduced {
    /// What is left.
    pub model: CondensedModel,
    /// Why.
    pub sides: Sides,
    maps: Reduction,
    /// √s
    scale: Vec<f64>,
}

impl Reduced {
    /// Takes out what never changes; nothing where every edge may.
    pub fn new(whole: &CondensedModel, sides: Sides) -> Option<Self> {
        if sides.kept.iter().all(|&kept| kept) {
            return None;
        }
        let maps = sides.reduction(whole)?;
        let m = whole.inputs;
        let scale: Vec<f64> =
            maps.kept.iter().zip(m..).map(|(&at, j)| maps.r[at].factors[j].sqrt()).collect();
        // Not positive definite to working precision.
        if !scale.iter().all(|s| *s > 0.0) {
            return None;
        }
        let build = Build { whole, sides: &sides, maps: &maps, scale: &scale };
        let model = build.model();
        Some(Self { model, sides, maps, scale })
    }

    /// The edges of the whole model that were taken out as always open: their reaction is 0 in every tick.
    pub fn open(&self) -> Vec<bool> {
        let mut open = vec![false; self.sides.of.len()];
        self.maps.open.iter().take(self.maps.above).for_each(|&at| open[at] = true);
        open
    }

    /// The factors of a linear function in (p, x, d) of this model, from those in the whole one; each with what it may be off.
    pub fn combined(&self, whole: &CondensedModel, of_whole: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let Self { sides, maps, scale, .. } = self;
        let build = Build { whole, sides, maps, scale };
        whole
            .certificate
            .as_ref()
            .map_or_else(|_| Vec::new(), |form| build.combined(form, of_whole))
    }

    /// No more than what presses each edge of the whole model in every tick, ∫_E (τ·n − lo): above 0 where it always touches and its
    /// flux has no limit.
    pub fn pressed(&self, whole: &CondensedModel) -> Vec<f64> {
        let mut pressed = vec![0.0; self.sides.of.len()];
        let all = self.sides.box_of(&self.maps);
        for &at in self.maps.touching.iter().filter(|_| !whole.is_limited()) {
            pressed[at] = whole.multiplier[at] * self.maps.r[at].least(1.0, &all).max(0.0);
        }
        pressed
    }

    /// x of the whole model.
    pub fn expand(&self, p: &[f64], x: &[f64]) -> Vec<f64> {
        let mut whole = vec![0.0; self.sides.of.len()];
        let kept: Vec<f64> = x.iter().zip(&self.scale).map(|(x, s)| x / s).collect();
        for &at in &self.maps.open {
            let terms = self.maps.x[at].iter().zip(p.iter().chain(&kept));
            whole[at] = terms.map(|(factor, value)| factor * value).sum();
        }
        self.maps.kept.iter().zip(kept).for_each(|(&at, x)| whole[at] = x);
        whole
    }

    /// Where x′ lies, for x of the whole model within these.
    pub(super) fn within(&self, x: &[Interval]) -> Vec<Interval> {
        let kept = self.maps.kept.iter().zip(&self.scale);
        kept.map(|(&at, &s)| x[at] * Interval::point(s)).collect()
    }
}

/// What a reduced model is built from.
pub(super) struct Build<'b> {
    pub whole: &'b CondensedModel,
    pub sides: &'b Sides,
    pub maps: &'b Reduction,
    pub scale: &'b [f64],
}

impl Build<'_> {
    fn model(&self) -> CondensedModel {
        let Self { whole, maps, scale, .. } = *self;
        let (m, kept) = (whole.inputs, &maps.kept);
        let n = kept.len();
        let entry = |i: usize, j: usize| maps.r[kept[i]].factors[m + j] / (scale[i] * scale[j]);
        let matrix = |at: usize| match (at / n, at % n) {
            (i, j) if i == j => 1.0,
            (i, j) => 0.5 * (entry(i, j) + entry(j, i)),
        };
        let load =
            |j: usize| kept.iter().zip(scale).map(|(&at, s)| -maps.r[at].factors[j] / s).collect();
        let scaled = |of: &dyn Fn(usize, f64) -> f64| {
            kept.iter().zip(scale).map(|(&at, &s)| of(at, s)).collect::<Vec<f64>>()
        };
        CondensedModel {
            contact: n,
            edges: kept.iter().map(|&at| whole.edges[at]).collect(),
            inputs: m,
            matrix: (0..n * n).map(matrix).collect(),
            opening: scaled(&|at, s| whole.opening[at] / s),
            multiplier: scaled(&|at, s| whole.multiplier[at] * s),
            load: (0..m).map(load).collect(),
            spans: self.spans(),
            limits: kept
                .iter()
                .zip(scale)
                .map(|(&at, s)| self.sides.limits[at].map(|limit| limit * s))
                .collect(),
            defaults: whole.defaults.clone(),
            ranges: whole.ranges.clone(),
            outputs: whole.outputs.iter().map(|measure| self.measure(measure)).collect(),
            certificate: whole
                .certificate
                .as_ref()
                .map(|form| self.form(form))
                .map_err(Clone::clone),
            energy_unit: whole.energy_unit,
            held_by_contact: Vec::new(),
            rooms: whole.rooms.clone(),
            balances: whole.balances.clone(),
        }
    }

    /// Those of the edges that are left; none where their fluxes all go up without an end.
    fn spans(&self) -> Vec<Vec<f64>> {
        if !self.is_limited() {
            return Vec::new();
        }
        let of_kept = |column: &Vec<f64>| {
            self.maps.kept.iter().zip(self.scale).map(|(&at, s)| column[at] / s).collect()
        };
        self.whole.spans.iter().map(of_kept).collect()
    }

    /// Whether any edge that is left has a limit.
    pub fn is_limited(&self) -> bool {
        let constant = self.whole.spans.first();
        constant.is_some_and(|spans| self.maps.kept.iter().any(|&at| spans[at] != f64::INFINITY))
    }

    /// Factors of (p, x′) from those of (p, x_U).
    pub fn rescaled(&self, mut factors: Vec<f64>) -> Vec<f64> {
        let of_contact = factors.iter_mut().skip(self.whole.inputs);
        of_contact.zip(self.scale).for_each(|(factor, s)| *factor /= s);
        factors
    }

    /// Factors of (p, x′) of Y_x x, and those of Y_r r on the edges that always touch.
    fn affine(&self, of_contact: &[f64], of_reaction: &[f64]) -> [Vec<f64>; 2] {
        let mut sum = vec![0.0; self.whole.inputs + self.maps.kept.len()];
        let mut add = |weight: f64, row: &[f64]| {
            sum.iter_mut().zip(row).for_each(|(sum, factor)| *sum += weight * factor);
        };
        let weight = |of: &[f64], edge: usize| of.get(edge).copied().unwrap_or(0.0);
        for &edge in &self.maps.open {
            add(weight(of_contact, edge), &self.maps.x[edge]);
        }
        for &edge in &self.maps.touching {
            add(weight(of_reaction, edge), &self.maps.r[edge].factors);
        }
        // The end of a side that nobody asks for may be infinite.
        let ends = self.maps.open.iter().zip(self.maps.ends(self.whole));
        for (&edge, end) in ends.filter(|(edge, _)| weight(of_reaction, **edge) != 0.0) {
            add(weight(of_reaction, edge), &end);
        }
        for (at, &edge) in self.maps.kept.iter().enumerate() {
            sum[self.whole.inputs + at] += weight(of_contact, edge);
        }
        let mut of_inputs = self.rescaled(sum);
        let of_contact = of_inputs.split_off(self.whole.inputs);
        [of_inputs, of_contact]
    }

    fn measure(&self, measure: &Measure) -> Measure {
        let sum = |a: &[f64], b: Vec<f64>| match a.is_empty() {
            true => b,
            false => a.iter().zip(b).map(|(a, b)| a + b).collect(),
        };
        let or_none = |factors: Vec<f64>| match factors.iter().any(|&factor| factor != 0.0) {
            true => factors,
            false => Vec::new(),
        };
        let kept = |of: &[f64]| self.maps.kept.iter().map(|&at| of[at]).collect::<Vec<f64>>();
        match measure {
            Measure::Linear { of_inputs, of_contact } => {
                let [more, of_contact] = self.affine(of_contact, &[]);
                Measure::Linear { of_inputs: sum(of_inputs, more), of_contact }
            }
            Measure::Flux { of_inputs, of_contact, of_reaction } => {
                let [more, of_contact] = self.affine(of_contact, of_reaction);
                let reactions = kept(of_reaction).into_iter().zip(self.scale);
                Measure::Flux {
                    of_inputs: or_none(sum(of_inputs, more)),
                    of_contact: or_none(of_contact),
                    of_reaction: reactions.map(|(weight, s)| weight * s).collect(),
                }
            }
            Measure::Length { always, of_contact } => {
                let touching: f64 = self.maps.touching.iter().map(|&at| of_contact[at]).sum();
                Measure::Length { always: always + touching, of_contact: kept(of_contact) }
            }
            Measure::Saturated { always, of_contact } => {
                let beyond = &self.maps.open[self.maps.above..];
                let beyond: f64 = beyond.iter().map(|&at| of_contact[at]).sum();
                Measure::Saturated { always: always + beyond, of_contact: kept(of_contact) }
            }
            Measure::Bound => Measure::Bound,
        }
    }
}
