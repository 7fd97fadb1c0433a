//! Each operation on forms.

use super::super::operation::{Binary, Unary};
use super::super::program::Numbers;
use super::derivatives::{of_power, series};
use super::form::Form;
use super::function::{ULP, binary, unary};
use super::interval::Interval;
use super::polynomial::{self, Shape};

/// Forms over a shape.
pub(super) struct Forms(pub Shape);

impl Numbers for Forms {
    type Number = Form;

    fn constant(&self, value: f64) -> Form {
        Form::constant(self.0, value)
    }

    fn unary(&self, operation: Unary, a: Form) -> Form {
        let (range, is_number) = unary(operation, a.range());
        let natural = (range, is_number && a.is_defined());
        match operation {
            Unary::Negate => a.scaled(-1.0),
            Unary::Abs if a.range().low >= 0.0 => a,
            Unary::Abs if a.range().high <= 0.0 => a.scaled(-1.0),
            Unary::Abs => kink(&a, natural),
            Unary::Sign if a.has_thin_levels() && a.range().low >= 0.0 => self.constant(1.0),
            Unary::Sign if a.has_thin_levels() && a.range().high <= 0.0 => self.constant(-1.0),
            Unary::Sign => Form::flat(self.0, range, natural.1),
            smooth => {
                let lower =
                    |at| series(smooth, at).map(|[value, slope, second, _]| [value, slope, second]);
                composed(&a, lower, |at| series(smooth, at).map(|[.., third]| third), natural)
            }
        }
    }

    fn binary(&self, operation: Binary, a: Form, b: Form) -> Form {
        let (range, is_number) = binary(operation, a.range(), b.range());
        let natural = (range, is_number && a.is_defined() && b.is_defined());
        match operation {
            Binary::Add => a.combined(1.0, &b, 1.0).within(natural),
            Binary::Subtract => a.minus(&b).within(natural),
            Binary::Multiply => a.times_within(&b, natural),
            Binary::Divide if !b.range().holds(0.0) => a.times_within(&b.to(-1.0), natural),
            Binary::Divide => Form::flat(self.0, range, natural.1),
            Binary::Power if b.is_constant() => a.to(b.range().low),
            Binary::Power if a.range().low > 0.0 => {
                let logarithm = self.unary(Unary::Ln, a);
                self.unary(Unary::Exp, b.times(&logarithm)).within(natural)
            }
            Binary::Power => Form::flat(self.0, range, natural.1),
            Binary::Atan2 => self.angle(a, b, natural),
            // max(a, b) = b + max(a − b, 0), min(a, b) = a − max(a − b, 0)
            Binary::Max => {
                let above = positive_part(&a.minus(&b));
                above.map_or_else(|| a, |above| b.combined(1.0, &above, 1.0)).within(natural)
            }
            Binary::Min => {
                let above = positive_part(&a.minus(&b));
                above.map_or_else(|| b, |above| a.minus(&above)).within(natural)
            }
        }
    }
}

impl Forms {
    /// atan2(a, b) off the cut: arctan(a/b) to the right, ±π/2 − arctan(b/a) above and below.
    fn angle(&self, a: Form, b: Form, natural: (Interval, bool)) -> Form {
        let half_turn = |way: f64| {
            let turned = self.unary(Unary::Atan, self.binary(Binary::Divide, b, a));
            let quarter = way * std::f64::consts::FRAC_PI_2;
            turned.scaled(-1.0).shifted_by(Interval::point(quarter).widened(ULP))
        };
        let form = if b.range().low > 0.0 {
            self.unary(Unary::Atan, self.binary(Binary::Divide, a, b))
        } else if a.range().low > 0.0 {
            half_turn(1.0)
        } else if a.range().high < 0.0 {
            half_turn(-1.0)
        } else {
            return Form::flat(self.0, natural.0, natural.1);
        };
        form.within(natural)
    }
}

impl Form {
    /// self/other; anything where `other` may be 0.
    #[must_use]
    pub fn over(&self, other: &Self) -> Self {
        Forms(self.shape()).binary(Binary::Divide, *self, *other)
    }

    /// aᵖ
    pub(super) fn to(&self, p: f64) -> Self {
        let (range, is_number) = super::function::power(self.range(), p);
        let natural = (range, is_number && self.is_defined());
        if p == 1.0 {
            return *self;
        }
        if p == 2.0 {
            return self.times_within(self, natural);
        }
        let lower = |at| Some([0, 1, 2].map(|k| of_power(at, p, k)));
        composed(self, lower, |at| Some(of_power(at, p, 3)), natural)
    }
}

/// The root of a form.
pub fn root(form: &Form) -> Form {
    Forms(form.shape()).unary(Unary::Sqrt, *form)
}

/// f(a) = f(m) + f′(m)u + ½f″(m)u² + ⅙f‴(ξ)u³ with u = a − m, m the middle of the range of a and ξ somewhere in it: `lower` has the
/// coefficients of degree 0 to 2, and `third` that of degree 3.
fn composed(
    a: &Form,
    lower: impl Fn(Interval) -> Option<[Interval; 3]>,
    third: impl Fn(Interval) -> Option<Interval>,
    natural: (Interval, bool),
) -> Form {
    let flat = Form::flat(a.shape(), natural.0, natural.1);
    let range = a.range();
    if !natural.1 || !range.is_finite() || range.low == range.high {
        return flat;
    }
    let middle = range.middle();
    let (Some([value, slope, second]), Some(third)) =
        (lower(Interval::point(middle)), third(range))
    else {
        return flat;
    };
    if !third.is_finite() {
        return flat;
    }
    let u = a.shifted(-middle);
    let within = range - Interval::point(middle);
    let square = u.times_within(&u, (within.square(), true));
    let middles = [value, slope, second].map(Interval::middle);
    let [d0, d1, d2] = middles;
    let mut coefficients: [f64; 6] =
        std::array::from_fn(|k| d1 * u.coefficients[k] + d2 * square.coefficients[k]);
    coefficients[0] += d0;
    // What the coefficients are off by, and the rounding of the sum.
    let [e0, e1, e2] =
        [value - Interval::point(d0), slope - Interval::point(d1), second - Interval::point(d2)];
    let sizes = [u, square].map(|form| polynomial::size(&form.coefficients));
    let slack = 4.0 * ULP * (d0.abs() + (d1 * sizes[0]).abs() + (d2 * sizes[1]).abs());
    let missed = d1 * u.remainder + d2 * square.remainder + third * (within * within.square());
    let remainder = (missed + e0 + e1 * within + e2 * within.square()).widened(slack);
    Form::new(a.shape(), coefficients, remainder, natural, a.is_analytic())
}

/// |a| between the chord of its ends and that less its height at the kink:  |a| = λa + μ − [0, μ],
/// λ = (h + l)/(h − l), μ = −2lh/(h − l) on [l, h].
fn kink(a: &Form, natural: (Interval, bool)) -> Form {
    match positive_part(a) {
        // |a| = 2 max(a, 0) − a
        Some(part) => part.combined(2.0, a, -1.0).within(natural),
        None => *a,
    }
}

/// max(a, 0) on [l, h], l < 0 < h: λa + [0, μ], λ = h/(h − l), μ = −λl; 0 for h ≤ 0, and `None`, a itself, for l ≥ 0.
fn positive_part(a: &Form) -> Option<Form> {
    let Interval { low, high } = a.range();
    if low >= 0.0 {
        return None;
    }
    if high <= 0.0 {
        return Some(Form::flat(a.shape(), Interval::ZERO, a.is_defined()));
    }
    let natural = (Interval { low: 0.0, high }, a.is_defined());
    if !a.range().is_finite() {
        return Some(Form::flat(a.shape(), natural.0, natural.1));
    }
    let share = high / (high - low);
    let height = -(share * low) * (1.0 + 8.0 * ULP);
    let slack = 8.0 * ULP * a.range().size();
    let line = a.scaled(share);
    let remainder = (line.remainder + Interval { low: 0.0, high: height }).widened(slack);
    // Half of the height is the middle.
    let mut coefficients = line.coefficients;
    coefficients[0] += 0.5 * height;
    let centred = remainder - Interval::point(0.5 * height);
    Some(Form::new(a.shape(), coefficients, centred.widened(slack), natural, false))
}
