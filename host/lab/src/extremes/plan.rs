//! What is run: each axis alone, then pairs, in both scalars.

use super::axis::Axis;
use super::case::{Effort, ExtremeCase};
use super::flush;
use super::grid::{Grid, Shape};
use super::posed::{Hold, Posed, Scales};
use super::solution::{Shear, Solution};
use signorini_scene::mesh::structured::Cells;
use signorini_solve::ScalarKind;

/// An axis or a pair of them, with the problem whose numbers they push.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisStudy {
    /// The axis.
    pub axis: Axis,
    /// What it is crossed with.
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

/// All of them, in the order of the report.
pub const STUDIES: [AxisStudy; 62] = [
    study(Axis::Contrast, "triangles", J, 16, Cells::Triangles),
    study(Axis::Contrast, "quads", J, 16, Cells::Quads),
    study(Axis::Anisotropy, "A, triangles", A, 16, Cells::Triangles),
    study(Axis::Anisotropy, "H, triangles", H, 16, Cells::Triangles),
    study(Axis::Anisotropy, "H, quads", H, 16, Cells::Quads),
    study(Axis::Obliqueness, "A, triangles", A, 16, Cells::Triangles),
    study(Axis::Obliqueness, "H, triangles", H, 16, Cells::Triangles),
    study(Axis::Aspect, "triangles", A, 16, Cells::Triangles),
    study(Axis::Aspect, "quads", A, 16, Cells::Quads),
    study(Axis::Slivers, "triangles", A, 16, Cells::Triangles),
    study(Axis::Slivers, "needle quads", A, 16, Cells::Quads),
    study(Axis::Collapse, "", A, 16, Cells::Quads),
    study(Axis::Trapezoids, "", A, 16, Cells::Quads),
    study(Axis::Length, "", A, 16, Cells::Triangles),
    study(Axis::Shift, "triangles", A, 16, Cells::Triangles),
    study(Axis::Shift, "quads", A, 16, Cells::Quads),
    study(Axis::Load, "triangles", A, 16, Cells::Triangles),
    study(Axis::Load, "quads", A, 16, Cells::Quads),
    study(Axis::FlushedLoad, "", A, 16, Cells::Triangles),
    study(Axis::Stiffness, "", A, 16, Cells::Triangles),
    study(Axis::Grazing, "", A, 16, Cells::Triangles),
    study(Axis::Contact, "", A, 16, Cells::Triangles),
    study(Axis::Active, "", A, 16, Cells::Mixed),
    study(Axis::Dirichlet, "", A, 16, Cells::Triangles),
    study(Axis::Cells, "", A, 16, Cells::Triangles),
    study(Axis::Omega, "", A, 8, Cells::Triangles),
    study(Axis::Sweeps, "", A, 16, Cells::Triangles),
    study(Axis::Robin, "", A, 16, Cells::Triangles),
    study(Axis::Switching, "", Solution::Switching, 16, Cells::Triangles),
    pair(Axis::Contrast, Axis::Cells, J, Cells::Triangles),
    pair(Axis::Contrast, Axis::Load, J, Cells::Triangles),
    pair(Axis::Contrast, Axis::Anisotropy, J, Cells::Triangles),
    pair(Axis::Contrast, Axis::Omega, J, Cells::Triangles),
    pair(Axis::Contrast, Axis::Robin, J, Cells::Triangles),
    pair(Axis::Anisotropy, Axis::Obliqueness, A, Cells::Triangles),
    pair(Axis::Anisotropy, Axis::Aspect, H, Cells::Quads),
    pair(Axis::Length, Axis::Load, A, Cells::Triangles),
    pair(Axis::Shift, Axis::Aspect, A, Cells::Triangles),
    study(Axis::Span, "L, triangles", L, 16, Cells::Triangles),
    study(Axis::Span, "L, quads", L, 16, Cells::Quads),
    study(Axis::SpanBelow, "L, mixed", L, 16, Cells::Mixed),
    study(Axis::Ends, "heated wall", HEATED, 16, Cells::Triangles),
    study(Axis::Ends, "cooled wall", COOLED, 16, Cells::Mixed),
    study(Axis::Above, "wall", COOLED, 16, Cells::Triangles),
    study(Axis::Limit, "A, triangles", A, 16, Cells::Triangles),
    study(Axis::Limit, "A, quads", A, 16, Cells::Quads),
    study(Axis::Least, "−A, triangles", B, 16, Cells::Triangles),
    study(Axis::Infinite, "", A, 16, Cells::Triangles),
    study(Axis::MovingWall, "", Solution::MovingWall([-2.0, 3.0]), 16, Cells::Triangles),
    study(Axis::Load, "L, triangles", L, 16, Cells::Triangles),
    study(Axis::FlushedLoad, "L", L, 16, Cells::Triangles),
    study(Axis::Stiffness, "L", L, 16, Cells::Triangles),
    study(Axis::Length, "L", L, 16, Cells::Triangles),
    study(Axis::Aspect, "L, triangles", L, 16, Cells::Triangles),
    study(Axis::Sweeps, "L", L, 16, Cells::Triangles),
    pair(Axis::Span, Axis::Cells, L, Cells::Triangles),
    pair(Axis::Span, Axis::Load, L, Cells::Triangles),
    pair(Axis::Span, Axis::Sweeps, L, Cells::Quads),
    pair(Axis::Span, Axis::Anisotropy, L, Cells::Triangles),
    pair(Axis::Ends, Axis::Contrast, HEATED, Cells::Triangles),
    pair(Axis::Ends, Axis::Sweeps, COOLED, Cells::Triangles),
    pair(Axis::Limit, Axis::Contrast, J, Cells::Triangles),
];

impl AxisStudy {
    /// The name of its axis in the files.
    pub fn name(&self) -> String {
        let name = self.axis.name();
        if self.of.is_empty() { name.to_owned() } else { format!("{name}: {}", self.of) }
    }

    /// Its cases.
    pub fn cases(&self) -> Vec<ExtremeCase> {
        let mut cases = Vec::new();
        for scalar in [ScalarKind::F64, ScalarKind::F32] {
            match self.across {
                None => {
                    cases.extend(self.axis.values().iter().map(|&v| self.case(scalar, v, None)))
                }
                Some(across) => cases.extend(across.crossed().iter().flat_map(|&other| {
                    let values = self.axis.crossed().iter();
                    values.map(move |&value| self.case(scalar, value, Some((across, other))))
                })),
            }
        }
        cases
    }

    fn case(&self, scalar: ScalarKind, value: f64, across: Option<(Axis, f64)>) -> ExtremeCase {
        let mut case = ExtremeCase {
            axis: self.name(),
            value,
            across: across.map(|(axis, value)| (axis.name().to_owned(), value)),
            scalar,
            posed: self.posed(),
            effort: Effort::default(),
        };
        self.axis.set(value, &mut case);
        if let Some((axis, value)) = across {
            axis.set(value, &mut case);
        }
        case
    }

    fn posed(&self) -> Posed {
        Posed {
            solution: self.solution,
            shear: Shear::NONE,
            grid: Grid { n: self.n, cells: self.cells, shape: Shape::Square },
            scales: Scales::ONE,
            sides: [Hold::Contact, Hold::Dirichlet, Hold::Dirichlet, Hold::Dirichlet],
            split: None,
            ends: None,
        }
    }
}

/// Every case of every study.
pub fn cases() -> Vec<ExtremeCase> {
    let can = |study: &&AxisStudy| study.axis != Axis::FlushedLoad || flush::SUPPORTED;
    STUDIES.iter().filter(can).flat_map(AxisStudy::cases).collect()
}
