//! How wrong an answer is, at scale 1 and without the solver that gave it.
//!
//! The answer is divided by the factors of its scale; the exact solution is evaluated on the mesh at scale 1,
//! where coordinates are of size 1 and numbers neither overflow nor vanish. There 16×16 points per cell (on large grids 4×4)
//! integrate the distance, and the direct solver says what the grid allows for.
//! Where ‖u‖ spans more than 16 digits inside a cell (κ = 10⁶ and beyond), or loads are subnormal, the
//! exact solution is itself good to a few digits only; bounds there are far above that.

use std::path::Path;
use std::sync::Arc;

use super::attempt::Attempt;
use super::case::ExtremeCase;
use super::grid::Shape;
use super::posed::Posed;
use crate::mesh_solution::solve_directly;
use signorini_certify::admissible::Admissible;
use signorini_certify::exact::{distance, of_fewer_points};
use signorini_problem::Problem;
use signorini_scene::{Mesh, Result, Scene};
use signorini_solve::norms::errors;

/// An answer beside the truth, in energy norms at scale 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Measured {
    pub bound: Option<f64>,
    /// The true error that it bounds; without a bound, ‖A^½∇_h(u − u_h)‖.
    pub error: f64,
    /// How far that number may be off: what half of the points a direction change, where it seems above the bound.
    pub uncertain: f64,
    /// The exact discrete solution beside the truth; none where the direct solver finds none.
    pub reference: Option<Reference>,
    /// |u − u_h|₁ and ‖σ − σ_h‖ on trapezoids, where they fall at different rates.
    pub of_fields: Option<[f64; 2]>,
    pub finite: bool,
}

/// The exact discrete solution.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Reference {
    /// Its bound, where it has one.
    pub bound: Option<f64>,
    /// ‖A^½∇_h(u − u_h)‖; NaN where the answer has a bound, and it is not asked for.
    pub error: f64,
    /// ‖A^½∇_h u_h‖
    pub energy: f64,
}

/// Finer grids get their reference from one of this many rows, times the ratio of the widths.
const FINEST: u32 = 64;
/// Grids with more rows are integrated with fewer points: solutions that are polynomials in each cell need no more.
const LARGE: u32 = 128;

pub fn measure(case: &ExtremeCase, attempt: &Attempt) -> Result<Measured> {
    let posed = case.posed.at_scale_one();
    let mesh = case.posed.scales.unplaced(Mesh::clone(&attempt.mesh));
    let problem = at_scale_one(&posed, mesh)?;
    let scales = case.posed.scales;
    let (load, unit) = (scales.load, scales.energy());
    let scaled = |numbers: &[f64], factor: f64| -> Vec<f64> {
        numbers.iter().map(|x| x / load / factor).collect()
    };
    let (u, flux) =
        (scaled(&attempt.answer.u, 1.0), scaled(&attempt.answer.flux, scales.stiffness));
    let reference = reference(&posed, &problem, attempt.answer.bound.is_none()).ok();
    let finite = u.iter().chain(&flux).all(|x| x.is_finite())
        && attempt.answer.bound.is_none_or(|bound| bound.total.is_finite());
    let Some(exact) = problem.scene.exact.as_ref().filter(|_| finite) else {
        return Ok(Measured { reference, ..Measured::default() });
    };
    let bound = attempt.answer.bound.map(|bound| bound.total / unit);
    let mut uncertain = 0.0;
    let error = match attempt.answer.bound {
        None => errors(exact, &problem, &u, &flux)?.energy,
        Some(_) => {
            let certified = &attempt.answer.certified;
            let vertices = scaled(&certified.vertices, 1.0);
            let bubbles = scaled(&certified.bubbles, 1.0);
            let tau = scaled(&certified.tau, scales.stiffness);
            let following = &certified.following;
            let admissible =
                Admissible { vertices: &vertices, bubbles: &bubbles, tau: &tau, following };
            if posed.grid.n > LARGE {
                of_fewer_points(exact, &problem, &admissible)?
            } else {
                let found = distance(exact, &problem, &admissible)?.combined;
                let transfers = !problem.loads.robin.is_empty();
                if bound.is_some_and(|bound| found > bound) && !transfers {
                    uncertain = (found - of_fewer_points(exact, &problem, &admissible)?).abs();
                }
                found
            }
        }
    };
    let is_bent = posed.grid.shape == Shape::Trapezoids;
    let of_fields = is_bent.then(|| errors(exact, &problem, &u, &flux)).transpose()?;
    let of_fields = of_fields.map(|errors| [errors.h1, errors.flux]);
    let finite = error.is_finite();
    Ok(Measured { bound, error, uncertain, reference, of_fields, finite })
}

/// Of the ticks the one whose bound is worst kept, against the exact discrete solution of its time.
pub fn of_ticks(case: &ExtremeCase, attempt: &Attempt) -> Result<Measured> {
    let mut problem = at_scale_one(&case.posed, attempt.mesh.clone())?;
    let mut worst = Measured { finite: true, ..Measured::default() };
    for tick in &attempt.ticks {
        problem.set_time(tick.time)?;
        let found = solve_directly(&problem).ok();
        let measured = Measured {
            bound: tick.bound.map(|bound| bound.total),
            error: tick.combined.unwrap_or(f64::NAN),
            uncertain: 0.0,
            reference: found.map(|solution| Reference {
                bound: solution.bound.map(|bound| bound.total),
                error: f64::NAN,
                energy: solution.energy(&problem),
            }),
            of_fields: None,
            finite: tick.bound.is_some() && tick.combined.is_some(),
        };
        let ratio = |of: &Measured| of.bound.map_or(0.0, |bound| of.error / bound);
        if !measured.finite {
            return Ok(measured);
        }
        if worst.bound.is_none() || ratio(&measured) > ratio(&worst) {
            worst = measured;
        }
    }
    Ok(worst)
}

fn at_scale_one(posed: &Posed, mesh: impl Into<Arc<Mesh>>) -> Result<Problem> {
    Problem::new(&Scene::parse(&posed.scene(), Path::new("scale-1.toml"))?, mesh)
}

/// The exact discrete solution, its error where that is `needed`.
fn reference(posed: &Posed, problem: &Problem, needed: bool) -> Result<Reference> {
    if posed.grid.n > FINEST {
        let mut coarse = *posed;
        coarse.grid.n = FINEST;
        let problem = at_scale_one(&coarse, coarse.mesh())?;
        let found = reference(&coarse, &problem, needed)?;
        let ratio = f64::from(FINEST) / f64::from(posed.grid.n);
        let bound = found.bound.map(|bound| ratio * bound);
        return Ok(Reference { bound, error: ratio * found.error, ..found });
    }
    let solution = solve_directly(problem)?;
    let of_bound = solution.bound.map(|bound| bound.total);
    let exact = problem.scene.exact.as_ref().filter(|_| needed);
    let error = exact.map(|exact| errors(exact, problem, &solution.u, &solution.flux));
    let error = error.transpose()?.map_or(f64::NAN, |errors| errors.energy);
    Ok(Reference { bound: of_bound, error, energy: solution.energy(problem) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::extremes::grid::Grid;
    use crate::extremes::solution::Solution as Exact;
    use signorini_scene::mesh::structured::Cells;

    /// The bound of a jump whose scene is changed holds, and is near where it has to be.
    fn check(k: f64, is_near: bool, change: impl Fn(&str) -> String) -> Result<()> {
        let grid = Grid { n: 12, cells: Cells::Triangles, shape: Shape::Square };
        let posed = Posed::new(Exact::Jump(k), grid);
        let scene = Scene::parse(&change(&posed.scene()), Path::new("jump.toml"))?;
        let problem = Problem::new(&scene, posed.mesh())?;
        let solution = solve_directly(&problem)?;
        let exact = problem.scene.exact.as_ref().expect("an exact solution");
        let found = distance(exact, &problem, &solution.certified.admissible())?;
        let (total, combined) = (solution.bound.expect("a bound").total, found.combined);
        println!("k = {k:e}: total {total:.5e}, combined {combined:.5e}");
        assert!(total >= combined, "k = {k:e}: {total} {combined}");
        assert!(total <= 1.01 * combined || !is_near, "k = {k:e}: {total} {combined}");
        Ok(())
    }

    /// On the stiff side u is small and its energy is not: u_D there counts by its energy.
    #[test]
    fn a_high_contrast_keeps_the_data_of_its_stiff_side() -> Result<()> {
        for k in [1e9, 7e9, 1e10, 1e12] {
            // Rounding is half of it where the contrast is 1e12.
            check(k, k <= 1e10, str::to_owned)?;
        }
        Ok(())
    }

    /// cos αθ, which is small where both halves meet, as a difference of numbers near 1: u_D at (0, 1) is 10⁻¹⁶ off what its
    /// left side tends to, and A∇s is 10⁴ there.
    #[test]
    fn two_branches_that_differ_by_rounding_cancel_nothing() -> Result<()> {
        for k in [1e8_f64, 3e8, 1e9] {
            let less = 2.0 / std::f64::consts::PI * (1.0 / k.sqrt()).atan();
            let plain = |text: &str| {
                let on_right = format!("(x*cos({less:e}*atan2(y,x)) - y*sin({less:e}*atan2(y,x)))");
                let alpha = format!("{:e}", 1.0 + less);
                assert!(text.contains(&on_right), "{text}");
                text.replace(&on_right, &format!("(sqrt(x^2 + y^2)*cos({alpha}*atan2(y,x)))"))
            };
            check(k, true, plain)?;
        }
        Ok(())
    }
}
