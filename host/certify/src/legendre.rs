//! Legendre's polynomials on \[0, 1\], and their integrals.

/// Polynomials that data are fitted with, a direction: they have a wave of one cell to 1e−4 of it, of half a cell to 1e−6.
pub const DEGREES: usize = 8;

/// P_0 … of the variable 2t − 1.
pub fn legendre(t: f64) -> [f64; DEGREES] {
    let x = 2.0 * t - 1.0;
    let mut all = [1.0; DEGREES];
    all[1] = x;
    for n in 2..DEGREES {
        let k = n as f64;
        all[n] = ((2.0 * k - 1.0) * x * all[n - 1] - (k - 1.0) * all[n - 2]) / k;
    }
    all
}

/// ∫₀ᵗ of these: t, and 2t(t − 1) P′_n(2t − 1)/(n(n + 1)), which is 0 at both ends.
pub fn integrated(t: f64) -> [f64; DEGREES] {
    let (x, values) = (2.0 * t - 1.0, legendre(t));
    let (mut all, mut slope) = ([t; DEGREES], 0.0);
    for n in 1..DEGREES {
        // P′_n = n P_{n−1} + x P′_{n−1}
        slope = n as f64 * values[n - 1] + x * slope;
        all[n] = 2.0 * t * (t - 1.0) * slope / (n * (n + 1)) as f64;
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_problem::quadrature::gauss;
    use signorini_tolerances::solve::RULE;

    #[test]
    fn integrals_are_those_of_the_polynomials() {
        for t in [0.0, 0.1, 0.5, 0.93, 1.0] {
            let found = integrated(t);
            for (n, found) in found.into_iter().enumerate() {
                let rule = gauss(DEGREES);
                let sum: f64 = rule.iter().map(|[x, weight]| weight * t * legendre(t * x)[n]).sum();
                RULE.check(format_args!("{n} at {t}"), found - sum);
            }
        }
    }
}
