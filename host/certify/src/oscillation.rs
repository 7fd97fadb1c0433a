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
//! ([`super::robin`]). Where a cell is stretched, or A is, fluxes inside it bound both closer ([`super::stretched`]).

use std::f64::consts::PI;

use signorini_kernel::mesh::geometry::triangle_area;

use super::cell::Cell;
use super::conductivity::{Conductivity, smallest_eigenvalue};
use super::profile::NO_SIDES;
use super::robin::missed;
use super::stretch::is_even;
use super::stretched;
use signorini_problem::quadrature::enclosed::{self, Integral, pole};
use signorini_problem::quadrature::refined::{Part, refined};
use signorini_problem::quadrature::{Point, gauss, on_panels};
use signorini_problem::threads::in_portions;
use signorini_problem::{EdgeKind, Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::expression::enclosure::{Form, Interval, Region, Shape};
use signorini_scene::mesh::shape::edge_length;
use signorini_scene::scene::Field;

/// Gauss points a direction on a cell, and a panel on an edge.
pub(super) const POINTS: usize = 16;
/// Panels on an edge.
pub(super) const PANELS: u32 = 4;
/// Ellipses in which continuations are looked at.
pub(super) const ELLIPSES: [f64; 3] = [4.0, 2.0, 8.0];
/// Part of ‖f − f̄‖² up to which the rule is right.
const RESOLVED: f64 = 1e-13;
/// Part of Σ osc² that may be left on parts: 5 % of the oscillation.
const LEFT: f64 = 0.1;
/// Most parts in search of it: in all, for each cell that the rule does not resolve, and on an edge.
const MOST: usize = 20_000;
const EACH: usize = 4;
const MOST_OF_EDGE: usize = 200;

/// What the means of f, g, q and u_ext leave out.
#[derive(Debug, Clone, Default)]
pub struct Oscillation {
    /// osc_T + Σ osc_E over the sides of each cell, triangles first, in the unit of ‖A^½∇u‖. That of the whole is the root of the sum of the squares.
    pub of_cells: Vec<f64>,
    /// The part of each that was enclosed and not resolved.
    pub unresolved: Vec<f64>,
    /// Where f, flux or limit is not square integrable, or not proved to be: what, the point, and whether it is proved.
    pub pole: Option<(Field, [f64; 2], bool)>,
}

/// That of the data of `problem` at its time.
///
/// # Errors
/// Data that are not finite.
pub fn oscillation(problem: &Problem) -> Result<Oscillation> {
    let mut all = of_source(problem)?;
    let mut through_sides = stretched::through_sides(problem, &all)?;
    for edge in 0..problem.kinds.len() {
        let (at, _) = problem.topology.first_side(edge);
        let [known, missed] = match problem.kinds[edge] {
            EdgeKind::Neumann | EdgeKind::Contact => of_flux(problem, edge)?,
            EdgeKind::Robin => [missed(problem, edge, problem.time)?, 0.0],
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

/// Where a flux or a limit has no square integral on an edge.
fn pole_on_edge(problem: &Problem, edge: usize) -> Option<(Field, [f64; 2], bool)> {
    [Field::Flux, Field::Limit].into_iter().find_map(|field| {
        let data = Sum::on_edge(problem, edge, field, problem.time)?;
        let (at, is_proved) = pole(&data, &Region::segment(problem.segment(edge)), 2.0)?;
        Some((field, at, is_proved))
    })
}

/// osc_T of every cell, from what is left of f − f̄.
fn of_source(problem: &Problem) -> Result<Oscillation> {
    let f = Sum::source(&problem.scene, problem.time);
    let cells = problem.cells();
    let mut all =
        Oscillation { of_cells: vec![0.0; cells], unresolved: vec![0.0; cells], pole: None };
    if f.is_zero() {
        return Ok(all);
    }
    let weights = in_portions(cells, |portion| {
        Ok(portion
            .map(|at| Cell::of(problem, at).diameter() / PI / alpha(problem, at).sqrt())
            .collect::<Vec<_>>())
    })?;
    let weights = weights.concat();
    for (at, square) in squares(problem, &f, &weights)?.into_iter().enumerate() {
        let root = |square: f64| weights[at] * square.sqrt();
        all.of_cells[at] = root(square.value + square.missed);
        if square.missed == 0.0 && !is_even(problem, at) {
            let closed = stretched::closed(problem, at, &f, &NO_SIDES)?;
            all.of_cells[at] = all.of_cells[at].min(closed);
        }
        all.unresolved[at] = all.of_cells[at] - root(square.value);
        if !square.missed.is_finite() && all.pole.is_none() {
            let found = pole(&f, &enclosed::region(Cell::of(problem, at)), 2.0);
            all.pole = found.map(|(at, is_proved)| (Field::Source, at, is_proved));
        }
    }
    Ok(all)
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
    let whole = open.iter().enumerate().map(|(of, &at)| {
        let region = enclosed::region(Cell::of(problem, at));
        let [value, missed] = deviation(of, &region);
        Part { of, region, value, missed }
    });
    let all = squares.iter().zip(weights);
    let known: f64 = all.map(|(of, weight)| of.value * weight * weight).sum();
    let is_enough = |size: f64, missed: f64| missed <= LEFT * size.max(known);
    let parts = refined(f, whole.collect(), MOST + EACH * open.len(), is_enough, deviation);
    for &at in &open {
        squares[at] = Integral { value: 0.0, missed: 0.0 };
    }
    for part in parts {
        let (square, weight) = (&mut squares[open[part.of]], weights[open[part.of]].powi(2));
        square.value += part.value / weight;
        square.missed += part.missed / weight;
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
    let square: f64 = differences
        .iter()
        .map(|(point, difference)| point.weight / unit / unit * difference.powi(2))
        .sum();
    let value = f.finite(square, cell.corners()[0])?;
    Ok((Integral { value, missed: 0.0 }, is_resolved(f, &cell, load, value)))
}

/// f − f̄ at the points of the rule, times a unit: squares of f may vanish or overflow where lengths are huge or tiny, those of f times
/// a length do not.
pub(super) fn differences(cell: &Cell, f: &Sum, load: f64) -> (f64, Vec<(Point, f64)>) {
    let unit = cell.diameter().log2().round().exp2();
    let points = cell.points(&gauss(POINTS));
    let values = f.at_all(&points.iter().map(|point| point.x).collect::<Vec<_>>());
    let difference = |(point, value): (Point, f64)| {
        let mean = cell.spread(load, cell.local(point.reference).determinant);
        (point, unit * (value - mean))
    };
    (unit, points.into_iter().zip(values).map(difference).collect())
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
    let form = f.enclose(part);
    match form.range().is_finite() {
        true => part.square(&form.combined(1.0, &mean, -1.0)),
        false => unbounded(f, part, mean.range()),
    }
}

/// ∫(f − m)² = ∫f² − 2m∫f + m²|T| over a part where f is not bounded, as it grows, for any m in `mean`.
fn unbounded(f: &Sum, part: &Region, mean: Interval) -> [f64; 2] {
    let Some(growth) = f.growth(part) else { return [0.0, f64::INFINITY] };
    let [integral, square] = [1.0, 2.0].map(|k| part.grown(&growth, k));
    if !square.high.is_finite() {
        return [0.0, f64::INFINITY];
    }
    let signed =
        if growth.sign == 0.0 { Interval::around(integral.high) } else { growth.sign * integral };
    let rest = mean.square() * Interval::point(part.measure()) - 2.0 * (mean * signed);
    let whole = square + rest;
    [whole.middle().max(0.0), 0.5 * whole.width()]
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

/// osc_E, and what may be missed of it; g and q are both the `flux` of their boundary. Between two finite ends τ·n = lo + θ (hi − lo) all
/// along the edge, where θ is that of its mean. What the mean leaves out of it, (1 − θ) that of lo and θ that of hi, is at most the larger
/// one of both.
fn of_flux(problem: &Problem, edge: usize) -> Result<[f64; 2]> {
    let least = of_end(problem, edge, Field::Flux)?;
    let most = of_end(problem, edge, Field::Limit)?;
    Ok(if least.iter().sum::<f64>() > most.iter().sum() { least } else { most })
}

fn of_end(problem: &Problem, edge: usize, field: Field) -> Result<[f64; 2]> {
    let Some(g) = Sum::on_edge(problem, edge, field, problem.time) else { return Ok([0.0; 2]) };
    if g.constant().is_some() {
        return Ok([0.0; 2]);
    }
    let segment @ [a, b] = problem.segment(edge);
    let (length, mean) = (problem.lengths[edge], g.mean_and_missed(segment)?);
    let square = length_square(&g, segment, length, mean)?;
    let (at, side) = problem.topology.first_side(edge);
    let apex = opposite(&Cell::of(problem, at), side);
    let diameter = length.max(edge_length([a, apex])).max(edge_length([b, apex]));
    let shape = length * diameter * diameter / triangle_area([a, b, apex]);
    let trace = 1.0 / (PI * PI) + 1.0 / PI;
    let by_trace = |square: f64| (shape * trace * square / alpha(problem, at)).sqrt();
    let known = by_trace(square.value);
    if square.missed == 0.0 && !is_even(problem, at) {
        return Ok([known.min(stretched::along_edge(problem, edge, &g, mean.value, by_trace)), 0.0]);
    }
    Ok([known, by_trace(square.value + square.missed) - known])
}

/// ‖g − ḡ‖² on an edge. What is missed of the mean counts with it.
fn length_square(g: &Sum, segment: [[f64; 2]; 2], length: f64, mean: Integral) -> Result<Integral> {
    let [a, b] = segment;
    let difference = |t: f64| g.at(a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])) - mean.value;
    let rule = on_panels(PANELS, &gauss(POINTS));
    let square: f64 = rule.iter().map(|[t, weight]| weight * difference(*t).powi(2)).sum();
    let square = length * g.finite(square, a)?;
    let region = Region::segment(segment);
    let is_resolved = g.degree() < POINTS as f64
        || ELLIPSES.into_iter().any(|rho| {
            let most = g.modulus(&region, rho) + mean.value.abs();
            region.missed(POINTS, rho, most * most) <= RESOLVED * square
        });
    if is_resolved {
        return Ok(Integral { value: square, missed: 0.0 });
    }
    let integral = |_: usize, part: &Region| {
        let form = g.enclose(part);
        match form.range().is_finite() {
            true => part.square(&form.shifted(-mean.value)),
            false => unbounded(g, part, Interval::point(mean.value)),
        }
    };
    let [value, missed] = integral(0, &region);
    let whole = vec![Part { of: 0, region, value, missed }];
    let parts = refined(g, whole, MOST_OF_EDGE, |size, missed| missed <= LEFT * size, integral);
    let [value, missed] = parts
        .iter()
        .fold([0.0; 2], |[value, missed], part| [value + part.value, missed + part.missed]);
    Ok(Integral { value, missed: missed + length * mean.missed.powi(2) })
}

/// The vertex opposite of a triangle's side, the middle of a quad.
fn opposite(cell: &Cell, side: usize) -> [f64; 2] {
    match cell {
        Cell::Triangle(corners) => corners[(side + 2) % 3],
        Cell::Quad([a, b, c, d]) => [0, 1].map(|k| 0.25 * (a[k] + b[k] + c[k] + d[k])),
    }
}

/// The smallest eigenvalue of A on a cell; where A varies, of A at the quadrature points.
pub fn alpha(problem: &Problem, at: usize) -> f64 {
    let (cell, a) = (Cell::of(problem, at), Conductivity::of(problem, at));
    if a.is_constant() {
        return smallest_eigenvalue(&a.at(cell.corners()[0]));
    }
    let points = cell.points(&gauss(POINTS)).into_iter();
    points.map(|point| smallest_eigenvalue(&a.at(point.x))).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_problem::fixtures::{self, PARABOLA, SMOOTH};
    use signorini_scene::mesh::structured::{Cells, grid};
    use signorini_tolerances::solve::OSCILLATION;

    /// Eigenvalues of [2, ½; ½, 1] are (3 ± √2)/2.
    fn smallest() -> f64 {
        0.5 * (3.0 - 2.0_f64.sqrt())
    }

    #[test]
    fn linear_data_on_triangles_in_closed_form() -> Result<()> {
        let (_, problem) =
            fixtures::on_grid(SMOOTH, fixtures::distorted(grid(3, Cells::Triangles)))?;
        let found = oscillation(&problem)?.of_cells;
        for (at, vertices) in problem.mesh.triangles.iter().enumerate() {
            let corners = vertices.map(|vertex| problem.mesh.vertices[vertex as usize]);
            // ∫λ_iλ_j = |T|/12 (1 + δ_ij): ‖f − f̄‖² = |T|/12 Σ (f_i − f̄)².
            let values = corners.map(|[x, y]| -(4.0 * y + 14.0 * x + 2.0));
            let mean = values.iter().sum::<f64>() / 3.0;
            let spread: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
            let square = triangle_area(corners) / 12.0 * spread;
            let diameter = (0..3).map(|k| edge_length([corners[k], corners[(k + 1) % 3]]));
            let diameter = diameter.fold(0.0, f64::max);
            let mut expected = diameter / PI * (square / smallest()).sqrt();
            for &edge in &problem.topology.of_triangles[at] {
                let (edge, length) = (edge as usize, problem.lengths[edge as usize]);
                // 1e−10 of it: u_ext is rational. Its own test is in `robin`.
                expected += missed(&problem, edge, 0.0)?;
                let [[x0, y0], [x1, y1]] = problem.segment(edge);
                // ‖g − ḡ‖² of a linear g is |E|/12 times its rise squared; of q = −3.5x² − 1 with the
                // middle m, ∫ = |E| 3.5² (m² l²/3 + l⁴/180).
                let square = match problem.kinds[edge] {
                    EdgeKind::Neumann => length / 12.0 * (5.0 * (y1 - y0)).powi(2),
                    EdgeKind::Contact => {
                        let (middle, l) = (0.5 * (x0 + x1), x1 - x0);
                        let square = middle.powi(2) * l.powi(2) / 3.0 + l.powi(4) / 180.0;
                        length * 3.5_f64.powi(2) * square
                    }
                    _ => 0.0,
                };
                let shape = length * diameter * diameter / triangle_area(corners);
                let trace = 1.0 / (PI * PI) + 1.0 / PI;
                expected += (shape * trace * square / smallest()).sqrt();
            }
            OSCILLATION.check_over(format_args!("cell {at}"), found[at] - expected, expected);
        }
        Ok(())
    }

    /// Of ‖f − f̄‖ in closed form: narrow, kinked, jumping data, which no rule on the whole cell sees.
    #[test]
    fn oscillations_hold_what_no_rule_sees() -> Result<()> {
        let gaussian = |width: f64| {
            let text = format!("exp(-((x - 0.31)^2 + (y - 0.43)^2)/{width}^2)");
            (text, PI / 2.0 * width * width, PI * width * width)
        };
        let cases = [
            gaussian(0.05),
            gaussian(0.002),
            ("sign(3*x + 2*y - 1.7)".to_owned(), 2.0, f64::NAN),
            ("max(0, 1 - abs(x - 0.3)/0.001)".to_owned(), 2e-3 / 3.0, 1e-3),
            ("sin(40*x)".to_owned(), 1.0 - 80.0_f64.sin() / 80.0, 0.0),
        ];
        for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
            for (text, square, integral) in &cases {
                let scene = PARABOLA.replace("f = \"0\"", &format!("f = \"{text}\""));
                let (_, problem) = fixtures::on_grid(&scene, grid(2, cells))?;
                let load = |at: usize| problem.loads.of_cell(at);
                let sum: f64 = (0..problem.cells()).map(load).sum();
                let slack = problem.loads.missed + 1e-12;
                assert!(integral.is_nan() || (sum - integral).abs() <= slack, "{text}: {sum}");
                // ‖f‖² = Σ‖f − f̄‖² + Σ|T|f̄²
                let means: f64 = (0..problem.cells())
                    .map(|at| load(at).powi(2) / enclosed::region(Cell::of(&problem, at)).measure())
                    .sum();
                let exact = square - means;
                let f = Sum::source(&problem.scene, 0.0);
                let found = squares(&problem, &f, &vec![1.0; problem.cells()])?;
                let [value, missed] = found
                    .iter()
                    .fold([0.0; 2], |[value, missed], of| [value + of.value, missed + of.missed]);
                assert!(
                    (value - exact).abs() <= missed + 1e-12,
                    "{text}: {value} ± {missed}, {exact}"
                );
                assert!(
                    missed <= 0.11 * exact && slack < 1e-5,
                    "{text}: {missed} of {exact}, {slack}"
                );
            }
        }
        Ok(())
    }

    #[test]
    fn constant_data_oscillate_only_where_the_area_element_does() -> Result<()> {
        let constant = PARABOLA.replace("f = \"0\"", "f = \"3\"");
        for cells in [Cells::Triangles, Cells::Quads] {
            let (_, problem) = fixtures::on_grid(&constant, grid(3, cells))?;
            assert!(oscillation(&problem)?.of_cells.iter().all(|&cell| cell == 0.0));
        }
        let mesh = fixtures::distorted(grid(3, Cells::Quads));
        let (_, problem) = fixtures::on_grid(&constant, mesh.clone())?;
        assert!(oscillation(&problem)?.of_cells.iter().any(|&cell| cell > 1e-3));
        let (_, problem) = fixtures::on_grid(PARABOLA, mesh)?;
        assert!(oscillation(&problem)?.of_cells.iter().all(|&cell| cell == 0.0));
        Ok(())
    }

    #[test]
    fn linear_source_on_a_square() -> Result<()> {
        // f = x on squares of side h: ‖f − f̄‖² = h⁴/12, diameter √2 h, A = I.
        let linear = PARABOLA.replace("f = \"0\"", "f = \"x\"");
        let (_, problem) = fixtures::on_grid(&linear, grid(4, Cells::Quads))?;
        let expected = 2.0_f64.sqrt() * 0.25 / PI * (0.25_f64.powi(4) / 12.0).sqrt();
        for cell in oscillation(&problem)?.of_cells {
            OSCILLATION.check("a cell", cell - expected);
        }
        Ok(())
    }
}
