//! The studies: each axis alone, then pairs, in both scalars.

use super::axis::{self, Axis};
use super::case::{Effort, ExtremeCase};
use super::flush;
use super::grid::{Grid, Shape};
use super::posed::Posed;
use super::solution::Solution;
use signorini_scene::mesh::structured::Cells;
use signorini_solve::ScalarKind;

/// An axis or a pair of them, with the problem whose numbers they push.
#[derive(Debug, Clone, Copy)]
pub struct AxisStudy {
    pub axis: Axis,
    pub across: Option<Axis>,
    solution: Solution,
    /// Which of several studies along one axis; empty where it is the only one.
    of: &'static str,
    n: u32,
    cells: Cells,
}

const A: Solution = Solution::Smooth { grazing: 0.0 };
const H: Solution = Solution::Punch;
const J: Solution = Solution::Jump(1.0);
/// Limits in three states, with one of them, and where u is kept below ψ.
const L: Solution = Solution::ThreeStates([-0.5, 1.0]);
const HEATED: Solution = Solution::Wall { above: -1.0, ends: [-2.0, 3.0], contrast: 1.0 };
const COOLED: Solution = Solution::Wall { above: 1.0, ends: [-2.0, 3.0], contrast: 1.0 };
const B: Solution = Solution::Below;

const fn study(
    axis: Axis,
    of: &'static str,
    solution: Solution,
    n: u32,
    cells: Cells,
) -> AxisStudy {
    AxisStudy { axis, across: None, solution, of, n, cells }
}

const fn pair(axis: Axis, across: Axis, solution: Solution, cells: Cells) -> AxisStudy {
    AxisStudy { axis, across: Some(across), solution, of: "", n: 8, cells }
}

/// All studies, in the order of the report.
pub const STUDIES: [AxisStudy; 62] = [
    study(axis::CONTRAST, "triangles", J, 16, Cells::Triangles),
    study(axis::CONTRAST, "quads", J, 16, Cells::Quads),
    study(axis::ANISOTROPY, "A, triangles", A, 16, Cells::Triangles),
    study(axis::ANISOTROPY, "H, triangles", H, 16, Cells::Triangles),
    study(axis::ANISOTROPY, "H, quads", H, 16, Cells::Quads),
    study(axis::OBLIQUENESS, "A, triangles", A, 16, Cells::Triangles),
    study(axis::OBLIQUENESS, "H, triangles", H, 16, Cells::Triangles),
    study(axis::ASPECT, "triangles", A, 16, Cells::Triangles),
    study(axis::ASPECT, "quads", A, 16, Cells::Quads),
    study(axis::SLIVERS, "triangles", A, 16, Cells::Triangles),
    study(axis::SLIVERS, "needle quads", A, 16, Cells::Quads),
    study(axis::COLLAPSE, "", A, 16, Cells::Quads),
    study(axis::TRAPEZOIDS, "", A, 16, Cells::Quads),
    study(axis::LENGTH, "", A, 16, Cells::Triangles),
    study(axis::SHIFT, "triangles", A, 16, Cells::Triangles),
    study(axis::SHIFT, "quads", A, 16, Cells::Quads),
    study(axis::LOAD, "triangles", A, 16, Cells::Triangles),
    study(axis::LOAD, "quads", A, 16, Cells::Quads),
    study(axis::FLUSHED_LOAD, "", A, 16, Cells::Triangles),
    study(axis::STIFFNESS, "", A, 16, Cells::Triangles),
    study(axis::GRAZING, "", A, 16, Cells::Triangles),
    study(axis::CONTACT, "", A, 16, Cells::Triangles),
    study(axis::ACTIVE, "", A, 16, Cells::Mixed),
    study(axis::DIRICHLET, "", A, 16, Cells::Triangles),
    study(axis::CELLS, "", A, 16, Cells::Triangles),
    study(axis::OMEGA, "", A, 8, Cells::Triangles),
    study(axis::SWEEPS, "", A, 16, Cells::Triangles),
    study(axis::ROBIN, "", A, 16, Cells::Triangles),
    study(axis::SWITCHING, "", Solution::Switching, 16, Cells::Triangles),
    pair(axis::CONTRAST, axis::CELLS, J, Cells::Triangles),
    pair(axis::CONTRAST, axis::LOAD, J, Cells::Triangles),
    pair(axis::CONTRAST, axis::ANISOTROPY, J, Cells::Triangles),
    pair(axis::CONTRAST, axis::OMEGA, J, Cells::Triangles),
    pair(axis::CONTRAST, axis::ROBIN, J, Cells::Triangles),
    pair(axis::ANISOTROPY, axis::OBLIQUENESS, A, Cells::Triangles),
    pair(axis::ANISOTROPY, axis::ASPECT, H, Cells::Quads),
    pair(axis::LENGTH, axis::LOAD, A, Cells::Triangles),
    pair(axis::SHIFT, axis::ASPECT, A, Cells::Triangles),
    study(axis::SPAN, "L, triangles", L, 16, Cells::Triangles),
    study(axis::SPAN, "L, quads", L, 16, Cells::Quads),
    study(axis::SPAN_BELOW, "L, mixed", L, 16, Cells::Mixed),
    study(axis::ENDS, "heated wall", HEATED, 16, Cells::Triangles),
    study(axis::ENDS, "cooled wall", COOLED, 16, Cells::Mixed),
    study(axis::ABOVE, "wall", COOLED, 16, Cells::Triangles),
    study(axis::LIMIT, "A, triangles", A, 16, Cells::Triangles),
    study(axis::LIMIT, "A, quads", A, 16, Cells::Quads),
    study(axis::LEAST, "−A, triangles", B, 16, Cells::Triangles),
    study(axis::INFINITE, "", A, 16, Cells::Triangles),
    study(axis::MOVING_WALL, "", Solution::MovingWall([-2.0, 3.0]), 16, Cells::Triangles),
    study(axis::LOAD, "L, triangles", L, 16, Cells::Triangles),
    study(axis::FLUSHED_LOAD, "L", L, 16, Cells::Triangles),
    study(axis::STIFFNESS, "L", L, 16, Cells::Triangles),
    study(axis::LENGTH, "L", L, 16, Cells::Triangles),
    study(axis::ASPECT, "L, triangles", L, 16, Cells::Triangles),
    study(axis::SWEEPS, "L", L, 16, Cells::Triangles),
    pair(axis::SPAN, axis::CELLS, L, Cells::Triangles),
    pair(axis::SPAN, axis::LOAD, L, Cells::Triangles),
    pair(axis::SPAN, axis::SWEEPS, L, Cells::Quads),
    pair(axis::SPAN, axis::ANISOTROPY, L, Cells::Triangles),
    pair(axis::ENDS, axis::CONTRAST, HEATED, Cells::Triangles),
    pair(axis::ENDS, axis::SWEEPS, COOLED, Cells::Triangles),
    pair(axis::LIMIT, axis::CONTRAST, J, Cells::Triangles),
];

impl AxisStudy {
    pub fn name(&self) -> String {
        let name = self.axis.name;
        if self.of.is_empty() { name.to_owned() } else { format!("{name}: {}", self.of) }
    }

    pub fn cases(&self) -> Vec<ExtremeCase> {
        let mut cases = Vec::new();
        for scalar in [ScalarKind::F64, ScalarKind::F32] {
            match self.across {
                None => cases.extend(self.axis.values.iter().map(|&v| self.case(scalar, v, None))),
                Some(across) => cases.extend(across.crossed.iter().flat_map(|&other| {
                    let values = self.axis.crossed.iter();
                    values.map(move |&value| self.case(scalar, value, Some((across, other))))
                })),
            }
        }
        cases
    }

    fn case(&self, scalar: ScalarKind, value: f64, across: Option<(Axis, f64)>) -> ExtremeCase {
        let grid = Grid { n: self.n, cells: self.cells, shape: Shape::Square };
        let mut case = ExtremeCase {
            axis: self.name(),
            value,
            across: across.map(|(axis, value)| (axis.name.to_owned(), value)),
            scalar,
            posed: Posed::new(self.solution, grid),
            effort: Effort::default(),
        };
        (self.axis.set)(value, &mut case);
        if let Some((axis, value)) = across {
            (axis.set)(value, &mut case);
        }
        case
    }
}

/// Every case of every study that this machine can run.
pub fn cases() -> Vec<ExtremeCase> {
    let mut cases: Vec<_> = STUDIES.iter().flat_map(AxisStudy::cases).collect();
    cases.retain(|case| flush::SUPPORTED || !case.effort.flush);
    cases
}

/// A remark on the axes of a map of outcomes; empty where their names say it all.
pub fn remark(study: &str, across: Option<&str>) -> &'static str {
    let name = study.split(':').next().unwrap_or(study);
    if (name, across) == ("anisotropy", Some("obliqueness")) {
        return "beyond s/κ = 2¹² in f32 and 2²⁶ in f64 the stored tensor is singular";
    }
    let known = STUDIES.iter().map(|study| study.axis).find(|axis| axis.name == name);
    let said = known.filter(|axis| across.is_none() || axis.is_said_of_pairs);
    said.map_or("", |axis| axis.remark)
}
