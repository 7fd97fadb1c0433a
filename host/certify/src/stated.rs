//! How far s is from a stated u, in the norm of what is stored.
//!
//! On a part P of a cell s less what it follows of curved data, S − L, is a polynomial, and so is the parabola p of a Taylor form of u.
//! The rule is exact for (p − (S − L))²:
//! ```text
//!   ‖u − (S − L)‖ ≤ (Σ weight (u − (S − L))²)^½ + 2|P|^½ max |u − p|,        ‖c^½(u − S)‖ ≤ ‖c^½(u − (S − L))‖ + ‖c^½L‖
//! ```
//! Parts are cut where most is missed.

use std::collections::BTreeMap;

use super::admissible::{Admissible, Chordal};
use super::between::{form_missed, on_part};
use super::cell::Cell;
use super::deviation::Deviations;
use super::lifted::share;
use signorini_problem::quadrature::enclosed::region;
use signorini_problem::quadrature::refined::refined;
use signorini_problem::quadrature::{DATA_POINTS, gauss};
use signorini_problem::{Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::expression::enclosure::Region;

/// Points a direction: squares of a parabola less s, times the area element, are integrated exactly from 3 on.
const POINTS: usize = 4;
/// Part of the square that may be missed.
const LEFT: f64 = 0.02;
/// Parts beside the cells, at most.
const MOST: usize = 20_000;

/// ‖c^½(u − s)‖ at most, for `stated` u and c its mean on each cell; infinite where u is not bounded.
///
/// # Errors
/// Data that are not finite.
pub fn distance(problem: &Problem, s: &Admissible, stated: &Sum) -> Result<f64> {
    let all: Vec<_> = (0..problem.cells()).map(|at| OnCell::new(problem, s, at)).collect();
    let storing = all.iter().enumerate().filter(|(_, cell)| cell.capacity > 0.0);
    let regions = storing.map(|(of, cell)| (of, region(cell.cell)));
    let is_enough = |size: f64, missed: f64| missed <= LEFT * size;
    let square = |of: usize, region: &Region| all[of].square(stated, region);
    let parts = refined(|_| None, regions, MOST, is_enough, square);
    let square: f64 = parts.iter().map(|part| part.value + part.missed).sum();
    Ok(square.sqrt() + followed(problem)?)
}

/// ‖c^½L‖ at most.
fn followed(problem: &Problem) -> Result<f64> {
    let mut of_cells = BTreeMap::new();
    for deviation in &Deviations::of(problem)?.found {
        let (mut square, mut missed) = (0.0, 0.0);
        for part in deviation.parts() {
            missed += part.missed[0];
            for [t, weight] in on_part(part.range, &gauss(DATA_POINTS)) {
                square += weight * deviation.at(t)?[0].powi(2);
            }
        }
        let (cell, _) = problem.topology.first_side(deviation.edge);
        let content = problem.capacities[cell] * Cell::of(problem, cell).corners().len() as f64;
        let share = (share(problem, cell) * content).sqrt();
        *of_cells.entry(cell).or_insert(0.0) += share * (square.sqrt() + missed.sqrt());
    }
    Ok(of_cells.values().fold(0.0_f64, |sum, of| sum.hypot(*of)))
}

/// S − L on a cell.
struct OnCell {
    cell: Cell,
    chordal: Chordal,
    /// c
    capacity: f64,
}

impl OnCell {
    fn new(problem: &Problem, s: &Admissible, at: usize) -> Self {
        let cell = Cell::of(problem, at);
        let capacity = problem.capacities[at] * cell.corners().len() as f64 / cell.area();
        Self { cell, chordal: s.chordal(problem, at), capacity }
    }

    /// ∫c(u − (S − L))² over a part by the rule, and what is missed of it.
    fn square(&self, stated: &Sum, region: &Region) -> [f64; 2] {
        let part = match *region.corners() {
            [a, b, c] => Cell::Triangle([a, b, c]),
            [a, b, c, d] => Cell::Quad([a, b, c, d]),
            _ => return [0.0, f64::INFINITY],
        };
        let points = part.points(&gauss(POINTS));
        let squares = points.iter().map(|point| {
            let own = self.chordal.at(&self.cell.local(self.cell.reference(point.x))).value;
            point.weight * (stated.at(point.x[0], point.x[1]) - own).powi(2)
        });
        let square: f64 = squares.sum();
        let missed = form_missed(&stated.enclose(region), region.measure());
        let most = (square.sqrt() + missed.sqrt()).powi(2);
        match most.is_finite() {
            true => [square, most - square].map(|of| self.capacity * of),
            false => [0.0, f64::INFINITY],
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;
    use std::path::Path;

    use signorini_scene::mesh::structured::{Cells, grid};
    use signorini_scene::scene::Scene;
    use signorini_tolerances::solve::{GUARANTEE, POINTS};

    use super::super::admissible::Following;
    use super::*;

    /// ‖2u‖ on (−1, 1) × (0, 1) at most, for a stated u and s = 0.
    fn found(cells: Cells, u: &str, gap: &str) -> f64 {
        let text = format!(
            "mesh = \"grid\"\n[material.default]\nconductivity = 1\ncapacity = 4\n[boundary.contact]\nkind = \"contact\"\n\
             gap = \"{gap}\"\n[boundary.dirichlet]\nkind = \"dirichlet\"\nvalue = 0\n[time]\nstep = 1\ninitial = \"{u}\"\n"
        );
        let scene = Scene::parse(&text, Path::new("stated.toml")).unwrap();
        let problem = Problem::new(&scene, grid(4, cells)).unwrap();
        let zeros = vec![0.0; problem.ends.len()];
        let (vertices, tau, following) = (&zeros[..], &zeros[..], &Following::default());
        let s = Admissible { vertices, bubbles: &zeros, tau, following };
        let initial = scene.time.as_ref().and_then(|time| time.initial.as_ref()).unwrap();
        distance(&problem, &s, &Sum::alone(&problem.scene, initial, 0.0)).unwrap()
    }

    /// 2‖u‖ as known on paper, for a polynomial and for a bump between the points of any rule on these cells.
    #[test]
    fn it_is_above_the_distance_and_near_it() {
        let bump = 2.0 * (0.5 * PI / 1e6_f64).sqrt();
        for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
            for (u, exact) in [
                ("x*y", 2.0 * (2.0_f64 / 9.0).sqrt()),
                ("x^4*y^3", 2.0 * (2.0_f64 / 63.0).sqrt()),
                ("exp(-1e6*((x-0.31)^2+(y-0.47)^2))", bump),
                ("max(0, sign(x - 0.3))", 2.0 * 0.7_f64.sqrt()),
            ] {
                let found = found(cells, u, "-1");
                GUARANTEE.check_at_most(format_args!("{cells:?}, {u}"), exact, found);
                assert!(found < 1.02 * exact, "{cells:?}, {u}: {found} {exact}");
            }
            assert_eq!(found(cells, "1/(x^2+y^2)", "-1"), f64::INFINITY);
        }
    }

    /// s follows a gap of which it has no numbers: ‖(1 − η)w‖² = h²/6 ∫w² on half of a square of side h and h²/3 ∫w² on it.
    #[test]
    fn what_s_follows_of_curved_data_counts() {
        let square = 8.0 * 0.25_f64.powi(5) / 30.0;
        for (cells, share) in [(Cells::Triangles, 0.5), (Cells::Quads, 1.0 / 3.0)] {
            let [with, without] = ["x^2 - 2", "-2"].map(|gap| found(cells, "0", gap));
            assert_eq!(without, 0.0);
            // Half a square has half of the area.
            let area = if cells == Cells::Triangles { 0.5 } else { 1.0 };
            let exact = 2.0 * (share * area * 0.25 * square).sqrt();
            POINTS.check_relative(format_args!("{cells:?}"), with, exact);
        }
    }
}
