//! The residual A^½∇s − A^{−½}τ cell by cell, as rows over what s and τ are made of.
//!
//! With A = LLᵀ at a quadrature point of weight w, |√w (Lᵀ∇s − L⁻¹τ)|² is its share of
//! ‖A^½∇s − A^{−½}τ‖², and on a Robin edge |√(w|E|h) (s − u_ext) + √(w/(|E|h)) ∫_E τ·n|² that of
//! ∫_R (τ·n + h(s − u_ext))²/h. Of a cell's many rows only their triangular factor matters, at most one
//! row for each of its functions: three on triangles where A is constant, whatever the rule. With A^½∇u_h of means in the
//! place of A^{−½}τ the same rows give ‖A^½∇_h(s − u_h)‖.

use std::collections::BTreeSet;

use super::Pieces;
use super::block::{Block, Functions};
use super::chain::is_left_out;
use super::laws::{of_law, of_robin, points_of, transfer};
use signorini_certify::TermData;
use signorini_certify::cell::Cell;
use signorini_certify::conductivity::Conductivity;
use signorini_certify::curved::{
    FINE, POINTS, between_smooth_rays, of_rough_sides, on_side, square,
};
use signorini_certify::deviation::{Deviations, Lift};
use signorini_problem::Problem;
use signorini_problem::field::CellField;
use signorini_problem::pieces::{PiecePoint, Root};
use signorini_problem::quadrature::{Point, gauss, on_panels};
use signorini_problem::triangular::triangular;
use signorini_scene::error::Result;

/// Rows over these functions of s, which follows what data of patterns deviate from their chords by.
pub(super) struct Residual<'r> {
    pieces: &'r Pieces<'r>,
    functions: &'r Functions,
    deviations: Vec<Deviations<'r>>,
}

impl<'r> Residual<'r> {
    /// Between vertices that are `released` s follows nothing.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn new(
        pieces: &'r Pieces<'r>,
        functions: &'r Functions,
        released: &BTreeSet<u32>,
    ) -> Result<Self> {
        let followed = |pattern: &'r TermData| {
            let mut deviations = Deviations::of(&pattern.problem)?;
            deviations.found.retain(|of| !is_left_out(pieces.problem.ends[of.edge], released));
            Ok(deviations)
        };
        let deviations = pieces.patterns.iter().map(followed).collect::<Result<_>>()?;
        Ok(Self { pieces, functions, deviations })
    }

    /// The rows of all cells and Robin edges.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn blocks(&self) -> Result<Vec<Block>> {
        let (functions, Pieces { problem, patterns, laws, .. }) = (self.functions, self.pieces);
        let mut blocks = self.of_cells(Of::Fluxes)?;
        let transfer = transfer(patterns)?;
        for (at, record) in problem.loads.robin.iter().enumerate() {
            let ambient: Vec<_> = transfer.iter().map(|edges| edges[at]).collect();
            let edge = record.edge as usize;
            blocks.push(match laws.as_ref().is_some_and(|laws| laws.shares[at] > 0.0) {
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
    pub fn jumps(&self) -> Result<Option<Vec<Block>>> {
        let Pieces { problem, patterns, .. } = self.pieces;
        let is_lifted = self.deviations.iter().any(|of| !of.found.is_empty());
        let has_source =
            patterns.iter().any(|p| p.loads().triangles.iter().any(|&load| load != 0.0));
        let is_constant = |at| Conductivity::of(problem, at).is_constant();
        let is_plain = problem.mesh.quads.is_empty() && (0..problem.cells()).all(is_constant);
        if is_plain && !(is_lifted && has_source) {
            return Ok(None);
        }
        self.of_cells(Of::Means).map(Some)
    }

    /// The rows of all cells.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn of_cells(&self, of: Of) -> Result<Vec<Block>> {
        (0..self.pieces.problem.cells()).map(|at| self.of_cell(at, of)).collect()
    }

    fn of_cell(&self, at: usize, of: Of) -> Result<Block> {
        let (problem, deviations) = (self.pieces.problem, &self.deviations);
        let (vertices, edges) = (problem.vertices_of(at), problem.topology.edges_of(at));
        let bubbles = self.functions.bubbles_of(edges);
        let on_side = |side: usize| deviations.iter().map(move |all| all.on(edges[side] as usize));
        let curved: Vec<usize> =
            (0..edges.len()).filter(|&side| on_side(side).any(|of| of.is_some())).collect();
        let (cell, conductivity) = (Cell::of(problem, at), Conductivity::of(problem, at));
        let fields = unit_fields(problem, at, edges);
        let lifts: Vec<_> = deviations.iter().map(|of| Lift::on_cell(problem, at, of)).collect();
        let width = vertices.len() + bubbles.len() + fields.len() + deviations.len();
        let mut columns = vec![Vec::new(); width];
        let rough = of_rough_sides(problem, at, deviations, &gauss(POINTS))?;
        let smooth = || points(&cell, conductivity.points_for(&cell, 2), &curved);
        let seen = |(reference, weight): ([f64; 3], f64)| {
            let local = cell.local(reference);
            conductivity.resolved(Point {
                x: local.x,
                reference,
                weight: weight * local.determinant,
            })
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
            for lift in &lifts {
                entries.push(Entry::Gradient(lift.at(&local)?.gradient));
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
}

/// Field subtracted from A^½∇s.
#[derive(Debug, Clone, Copy)]
pub(super) enum Of {
    /// A^{−½}τ
    Fluxes,
    /// A^½∇u_h
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

/// For each edge the field of a unit flux along its direction and a unit mean over it.
fn unit_fields(problem: &Problem, at: usize, edges: &[u32]) -> Vec<CellField> {
    let unit = |side: usize| {
        let only = |value: f64| std::array::from_fn(|k| if k == side { value } else { 0.0 });
        let is_along = problem.topology.first_side(edges[side] as usize) == (at, side);
        CellField::of_sides(problem, at, only(1.0), only(if is_along { 1.0 } else { -1.0 }))
    };
    (0..edges.len()).map(unit).collect()
}

/// Reference coordinates with weights that lack the area element, with `rule` points a direction or,
/// where sides are `curved`, those that integrate what the sides carry inside.
pub(super) fn points(cell: &Cell, rule: usize, curved: &[usize]) -> Vec<([f64; 3], f64)> {
    let along = on_panels(FINE, &gauss(POINTS));
    match (cell, curved) {
        (Cell::Triangle(_), []) => on_side(cell, 0, &gauss(rule), &gauss(rule)),
        (Cell::Triangle(_), [side]) => on_side(cell, *side, &along, &gauss(POINTS)),
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
