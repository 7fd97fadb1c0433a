//! The axes: which number of a problem each of them pushes, and how far.

use super::case::ExtremeCase;
use super::grid::Shape;
use super::posed::{Hold, Split};
use super::solution::Solution;
use signorini_scene::mesh::structured::Cells;

/// A number that is pushed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// k of J(k).
    Contrast,
    /// κ of T(s, κ); powers of two, so that A is stored exactly.
    Anisotropy,
    /// s of T(s, κ).
    Obliqueness,
    /// Width over height of the flattest cells, rows graded.
    Aspect,
    /// The same, with angles near 180°.
    Slivers,
    /// Width of a side of quads over that of the others.
    Collapse,
    /// Rows of trapezoids.
    Trapezoids,
    /// Unit of length.
    Length,
    /// Distance from the origin in diameters.
    Shift,
    /// Factor of u and all loads.
    Load,
    /// The same, with subnormal numbers flushed to zero.
    FlushedLoad,
    /// Factor of A and all loads.
    Stiffness,
    /// Length of the part of C with neither force nor gap.
    Grazing,
    /// Length of C.
    Contact,
    /// Share of C in contact.
    Active,
    /// Length of D.
    Dirichlet,
    /// Number of cells.
    Cells,
    /// A fixed ω.
    Omega,
    /// Most sweeps.
    Sweeps,
    /// Transfer coefficient of the upper side, the others having no D.
    Robin,
    /// Contact edges that all open or close from tick to tick.
    Switching,
    /// hi − lo over lo, of a flux in three states.
    Span,
    /// The same with hi < 0: over |hi|.
    SpanBelow,
    /// hi = −lo on a wall whose flux would be 1.
    Ends,
    /// u above a wall whose flux has the ends −2 and 3.
    Above,
    /// hi over the largest flux, which nothing reaches beyond 1.
    Limit,
    /// lo likewise, where u is kept below ψ.
    Least,
    /// Which end is infinite: the lower one (−1), the upper one (1), both (0).
    Infinite,
    /// A wall at either end of the flux from tick to tick.
    MovingWall,
}

/// ‖(2, 1)‖: the diameter of the domain.
const DIAMETER: f64 = 2.236_067_977_499_79;

impl Axis {
    /// Its name in the files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Contrast => "contrast",
            Self::Anisotropy => "anisotropy",
            Self::Obliqueness => "obliqueness",
            Self::Aspect => "aspect ratio",
            Self::Slivers => "slivers",
            Self::Collapse => "collapsed quads",
            Self::Trapezoids => "trapezoids",
            Self::Length => "unit of length",
            Self::Shift => "shift in diameters",
            Self::Load => "load",
            Self::FlushedLoad => "load, flush-to-zero",
            Self::Stiffness => "stiffness",
            Self::Grazing => "grazing length",
            Self::Contact => "length of C",
            Self::Active => "active share of C",
            Self::Dirichlet => "length of D",
            Self::Cells => "cells",
            Self::Omega => "fixed relaxation",
            Self::Sweeps => "most sweeps",
            Self::Robin => "transfer coefficient",
            Self::Switching => "switching edges",
            Self::Span => "span of the flux",
            Self::SpanBelow => "span of a negative flux",
            Self::Ends => "ends of the flux",
            Self::Above => "potential above",
            Self::Limit => "greatest flux",
            Self::Least => "least flux",
            Self::Infinite => "infinite end",
            Self::MovingWall => "switching limits",
        }
    }

    /// Moves a case to this place on the axis.
    pub fn set(self, value: f64, case: &mut ExtremeCase) {
        let (posed, effort) = (&mut case.posed, &mut case.effort);
        match self {
            Self::Contrast => set_contrast(value, case),
            Self::Anisotropy => posed.shear.anisotropy = value,
            Self::Obliqueness => posed.shear.obliqueness = value,
            Self::Aspect => posed.grid.shape = Shape::Graded { aspect: value },
            Self::Slivers => posed.grid.shape = Shape::Slivers { aspect: value },
            Self::Collapse => posed.grid.shape = Shape::Collapsed { left: value },
            Self::Trapezoids => {
                (posed.grid.n, posed.grid.shape) = (value as u32, Shape::Trapezoids);
            }
            Self::Length => posed.scales.length = value,
            Self::Shift => posed.scales.shift = value * DIAMETER,
            Self::Load => posed.scales.load = value,
            Self::FlushedLoad => (posed.scales.load, effort.flush) = (value, true),
            Self::Stiffness => posed.scales.stiffness = value,
            Self::Grazing => posed.solution = Solution::Smooth { grazing: value },
            Self::Contact => set_contact(value, case),
            Self::Active => posed.solution = active(value),
            Self::Dirichlet => set_dirichlet(value, case),
            Self::Cells if value < 4.0 => (posed.grid.n, posed.grid.cells) = (1, Cells::Quads),
            Self::Cells => posed.grid.n = (value / 4.0).sqrt() as u32,
            Self::Omega => effort.omega = Some(value),
            Self::Sweeps => effort.sweeps = Some(value as u32),
            Self::Robin => {
                posed.sides = [Hold::Contact, Hold::Neumann, Hold::Robin(value), Hold::Neumann];
            }
            Self::Switching => {
                (posed.grid.n, posed.solution) = (value as u32 / 2, Solution::Switching);
                effort.ticks = 8;
            }
            Self::MovingWall => (posed.grid.n, effort.ticks) = (value as u32 / 2, 8),
            Self::Span => posed.solution = Solution::ThreeStates([1.0, 1.0 + value]),
            Self::SpanBelow => posed.solution = Solution::ThreeStates([-1.0 - value, -1.0]),
            Self::Ends | Self::Above => set_wall(self, value, case),
            Self::Limit => posed.ends = Some([0.0, value * posed.solution.largest_flux()]),
            Self::Least => posed.ends = Some([-value, 0.0]),
            Self::Infinite => set_infinite(value, case),
        }
    }
}

/// The jump of J, or of the wall.
fn set_contrast(k: f64, case: &mut ExtremeCase) {
    let solution = &mut case.posed.solution;
    *solution = match *solution {
        Solution::Wall { above, ends, .. } => Solution::Wall { above, ends, contrast: k },
        _ => Solution::Jump(k),
    };
    // The flux of J grows like √k.
    if let Some(ends) = &mut case.posed.ends {
        *ends = ends.map(|end| end * k.sqrt());
    }
}

fn set_wall(axis: Axis, value: f64, case: &mut ExtremeCase) {
    let Solution::Wall { above, ends, contrast } = case.posed.solution else { return };
    let (above, ends) = match axis {
        Axis::Ends => (above, [-value, value]),
        _ => (value, ends),
    };
    case.posed.solution = Solution::Wall { above, ends, contrast };
    case.posed.sides = [Hold::Contact, Hold::Neumann, Hold::Dirichlet, Hold::Neumann];
}

fn set_infinite(which: f64, case: &mut ExtremeCase) {
    if which < 0.0 {
        case.posed.solution = Solution::Below;
    } else if which == 0.0 {
        case.posed.ends = Some([f64::NEG_INFINITY, f64::INFINITY]);
    }
}

/// With C none of the boundary, one edge next to the free point, the lower side, or all of it.
fn set_contact(length: f64, case: &mut ExtremeCase) {
    let posed = &mut case.posed;
    let n = posed.grid.n as usize;
    if length == 0.0 {
        posed.sides[0] = Hold::Neumann;
    } else if length < 2.0 {
        posed.split = Some(Split { of: "bottom", edges: [n - 1, n], rest: Hold::Neumann });
    } else if length > 2.0 {
        posed.sides = [Hold::Pressed; 4];
    }
}

fn active(share: f64) -> Solution {
    match share {
        0.0 => Solution::Lifted,
        1.0 => Solution::Pressed,
        _ => Solution::Smooth { grazing: 0.0 },
    }
}

/// With D none of the boundary, the lowest edge at the right, the right side, or three sides.
fn set_dirichlet(length: f64, case: &mut ExtremeCase) {
    let posed = &mut case.posed;
    let n = f64::from(posed.grid.n);
    if length > 1.0 {
        return;
    }
    let right = if length > 0.0 { Hold::Dirichlet } else { Hold::Neumann };
    posed.sides = [Hold::Contact, right, Hold::Neumann, Hold::Neumann];
    if length > 0.0 && length < 1.0 {
        posed.grid.shape = Shape::Graded { aspect: 1.0 / (n * length) };
        posed.split = Some(Split { of: "right", edges: [0, 1], rest: Hold::Neumann });
    }
}
