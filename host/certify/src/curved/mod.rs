//! Edges whose boundary data are not affine, and what carrying them inside costs.
//!
//! s follows the chords of ψ and u_D; between chord and data lies w(t). s + Σ v_E with the extensions
//! v_E = (1 − η) w(t) of `cell` is admissible again, and with σ the gradient part of the bound,
//! ```text
//!   ‖A^½∇(s + v) − A^{−½}τ‖² = ‖A^½∇s − A^{−½}τ‖² + 2∫A∇v·∇s + ∫A∇v·∇v − 2∫∇v·τ.
//! ```
//! The last integral needs only w̄ and fluxes: ∫∇v·τ = w̄ τ_E + ∫v f̄. The other two are here, so that
//! nobody downstream needs a quadrature: s is a sum of vertex functions and bubbles.

mod cleared;
mod cross;
mod inside;
mod panels;
mod rise;
mod singular;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use super::cell::{Cell, Local};
use super::conductivity::{Conductivity, product};
use super::deviation::{Deviation, Deviations};
use super::energy::{CellEnergy, Sample};
use panels::{Mended, Panels};
use signorini_bound::certificate;
use signorini_kernel::Tensor;
use signorini_problem::Problem;
use signorini_problem::pieces::{PiecePoint, Pieces};
use signorini_problem::quadrature::gauss;
use signorini_problem::scalar::Scalar;
use signorini_scene::error::Result;

pub use cleared::{followed, may_be_cleared, peak};
pub use cross::{between_smooth_rays, square};
pub use inside::{of_rough_sides, on_side, points, points_along_sides};
pub use panels::PANELS;
pub use singular::Rough;

/// Gauss points a panel, and away from the edge.
pub const POINTS: usize = 8;
/// Part of ‖A^½∇v‖ that points of pieces may miss: v is smooth in a piece, but for a corner from which its rays start.
const MISSED_BY_POINTS: f64 = 0.01;
/// Panels along an edge for squares and products of smooth data, which have twice their waves.
pub const FINE: u32 = 2 * PANELS;

/// The extension v of one edge's deviation w = data − chord into the edge's cell T.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Curved {
    /// A contact or Dirichlet edge.
    pub edge: u32,
    /// ∫₀¹ w dt, in the unit of u.
    pub mean: f64,
    /// At least |w| all along the edge, in the unit of u; infinite where S follows w in any case.
    pub peak: f64,
    /// ∫_T A∇v·∇v, and 2∫_T A∇v·∇v′ for each earlier record v′ in the same cell: the sum over a
    /// cell's records is the energy of the sum of their extensions.
    pub energy: f64,
    /// ∫_T A∇v·∇N_k. Triangles: k = 0, 1, 2 the barycentric functions of the cell's vertices. Quads:
    /// 0 to 3 the bilinear functions of the vertices, 4 to 7 the bubbles 4t(1 − t)(1 − η) of the
    /// sides. The rest is 0.
    pub coupling: [f64; 8],
    /// Where no function of finite energy is w on the edge: these numbers mean nothing then.
    pub rough: Option<Rough>,
    /// ‖A^½∇·‖ of what the points on the edge miss of v.
    pub missed: f64,
}

impl Curved {
    /// The record of the kernel, in another scalar.
    pub fn narrowed<R: Scalar>(&self) -> certificate::Curved<R, u32> {
        certificate::Curved {
            edge: self.edge,
            mean: R::narrow(self.mean),
            peak: R::narrow(self.peak),
            energy: R::narrow(self.energy),
            coupling: self.coupling.map(R::narrow),
        }
    }
}

/// The edges on which ψ or u_D is not affine at the time of `problem`, in the order of the edges.
///
/// # Errors
/// Data that are not finite or not differentiable at a quadrature point.
pub fn curved(problem: &Problem) -> Result<Vec<Curved>> {
    Ok(CurvedEdges::new(problem, &Deviations::of(problem)?)?.records)
}

/// The records, and what they leave out.
#[derive(Debug, Clone)]
pub struct CurvedEdges {
    /// See [`curved`].
    pub records: Vec<Curved>,
    /// ‖A^½∇·‖ of what edges without a record and points of the others leave out of Σv: to be added to the bound.
    pub left_out: f64,
    /// The panels of each record.
    panels: Vec<Panels>,
}

impl CurvedEdges {
    /// The edges of these deviations, which are all of a time.
    ///
    /// # Errors
    /// As for [`curved`].
    pub fn new(problem: &Problem, deviations: &Deviations) -> Result<Self> {
        let mut extensions: Vec<Extension> = Vec::with_capacity(deviations.found.len());
        let mut records = Vec::with_capacity(deviations.found.len());
        let edges = deviations.found.iter().map(|deviation| deviation.edge);
        for (deviation, may_be_cleared) in
            deviations.found.iter().zip(may_be_cleared(problem, edges))
        {
            let extension = Extension::new(problem, deviation)?;
            let mut record = extension.integrate()?;
            record.missed += extension.missed(problem)?;
            if may_be_cleared {
                record.peak = cleared::peak_on(deviation, &extension.panels)?;
            }
            // A boundary cell has few sides, but they need not be neighbours in the order of the edges.
            for earlier in extensions.iter().filter(|other| other.at == extension.at) {
                record.energy += 2.0 * extension.cross(earlier)?;
            }
            records.push(record);
            extensions.push(extension);
        }
        let mut of_cells = BTreeMap::new();
        for (record, extension) in records.iter().zip(&extensions) {
            *of_cells.entry(extension.at).or_insert(0.0) += record.missed;
        }
        let missed = of_cells.values().fold(0.0_f64, |sum, missed| sum.hypot(*missed));
        let panels = extensions.into_iter().map(|extension| extension.panels).collect();
        Ok(Self { records, left_out: deviations.dropped + missed, panels })
    }

    /// Points along each edge with their weights, and ∫(w − w̃)² of what they miss.
    pub fn points(&self) -> impl Iterator<Item = (Vec<[f64; 2]>, f64)> {
        self.panels.iter().map(|panels| (panels.rule(), panels.missed[0]))
    }
}

/// v_E with its cell.
struct Extension<'d, 's> {
    deviation: &'d Deviation<'s>,
    at: usize,
    side: usize,
    cell: Cell,
    conductivity: Conductivity<'s>,
    panels: Panels,
    mended: Mended,
}

impl<'d, 's> Extension<'d, 's> {
    fn new(problem: &'s Problem, deviation: &'d Deviation<'s>) -> Result<Self> {
        let (at, side) = problem.topology.first_side(deviation.edge);
        let (cell, conductivity) = (Cell::of(problem, at), Conductivity::of(problem, at));
        let panels = Panels::along(deviation)?;
        let mended = Mended::new(deviation, &panels)?;
        Ok(Self { deviation, at, side, cell, conductivity, panels, mended })
    }

    /// w and w′ at t.
    fn sample(&self, t: f64) -> Result<[f64; 2]> {
        let [w, slope] = self.deviation.at(t)?;
        let [by, by_slope] = self.mended.change;
        Ok([w + by, slope + by_slope])
    }

    /// ∇v at a point of its cell.
    fn gradient(&self, local: &Local) -> Result<[f64; 2]> {
        let side = &local.sides[self.side];
        let [w, slope] = self.sample(side.t)?;
        Ok(side.extension(w, slope).gradient)
    }

    /// The record, cross terms still missing.
    fn integrate(&self) -> Result<Curved> {
        let (edge, rough) = (self.deviation.edge as u32, self.panels.rough);
        let mut record = Curved { edge, peak: f64::INFINITY, rough, ..Curved::default() };
        let away = self.rule_away();
        for [t, weight] in self.panels.rule() {
            let [w, slope] = self.sample(t)?;
            record.mean += weight * w;
            if self.conductivity.cut_for_curves().is_some() {
                continue;
            }
            for &[eta, weight_away] in &away {
                let local = self.cell.local(self.cell.side_point(self.side, t, eta));
                let gradient = local.sides[self.side].extension(w, slope).gradient;
                let weight = weight * weight_away * self.cell.area_element(&local, eta);
                let a = self.conductivity.at(local.x);
                self.add(&mut record, &local, gradient, (a, weight));
            }
        }
        match self.conductivity.cut_for_curves() {
            Some(pieces) => self.integrate_pieces(pieces, &mut record)?,
            None => record.missed = 2.0 * self.conductivity.share() * record.energy.sqrt(),
        }
        Ok(record)
    }

    /// The integrals over a cell whose own points do not resolve A; what A has above p there is missed, by s and by s − u_h.
    fn integrate_pieces(&self, pieces: &Pieces, record: &mut Curved) -> Result<()> {
        let mut open = [0.0; 2];
        for at in pieces.many_points(self.cell) {
            let (local, weight) = (self.cell.local(at.point.reference), at.point.weight);
            let gradient = self.gradient(&local)?;
            self.add(record, &local, gradient, (at.below, weight));
            let whole = PiecePoint { share: 1.0, ..at };
            open[0] += weight * at.open(gradient).powi(2);
            open[1] += weight * whole.open(gradient).powi(2);
        }
        let points = MISSED_BY_POINTS * record.energy.sqrt();
        record.missed = open[0].sqrt() + open[1].sqrt() + points;
        Ok(())
    }

    /// ‖A^½∇·‖ of what the panels' points leave out, and of what mending changes beyond rounding.
    fn missed(&self, problem: &Problem) -> Result<f64> {
        let energy = CellEnergy::of(problem, self.at);
        let missed = energy.of_missed(self.side, self.panels.missed);
        if !self.mended.is_counted {
            return Ok(missed);
        }
        let [w, slope] = self.mended.change;
        let change = gauss(POINTS).into_iter().map(|[t, weight]| Sample { t, weight, w, slope });
        Ok(missed + energy.of_extension(self.side, &change.collect::<Vec<_>>()))
    }

    /// The rule in η: on triangles ∇v does not depend on it, so that with constant A one point for
    /// the area element 2|T|(1 − η) is exact.
    fn rule_away(&self) -> Vec<[f64; 2]> {
        match self.cell {
            Cell::Triangle(_) if self.conductivity.is_constant() => gauss(1),
            _ => gauss(POINTS),
        }
    }

    fn add(
        &self,
        record: &mut Curved,
        local: &Local,
        gradient: [f64; 2],
        (a, weight): (Tensor<f64>, f64),
    ) {
        record.energy += weight * product(&a, gradient, gradient);
        let bubbles = match self.cell {
            Cell::Triangle(_) => 0,
            Cell::Quad(_) => 4,
        };
        let vertices = local.vertices.iter().copied();
        let sides = local.sides[..bubbles].iter().map(|side| side.bubble());
        for (entry, function) in record.coupling.iter_mut().zip(vertices.chain(sides)) {
            *entry += weight * product(&a, gradient, function.gradient);
        }
    }

    /// ∫_T A∇v·∇v′
    fn cross(&self, other: &Self) -> Result<f64> {
        let mut sum = 0.0;
        if let Some(pieces) = self.conductivity.cut_for_curves() {
            for at in pieces.many_points(self.cell) {
                let local = self.cell.local(at.point.reference);
                let (mine, its) = (self.gradient(&local)?, other.gradient(&local)?);
                sum += at.point.weight * product(&at.below, mine, its);
            }
            return Ok(sum);
        }
        let (sides, panels) = ([self.side, other.side], [&self.panels, &other.panels]);
        for (reference, weight) in cross::points(&self.cell, sides, panels) {
            let local = self.cell.local(reference);
            let (mine, its) = (self.gradient(&local)?, other.gradient(&local)?);
            let a = self.conductivity.at(local.x);
            sum += weight * local.determinant * product(&a, mine, its);
        }
        Ok(sum)
    }
}
