//! What the 8 Gauss points of a panel miss of data between them.
//!
//! w̃ is the polynomial of degree 7 through the values of w at the points, and another one through those of w′ = dw/dt. The rule is exact for squares
//! of such polynomials, so that ‖w̃ − p‖² = Σ (w − p)² weights for each p among them, and
//! ```text
//!   ‖w − w̃‖ ≤ 2 (|panel|)^½ max |w − p|.
//! ```
//! p is the part of degree 7 of the Chebyshev series, of which the modulus in an ellipse bounds the rest, |aₖ| ≤ 2Mρ⁻ᵏ and |Tₖ′| ≤ k²;
//! or the parabola of the Taylor form.

use signorini_problem::Sum;
use signorini_problem::quadrature::DATA_POINTS;
use signorini_scene::expression::enclosure::Region;

/// Ellipses around a panel, by ρ, that are tried.
const ELLIPSES: [f64; 4] = [16.0, 64.0, 5.5, 2.5];
/// Part of the modulus beyond which no ellipse is tried: rounding.
const ROUNDING: f64 = 1e-13;

/// ∫(w − w̃)² and ∫(w′ − w̃′)² at most, over a panel of such a width in t, of data that run along `direction` while t grows by 1.
pub fn missed(data: &Sum, panel: &Region, direction: [f64; 2], width: f64) -> [f64; 2] {
    if data.degree() < DATA_POINTS as f64 {
        return [0.0; 2];
    }
    let mut most = [f64::INFINITY; 2];
    for rho in ELLIPSES {
        let size = 2.0 * data.bend(panel, rho);
        let found = [size * tail(rho, 0), size * tail(rho, 2) * 2.0 / width];
        most = [0, 1].map(|k| if found[k] < most[k] { found[k] } else { most[k] });
        if most[1] * width <= ROUNDING * size {
            break;
        }
    }
    let forms = data.enclose_slope(panel, direction);
    let of_forms = forms.map(|form| match form.is_finite() {
        true => 0.5 * form.remainder.width(),
        false => f64::INFINITY,
    });
    [0, 1].map(|k| 4.0 * width * most[k].min(of_forms[k]).powi(2))
}

/// Σ ρ⁻ᵏ from k = 8 on, or Σ k²ρ⁻ᵏ from k = 9 on.
fn tail(rho: f64, power: i32) -> f64 {
    let (q, points) = (1.0 / rho, DATA_POINTS as i32);
    let rest = 1.0 - q;
    match power {
        0 => q.powi(points) / rest,
        _ => {
            let n = f64::from(points + 1);
            let sum = n * n / rest + 2.0 * n * q / rest.powi(2) + q * (1.0 + q) / rest.powi(3);
            q.powi(points + 1) * sum
        }
    }
}

/// Sums of what panels miss.
pub fn sum(panels: impl Iterator<Item = [f64; 2]>) -> [f64; 2] {
    panels.fold([0.0; 2], |[w, slope], of| [w + of[0], slope + of[1]])
}
