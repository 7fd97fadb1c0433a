//! The part of data that 8 Gauss points of a panel miss between them.
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
/// Part of the modulus below which no more is tried.
const NOTHING: f64 = 1e-9;

/// ∫(w − w̃)² and ∫(w′ − w̃′)² at most, over a panel of such a width in t, of data that run along `direction` while t grows by 1.
pub fn missed(data: &Sum, panel: &Region, direction: [f64; 2], width: f64) -> [f64; 2] {
    if data.degree() < DATA_POINTS as f64 {
        return [0.0; 2];
    }
    let (size, [w, slope]) = by_ellipses(|rho| data.bend(panel, rho));
    let [of_w, of_slope] = match slope.is_finite() && slope <= NOTHING * size {
        true => [f64::INFINITY; 2],
        false => data.enclose_slope(panel, direction).each_ref().map(by_form),
    };
    [w.min(of_w), (slope * 2.0 / width).min(of_slope)].map(|most| square(most, width))
}

/// ∫(w − w̃)² at most.
pub fn value_missed(data: &Sum, panel: &Region, width: f64) -> f64 {
    if data.degree() < DATA_POINTS as f64 {
        return 0.0;
    }
    let (_, [most, _]) = by_ellipses(|rho| data.bend(panel, rho));
    square(most.min(by_form(&data.enclose(panel))), width)
}

/// The part that is missed of a form.
pub fn form_missed(form: &Form, width: f64) -> f64 {
    square(by_form(form), width)
}

/// 4 |panel| max², rounded up to 10 bits: in other units, which are powers of two, it has the same digits.
fn square(most: f64, width: f64) -> f64 {
    const BITS: u64 = 1 << 42;
    let up = f64::from_bits((most.to_bits() & !(BITS - 1)) + BITS);
    let most = if most == 0.0 || most.is_infinite() { most } else { up };
    4.0 * width * most * most
}

/// The modulus of w less a linear function in some ellipse, max |w − p| and max |dw/dξ − p|, ξ from −1 to 1.
fn by_ellipses(bend: impl Fn(f64) -> f64) -> (f64, [f64; 2]) {
    let (mut least, mut most) = (f64::INFINITY, [f64::INFINITY; 2]);
    for rho in ELLIPSES {
        let size = 2.0 * bend(rho);
        let found = [size * tail(rho, 0), size * tail(rho, 2)];
        most = [0, 1].map(|k| if found[k] < most[k] { found[k] } else { most[k] });
        least = least.min(size);
        if most[1] <= NOTHING * least {
            break;
        }
    }
    (least, most)
}

/// max |w − p| with the parabola of a form; 0 where that is rounding of the values.
fn by_form(form: &Form) -> f64 {
    const ROUNDING: f64 = 1e-14;
    let most = 0.5 * form.remainder.width();
    match form.is_finite() {
        true if most <= ROUNDING * form.range().size() => 0.0,
        true => most,
        false => f64::INFINITY,
    }
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

/// A part of an edge, and what its own 8 points miss: ∫(w − w̃)² and ∫(w′ − w̃′)² over it, infinite where w is singular.
#[derive(Debug, Clone, Copy)]
pub struct Part {
    /// From where to where.
    pub range: [f64; 2],
    /// The norm of the part that is missed.
    pub missed: [f64; 2],
    /// ∫w′² by the points.
    pub energy: f64,
}

impl Part {
    /// Whether w is singular in it, as far as anything is proved.
    pub fn is_singular(&self) -> bool {
        !self.missed.iter().all(|missed| missed.is_finite())
    }

    fn size(&self) -> f64 {
        self.missed[0] + self.missed[1]
    }

    /// Whether it is right beside another one.
    fn is_beside(&self, other: &Self) -> bool {
        let near = NEAR * self.width();
        other.range[0] - near < self.range[1] && self.range[0] < other.range[1] + near
    }

    fn width(&self) -> f64 {
        self.range[1] - self.range[0]
    }
}

/// Parts that smooth data have, all of one length.
pub const PANELS: u32 = 4;
/// Parts of an edge, at most; and halvings of singular ones, and of all.
const MOST: usize = 128;
const SINGULAR: i32 = 26;
const HALVINGS: i32 = 50;
/// Widths of a part within which a singular one is beside it.
const NEAR: f64 = 2.0;
/// Part of (∫w′²)^½ that is little.
const LITTLE: f64 = 1e-5;

/// Parts of an edge, ascending, cut where most is missed until that is little; `of` tells a part from its range, and whether it is as
/// short as coordinates tell apart. Right beside singular parts nothing is proved: what `by_points` sees stands for it.
pub fn parts(
    of: impl Fn([f64; 2]) -> (Part, bool),
    by_points: impl Fn([f64; 2]) -> [f64; 2],
) -> Vec<Part> {
    let share = 1.0 / f64::from(PANELS);
    let first = (0..PANELS).map(|k| of([k, k + 1].map(|end| share * f64::from(end))));
    let (mut open, mut done): (Vec<_>, Vec<Part>) = (first.collect(), Vec::new());
    while open.len() + done.len() < MOST {
        let sum = |of: fn(&Part) -> f64| -> f64 {
            open.iter().map(|(part, _)| of(part)).sum::<f64>() + done.iter().map(of).sum::<f64>()
        };
        if sum(Part::size) <= LITTLE * LITTLE * sum(|part| part.energy) {
            break;
        }
        let worst = (0..open.len()).max_by(|&i, &j| open[i].0.size().total_cmp(&open[j].0.size()));
        let Some((part, is_tiny)) = worst.map(|at| open.swap_remove(at)) else { break };
        let least = 0.5_f64.powi(if part.is_singular() { SINGULAR } else { HALVINGS });
        if is_tiny || part.width() <= least {
            done.push(part);
            continue;
        }
        let [from, to] = part.range;
        let middle = 0.5 * (from + to);
        open.extend([[from, middle], [middle, to]].map(&of));
    }
    done.extend(open.into_iter().map(|(part, _)| part));
    done.sort_by(|a, b| a.range[0].total_cmp(&b.range[0]));
    let singular: Vec<Part> = done.iter().filter(|part| part.is_singular()).copied().collect();
    let is_beside = |part: &&mut Part| singular.iter().any(|other| part.is_beside(other));
    for part in done.iter_mut().filter(|part| !part.is_singular()).filter(is_beside) {
        let seen = by_points(part.range);
        part.missed = [0, 1].map(|k| part.missed[k].min(seen[k]));
    }
    done
}

/// The points of a rule on a part.
pub fn on_part([from, to]: [f64; 2], rule: &[[f64; 2]]) -> impl Iterator<Item = [f64; 2]> {
    rule.iter().map(move |[t, weight]| [from + (to - from) * t, (to - from) * weight])
}

/// The polynomials through w and w′ at the points of `rule`, at t (Lagrange).
pub fn through(rule: &[[f64; 2]], known: &[[f64; 2]], t: f64) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for (at, ([own, _], values)) in rule.iter().zip(known).enumerate() {
        let others = rule.iter().enumerate().filter(|(other, _)| *other != at);
        let factor: f64 = others.map(|(_, [other, _])| (t - other) / (own - other)).product();
        sum = [0, 1].map(|k| sum[k] + factor * values[k]);
    }
    sum
}
