//! How far each axis goes: its places when it stands alone, and fewer where it is crossed with another.

use super::axis::Axis;

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

/// From equal ends over those that rounding tells apart to one beside which the other is nothing.
const SPANS: [f64; 16] =
    [0.0, 1e-300, 1e-16, 1e-15, 1e-12, 1e-8, 1e-6, 1e-4, 1e-2, 0.1, 1.0, 1e2, 1e4, 1e8, 1e12, 1e16];
/// From none over those that rounding tells from 1 to those that are next to infinite.
const ENDS: [f64; 18] = [
    0.0, 1e-310, 1e-300, 1e-150, 1e-40, 1e-16, 1e-12, 1e-6, 0.5, BELOW_1, 1.0, BEYOND_1, 1e6, 1e12,
    1e16, 1e30, 1e150, 1e300,
];
/// 1 and numbers beside it that f64 tells apart, and f32 does not; likewise 2 and 3.
const BELOW_1: f64 = 0.999_999_999_999_9;
const BEYOND_1: f64 = 1.000_000_000_000_1;
const BEYOND_2: f64 = 2.000_000_000_000_1;
const BEYOND_3: f64 = 3.000_000_000_000_1;

impl Axis {
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
            Self::Switching | Self::MovingWall => &[2.0, 8.0, 16.0, 32.0],
            Self::Span | Self::SpanBelow => &SPANS,
            Self::Ends => &ENDS,
            Self::Above => &[
                -1e300, -1e150, -1e30, -1e16, -1e8, -3.1, -BEYOND_3, -3.0, -1.0, -1e-12, 0.0,
                1e-300, 1.0, 2.0, BEYOND_2, 2.1, 1e8, 1e16, 1e30, 1e150, 1e300,
            ],
            Self::Limit | Self::Least => {
                &[1.0, BEYOND_1, 1.1, 1e2, 1e4, 1e8, 1e12, 1e16, 1e30, 1e37, 1e100, 1e300, 1e308]
            }
            Self::Infinite => &[-1.0, 0.0, 1.0],
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
            Self::Span => &[0.0, 1e-16, 1e-8, 1e-2, 1.0, 1e4, 1e12],
            Self::Ends => &[0.0, 1e-300, 1e-12, 0.5, 1.0, BEYOND_1, 1e12],
            Self::Limit => &[1.0, 1e4, 1e8, 1e16, 1e30],
            other => other.values(),
        }
    }
}
