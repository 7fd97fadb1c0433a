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
use signorini_scene::expression::enclosure::{Form, Region};

/// Ellipses around a panel, by ρ, that are tried.
const ELLIPSES: [f64; 4] = [16.0, 64.0, 5.5, 2.5];
/// Part of the modulus beyond which no ellipse is tried: rounding.
const ROUNDING: f64 = 1e-13;

/// ∫(w − w̃)² and ∫(w′ − w̃′)² at most, over a panel of such a width in t, of data that run along `direction` while t grows by 1.
pub fn missed(data: &Sum, panel: &Region, direction: [f64; 2], width: f64) -> [f64; 2] {
    if data.degree() < DATA_POINTS as f64 {
        return [0.0; 2];
    }
    let [w, slope] = by_ellipses(|rho| data.bend(panel, rho));
    let [of_w, of_slope] = data.enclose_slope(panel, direction).each_ref().map(by_form);
    [w.min(of_w), (slope * 2.0 / width).min(of_slope)].map(|most| square(most, width))
}

/// ∫(w − w̃)² at most.
pub fn value_missed(data: &Sum, panel: &Region, width: f64) -> f64 {
    if data.degree() < DATA_POINTS as f64 {
        return 0.0;
    }
    let [most, _] = by_ellipses(|rho| data.bend(panel, rho));
    square(most.min(by_form(&data.enclose(panel))), width)
}

/// The same of a form.
pub fn form_missed(form: &Form, width: f64) -> f64 {
    square(by_form(form), width)
}

fn square(most: f64, width: f64) -> f64 {
    4.0 * width * most * most
}

/// max |w − p| and max |dw/dξ − p|, ξ from −1 to 1, from the modulus of w less a linear function.
fn by_ellipses(bend: impl Fn(f64) -> f64) -> [f64; 2] {
    let mut most = [f64::INFINITY; 2];
    for rho in ELLIPSES {
        let size = 2.0 * bend(rho);
        let found = [size * tail(rho, 0), size * tail(rho, 2)];
        most = [0, 1].map(|k| if found[k] < most[k] { found[k] } else { most[k] });
        if most[1] <= ROUNDING * size {
            break;
        }
    }
    most
}

/// max |w − p| with the parabola of a form.
fn by_form(form: &Form) -> f64 {
    if form.is_finite() { 0.5 * form.remainder.width() } else { f64::INFINITY }
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
