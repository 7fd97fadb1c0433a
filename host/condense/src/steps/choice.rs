//! How many states a condensed model gets where nobody says it: the fewest whose dropped part is proved to be a tenth of the bound.
//!
//! Inputs jump, ramp and swing over their ranges. The truncated model plays them with δ dropped after each tick, in the coordinates √κ z of
//! modes, whose ν = 1/κ. Its answer is off that of the model with all states by what the bound of the evolution makes of
//! ```text
//!   η² = Σ (1 + ν_j)² δ_j² + l·S⁻¹l,    l_i = Σ_j ν_j ψ_ij δ_j,    ψ_i the coordinates of opening i
//! ```
//! ρ = 0, r = 0. In the same weights stands the mean of the steady bounds for these inputs.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

use super::super::CondensedModel;
use super::gramian::Subspace;
use super::motion::Motion;
use super::shapes::{Begun, Shapes};
use signorini_kernel::evolution::{PHI, THETA};
use signorini_problem::random::Random;

/// The part of the bound that dropped states may be.
const SHARE: f64 = 0.1;

/// Numbers of states that are tried.
const TRIED: [usize; 11] = [1, 2, 4, 8, 12, 16, 24, 32, 48, 64, 96];

/// Where nothing can be proved: a thousandth of the motion in most scenes, at steps of a hundredth of their slowest time.
const USUAL: usize = 24;

/// Ticks of the trajectory.
const TICKS: usize = 160;

/// Ticks between changes of an input.
const REST: u32 = 40;

/// A model of steps without states, and what its states would follow.
pub(super) struct Trial<'t> {
    /// Its inputs are those of the scene, p⁻ and x⁻.
    pub model: &'t CondensedModel,
    pub motion: &'t Motion<'t>,
    /// dt and λ.
    pub pace: [f64; 2],
}

impl Trial<'_> {
    /// The fewest states that will do; `kept` finds the dominant ones.
    pub fn least(&self, kept: impl Fn(usize) -> Subspace) -> usize {
        let Some(reference) = self.reference() else { return USUAL };
        let is_enough = |&count: &usize| {
            let states = kept(count);
            let found = self.dropped(&states, &reference.inputs);
            found.is_some_and(|dropped| {
                let pairs = dropped.iter().zip(&reference.bounds);
                pairs.clone().all(|(dropped, bound)| *dropped <= SHARE * bound)
            })
        };
        let most = self.motion.deviations.count();
        let tried = TRIED.iter().copied().filter(|&count| count < most).find(is_enough);
        tried.unwrap_or(most.min(TRIED[TRIED.len() - 1]))
    }

    /// By how much what is remembered fades in a step.
    fn fading(&self) -> f64 {
        let [step, rate] = self.pace;
        1.0 / (1.0 + 2.0 * THETA * rate * step)
    }

    /// The inputs of each tick, and the fading mean of the steady bounds; nothing without any.
    fn reference(&self) -> Option<Reference> {
        let [step, rate] = self.pace;
        let Motion { shapes: Shapes { steady, .. }, start: Begun { inputs: begin, .. }, .. } =
            self.motion;
        if rate.is_nan() || rate <= 0.0 || begin.len() == 1 {
            return None;
        }
        let inputs = trajectory(steady, &self.motion.sizes, begin);
        let bound = |p: &[f64]| steady.bound(p, &steady.solve(p).ok()?);
        let (mut mean, fading) = (bound(begin)?.powi(2), self.fading());
        let mut bounds = Vec::new();
        for p in &inputs {
            mean = fading * mean + (1.0 - fading) * bound(p)?.powi(2);
            bounds.push(mean.sqrt());
        }
        step.is_finite().then_some(Reference { inputs, bounds })
    }

    /// The bound of what is dropped, in the same mean; nothing where a tick has no answer.
    fn dropped(&self, states: &Subspace, inputs: &[Vec<f64>]) -> Option<Vec<f64>> {
        let ([step, rate], fading) = (self.pace, self.fading());
        let Motion { start: begin, deviations, coordinates, left, .. } = self.motion;
        let (mut p_old, mut x_old) = (begin.inputs[1..].to_vec(), begin.openings.clone());
        let mut y = states.inner(left);
        let rows = states.changes(&deviations.fading, coordinates);
        let of_load = self.factor()?;
        let (mut square, mut all) = (0.0, Vec::new());
        let mut of_tick = self.model.clone();
        for p in inputs {
            // What states load stands in the constant's column.
            let load = &mut of_tick.load[0];
            load.copy_from_slice(&self.model.load[0]);
            for (row, y) in rows.iter().zip(&y) {
                let own = load.iter_mut().zip(&row[p_old.len()..]);
                own.for_each(|(load, of)| *load += y * of);
            }
            let x = of_tick.solve(&[&p[..], &p_old, &x_old].concat()).ok()?;
            let changes: Vec<f64> = p[1..]
                .iter()
                .zip(&p_old)
                .chain(x.iter().zip(&x_old))
                .map(|(now, was)| now - was)
                .collect();
            let mut z = states.outer(&y, deviations.count());
            for (change, shape) in changes.iter().zip(coordinates) {
                z.iter_mut().zip(shape).for_each(|(z, of)| *z -= change * of);
            }
            z.iter_mut().zip(&deviations.fading).for_each(|(z, rho)| *z *= rho);
            y = states.inner(&z);
            let kept = states.outer(&y, z.len());
            let delta: Vec<f64> = z.iter().zip(&kept).map(|(z, kept)| z - kept).collect();
            let eta = self.square(&delta, &coordinates[p_old.len()..], &of_load);
            square = fading * (square + step * eta / (2.0 * (1.0 - THETA - PHI)));
            all.push((square * THETA * rate / PHI).sqrt());
            (p_old, x_old) = (p[1..].to_vec(), x);
        }
        Some(all)
    }

    /// S in the unit of x of the steps.
    fn factor(&self) -> Option<faer::linalg::solvers::Llt<f64>> {
        let n = self.model.contact;
        let steady = &self.motion.shapes.steady;
        let unit = steady.energy_unit;
        let pairs = self.model.opening.iter().zip(&steady.opening);
        let scale: Vec<f64> = pairs.map(|(own, d)| unit * own / d).collect();
        let entry = |i: usize, j: usize| steady.matrix[n * i + j] * scale[i] * scale[j];
        Mat::from_fn(n, n, entry).llt(Side::Lower).ok()
    }

    /// η²
    fn square(
        &self,
        delta: &[f64],
        openings: &[Vec<f64>],
        of_load: &faer::linalg::solvers::Llt<f64>,
    ) -> f64 {
        let nu: Vec<f64> =
            self.motion.deviations.fading.iter().map(|rho| rho / (1.0 - rho)).collect();
        let own: f64 = delta.iter().zip(&nu).map(|(d, nu)| ((1.0 + nu) * d).powi(2)).sum();
        let load = |shape: &Vec<f64>| -> f64 {
            shape.iter().zip(delta).zip(&nu).map(|((of, d), nu)| nu * of * d).sum()
        };
        let load: Vec<f64> = openings.iter().map(load).collect();
        let right = Mat::from_fn(load.len(), 1, |i, _| load[i]);
        let solved = of_load.solve(&right);
        own + load.iter().enumerate().map(|(i, l)| l * solved[(i, 0)]).sum::<f64>()
    }
}

/// What the dropped part stands beside.
struct Reference {
    inputs: Vec<Vec<f64>>,
    bounds: Vec<f64>,
}

/// Inputs of every tick, the constant first: each jumps, ramps or swings within its range, and then takes its next way.
fn trajectory(of: &CondensedModel, sizes: &[f64], begin: &[f64]) -> Vec<Vec<f64>> {
    let mut random = Random::new(24);
    let ranges = of.ranges.iter().zip(begin).skip(1).zip(sizes);
    let ranges: Vec<[f64; 2]> = ranges
        .map(|((range, p), size)| match range.iter().all(|end| end.is_finite()) {
            true => *range,
            false => [p - 0.5 * size, p + 0.5 * size],
        })
        .collect();
    let mut now: Vec<f64> = begin[1..].to_vec();
    let mut ways: Vec<(u32, f64, f64)> = now.iter().map(|p| (0, *p, *p)).collect();
    let mut all = Vec::new();
    for tick in 0..TICKS as u32 {
        for ((p, way), [lo, hi]) in now.iter_mut().zip(&mut ways).zip(&ranges) {
            if tick % REST == 0 {
                *way = (random.below(3), *p, random.between(*lo, *hi));
            }
            let ((kind, from, to), part) = (*way, f64::from(tick % REST + 1) / f64::from(REST));
            *p = match kind {
                0 => to,
                1 => from + part * (to - from),
                _ => from + (to - from) * (2.0 * std::f64::consts::PI * part).sin().abs(),
            };
        }
        all.push([&[1.0], &now[..]].concat());
    }
    all
}
