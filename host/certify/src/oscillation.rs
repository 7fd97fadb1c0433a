//! Data oscillation: what the bound's τ cannot see, since it meets f, g and q in their means only.
//!
//! With τ such that ∇·τ + f̄ = 0 and τ·n = ḡ, the bound misses ∫(s − u)(f − f̄) and ∫_N (s − u)(g − ḡ).
//! f − f̄ and g − ḡ have no mean, so that Poincaré's inequality on a convex cell and its trace version
//! on the triangle K of an edge and the opposite vertex (the middle of a quad) bound them by the
//! energy of s − u:
//! ```text
//!   osc_T  = (h_T/π) ‖f − f̄‖_T / √α_T
//!   osc_E² = (|E| h_K²/|K|)(1/π² + 1/π) ‖g − ḡ‖²_E / α_T
//! ```
//! with the diameters h and the smallest eigenvalue α_T of A on T. q counts like g; of u_ext what 8 points do not see
//! ([`super::robin`]). Where a cell is stretched, or A is, fluxes inside it bound both closer (`stretched`).

mod edges;
mod parts;
mod rules;
mod stretched;
#[cfg(test)]
mod tests;

use std::f64::consts::PI;

use super::cell::Cell;
use super::conductivity::Conductivity;
use super::robin::missed;
use super::stretch::is_even;
pub use edges::off_mean;
use edges::{of_flux, pole_on_edge};
use parts::square;
use rules::{ELLIPSES, LEFT, POINTS, RESOLVED, differences};
use signorini_problem::quadrature::enclosed::{self, Integral, pole};
use signorini_problem::quadrature::gauss;
use signorini_problem::quadrature::refined::refined;
use signorini_problem::threads::in_portions;
use signorini_problem::{EdgeKind, Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::expression::enclosure::{Form, Region, Shape};
use signorini_scene::scene::Field;
use stretched::Inside;

/// Most parts in search of it: in all, and for each cell that the rule does not resolve.
const MOST: usize = 20_000;
const EACH: usize = 4;

/// The parts of f, g, q and u_ext that their means leave out.
#[derive(Debug, Clone, Default)]
pub struct Oscillation {
    /// osc_T + Σ osc_E over the sides of each cell, triangles first, in the unit of ‖A^½∇u‖. That of the whole is the root of the sum of the squares.
    pub of_cells: Vec<f64>,
    /// The part of each that was enclosed and not resolved.
    pub unresolved: Vec<f64>,
    /// Where f, flux or limit is not square integrable, or not proved to be: what, the point, and whether it is proved.
    pub pole: Option<(Field, [f64; 2], bool)>,
}

/// The oscillation of the data of `problem` at its time.
///
/// # Errors
/// Data that are not finite.
pub fn oscillation(problem: &Problem) -> Result<Oscillation> {
    with_source(problem, of_source(problem)?)
}

/// That of f alone, and the fluxes inside the cells.
pub type OfSource = (Oscillation, Vec<Option<Inside>>);

/// The oscillation of the data with that of f.
///
/// # Errors
/// Data that are not finite.
pub fn with_source(problem: &Problem, (mut all, inside): OfSource) -> Result<Oscillation> {
    let mut through_sides = stretched::through_sides(problem, &all.of_cells, &inside);
    for edge in 0..problem.kinds.len() {
        let (at, _) = problem.topology.first_side(edge);
        let [known, missed] = match problem.kinds[edge] {
            EdgeKind::Neumann | EdgeKind::Contact => of_flux(problem, edge)?,
            EdgeKind::Robin => missed(problem, edge)?,
            EdgeKind::Interior | EdgeKind::Dirichlet => [0.0; 2],
        };
        all.of_cells[at] += known + missed;
        all.unresolved[at] += missed;
        through_sides.get_mut(at).into_iter().for_each(|osc| *osc += known + missed);
        if !missed.is_finite() && all.pole.is_none() {
            all.pole = pole_on_edge(problem, edge);
        }
    }
    // Fluxes through sides are there in all cells, or in none.
    let square = |cells: &[f64]| cells.iter().map(|osc| osc * osc).sum::<f64>();
    if !through_sides.is_empty() && square(&through_sides) < square(&all.of_cells) {
        all.of_cells = through_sides;
    }
    Ok(all)
}

/// osc_T of every cell, from what is left of f − f̄, with the flux inside where the cell is stretched and f is resolved.
///
/// # Errors
/// Data that are not finite.
pub fn of_source(problem: &Problem) -> Result<OfSource> {
    let f = Sum::source(&problem.scene, problem.time);
    let cells = problem.cells();
    let mut all =
        Oscillation { of_cells: vec![0.0; cells], unresolved: vec![0.0; cells], pole: None };
    let mut inside = Vec::new();
    if f.is_zero() {
        return Ok((all, inside));
    }
    let weights = in_portions(cells, |portion| {
        Ok(portion
            .map(|at| {
                let alpha = Conductivity::of(problem, at).alpha();
                Cell::of(problem, at).diameter() / PI / alpha.sqrt()
            })
            .collect::<Vec<_>>())
    })?;
    let weights = weights.concat();
    for (at, square) in squares(problem, &f, &weights)?.into_iter().enumerate() {
        let root = |square: f64| weights[at] * square.sqrt();
        all.of_cells[at] = root(square.value + square.missed);
        all.unresolved[at] = all.of_cells[at] - root(square.value);
        let is_fitted = square.missed == 0.0 && square.value != 0.0 && !is_even(problem, at);
        let flux = is_fitted.then(|| stretched::in_cell(problem, at, &f));
        if let Some((balanced, _)) = &flux {
            all.of_cells[at] = all.of_cells[at].min(*balanced);
        }
        inside.push(flux.map(|(_, inside)| inside));
        if !square.missed.is_finite() && all.pole.is_none() {
            let found = pole(&f, &enclosed::region(Cell::of(problem, at)), 2.0);
            all.pole = found.map(|(at, is_proved)| (Field::Source, at, is_proved));
        }
    }
    Ok((all, inside))
}

/// ‖f − f̄‖² of every cell: by the rule where it is resolved, else on parts where f is enclosed, those first that weigh most.
fn squares(problem: &Problem, f: &Sum, weights: &[f64]) -> Result<Vec<Integral>> {
    let portions = in_portions(problem.cells(), |cells| {
        cells.map(|at| of_rule(problem, at, f)).collect::<Result<Vec<_>>>()
    })?;
    let (mut squares, is_resolved): (Vec<_>, Vec<_>) = portions.into_iter().flatten().unzip();
    let open: Vec<usize> = (0..squares.len()).filter(|&at| !is_resolved[at]).collect();
    let deviation = |of: usize, region: &Region| {
        let (at, weight) = (open[of], weights[open[of]].powi(2));
        deviation(problem, at, f, region).map(|square| weight * square)
    };
    let regions = open.iter().map(|&at| enclosed::region(Cell::of(problem, at)));
    let all = squares.iter().zip(weights);
    let known: f64 = all.map(|(of, weight)| of.value * weight * weight).sum();
    let is_enough = |size: f64, missed: f64| missed <= LEFT * size.max(known);
    let parts = refined(
        |region| f.cut(region),
        regions.enumerate(),
        MOST + EACH * open.len(),
        is_enough,
        deviation,
    );
    let mut sums = vec![Integral { value: 0.0, missed: 0.0 }; open.len()];
    for part in parts {
        let (sum, weight) = (&mut sums[part.of], weights[open[part.of]].powi(2));
        sum.value += part.value / weight;
        sum.missed += part.missed / weight;
    }
    for (&at, sum) in open.iter().zip(sums) {
        squares[at] = sum.unless(squares[at].value, RESOLVED * squares[at].value);
    }
    Ok(squares)
}

/// ‖f − f̄‖² of a cell by the rule, and whether that is resolved: f is constant, a polynomial, or analytic far enough around.
fn of_rule(problem: &Problem, at: usize, f: &Sum) -> Result<(Integral, bool)> {
    let cell = Cell::of(problem, at);
    if let (Some(f), true) = (f.constant(), cell.is_affine()) {
        return Ok((Integral { value: of_bend(&cell, f), missed: 0.0 }, true));
    }
    let load = problem.loads.of_cell(at);
    let (unit, differences) = differences(&cell, f, load);
    let squares = differences.iter().map(|(point, of)| point.weight / unit / unit * of.powi(2));
    let square: f64 = squares.sum();
    let value = f.finite(square, cell.corners()[0])?;
    Ok((Integral { value, missed: 0.0 }, is_resolved(f, &cell, load, value)))
}

/// Whether the rule misses of ‖f − f̄‖² no more than rounding does.
fn is_resolved(f: &Sum, cell: &Cell, load: f64, square: f64) -> bool {
    if cell.is_affine() && f.degree() < POINTS as f64 {
        return true;
    }
    let region = enclosed::region(*cell);
    let tolerance = RESOLVED * square;
    ELLIPSES.into_iter().any(|rho| {
        let density = region.least_density(rho);
        let mean = load.abs() / region.measure() / density;
        let most = f.modulus(&region, rho) + mean;
        density > 0.0 && region.missed(POINTS, rho, most * most) <= tolerance
    })
}

/// ∫(f − f̄)² over a part of cell `at`, and what is missed of it.
fn deviation(problem: &Problem, at: usize, f: &Sum, part: &Region) -> [f64; 2] {
    let cell = enclosed::region(Cell::of(problem, at));
    let load = Form::constant(part.shape(), problem.loads.of_cell(at));
    let mean = match part.shape() {
        // f̄ = load/det DF, of which the part's own is a power of ½.
        Shape::Quad => {
            let share = (part.measure() / cell.measure()).log2().round().exp2();
            load.over(&part.density()).scaled(share)
        }
        _ => load.scaled(1.0 / cell.measure()),
    };
    square(f, part, &mean)
}

/// ‖f − f̄‖² of a constant f on a quad that only rounding distorts: det DF leaves its mean |T| by at most 2 h_T times the
/// distortion, and f − f̄ is f times that over |T|.
fn of_bend(cell: &Cell, f: f64) -> f64 {
    let distortion = cell.distortion();
    if distortion == 0.0 || f == 0.0 {
        return 0.0;
    }
    let area: f64 = cell.points(&gauss(1)).iter().map(|point| point.weight).sum();
    let difference = f.abs() * (2.0 * cell.diameter() / area.sqrt()) * (distortion / area.sqrt());
    difference.powi(2) * area
}
