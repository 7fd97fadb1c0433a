//! A condensed model against the same without the edges that never change sides.
//!
//! Both must tell the same of every p of the box, at solutions and at any x within the limits of a tick. What can go
//! wrong is measured by [`Off`]; wrong sides, put there on purpose, must show in it.

mod bounds;
mod largest;
mod mutations;
mod standard;
mod ticks;
mod unproved;

use signorini_condense::ranges::reduced::Reduced;
use signorini_condense::ranges::sides::{EdgeSide, Sides};
use signorini_condense::{CondensedModel, Measure};
use signorini_tests::random::Random;
use signorini_tolerances::twins::{REDUCED_BOUND, REDUCED_OPENINGS, REDUCED_OUTPUTS};

use crate::condensed::scenes::Model;

/// A whole model and what is left of it.
pub struct Pair {
    pub what: String,
    pub whole: CondensedModel,
    pub reduced: Reduced,
    /// Both as if mending cost nothing: their bounds are the same then.
    unmended: [CondensedModel; 2],
}

/// The largest deviations, over the sums of the sizes of terms, and how often something was on its wrong side.
#[derive(Debug, Clone, Copy, Default)]
pub struct Off {
    pub openings: f64,
    pub outputs: f64,
    /// By how much the reduced bound is below the whole one, above it without need, or another but for mending.
    pub bound: f64,
    pub on_wrong_side: usize,
    pub samples: usize,
}

impl Off {
    pub fn check(&self, what: &str) {
        assert_eq!(self.on_wrong_side, 0, "{what}: on the wrong side");
        REDUCED_OPENINGS.check(what, self.openings);
        REDUCED_OUTPUTS.check(what, self.outputs);
        REDUCED_BOUND.check(what, self.bound);
    }

    /// Whether a check would fail.
    pub fn is_wrong(&self) -> bool {
        let is_off = self.openings > REDUCED_OPENINGS.value
            || self.outputs > REDUCED_OUTPUTS.value
            || self.bound > REDUCED_BOUND.value;
        self.on_wrong_side > 0 || is_off
    }
}

impl Pair {
    /// `None` where no edge can be taken out.
    pub fn new(what: &str, whole: &CondensedModel) -> Option<Self> {
        Self::with(what, whole, Sides::new(whole).expect("finite loads"))
    }

    pub fn with(what: &str, whole: &CondensedModel, sides: Sides) -> Option<Self> {
        let reduced = Reduced::new(whole, sides)?;
        let unmended = [whole, &reduced.model].map(|model| {
            let mut model = model.clone();
            model.certificate.iter_mut().for_each(|form| form.stability = 0.0);
            model
        });
        Some(Self { what: what.to_owned(), whole: whole.clone(), reduced, unmended })
    }

    /// A random scene, with a range for each input; `None` where nothing can be taken out.
    pub fn random(seed: u64) -> Option<Self> {
        limited(seed).and_then(|(what, whole)| Self::new(&what, &whole))
    }

    /// At the solution of p, each model's own; that of the whole model.
    pub fn at_solution(&self, p: &[f64], off: &mut Off) -> Vec<f64> {
        let Self { whole, reduced, .. } = self;
        let x = whole.solve(p).expect("a solution");
        let own = reduced.model.solve(p).expect("a solution");
        let expanded = reduced.expand(p, &own);
        let size = x.iter().fold(size_of_load(whole, p), |most, x| most.max(*x));
        for (x, expanded) in x.iter().zip(&expanded) {
            off.openings = off.openings.max(over(x - expanded, size));
        }
        off.on_wrong_side += self.misplaced(&x, size);
        self.outputs_and_bound(p, &own, [&expanded, &x], off);
        x
    }

    /// At so many inputs of the box, as a solution and otherwise.
    pub fn sampled(&self, samples: usize, random: &mut Random) -> Off {
        let mut off = Off::default();
        for _ in 0..samples {
            let p = drawn(&self.whole, random);
            self.at_solution(&p, &mut off);
            self.at(&p, &self.within(random), &mut off);
        }
        off
    }

    /// At any x of the reduced model, solution or not.
    pub fn at(&self, p: &[f64], own: &[f64], off: &mut Off) {
        let x = self.reduced.expand(p, own);
        let rounding = 1e-12 * size_of_load(&self.whole, p);
        let residual = self.whole.residual(p, &x);
        for (at, (x, r)) in x.iter().zip(&residual).enumerate() {
            if !self.reduced.sides.kept[at] {
                let is_open = self.reduced.sides.of[at] == EdgeSide::Open;
                let is_misplaced = if is_open { *x <= 0.0 } else { *r < -rounding };
                off.on_wrong_side += usize::from(is_misplaced);
            }
        }
        self.outputs_and_bound(p, own, [&x, &x], off);
    }

    /// How many edges of a solution lie where `sides` says that they never do. An edge that may change may do so
    /// within rounding.
    fn misplaced(&self, x: &[f64], size: f64) -> usize {
        let Sides { of, limits, .. } = &self.reduced.sides;
        let is_misplaced = |((&x, side), [least, most]): ((&f64, &EdgeSide), &[f64; 2])| {
            let is_on_side = match side {
                EdgeSide::Open => x > 0.0,
                EdgeSide::Touching => x == 0.0,
                EdgeSide::Saturated => x < 0.0,
                EdgeSide::MayChange => true,
            };
            !is_on_side || x < *least || x > most + 1e-14 * size
        };
        x.iter().zip(of).zip(limits).filter(|&of| is_misplaced(of)).count()
    }

    /// At `own_x`, which is the first of `x` in the whole model; lengths and solutions of that are the second.
    fn outputs_and_bound(
        &self,
        p: &[f64],
        own_x: &[f64],
        [x, solution]: [&[f64]; 2],
        off: &mut Off,
    ) {
        let Self { whole, reduced, .. } = self;
        off.samples += 1;
        let found = reduced.model.outputs(p, own_x);
        for ((measure, found), expected) in
            whole.outputs.iter().zip(found).zip(whole.outputs(p, solution))
        {
            if let Some(terms) = terms(whole, measure, p, solution, 1e-9) {
                let [found, expected] = [found, expected].map(|value| value.expect("a value"));
                off.outputs = off.outputs.max(over(found - expected, terms));
            }
        }
        let bounds = [whole.bound(p, x), reduced.model.bound(p, own_x)];
        match bounds {
            [Some(whole), Some(own)] => {
                let terms = self.terms_of_bound(p, x);
                let most = whole * self.worth_of_mending();
                off.bound = off.bound.max(over((whole - own).max(own - most).max(0.0), terms));
                let unmended = [(&self.unmended[0], x), (&self.unmended[1], own_x)];
                let [whole, own] = unmended.map(|(model, x)| model.bound(p, x).expect("a bound"));
                off.bound = off.bound.max(over(whole - own, terms));
            }
            _ => assert_eq!(bounds[0], bounds[1], "{}", self.what),
        }
    }

    /// √s of every edge kept.
    fn scales(&self) -> Vec<f64> {
        let Self { whole, reduced, .. } = self;
        let kept = (0..whole.contact).filter(|&at| reduced.sides.kept[at]);
        kept.zip(&reduced.model.opening).map(|(at, own)| whole.opening[at] / own).collect()
    }

    /// The cost of mending is taken at the largest √s, for edges down to the smallest.
    fn worth_of_mending(&self) -> f64 {
        let scales = self.scales();
        let most = scales.iter().fold(0.0, |most: f64, s| most.max(*s));
        let least = scales.iter().fold(most, |least, s| least.min(*s));
        if least > 0.0 { most / least } else { 1.0 }
    }

    /// Σ of the sizes of what the bound of the whole model is a norm of.
    fn terms_of_bound(&self, p: &[f64], x: &[f64]) -> f64 {
        let Ok(form) = &self.whole.certificate else { return 0.0 };
        let z = p.iter().chain(x).copied().chain(self.whole.corrections(p, x));
        let column = |j: usize| &form.factor[j * (j + 1) / 2..(j + 1) * (j + 2) / 2];
        let norm = |j: usize| column(j).iter().map(|entry| entry * entry).sum::<f64>().sqrt();
        let terms: f64 = z.enumerate().map(|(j, z)| norm(j) * z.abs()).sum();
        self.whole.energy_unit * (terms + form.stability * size_of_load(&self.whole, p))
    }

    /// x within the limits of a tick: touching here and there, at a limit, between them.
    pub fn within(&self, random: &mut Random) -> Vec<f64> {
        let draw = |&[least, most]: &[f64; 2]| match random.below(4) {
            0 => least,
            1 => most,
            _ => random.between(least, most),
        };
        self.reduced.model.limits.iter().map(draw).collect()
    }
}

/// A random scene, with a range for each input.
fn limited(seed: u64) -> Option<(String, CondensedModel)> {
    let Model { what, condensate: mut whole, .. } = Model::random(seed, 5)?;
    limit(&mut whole, &mut Random::new(seed ^ 0x5eed));
    Some((what, whole))
}

/// Gives every input a range around its default or far away from it, and a default within.
fn limit(whole: &mut CondensedModel, random: &mut Random) {
    // Half of the scenes are those of small changes, for which most edges stay where they are.
    let most = if random.below(2) == 0 { 0.03 } else { 1.0 };
    for (range, default) in whole.ranges.iter_mut().zip(&mut whole.defaults).skip(1) {
        let width = most * 10f64.powf(random.between(-3.0, 0.0));
        *range = match random.below(6) {
            0 => [*default; 2],
            1 => [*default - 10.0 * width, *default + 10.0 * width],
            2 => [60.0 - width, 60.0],
            3 => [0.0, width],
            _ => [*default - width, *default + width],
        };
        *default = default.clamp(range[0], range[1]);
    }
}

/// Inputs of the box, the constant first: anywhere, or at its corners.
pub fn drawn(whole: &CondensedModel, random: &mut Random) -> Vec<f64> {
    let is_corner = random.below(2) == 0;
    let draw = |&[lo, hi]: &[f64; 2]| match (is_corner, random.below(2)) {
        (false, _) => lo + (hi - lo) * random.between(0.0, 1.0),
        (true, 0) => lo,
        (true, _) => hi,
    };
    whole.ranges.iter().map(draw).collect()
}

/// The largest Σ |B_ij p_j|
pub fn size_of_load(of: &CondensedModel, p: &[f64]) -> f64 {
    let size = |i: usize| of.load.iter().zip(p).map(|(column, p)| (column[i] * p).abs()).sum();
    (0..of.contact).map(size).fold(0.0, f64::max)
}

/// The sum of the sizes of all that an output is a sum of; `None` of a length that another rounding may change, and of
/// the bound.
pub fn terms(
    of: &CondensedModel,
    measure: &Measure,
    p: &[f64],
    x: &[f64],
    doubt: f64,
) -> Option<f64> {
    let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a * b).abs()).sum::<f64>();
    match measure {
        Measure::Linear { of_inputs, of_contact } => Some(sum(of_inputs, p) + sum(of_contact, x)),
        Measure::Flux { of_inputs, of_contact, of_reaction } => {
            let loads: Vec<f64> = of.load.iter().map(|column| sum(of_reaction, column)).collect();
            let rows = of.matrix.chunks(of.contact.max(1)).zip(of_reaction);
            let rows = rows.map(|(row, weight)| weight.abs() * sum(row, x)).sum::<f64>();
            Some(sum(of_inputs, p) + sum(of_contact, x) + sum(&loads, p) + rows)
        }
        Measure::Length { .. } | Measure::Saturated { .. } => {
            let residual = of.residual(p, x);
            let size = x.iter().fold(size_of_load(of, p), |most, x| most.max(*x));
            let is_doubtful = |(x, r): (&f64, &f64)| x.max(r.abs()) <= doubt * size;
            let is_known = !x.iter().zip(&residual).any(is_doubtful);
            is_known.then_some(1.0)
        }
        Measure::Bound => None,
    }
}

/// Where both are 0, nothing is off.
pub fn over(difference: f64, size: f64) -> f64 {
    if difference == 0.0 { 0.0 } else { difference.abs() / size }
}
