//! Exact solutions whose flux has a limit, lo ≤ σ·n ≤ hi on y = 0, n = (0, −1), ψ = 0.
//!
//! ```text
//!   three states:  −(c y + β (x η + y ξ − Re s)) with x + iy = a sin(ξ + iη), s = √(z² − a²), a = 0.55,
//!                  β = (lo − hi)/π, c = (lo + hi)/2: above the gap for x < −a, in contact between, below it for x > a
//!   a wall:        t + σ (1 − y), the flux σ as near to −t as lo and hi let it be: Duvaut and Lions in one dimension
//! ```

use super::texts::Texts;

/// u and σ·n = −∂u/∂y of all three states, with the r^{3/2} of both transitions.
pub(super) fn three_states(x: &str, y: &str, [lo, hi]: [f64; 2]) -> Texts {
    const A: &str = "0.55";
    let (beta, c) = ((lo - hi) / std::f64::consts::PI, 0.5 * lo + 0.5 * hi);
    let size = format!("((({x}-{A})^2+{y}^2)^0.25*(({x}+{A})^2+{y}^2)^0.25)");
    let angle = format!("(0.5*atan2({y},{x}-{A}) + 0.5*atan2({y},{x}+{A}))");
    let (re, im) = (format!("{size}*cos{angle}"), format!("{size}*sin{angle}"));
    let xi = format!("(pi/2 - atan2({y} + {im}, {x} + {re}))");
    let eta = format!("(0.5*ln((({x} + {re})^2 + ({y} + {im})^2)/{A}^2))");
    Texts {
        u: format!("-({c:e}*{y} + {beta:e}*({x}*{eta} + {y}*{xi} - {re}))"),
        gradient: [format!("-{beta:e}*{eta}"), format!("-({c:e} + {beta:e}*{xi})")],
        f: "0".to_owned(),
    }
}

/// The wall with `above`, a number or an expression of t, given at y = 1.
pub(super) fn wall(y: &str, above: &str, [lo, hi]: [f64; 2]) -> Texts {
    let flux = format!("max({lo:e}, min({hi:e}, -({above})))");
    // In contact u = t y has no term that cancels.
    let beyond = format!("(min({above} + {hi:e}, 0) + max({above} + {lo:e}, 0))");
    Texts {
        u: format!("({beyond} - {flux}*{y})"),
        gradient: ["0".to_owned(), format!("-{flux}")],
        f: "0".to_owned(),
    }
}
