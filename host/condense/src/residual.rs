//! The residual A^½∇s − A^{−½}τ cell by cell, as rows over what s and τ are made of.
//!
//! With A = LLᵀ at a quadrature point of weight w, |√w (Lᵀ∇s − L⁻¹τ)|² is its share of
//! ‖A^½∇s − A^{−½}τ‖², and on a Robin edge |√(w|E|h) (s − u_ext) + √(w/(|E|h)) ∫_E τ·n|² that of
//! ∫_R (τ·n + h(s − u_ext))²/h. Of a cell's many rows only their triangular factor matters, at most one
//! row for each of its functions: three on triangles where A is constant, whatever the rule. With A^½∇u_h of means in the
//! place of A^{−½}τ the same rows give ‖A^½∇_h(s − u_h)‖.

use std::collections::BTreeSet;

use super::block::{Block, Functions};
use super::chain::is_left_out;
use super::laws::{Laws, of_law, of_robin, points_of, transfer};
use signorini_certify::TermData;
use signorini_certify::cell::{Cell, Local};
use signorini_certify::conductivity::Conductivity;
use signorini_certify::curved::{FINE, POINTS, between_smooth_rays, of_rough_sides};
use signorini_certify::deviation::Deviations;
use signorini_problem::Problem;
use signorini_problem::field::CellField;
use signorini_problem::pieces::{PiecePoint, Root};
use signorini_problem::quadrature::{DATA_POINTS, Point, gauss, on_panels};
use signorini_problem::triangular::triangular;
use signorini_scene::error::Result;

/// The rows of all cells and Robin edges.
///
/// # Errors
/// Data that are not finite.
pub(super) fn blocks(
    problem: &Problem,
    patterns: &[TermData],
    functions: &Functions,
    laws: Option<&Laws>,
    released: &BTreeSet<u32>,
) -> Result<Vec<Block>> {
    let deviations = deviations(problem, patterns, released)?;
    let of_fluxes = |at| of_cell(problem, at, functions, &deviations, Of::Fluxes);
    let cells = (0..problem.cells()).map(of_fluxes);
    let mut blocks = cells.collect::<Result<Vec<_>>>()?;
    let transfer = transfer(patterns)?;
    for (at, record) in problem.loads.robin.iter().enumerate() {
        let ambient: Vec<_> = transfer.iter().map(|edges| edges[at]).collect();
        let edge = record.edge as usize;
        blocks.push(match laws.is_some_and(|laws| laws.shares[at] > 0.0) {
            true => of_law(problem, edge, functions, &ambient, record.coefficient),
            false => of_robin(problem, edge, functions, &points_of(patterns, edge, &ambient)?),
        });
    }
    Ok(blocks)
}

/// The rows of A^½∇_h(s − u_h), with the means of u_h over the edges in the place of fluxes. Nothing on triangles with
/// constant A: σ_h = A∇u_h − f̄(x − x_T)/2 there, and the two parts are orthogonal to each other in every cell, so that
/// A^½∇s − A^{−½}σ_h is never less. A lift of s in cells where f is not 0 may not be orthogonal to the second.
///
/// # Errors
/// Data that are not finite.
pub(super) fn jumps(
    problem: &Problem,
    patterns: &[TermData],
    functions: &Functions,
    released: &BTreeSet<u32>,
) -> Result<Option<Vec<Block>>> {
    let is_lifted = deviations(problem, patterns, released)?.iter().any(|of| !of.found.is_empty());
    let has_source = patterns.iter().any(|p| p.loads().triangles.iter().any(|&load| load != 0.0));
    let is_constant = |at| Conductivity::of(problem, at).is_constant();
    let is_plain = problem.mesh.quads.is_empty() && (0..problem.cells()).all(is_constant);
    if is_plain && !(is_lifted && has_source) {
        return Ok(None);
    }
    of_means(problem, patterns, functions, released).map(Some)
}

/// Those rows of all cells.
///
/// # Errors
/// Data that are not finite.
pub(super) fn of_means(
    problem: &Problem,
    patterns: &[TermData],
    functions: &Functions,
    released: &BTreeSet<u32>,
) -> Result<Vec<Block>> {
    let deviations = deviations(problem, patterns, released)?;
    let of_cell = |at| of_cell(problem, at, functions, &deviations, Of::Means);
    (0..problem.cells()).map(of_cell).collect()
}

/// Deviations of each pattern's data from their chords that s follows: none between vertices that are released.
fn deviations<'p>(
    problem: &Problem,
    patterns: &'p [TermData],
    released: &BTreeSet<u32>,
) -> Result<Vec<Deviations<'p>>> {
    let followed = |pattern: &'p TermData| {
        let mut deviations = Deviations::at_time(&pattern.problem, 0.0)?;
        deviations.found.retain(|of| !is_left_out(problem.ends[of.edge], released));
        Ok(deviations)
    };
    patterns.iter().map(followed).collect()
}

/// Field subtracted from A^½∇s: A^{−½}τ of fluxes, or A^½∇u_h of means.
#[derive(Debug, Clone, Copy)]
enum Of {
    Fluxes,
    Means,
}

/// A column's part at a point.
enum Entry {
    Gradient([f64; 2]),
    Flux([f64; 2]),
}

impl Entry {
    /// Rows at a point, and those of what A has above what it is taken for: with m the part of either that is `left` open,
    /// ```text
    ///   ‖A^{−½}(τ − A∇s)‖² ≤ (1 + m) ‖p^{−½}(τ − p∇s)‖² + (1 + 1/m) ‖N′^½∇s‖²,   ‖A^½∇(s − u_h)‖² ≤ ‖p^½·‖² + ‖N^½·‖²
    /// ```
    fn rows(&self, at: &PiecePoint, of: Of, [slack, left]: [f64; 2]) -> Vec<f64> {
        let weight = at.point.weight.sqrt() * (1.0 + slack);
        let (seen, open) = match of {
            _ if left == 0.0 => (weight, 0.0),
            Of::Fluxes => {
                (weight * (1.0 + left).sqrt(), weight * (at.share * (1.0 + 1.0 / left)).sqrt())
            }
            Of::Means => (weight, weight),
        };
        let root = Root::of(&at.below, seen);
        let (known, v) = match *self {
            Self::Gradient(v) => (root.gradient(v), v),
            Self::Flux(tau) => (root.flux(tau), [0.0; 2]),
        };
        let beyond = Root::of(&at.above, open).gradient(v);
        if left == 0.0 { known.to_vec() } else { [known, beyond].concat() }
    }
}

fn of_cell(
    problem: &Problem,
    at: usize,
    functions: &Functions,
    deviations: &[Deviations],
    of: Of,
) -> Result<Block> {
    let (mesh, topology) = (&problem.mesh, &problem.topology);
    let quad = at.checked_sub(mesh.triangles.len());
    let (vertices, edges): (&[u32], &[u32]) = match quad {
        None => (&mesh.triangles[at], &topology.of_triangles[at]),
        Some(quad) => (&mesh.quads[quad], &topology.of_quads[quad]),
    };
    let bubbles: Vec<(usize, u32)> = edges
        .iter()
        .enumerate()
        .filter(|_| quad.is_some())
        .filter_map(|(side, &edge)| Some((side, functions.bubble(edge as usize)?)))
        .collect();
    let on_side = |side: usize| deviations.iter().map(move |all| all.on(edges[side] as usize));
    let curved: Vec<usize> =
        (0..edges.len()).filter(|&side| on_side(side).any(|of| of.is_some())).collect();
    let (cell, conductivity) = (Cell::of(problem, at), Conductivity::of(problem, at));
    let fields = unit_fields(problem, at, edges);
    let width = vertices.len() + bubbles.len() + fields.len() + deviations.len();
    let mut columns = vec![Vec::new(); width];
    let rough = of_rough_sides(problem, at, deviations, &gauss(POINTS))?;
    let smooth = || points(&cell, points_for(&cell, &conductivity), &curved);
    let seen = |(reference, weight): ([f64; 3], f64)| {
        let local = cell.local(reference);
        conductivity.resolved(Point { x: local.x, reference, weight: weight * local.determinant })
    };
    let points: Vec<_> = match (conductivity.cut(), conductivity.cut_for_curves()) {
        (Some(pieces), _) if curved.is_empty() => pieces.points(cell).collect(),
        (_, Some(pieces)) => pieces.many_points(cell).collect(),
        _ => rough.unwrap_or_else(smooth).into_iter().map(seen).collect(),
    };
    let missed = conductivity.missed(cell);
    for at in points {
        let (point, local) = (at.point, cell.local(at.point.reference));
        let vertices =
            local.vertices[..vertices.len()].iter().map(|of| Entry::Gradient(of.gradient));
        let bubbles = bubbles.iter().map(|&(side, _)| local.sides[side].bubble().gradient);
        let fields = fields.iter().map(|field| {
            let sample = field.sample(&point);
            match of {
                Of::Fluxes => Entry::Flux(sample.flux.map(|x| -x)),
                Of::Means => Entry::Gradient(sample.gradient.map(|x| -x)),
            }
        });
        let mut entries: Vec<_> =
            vertices.chain(bubbles.map(Entry::Gradient)).chain(fields).collect();
        for of_pattern in deviations {
            entries.push(Entry::Gradient(extension(&local, of_pattern, edges, &curved)?));
        }
        for (column, entry) in columns.iter_mut().zip(entries) {
            column.extend(entry.rows(&at, of, missed));
        }
    }
    let bubbles = bubbles.iter().map(|&(_, function)| function);
    Ok(Block {
        functions: vertices.iter().copied().chain(bubbles).collect(),
        edges: edges.to_vec(),
        rows: triangular(columns),
    })
}

/// For each edge the field of a unit flux along its direction and a unit mean over it.
fn unit_fields(problem: &Problem, at: usize, edges: &[u32]) -> Vec<CellField> {
    let cell = Cell::of(problem, at);
    let outward = |side: usize| {
        let first = problem.topology.first_side(edges[side] as usize) == (at, side);
        if first { 1.0 } else { -1.0 }
    };
    let only = |side: usize, k: usize| if k == side { outward(side) } else { 0.0 };
    let unit = |side: usize| match cell {
        Cell::Triangle(corners) => {
            let out = std::array::from_fn(|k| only(side, k));
            CellField::Triangle(corners, mean(side), out)
        }
        Cell::Quad(corners) => {
            let out = std::array::from_fn(|k| only(side, k));
            CellField::Quad(corners, mean(side), out, problem.element)
        }
    };
    (0..edges.len()).map(unit).collect()
}

fn mean<const SIDES: usize>(side: usize) -> [f64; SIDES] {
    std::array::from_fn(|k| if k == side { 1.0 } else { 0.0 })
}

/// ∇ of what a pattern's boundary data have above their chords, carried inside.
fn extension(
    local: &Local,
    deviations: &Deviations,
    edges: &[u32],
    curved: &[usize],
) -> Result<[f64; 2]> {
    let mut sum = [0.0; 2];
    for &side in curved {
        let Some(deviation) = deviations.on(edges[side] as usize) else { continue };
        let coordinates = &local.sides[side];
        let [w, slope] = deviation.at(coordinates.t)?;
        let gradient = coordinates.extension(w, slope).gradient;
        sum = [sum[0] + gradient[0], sum[1] + gradient[1]];
    }
    Ok(sum)
}

/// Points a direction that a cell needs where its boundary data are affine; gradients of bubbles are
/// of degree 2.
fn points_for(cell: &Cell, conductivity: &Conductivity) -> usize {
    match cell {
        Cell::Triangle(_) if conductivity.is_constant() => 2,
        Cell::Quad(_) if conductivity.is_constant() && cell.is_affine() => 3,
        _ => DATA_POINTS,
    }
}

/// Reference coordinates with weights that lack the area element, with `rule` points a direction or,
/// where sides are `curved`, those that integrate what the sides carry inside.
pub(super) fn points(cell: &Cell, rule: usize, curved: &[usize]) -> Vec<([f64; 3], f64)> {
    let along = on_panels(FINE, &gauss(POINTS));
    match (cell, curved) {
        (Cell::Triangle(_), []) => on_triangle(cell, 0, &gauss(rule), &gauss(rule)),
        (Cell::Triangle(_), [side]) => on_triangle(cell, *side, &along, &gauss(POINTS)),
        (Cell::Triangle(_), [one, other, ..]) => between_smooth_rays([*one, *other]),
        (Cell::Quad(_), _) => {
            // Sides 0 and 2 run along x̂, 1 and 3 along ŷ.
            let axis = |parity: usize| match curved.iter().any(|side| side % 2 == parity) {
                true => along.clone(),
                false if curved.is_empty() => gauss(rule),
                false => gauss(POINTS),
            };
            square(&axis(0), &axis(1))
        }
    }
}

/// The points (t, η) of one side of a triangle.
fn on_triangle(
    cell: &Cell,
    side: usize,
    along: &[[f64; 2]],
    away: &[[f64; 2]],
) -> Vec<([f64; 3], f64)> {
    let point = |[t, weight]: [f64; 2], [eta, weight_away]: [f64; 2]| {
        (cell.side_point(side, t, eta), weight * weight_away * (1.0 - eta))
    };
    along.iter().flat_map(|&along| away.iter().map(move |&away| point(along, away))).collect()
}

fn square(along_x: &[[f64; 2]], along_y: &[[f64; 2]]) -> Vec<([f64; 3], f64)> {
    let point = |[x, wx]: [f64; 2], [y, wy]: [f64; 2]| ([x, y, 0.0], wx * wy);
    along_y.iter().flat_map(|&y| along_x.iter().map(move |&x| point(x, y))).collect()
}
