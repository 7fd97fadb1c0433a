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
}

/// ‖(2, 1)‖: the diameter of the domain.
const DIAMETER: f64 = 2.236_067_977_499_79;

const JUMPS: [f64; 13] =
    [1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6, 1e8, 1e10, 1e12];
const FEW_JUMPS: [f64; 7] = [1e-12, 1e-8, 1e-4, 1.0, 1e4, 1e8, 1e12];

/// 2⁻²⁰ to 2²⁰: 10⁻⁶ to 10⁶.
const STRETCHES: [f64; 13] = [
    9.536_743_164_062_5e-7,
    7.629_394_531_25e-6,
    6.103_515_625e-5,
    4.882_812_5e-4,
    3.906_25e-3,
    6.25e-2,
    1.0,
    16.0,
    256.0,
    2048.0,
    16_384.0,
    131_072.0,
    1_048_576.0,
];

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
        }
    }

    /// The places on it when it stands alone.
    pub fn values(self) -> &'static [f64] {
        match self {
            Self::Contrast => &JUMPS,
            Self::Anisotropy => &STRETCHES,
            Self::Obliqueness => &[0.0, 0.25, 1.0, 3.0, 10.0, 32.0, 100.0, 300.0, 1024.0],
            Self::Aspect | Self::Slivers => &[1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e9, 1e12],
            Self::Collapse => &[-0.1, 0.0, 1e-18, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1e-1],
            Self::Trapezoids => &[4.0, 8.0, 16.0, 32.0, 64.0],
            Self::Length => {
                &[1e-300, 1e-150, 1e-50, 1e-15, 1e-6, 1.0, 1e6, 1e15, 1e50, 1e150, 1e300]
            }
            Self::Shift => &[0.0, 1.0, 1e3, 1e6, 1e9, 1e12, 1e15],
            Self::Load => &[
                1e-320, 1e-310, 1e-300, 1e-150, 1e-44, 1e-40, 1e-30, 1e-15, 1.0, 1e10, 1e15, 1e20,
                1e30, 1e37, 1e150, 1e300,
            ],
            Self::FlushedLoad => {
                &[1e-320, 1e-308, 1e-300, 1e-150, 1e-44, 1e-40, 1e-37, 1e-30, 1e-15, 1.0]
            }
            Self::Stiffness => &[
                1e-310, 1e-300, 1e-150, 1e-44, 1e-30, 1e-15, 1e-10, 1e-5, 1.0, 1e5, 1e10, 1e15,
                1e30, 1e37, 1e150, 1e300,
            ],
            Self::Grazing => &[0.0, 0.25, 0.5, 1.0],
            Self::Contact => &[0.0, 0.0625, 2.0, 6.0],
            Self::Active => &[0.0, 0.5, 1.0],
            Self::Dirichlet => &[0.0, 1e-6, 1e-3, 0.0625, 1.0, 4.0],
            Self::Cells => &[2.0, 4.0, 64.0, 1024.0, 16_384.0, 262_144.0, 1_960_000.0],
            Self::Omega => &[
                -1.0,
                0.0,
                1e-12,
                1e-6,
                1e-3,
                0.1,
                1.0,
                1.9,
                1.99,
                1.9999,
                1.999_999,
                1.999_999_999,
                2.0,
            ],
            Self::Sweeps => &[1.0, 10.0, 100.0, 1000.0],
            Self::Robin => &JUMPS,
            Self::Switching => &[2.0, 8.0, 16.0, 32.0],
        }
    }

    /// The places on it when it is crossed with another.
    pub fn crossed(self) -> &'static [f64] {
        match self {
            Self::Contrast | Self::Robin => &FEW_JUMPS,
            Self::Anisotropy => &[
                STRETCHES[0],
                STRETCHES[2],
                STRETCHES[4],
                1.0,
                STRETCHES[8],
                STRETCHES[10],
                STRETCHES[12],
            ],
            Self::Obliqueness => &[0.0, 0.25, 1.0, 4.0, 32.0, 256.0, 1024.0],
            Self::Aspect => &[1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6],
            Self::Length => &[1e-15, 1e-10, 1e-5, 1.0, 1e5, 1e10, 1e15],
            Self::Load => &[1e-310, 1e-150, 1e-40, 1e-20, 1.0, 1e15, 1e30],
            Self::Cells => &[4.0, 16.0, 64.0, 256.0, 1024.0, 4096.0],
            Self::Omega => &[1e-3, 0.1, 1.0, 1.9, 1.99, 1.9999, 1.999_999],
            other => other.values(),
        }
    }

    /// Moves a case to this place on the axis.
    pub fn set(self, value: f64, case: &mut ExtremeCase) {
        let (posed, effort) = (&mut case.posed, &mut case.effort);
        match self {
            Self::Contrast => posed.solution = Solution::Jump(value),
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
        }
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
