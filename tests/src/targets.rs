//! The numbers to reproduce, each computed by independent programs.

use crate::exact::Exact;
use crate::grid::Cells;

/// A case of the catalogue on 2n × n squares of (−1, 1) × (0, 1).
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// The cells.
    pub cells: Cells,
    /// The case.
    pub case: TabledCase,
    /// n.
    pub n: u32,
    /// |u − u_h|_{1,h}.
    pub h1: f64,
    /// ‖u − u_h‖.
    pub l2: f64,
    /// Σ λ_h |E|.
    pub force: f64,
}

/// The cases with a full table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TabledCase {
    /// A.
    A,
    /// B.
    B,
    /// H(0.55).
    H,
    /// H_g(0.55).
    HGap,
}

impl TabledCase {
    /// Its exact solution.
    pub fn exact(self) -> Exact {
        match self {
            Self::A => Exact::a(),
            Self::B => Exact::b(),
            Self::H => Exact::h(0.55),
            Self::HGap => Exact::h_gap(0.55),
        }
    }
}

/// Four meshes in a row: n = 8, 16, 32, 64 with (h1, l2, force).
const fn row(cells: Cells, case: TabledCase, v: [(f64, f64, f64); 4]) -> [Target; 4] {
    const fn target(cells: Cells, case: TabledCase, n: u32, v: (f64, f64, f64)) -> Target {
        Target { cells, case, n, h1: v.0, l2: v.1, force: v.2 }
    }
    [
        target(cells, case, 8, v[0]),
        target(cells, case, 16, v[1]),
        target(cells, case, 32, v[2]),
        target(cells, case, 64, v[3]),
    ]
}

/// Contact on y = 0, Dirichlet elsewhere.
#[rustfmt::skip]
pub const CATALOGUE: [[Target; 4]; 8] = [
    row(Cells::Triangles, TabledCase::A, [
        (1.72375e-1, 6.27152e-3, 0.249009), (8.69757e-2, 1.60512e-3, 0.249693),
        (4.36144e-2, 4.04491e-4, 0.249917), (2.18266e-2, 1.01391e-4, 0.249978)]),
    row(Cells::Triangles, TabledCase::B, [
        (8.69604e-2, 3.02135e-3, 1.000378), (4.37635e-2, 7.60749e-4, 1.000088),
        (2.19455e-2, 1.90684e-4, 1.000021), (1.09877e-2, 4.77197e-5, 1.000005)]),
    row(Cells::Triangles, TabledCase::H, [
        (1.92773e-1, 7.78699e-3, 0.958411), (9.74473e-2, 1.97915e-3, 0.952483),
        (4.88908e-2, 4.96205e-4, 0.950931), (2.44903e-2, 1.25870e-4, 0.950367)]),
    row(Cells::Triangles, TabledCase::HGap, [
        (7.89787e-2, 3.55531e-3, 0.943432), (4.06534e-2, 8.76970e-4, 0.949018),
        (2.05596e-2, 2.20735e-4, 0.950045), (1.03607e-2, 6.54656e-5, 0.950143)]),
    row(Cells::Quads, TabledCase::A, [
        (1.22687e-1, 3.49463e-3, 0.251941), (6.14230e-2, 8.75774e-4, 0.250498),
        (3.07214e-2, 2.19030e-4, 0.250124), (1.53620e-2, 5.47563e-5, 0.250031)]),
    row(Cells::Quads, TabledCase::B, [
        (5.05215e-2, 1.30822e-3, 0.999581), (2.53347e-2, 3.28758e-4, 0.999894),
        (1.26856e-2, 8.24016e-5, 0.999973), (6.34733e-3, 2.06269e-5, 0.999993)]),
    row(Cells::Quads, TabledCase::H, QUAD_H),
    row(Cells::Quads, TabledCase::HGap, QUAD_H),
];

/// x² − y² lies in the space of quads, so H and H_g have the same errors there.
#[rustfmt::skip]
const QUAD_H: [(f64, f64, f64); 4] = [
    (4.84809e-2, 1.72908e-3, 0.944095), (2.41546e-2, 3.49377e-4, 0.950322),
    (1.20886e-2, 8.79228e-5, 0.950240), (6.03066e-3, 2.61708e-5, 0.950236)];

/// The active contact edges on triangles at n = 8, 16, 32, 64.
pub const ACTIVE: [(TabledCase, [usize; 4]); 2] =
    [(TabledCase::A, [9, 17, 33, 65]), (TabledCase::H, [10, 18, 36, 72])];

/// ‖σ − σ_h‖ of A at n = 32. Where f = 0 and A = I it is the error of the gradient.
pub const FLUX_OF_A: [(Cells, f64); 2] =
    [(Cells::Triangles, 3.98790e-2), (Cells::Quads, 1.71162e-2)];

/// J(k) on triangles, n = 32: (k, energy error, force).
pub const JUMPS: [(f64, f64, f64); 4] = [
    (1e-4, 4.38607e-2, 0.010000),
    (1e-2, 4.10550e-2, 0.100001),
    (1e2, 3.67042e-3, 10.000112),
    (1e4, 3.97987e-4, 100.000169),
];

/// T(s, κ) on triangles: (s, κ, of, n, energy error, force).
pub const TRANSFORMED: [(f64, f64, TabledCase, u32, Option<f64>, f64); 3] = [
    (0.5, 1.0, TabledCase::A, 32, Some(4.69682e-2), 0.25058),
    (3.0, 1.0, TabledCase::H, 32, Some(1.63102e-1), 0.942766),
    (0.0, 10.0, TabledCase::H, 8, None, 1.8555),
];

/// B mirrored on the smoothly moved grid, Neumann on the sides: cells, n, unknowns, then
/// |u − u_h|_{1,h}, ‖u − u_h‖, ‖σ − σ_h‖.
pub const MOVED: [(Cells, u32, usize, [f64; 3]); 4] = [
    (Cells::Triangles, 16, 1552, [4.4461e-2, 8.9491e-4, 4.4461e-2]),
    (Cells::Triangles, 64, 24640, [1.1159e-2, 5.6271e-5, 1.1159e-2]),
    (Cells::Quads, 16, 1040, [3.0974e-2, 4.2574e-4, 2.6959e-2]),
    (Cells::Quads, 64, 16448, [7.7623e-3, 2.6676e-5, 6.7556e-3]),
];

/// The benchmark of Ben Belgacem and Renard (unit square, u = 0 on top, no flux on the sides,
/// contact below, f = 2π sin 2πx): contact force on n × n cut squares; 0.2658309 half-analytically.
pub const BENCHMARK: [(u32, f64); 6] = [
    (8, 0.264976),
    (16, 0.265618),
    (32, 0.265825),
    (64, 0.265796),
    (128, 0.265830),
    (256, 0.265829),
];
