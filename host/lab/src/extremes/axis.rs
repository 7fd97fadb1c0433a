//! The axes: which number of a problem each of them pushes, how far, and what a map cannot say of it.

use super::case::ExtremeCase;
use super::grid::Shape;
use super::posed::Hold;
use super::solution::Solution;
use signorini_scene::mesh::structured::Cells;

/// A number that is pushed.
#[derive(Debug, Clone, Copy)]
pub struct Axis {
    pub name: &'static str,
    /// A remark beyond the name; may be empty.
    pub remark: &'static str,
    /// Whether the remark is said of pairs with another axis, too.
    pub is_said_of_pairs: bool,
    /// The places on the axis when it stands alone.
    pub values: &'static [f64],
    /// Fewer places, for when it is crossed with another.
    pub crossed: &'static [f64],
    /// Moves a case to a place.
    pub set: fn(f64, &mut ExtremeCase),
}

const fn axis(
    name: &'static str,
    remark: &'static str,
    values: &'static [f64],
    set: fn(f64, &mut ExtremeCase),
) -> Axis {
    Axis { name, remark, is_said_of_pairs: false, values, crossed: values, set }
}

impl Axis {
    const fn crossed(self, crossed: &'static [f64]) -> Self {
        Self { crossed, ..self }
    }

    const fn said_of_pairs(self) -> Self {
        Self { is_said_of_pairs: true, ..self }
    }
}

const JUMPS: [f64; 13] =
    [1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6, 1e8, 1e10, 1e12];
const FEW_JUMPS: [f64; 7] = [1e-12, 1e-8, 1e-4, 1.0, 1e4, 1e8, 1e12];
/// 10⁻⁶ to 10⁶ in powers of two, so that A is stored exactly.
const STRETCHES: [f64; 13] = powers([-20, -17, -14, -11, -8, -4, 0, 4, 8, 11, 14, 17, 20]);
const FEW_STRETCHES: [f64; 7] = powers([-20, -14, -8, 0, 8, 14, 20]);
const ASPECTS: [f64; 9] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e9, 1e12];
const EDGES: [f64; 4] = [2.0, 8.0, 16.0, 32.0];
/// From equal ends over those that rounding tells apart to one beside which the other is nothing.
const SPANS: [f64; 16] =
    [0.0, 1e-300, 1e-16, 1e-15, 1e-12, 1e-8, 1e-6, 1e-4, 1e-2, 0.1, 1.0, 1e2, 1e4, 1e8, 1e12, 1e16];
/// Finite limits that nothing reaches beyond the first.
const LIMITS: [f64; 13] =
    [1.0, BEYOND_1, 1.1, 1e2, 1e4, 1e8, 1e12, 1e16, 1e30, 1e37, 1e100, 1e300, 1e308];
/// Numbers beside 1, 2 and 3 that f64 tells apart from them, and f32 does not.
const BELOW_1: f64 = 0.999_999_999_999_9;
const BEYOND_1: f64 = 1.000_000_000_000_1;
const BEYOND_2: f64 = 2.000_000_000_000_1;
const BEYOND_3: f64 = 3.000_000_000_000_1;
/// ‖(2, 1)‖: the diameter of the domain.
const DIAMETER: f64 = 2.236_067_977_499_79;

const fn powers<const N: usize>(exponents: [i32; N]) -> [f64; N] {
    let (mut all, mut at) = ([1.0; N], 0);
    while at < N {
        let size = (1_u64 << exponents[at].unsigned_abs()) as f64;
        all[at] = if exponents[at] < 0 { 1.0 / size } else { size };
        at += 1;
    }
    all
}

pub const CONTRAST: Axis =
    axis("contrast", "k of J(k): A is k left of x = 0 and 1 right of it", &JUMPS, |k, case| {
        case.set_contrast(k)
    })
    .crossed(&FEW_JUMPS);

pub const ANISOTROPY: Axis = axis(
    "anisotropy",
    "κ of T(0, κ) with A = diag(κ, 1/κ): layers at C are κ times thinner than the domain",
    &STRETCHES,
    |kappa, case| case.posed.shear.anisotropy = kappa,
)
.crossed(&FEW_STRETCHES);

pub const OBLIQUENESS: Axis = axis(
    "obliqueness",
    "s of T(s, 1)",
    &[0.0, 0.25, 1.0, 3.0, 10.0, 32.0, 100.0, 300.0, 1024.0],
    |s, case| case.posed.shear.obliqueness = s,
)
.crossed(&[0.0, 0.25, 1.0, 4.0, 32.0, 256.0, 1024.0]);

pub const ASPECT: Axis = axis(
    "aspect ratio",
    "width over height of the flattest cells; rows grow from C upwards",
    &ASPECTS,
    |aspect, case| case.posed.grid.shape = Shape::Graded { aspect },
)
.crossed(&[1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6]);

pub const SLIVERS: Axis =
    axis("slivers", "flat cells with angles near 180°", &ASPECTS, |aspect, case| {
        case.posed.grid.shape = Shape::Slivers { aspect };
    });

pub const COLLAPSE: Axis = axis(
    "collapsed quads",
    "one side over the others; 0 is a triangle with four corners, below it the cell crosses itself",
    &[-0.1, 0.0, 1e-18, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1e-1],
    |left, case| case.posed.grid.shape = Shape::Collapsed { left },
);

pub const TRAPEZOIDS: Axis = axis(
    "trapezoids",
    "rows of a grid whose cells never become parallelograms",
    &[4.0, 8.0, 16.0, 32.0, 64.0],
    |rows, case| (case.posed.grid.n, case.posed.grid.shape) = (rows as u32, Shape::Trapezoids),
);

pub const LENGTH: Axis = axis(
    "unit of length",
    "",
    &[1e-300, 1e-150, 1e-50, 1e-15, 1e-6, 1.0, 1e6, 1e15, 1e50, 1e150, 1e300],
    |length, case| case.posed.scales.length = length,
)
.crossed(&[1e-15, 1e-10, 1e-5, 1.0, 1e5, 1e10, 1e15]);

pub const SHIFT: Axis =
    axis("shift in diameters", "", &[0.0, 1.0, 1e3, 1e6, 1e9, 1e12, 1e15], |diameters, case| {
        case.posed.scales.shift = diameters * DIAMETER
    });

pub const LOAD: Axis = axis(
    "load",
    "",
    &[
        1e-320, 1e-310, 1e-300, 1e-150, 1e-44, 1e-40, 1e-30, 1e-15, 1.0, 1e10, 1e15, 1e20, 1e30,
        1e37, 1e150, 1e300,
    ],
    |load, case| case.posed.scales.load = load,
)
.crossed(&[1e-310, 1e-150, 1e-40, 1e-20, 1.0, 1e15, 1e30]);

pub const FLUSHED_LOAD: Axis = axis(
    "load, flush-to-zero",
    "",
    &[1e-320, 1e-308, 1e-300, 1e-150, 1e-44, 1e-40, 1e-37, 1e-30, 1e-15, 1.0],
    |load, case| (case.posed.scales.load, case.effort.flush) = (load, true),
);

pub const STIFFNESS: Axis = axis(
    "stiffness",
    "",
    &[
        1e-310, 1e-300, 1e-150, 1e-44, 1e-30, 1e-15, 1e-10, 1e-5, 1.0, 1e5, 1e10, 1e15, 1e30, 1e37,
        1e150, 1e300,
    ],
    |stiffness, case| case.posed.scales.stiffness = stiffness,
);

pub const GRAZING: Axis = axis(
    "grazing length",
    "length of the part of C with neither force nor gap",
    &[0.0, 0.25, 0.5, 1.0],
    |grazing, case| case.posed.solution = Solution::Smooth { grazing },
);

pub const CONTACT: Axis = axis(
    "length of C",
    "none, one edge, the lower side, the whole boundary",
    &[0.0, 0.0625, 2.0, 6.0],
    |length, case| case.set_contact(length),
);

pub const ACTIVE: Axis = axis("active share of C", "", &[0.0, 0.5, 1.0], |share, case| {
    case.posed.solution = match share {
        0.0 => Solution::Lifted,
        1.0 => Solution::Pressed,
        _ => Solution::Smooth { grazing: 0.0 },
    };
});

pub const DIRICHLET: Axis = axis(
    "length of D",
    "none (contact alone holds the domain), one tiny edge, one side, three sides",
    &[0.0, 1e-6, 1e-3, 0.0625, 1.0, 4.0],
    |length, case| case.set_dirichlet(length),
);

pub const CELLS: Axis = axis(
    "cells",
    "beyond 10⁵ cells a solve is cut off after 3·10⁸ updates of unknowns",
    &[2.0, 4.0, 64.0, 1024.0, 16_384.0, 262_144.0, 1_960_000.0],
    |cells, case| match cells < 4.0 {
        true => (case.posed.grid.n, case.posed.grid.cells) = (1, Cells::Quads),
        false => case.posed.grid.n = (cells / 4.0).sqrt() as u32,
    },
)
.crossed(&[4.0, 16.0, 64.0, 256.0, 1024.0, 4096.0]);

pub const OMEGA: Axis = axis(
    "fixed relaxation",
    "an ω from the scene's setting",
    &[-1.0, 0.0, 1e-12, 1e-6, 1e-3, 0.1, 1.0, 1.9, 1.99, 1.9999, 2.0 - 1e-6, 2.0 - 1e-9, 2.0],
    |omega, case| case.effort.omega = Some(omega),
)
.crossed(&[1e-3, 0.1, 1.0, 1.9, 1.99, 1.9999, 2.0 - 1e-6])
.said_of_pairs();

pub const SWEEPS: Axis = axis("most sweeps", "", &[1.0, 10.0, 100.0, 1000.0], |sweeps, case| {
    case.effort.sweeps = Some(sweeps as u32);
});

pub const ROBIN: Axis =
    axis("transfer coefficient", "the upper side transfers, no side is held", &JUMPS, |h, case| {
        case.posed.sides = [Hold::Contact, Hold::Neumann, Hold::Robin(h), Hold::Neumann]
    })
    .crossed(&FEW_JUMPS);

pub const SWITCHING: Axis = axis(
    "switching edges",
    "ticks: every contact edge opens or closes from each to the next",
    &EDGES,
    |edges, case| {
        (case.posed.grid.n, case.posed.solution) = (edges as u32 / 2, Solution::Switching);
        case.effort.ticks = 8;
    },
);

pub const SPAN: Axis = axis(
    "span of the flux",
    "hi − lo over lo where lo ≤ σ·n ≤ hi on C, which is above, at and below the gap",
    &SPANS,
    |span, case| case.posed.solution = Solution::ThreeStates([1.0, 1.0 + span]),
)
.crossed(&[0.0, 1e-16, 1e-8, 1e-2, 1.0, 1e4, 1e12]);

pub const SPAN_BELOW: Axis = axis("span of a negative flux", "", &SPANS, |span, case| {
    case.posed.solution = Solution::ThreeStates([-1.0 - span, -1.0]);
});

/// From none over those that rounding tells from 1 to those that are next to infinite.
pub const ENDS: Axis = axis(
    "ends of the flux",
    "hi = −lo over the flux that the wall asks for",
    &[
        0.0, 1e-310, 1e-300, 1e-150, 1e-40, 1e-16, 1e-12, 1e-6, 0.5, BELOW_1, 1.0, BEYOND_1, 1e6,
        1e12, 1e16, 1e30, 1e150, 1e300,
    ],
    |end, case| case.set_wall(None, Some([-end, end])),
)
.crossed(&[0.0, 1e-300, 1e-12, 0.5, 1.0, BEYOND_1, 1e12]);

pub const ABOVE: Axis = axis(
    "potential above",
    "of a wall whose flux is between −2 and 3",
    &[
        -1e300, -1e150, -1e30, -1e16, -1e8, -3.1, -BEYOND_3, -3.0, -1.0, -1e-12, 0.0, 1e-300, 1.0,
        2.0, BEYOND_2, 2.1, 1e8, 1e16, 1e30, 1e150, 1e300,
    ],
    |above, case| case.set_wall(Some(above), None),
);

pub const LIMIT: Axis = axis(
    "greatest flux",
    "hi over the largest flux: a limit that is not reached",
    &LIMITS,
    |hi, case| case.posed.ends = Some([0.0, hi * case.posed.solution.largest_flux()]),
)
.crossed(&[1.0, 1e4, 1e8, 1e16, 1e30])
.said_of_pairs();

pub const LEAST: Axis =
    axis("least flux", "the same with all signs turned", &LIMITS, |hi, case| {
        case.posed.ends = Some([-hi, 0.0]);
    })
    .said_of_pairs();

pub const INFINITE: Axis =
    axis("infinite end", "the lower one, both, the upper one", &[-1.0, 0.0, 1.0], |which, case| {
        if which < 0.0 {
            case.posed.solution = Solution::Below;
        } else if which == 0.0 {
            case.posed.ends = Some([f64::NEG_INFINITY, f64::INFINITY]);
        }
    });

pub const MOVING_WALL: Axis = axis(
    "switching limits",
    "ticks: a wall at either end of its flux in turn",
    &EDGES,
    |edges, case| (case.posed.grid.n, case.effort.ticks) = (edges as u32 / 2, 8),
);
