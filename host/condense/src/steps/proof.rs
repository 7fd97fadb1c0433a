//! What the bound takes for granted of edges that were taken out of a model of steps, proved of that model.
//!
//! The bound of a model without these edges asks for two things, whatever a tick leaves unfinished:
//! ```text
//!   s ≥ ψ along edges that are always open,    τ·n ≥ q through those that always touch
//! ```
//! Both are affine in what a step takes and finds, and in all that has been: with the states written out,
//! ```text
//!   a·p_n + Σ_{i≥1} a_i·p_{n−i} + b·x_n + Σ_{i≥1} b_i·x_{n−i} + e·d_n + e⁻·d_{n−1}
//! ```
//! Inputs lie in their ranges, and openings are kept within limits by the tick. So the least value over all of them, lag by lag, less
//! what rounding may add up to in any scalar, is a proof. Where steps begin s is one number at each vertex.

use super::super::ranges::history::{backward, column};
use super::super::ranges::sides::widened;
use super::super::{Recovery, Settled, Vertex};
use super::memory::by_fading;
use super::{Memory, SteppedModel};
use signorini_certify::TermData;
use signorini_problem::Problem;

/// Roundings of f32 by which a term, and a state in each step, may be off at least.
const ROUNDINGS: f64 = 16.0;

/// What a model and its fields are proved with.
pub(super) struct Proof<'p> {
    of: &'p SteppedModel,
    recovery: &'p Recovery,
    /// Ranges of the inputs, the constant first.
    inputs: Vec<[f64; 2]>,
    /// Contact vertices, and where s − ψ = e + d lies there.
    vertices: &'p [Vertex],
    raised: Vec<[f64; 2]>,
    /// The states, the slowest first, and their numbers.
    memory: Memory,
    order: Vec<usize>,
    /// The part of a sum's terms by which rounding in f32 may put it off.
    rounding: f64,
}

impl<'p> Proof<'p> {
    /// Of a model with a bound that begins within its limits.
    pub fn new(of: &'p SteppedModel, recovery: &'p Recovery) -> Option<Self> {
        let form = of.model.certificate.as_ref().ok()?;
        let limits = &of.model.limits;
        let begin = of.start().iter().skip(of.inputs - 1).zip(limits);
        if !begin.into_iter().all(|(x, [lo, hi])| lo <= x && x <= hi) {
            return None;
        }
        let inputs = widened(&of.model.ranges[..of.inputs]);
        // e = Σ weights x, and d takes it to 0, or leaves it where it is above.
        let raised = |vertex: &Vertex| {
            let highest = vertex.edges.iter().zip(vertex.weights).map(|(&edge, weight)| {
                let [a, b] = limits[edge].map(|x| weight * x);
                a.max(b)
            });
            [0.0, highest.sum::<f64>().max(0.0)]
        };
        let raised = form.vertices.iter().map(raised).collect();
        let (memory, order) = (of.memory(), by_fading(&of.fading));
        // Half of an ε per term.
        let terms = (of.model.inputs + of.model.contact + 4) as f64;
        let rounding = ROUNDINGS.max(0.5 * terms) * f64::from(f32::EPSILON);
        let vertices = &form.vertices;
        Some(Self { of, recovery, vertices, inputs, raised, memory, order, rounding })
    }

    /// The edges of which some step might break what the bound asks for.
    pub fn failed(&self, problem: &Problem, patterns: &[TermData]) -> Vec<usize> {
        let Some(fields) = &self.recovery.admissibles else { return Vec::new() };
        let Settled { open, touching } = &self.of.settled;
        let free = problem.topology.counts.free;
        let unit = self.of.model.energy_unit;
        let m = self.of.inputs;
        let row = |of: &[f64]| -> Vec<f64> {
            let own = of.iter().enumerate();
            own.map(|(at, x)| if at < self.of.model.inputs { *x } else { unit * x }).collect()
        };
        let mut failed = Vec::new();
        for &edge in touching {
            let mut flux = row(fields.fluxes.row(free + edge));
            let q = patterns.iter().map(|pattern| pattern.loads().contact_flux[edge]);
            flux[..m].iter_mut().zip(q).for_each(|(flux, q)| *flux -= q);
            // A NaN proves nothing.
            let is_pressed = self.least(&flux) >= 0.0;
            if !is_pressed {
                failed.push(edge);
            }
        }
        for &edge in open {
            let is_above = |(end, vertex): (usize, u32)| {
                let mut above = row(fields.s.row(vertex as usize));
                let psi = patterns.iter().map(|pattern| pattern.ends.gap[edge][end]);
                above[..m].iter_mut().zip(psi).for_each(|(s, psi)| *s -= psi);
                let is_psi = above.iter().all(|factor| *factor == 0.0);
                let is_told = is_psi || fields.contact.contains(&vertex);
                let old = fields.s.row(fields.functions.count() + vertex as usize);
                is_told
                    || self.least(&above) >= 0.0 && self.at_start(old, edge, end, patterns) >= 0.0
            };
            if !problem.ends[free + edge].into_iter().enumerate().all(is_above) {
                failed.push(edge);
            }
        }
        failed
    }

    /// s − ψ where steps begin, s being so much of what the start leaves, less what may be rounded.
    fn at_start(&self, of_s: &[f64], edge: usize, end: usize, patterns: &[TermData]) -> f64 {
        let of = self.of;
        let mut sum = Least::default();
        for (factor, &value) in of_s.iter().zip(&of.model.defaults) {
            sum.add(*factor, [value; 2]);
        }
        let given = std::iter::once(&1.0).chain(of.start());
        for (pattern, &value) in patterns.iter().zip(given) {
            sum.add(-pattern.ends.gap[edge][end], [value; 2]);
        }
        sum.value - self.rounding * sum.size
    }

    /// The least value of these factors of (p, p⁻, x⁻, y⁻, d⁻, x, d), or less.
    fn least(&self, row: &[f64]) -> f64 {
        let (of, m) = (self.of, self.of.inputs);
        let (n, r) = (of.model.contact, of.fading.len());
        let (given, rest) = row.split_at(m);
        let (given_before, rest) = rest.split_at(m - 1);
        let (openings_before, rest) = rest.split_at(n);
        let (of_states, rest) = rest.split_at(r);
        let (corrections_before, rest) = rest.split_at(of.corrections);
        let (openings, corrections) = rest.split_at(n);
        let limits = &of.model.limits;
        let openings = self.without_ends(openings, corrections);
        let openings_before = self.without_ends(openings_before, corrections_before);
        let now = given.iter().zip(&self.inputs).chain(openings.iter().zip(limits));
        let raised = corrections.iter().zip(&self.raised);
        let raised_before = corrections_before.iter().zip(&self.raised);
        let mut sum = Least::default();
        now.chain(raised).chain(raised_before).for_each(|(factor, range)| sum.add(*factor, *range));
        let weights: Vec<f64> = self.order.iter().map(|&at| of_states[at]).collect();
        let Memory { fading, of_contact, of_inputs, .. } = &self.memory;
        let past = self.inputs.iter().skip(1).enumerate();
        let past = past.map(|(j, range)| (given_before[j], column(of_inputs, j), range));
        let opened = limits.iter().enumerate();
        let opened = opened.map(|(j, range)| (openings_before[j], column(of_contact, j), range));
        for (total, column, &range) in past.chain(opened) {
            let back = backward(total, fading, [&weights, &column]);
            sum.add(total + back, range);
            sum.add(-back, range);
        }
        sum.value + self.begun(&weights) - self.rounding * sum.size - self.drift(&weights)
    }

    /// Factors of openings, those of e + d being `corrections`.
    fn without_ends(&self, openings: &[f64], corrections: &[f64]) -> Vec<f64> {
        let mut own = openings.to_vec();
        for (vertex, factor) in self.vertices.iter().zip(corrections) {
            for (&edge, weight) in vertex.edges.iter().zip(vertex.weights) {
                own[edge] -= factor * weight;
            }
        }
        own
    }

    /// The least that what the start has left adds in any step.
    fn begun(&self, weights: &[f64]) -> f64 {
        let (mut sum, mut least, mut size) = (0.0_f64, 0.0_f64, 0.0);
        // Powers of ω fall along the states: what they make of a sum is between its parts.
        for (weight, begin) in weights.iter().zip(&self.memory.begin) {
            let term = weight * begin;
            (sum, size) = (sum + term, size + term.abs());
            least = least.min(sum);
        }
        least - self.rounding * size
    }

    /// What the rounding of states may add up to.
    fn drift(&self, weights: &[f64]) -> f64 {
        let widths = |of: &[[f64; 2]]| of.iter().map(|[lo, hi]| hi - lo).collect::<Vec<f64>>();
        let [openings, inputs] = [&self.of.model.limits[..], &self.inputs[1..]].map(widths);
        let states = weights.iter().zip(self.memory.drift([&openings, &inputs]));
        self.rounding * states.map(|(weight, drift)| weight.abs() * drift).sum::<f64>()
    }
}

/// A sum of least values, and of the largest sizes of its terms.
#[derive(Default)]
struct Least {
    value: f64,
    size: f64,
}

impl Least {
    fn add(&mut self, factor: f64, [lo, hi]: [f64; 2]) {
        self.value += (factor * lo).min(factor * hi);
        self.size += factor.abs() * hi.max(-lo);
    }
}
