//! The units in which a problem is solved: those in which its numbers are near 1.

use std::sync::Arc;

use signorini_problem::Problem;
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::units::Units;

use super::Solution;

/// Numbers between 2^−20 and 2^20 are near enough: their squares and sums stay far from the limits of f32.
const NEAR: i32 = 20;

/// The units of `problem`; 1 and 1 where its numbers are near 1 anyhow.
///
/// # Errors
/// Numbers whose energy f64 cannot hold.
pub fn choose(problem: &Problem) -> Result<Units> {
    let [u, conductivity] = sizes(problem).map(power);
    // An even power, whose root is a power of two as well.
    let conductivity = conductivity & !1;
    let units = Units { u: exp2(u), conductivity: exp2(conductivity) };
    let refused = |message: String, hint: &str| {
        Err(InputError::new(message).file(problem.scene.file()).hint(hint).into())
    };
    // Energies go with U²α, sums of them with the number of cells.
    if 2 * u + conductivity > 960 || u + conductivity > 960 {
        let message = format!(
            "u of about 1e{:.0} with a conductivity of about 1e{:.0} has an energy that f64 cannot hold",
            units.u.log10(),
            units.conductivity.log10()
        );
        // Of two ends the smaller one in size is a load.
        let hint = match problem.loads.spans.is_empty() {
            true => "choose other units",
            false => {
                "choose other units; an end of the flux that nothing reaches is \"inf\" or \"-inf\""
            }
        };
        return refused(message, hint);
    }
    // Normal numbers begin at 2^−1022, and fluxes are smaller than u.
    if u < -960 {
        let message =
            format!("u of about 1e{:.0} is too small for f64 to hold its digits", units.u.log10());
        return refused(message, "choose other units");
    }
    let is_near = |exponent: i32| exponent.abs() <= NEAR;
    let all = [u, conductivity, u + conductivity].into_iter().all(is_near);
    Ok(if all { Units::default() } else { units })
}

/// Numbers at the defaults that are smaller than this part of what inputs make are cancellation or 0.
const SILENT: f64 = 1e-6;

/// The units of a module that answers for any inputs: those of its defaults, and where these make next to nothing those
/// of 1 for each input whose default is 0. A large input would overflow the scalar otherwise.
///
/// # Errors
/// As for [`choose`].
pub fn choose_for_inputs(problem: &Problem) -> Result<Units> {
    let values: Vec<_> = problem.scene.inputs.iter().map(|input| input.default).collect();
    if !values.contains(&0.0) {
        return choose(problem);
    }
    let ones: Vec<_> = values.iter().map(|&value| if value == 0.0 { 1.0 } else { value }).collect();
    // Where 1 is not admissible, nothing is known of the inputs.
    let Ok(with_ones) = problem.with_inputs(&ones) else { return choose(problem) };
    let [[own, _], [of_inputs, _]] = [sizes(problem), sizes(&with_ones)];
    choose(if own >= SILENT * of_inputs { problem } else { &with_ones })
}

/// The size of u, and that of A: the geometric mean of its extremes. What is given outside of transfer edges
/// counts by what it does, as a load: behind a weak one it may be huge.
fn sizes(problem: &Problem) -> [f64; 2] {
    let loads = &problem.loads;
    let given = loads.dirichlet.iter().chain(&loads.gap).copied();
    let most = |numbers: &mut dyn Iterator<Item = f64>| {
        numbers.map(f64::abs).filter(|x| x.is_finite()).fold(0.0, f64::max)
    };
    let given = most(&mut { given });
    let Ok([diagonals, load]) = problem.diagonal_and_load() else { return [given, 1.0] };
    let stiffest = most(&mut diagonals.iter().copied());
    let softest = diagonals.iter().copied().fold(stiffest, f64::min);
    let loads = load.iter().zip(&diagonals);
    let driven = most(&mut loads.map(|(load, diagonal)| load / diagonal));
    [given.max(driven), stiffest.sqrt() * softest.sqrt()]
}

/// The exponent of the power of two next to x.
fn power(x: f64) -> i32 {
    if x > 0.0 && x.is_finite() { x.log2().round() as i32 } else { 0 }
}

/// 2ⁿ, and the largest or smallest normal one beyond.
fn exp2(n: i32) -> f64 {
    f64::from(n.clamp(-1000, 1000)).exp2()
}

/// A problem in units of its own, posed in them once: in those of the scene where these are 1.
#[derive(Debug)]
pub struct Scaled<'p> {
    /// In the scene's units.
    pub own: &'p Problem,
    /// Units of the other problem.
    pub units: Units,
    other: Option<Arc<Problem>>,
}

impl<'p> Scaled<'p> {
    /// `own` in `units`.
    ///
    /// # Errors
    /// Data that are not finite in these units.
    pub fn new(own: &'p Problem, units: Units) -> Result<Self> {
        let other = match units == Units::default() {
            true => None,
            false => Some(Arc::new(own.in_units(&units)?)),
        };
        Ok(Self { own, units, other })
    }

    /// The problem in these units.
    pub fn problem(&self) -> &Problem {
        self.other.as_deref().unwrap_or(self.own)
    }

    /// The problem in other units, where these are not the scene's.
    pub fn other(self) -> Option<Arc<Problem>> {
        self.other
    }
}

/// A solution in `units` becomes one in the scene's; with their inverse, the other way round.
pub fn times(units: &Units, mut solution: Solution) -> Solution {
    let times = |numbers: &mut [f64], unit: f64| numbers.iter_mut().for_each(|x| *x *= unit);
    times(&mut solution.u, units.u);
    times(&mut solution.flux, units.flux());
    solution.contact_force *= units.flux();
    solution.bound = solution.bound.map(|bound| bound.times(units.energy()));
    let certified = &mut solution.certified;
    times(&mut certified.vertices, units.u);
    times(&mut certified.bubbles, units.u);
    times(&mut certified.tau, units.flux());
    times(&mut certified.indicators, units.energy() * units.energy());
    solution
}
