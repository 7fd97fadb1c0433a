//! Where ψ or u_D leaves its chord: w(t) = data − chord of the end values, t along the edge.

use signorini_kernel::Real;

use super::cell::{Jet, Local};
use super::ends::Ends;
use crate::error::Result;
use crate::problem::{Problem, Sum};
use crate::quadrature::DATA_POINTS;
use crate::scene::{Field, Scene};

/// A deviation below this part of the largest boundary datum is the rounding of an affine one.
const ROUNDING: f64 = 1e-14;

/// Rules along an edge in search of a deviation: a bump narrower than a fortieth of the edge may lie between all points.
const LOOKS: u32 = 8;

/// w on one edge.
pub(crate) struct Deviation<'s> {
    /// The edge.
    pub(crate) edge: usize,
    data: Sum<'s>,
    segment: [[f64; 2]; 2],
    ends: [f64; 2],
    /// The largest boundary datum of all edges.
    scale: f64,
}

/// The edges whose data are not affine, ascending.
pub(crate) struct Deviations<'s>(pub(crate) Vec<Deviation<'s>>);

impl<'s> Deviations<'s> {
    /// Finds them at time `time`.
    pub(crate) fn at_time(scene: &'s Scene, problem: &Problem, time: f64) -> Result<Self> {
        let ends = Ends::at_time(scene, problem, time)?;
        let counts = problem.topology.counts;
        let contact = (counts.free..).zip(ends.gap.iter().map(|&pair| (Field::Gap, pair)));
        let given = (counts.unknowns()..).zip(ends.given.iter().map(|&pair| (Field::Value, pair)));
        let scale = ends.scale();
        let mut found = Vec::new();
        for (edge, (field, ends)) in contact.chain(given) {
            let data = Sum::on_edge(scene, problem, edge, field, time);
            let segment = problem.segment(edge);
            let Some(data) = data.filter(|data| data.constant().is_none()) else { continue };
            let deviation = Deviation { edge, data, segment, ends, scale };
            if deviation.exceeds(ROUNDING * scale)? {
                found.push(deviation);
            }
        }
        Ok(Self(found))
    }

    /// That of an edge.
    pub(crate) fn on(&self, edge: usize) -> Option<&Deviation<'s>> {
        let at = self.0.binary_search_by_key(&edge, |deviation| deviation.edge).ok()?;
        Some(&self.0[at])
    }

    /// Those of the sides of cell `at`, triangles first.
    pub(crate) fn of_cell(&self, problem: &Problem, at: usize) -> Vec<Option<&Deviation<'s>>> {
        let topology = &problem.topology;
        let edges: &[u32] = match topology.of_triangles.get(at) {
            Some(edges) => edges,
            None => &topology.of_quads[at - topology.of_triangles.len()],
        };
        edges.iter().map(|&edge| self.on(edge as usize)).collect()
    }
}

impl Deviation<'_> {
    /// w and w′ = dw/dt at t.
    ///
    /// # Errors
    /// Data that are not finite or not differentiable there.
    pub(crate) fn at(&self, t: f64) -> Result<[f64; 2]> {
        let ([a, b], x) = (self.segment, self.place(t));
        let gradient = self.data.gradient_at(x[0], x[1]);
        let slope = gradient[0] * (b[0] - a[0]) + gradient[1] * (b[1] - a[1]);
        Ok([
            self.data.finite(self.value(t), x)?,
            self.data.finite(slope - (self.ends[1] - self.ends[0]), x)?,
        ])
    }

    /// w at t; not finite where the data are not.
    pub(crate) fn value(&self, t: f64) -> f64 {
        let [x, y] = self.place(t);
        self.data.at(x, y) - (self.ends[0] + t * (self.ends[1] - self.ends[0]))
    }

    fn place(&self, t: f64) -> [f64; 2] {
        let [a, b] = self.segment;
        [0, 1].map(|k| a[k] + t * (b[k] - a[k]))
    }

    /// What rounding may leave of w: that of the data, and of the place where they are evaluated.
    pub(crate) fn rounding(&self) -> f64 {
        let of_place = |point: &[f64; 2]| {
            let [x, y] = self.place(point[0]);
            let [by_x, by_y] = self.data.gradient_at(x, y);
            (by_x * x).abs() + (by_y * y).abs()
        };
        let places = f64::GAUSS[DATA_POINTS - 1].iter().map(of_place);
        ROUNDING * places.fold(self.scale, f64::max)
    }

    /// At the points where [`super::curved`] looks first, `LOOKS` times the rule along the edge: what all of them miss is
    /// not seen at all.
    fn exceeds(&self, threshold: f64) -> Result<bool> {
        for panel in 0..LOOKS {
            for point in f64::GAUSS[DATA_POINTS - 1] {
                let t = (f64::from(panel) + point[0]) / f64::from(LOOKS);
                if self.at(t)?[0].abs() > threshold {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }
}

/// L = Σ v_E on one cell, v_E = (1 − η) w(t) for its sides E.
pub(crate) struct Lift<'d, 's>(Vec<Option<&'d Deviation<'s>>>);

impl<'d, 's> Lift<'d, 's> {
    /// That of cell `at`, triangles first.
    pub(crate) fn on_cell(problem: &Problem, at: usize, deviations: &'d Deviations<'s>) -> Self {
        Self(deviations.of_cell(problem, at))
    }

    /// Whether no side's data leave their chord.
    pub(crate) fn is_zero(&self) -> bool {
        self.0.iter().all(Option::is_none)
    }

    /// L and ∇L at a point of the cell.
    ///
    /// # Errors
    /// Data that are not finite or not differentiable there.
    pub(crate) fn at(&self, local: &Local) -> Result<Jet> {
        let mut sum = Jet::default();
        for (deviation, side) in self.0.iter().zip(&local.sides) {
            if let Some(deviation) = deviation {
                let [w, slope] = deviation.at(side.t)?;
                sum.add(1.0, side.extension(w, slope));
            }
        }
        Ok(sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certify::fixtures::{self, SMOOTH};
    use crate::mesh::structured::{Cells, grid};

    fn curved(gap: &str) -> Result<usize> {
        let text = SMOOTH.replace("gap = \"x^3\"", &format!("gap = \"{gap}\""));
        let (scene, problem) = fixtures::on_grid(&text, grid(4, Cells::Triangles))?;
        let free = problem.topology.counts.free;
        let contact = free..problem.topology.counts.unknowns();
        let found = Deviations::at_time(&scene, &problem, 0.0)?;
        Ok(found.0.iter().filter(|deviation| contact.contains(&deviation.edge)).count())
    }

    /// In the middle of an edge of ¼ the points of one rule lie 0.046 apart.
    #[test]
    fn a_bump_between_the_points_of_one_rule_is_seen() -> Result<()> {
        assert_eq!(curved("max(0, 1 - abs(x-0.375)/0.02)")?, 1);
        assert_eq!(curved("max(0, 1 - abs(x-0.375)/0.004)")?, 1);
        assert_eq!(curved("2*x - 1")?, 0);
        Ok(())
    }
}
