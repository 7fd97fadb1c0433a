//! By how much s differs from that of the step before, on one cell.

use signorini_kernel::Real;

/// Δ = s − s_old on one cell.
pub(super) struct Change<R> {
    /// Its mean.
    pub mean: R,
    /// ‖Δ − mean‖²/|T| on a cell whose area element is constant.
    pub variance: R,
    /// Size of the terms of `mean`.
    pub size: R,
}

/// a − b
pub(super) fn minus<R: Real, const N: usize>(mut a: [R; N], b: [R; N]) -> [R; N] {
    a.iter_mut().zip(b).for_each(|(a, b)| *a -= b);
    a
}

/// The mean of two numbers.
pub(super) fn mean<R: Real, const N: usize>(mut a: [R; N], b: [R; N]) -> [R; N] {
    a.iter_mut().zip(b).for_each(|(a, b)| *a = R::HALF * *a + R::HALF * b);
    a
}

/// ‖Δ − mean‖² = |T|/36 Σ_{i<j} (Δ_i − Δ_j)²
pub(super) fn of_triangle<R: Real>(now: [R; 3], old: [R; 3]) -> Change<R> {
    let [a, b, c] = minus(now, old);
    let square = |x: R| x * x;
    let differences = square(a - b) + square(b - c) + square(c - a);
    Change {
        mean: (a + b + c) * R::THIRD,
        variance: differences / R::from_count(36),
        size: size(&now, &old) * R::THIRD,
    }
}

/// With X = x̂ − ½, Y = ŷ − ½ and P(Z) = Z² − 1/12 as in [`super::quad`], Δ is a combination of 1, X, Y, XY, P(X), P(Y), P(X)Y and P(Y)X,
/// with the squares 1, 1/12, 1/12, 1/144, 1/180, 1/180, 1/2160 and 1/2160; the area element is 1 + tilt·(X, Y) over its mean.
pub(super) fn of_quad<R: Real>(now: [[R; 4]; 2], old: [[R; 4]; 2], tilt: [R; 2]) -> Change<R> {
    let [[s0, s1, s2, s3], [d0, d1, d2, d3]] = [minus(now[0], old[0]), minus(now[1], old[1])];
    let (over, square) = (|n: u32| R::ONE / R::from_count(n), |x: R| x * x);
    let two_thirds = R::TWO * R::THIRD;
    let along_x = R::HALF * (s1 + s2 - s0 - s3) + two_thirds * (d1 - d3);
    let along_y = R::HALF * (s2 + s3 - s0 - s1) + two_thirds * (d2 - d0);
    let twist = s0 - s1 + s2 - s3;
    let constant = R::QUARTER * (s0 + s1 + s2 + s3) + R::THIRD * (d0 + d1 + d2 + d3);
    let bent = square(d0 + d2) + square(d1 + d3);
    let arched = square(d2 - d0) + square(d1 - d3);
    Change {
        mean: constant + over(12) * (tilt[0] * along_x + tilt[1] * along_y),
        variance: over(12) * (square(along_x) + square(along_y))
            + over(144) * square(twist)
            + over(45) * bent
            + over(135) * arched,
        size: R::QUARTER * size(&now[0], &old[0]) + R::THIRD * size(&now[1], &old[1]),
    }
}

fn size<R: Real>(now: &[R], old: &[R]) -> R {
    now.iter().chain(old).fold(R::ZERO, |sum, value| sum + value.magnitude())
}
