//! The units in which a problem is solved: those in which its numbers are near 1, and what is given of u near 0.
//!
//! A constant added to every datum of u is added to u, and nothing else changes. But numbers are rounded by their size: where the
//! data are large against their differences, a constant is taken from all of them before they are narrowed.

use std::sync::Arc;

use signorini_problem::{Parts, Problem};
use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::units::Units;

use super::Solution;

/// Numbers between 2^−20 and 2^20 are near enough: their squares and sums stay far from the limits of f32.
const NEAR: i32 = 20;

/// Data of u this far from 0, over their range, are moved there. From 2 on no digit of them is lost by that: the difference of
/// two numbers within a factor of 2 is exact.
const FAR: f64 = 4.0;

/// The units of `problem`; 1, 1 and 0 where its numbers are near 1 anyhow.
///
/// # Errors
/// Numbers whose energy f64 cannot hold.
pub fn choose(problem: &Problem) -> Result<Units> {
    let zero = zero(problem);
    if zero == 0.0 {
        return powers(problem);
    }
    let moved = problem.in_units(&Units { zero, ..Units::default() })?;
    Ok(Units { zero, ..powers(&moved)? })
}

/// The middle of what is given of u, in few digits; 0 where that is near 0 for its range, or where some part of the domain has
/// nothing given: its u has a mean of 0.
fn zero(problem: &Problem) -> f64 {
    let loads = &problem.loads;
    let outside = loads.robin.iter().filter(|law| law.coefficient > 0.0);
    let given = loads.dirichlet.iter().chain(&loads.gap).copied();
    let given = given.chain(outside.map(|law| law.ambient / law.coefficient));
    let (low, high) =
        given.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    let (middle, range) = (0.5 * low + 0.5 * high, high - low);
    if !middle.is_finite() || middle.abs() <= FAR * range {
        return 0.0;
    }
    if !Parts::examine(problem).is_ok_and(|parts| parts.counts.floating == 0) {
        return 0.0;
    }
    let digit = if range > 0.0 { exp2(range.log2().floor() as i32) } else { 0.0 };
    if digit > 0.0 { (middle / digit).round() * digit } else { middle }
}

/// Units that leave the zero of u where it is.
fn powers(problem: &Problem) -> Result<Units> {
    let [u, conductivity] = sizes(problem).map(power);
    // An even power, whose root is a power of two as well.
    let conductivity = conductivity & !1;
    let units = Units { u: exp2(u), conductivity: exp2(conductivity), zero: 0.0 };
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
/// of 1 for each input whose default is 0. A large input would overflow the scalar otherwise. The zero of u stays: a module
/// reads inputs that are added to the data.
///
/// # Errors
/// As for [`choose`].
pub fn choose_for_inputs(problem: &Problem) -> Result<Units> {
    let values: Vec<_> = problem.scene.inputs.iter().map(|input| input.default).collect();
    if !values.contains(&0.0) {
        return powers(problem);
    }
    let ones: Vec<_> = values.iter().map(|&value| if value == 0.0 { 1.0 } else { value }).collect();
    // Where 1 is not admissible, nothing is known of the inputs.
    let Ok(with_ones) = problem.with_inputs(&ones) else { return powers(problem) };
    let [[own, _], [of_inputs, _]] = [sizes(problem), sizes(&with_ones)];
    powers(if own >= SILENT * of_inputs { problem } else { &with_ones })
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

/// A solution of `problem`, which is stated in `units`, becomes one of the scene's that remembers both.
pub fn in_scene(problem: &Arc<Problem>, units: &Units, solution: Solution) -> Solution {
    let own = Some(Arc::new((problem.clone(), solution.clone())));
    Solution { units: *units, own, ..times(units, solution) }
}

/// A solution in `units` becomes one in the scene's; with their inverse, the other way round.
pub fn times(units: &Units, mut solution: Solution) -> Solution {
    let times = |numbers: &mut [f64], unit: f64| numbers.iter_mut().for_each(|x| *x *= unit);
    let values = |numbers: &mut [f64]| numbers.iter_mut().for_each(|u| *u = units.value(*u));
    values(&mut solution.u);
    times(&mut solution.flux, units.flux());
    solution.contact_force *= units.flux();
    solution.bound = solution.bound.map(|bound| bound.times(units.energy()));
    let certified = &mut solution.certified;
    values(&mut certified.vertices);
    times(&mut certified.bubbles, units.u);
    times(certified.openings.as_flattened_mut(), units.u);
    certified.lifts = std::mem::take(&mut certified.lifts).in_units(units);
    times(&mut certified.tau, units.flux());
    times(&mut certified.indicators, units.energy() * units.energy());
    solution
}
