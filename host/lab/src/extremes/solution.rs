//! Exact solutions as expressions of any two coordinates, and what A = [[κ + s²/κ, s/κ], [s/κ, 1/κ]]
//! makes of them.
//!
//! Contact on y = 0, n = (0, −1), ψ = q = 0. With U any of them, u(x, y) = U(x − s y, κ y) solves the problem
//! of that A, det A = 1, with f = κ F: anisotropy κ and obliqueness s, exactly. σ·n on C is that of U.
//!
//! Where the flux has a limit, lo ≤ σ·n ≤ hi on C:
//! ```text
//!   three states:  −(c y + β (x η + y ξ − Re s)) with x + iy = a sin(ξ + iη), s = √(z² − a²), a = 0.55,
//!                  β = (lo − hi)/π, c = (lo + hi)/2: above the gap for x < −a, in contact between, below it for x > a
//!   a wall:        t + σ (1 − y), the flux σ as near to −t as lo and hi let it be: Duvaut and Lions in one dimension
//! ```

/// u, ∇u and f as expressions.
#[derive(Debug, Clone, PartialEq)]
pub struct Texts {
    /// u
    pub u: String,
    /// ∂u/∂x, ∂u/∂y
    pub gradient: [String; 2],
    /// −∇·(A∇u)
    pub f: String,
}

/// A solution for A = I, or for A = k left of x = 0 and 1 right of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Solution {
    /// x₊³ − y (−x − g)₊³: smooth. Contact for x < −g; for −g < x < 0 neither a force nor a gap.
    Smooth {
        /// g
        grazing: f64,
    },
    /// Re\[z s − a² log((z + s)/a)\] with s = √(z² − a²), a = 0.55: contact for |x| ≤ a.
    Punch,
    /// J(k): r^α cos αθ right, −k^{−½} r^α sin α(π − θ) left, α = 2 − (2/π) arctan √k; contact for x ≤ 0.
    Jump(f64),
    /// y²/2 − y: contact everywhere.
    Pressed,
    /// 1 + (x² − y²)/4: contact nowhere.
    Lifted,
    /// [`Solution::Pressed`] and [`Solution::Lifted`] + y²/2 in turn, from one whole t to the next.
    Switching,
    /// [`Solution::Smooth`] negated: u is kept below ψ, by fluxes without a lower end.
    Below,
    /// A flux between lo and hi, all three states; see above.
    ThreeStates([f64; 2]),
    /// A wall with this u above, a flux between lo and hi, and A = k left of x = 0.
    Wall {
        /// u at y = 1
        above: f64,
        /// lo and hi; left of x = 0 they are k times as large.
        ends: [f64; 2],
        /// k
        contrast: f64,
    },
    /// A wall with 5 cos πt above and A = 1: at either end in turn.
    MovingWall([f64; 2]),
}

/// A of a solution turned oblique.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shear {
    /// s
    pub obliqueness: f64,
    /// κ
    pub anisotropy: f64,
}

impl Shear {
    /// A = I.
    pub const NONE: Self = Self { obliqueness: 0.0, anisotropy: 1.0 };

    /// a_xx, a_xy, a_yy. Exact where s and κ are powers of two and s/κ is at most 2²⁶.
    pub fn tensor(&self) -> [f64; 3] {
        let Self { obliqueness: s, anisotropy: kappa } = *self;
        [kappa + s * s / kappa, s / kappa, 1.0 / kappa]
    }

    /// `solution` for this A, in the coordinates that `x` and `y` express.
    pub fn texts(&self, solution: Solution, x: &str, y: &str) -> Texts {
        if *self == Self::NONE {
            return solution.texts(x, y);
        }
        let Self { obliqueness: s, anisotropy: kappa } = *self;
        let Texts { u, gradient: [ux, uy], f } =
            solution.texts(&format!("({x} - {s:e}*{y})"), &format!("({kappa:e}*{y})"));
        let along_y = format!("(-{s:e}*({ux}) + {kappa:e}*({uy}))");
        Texts { u, gradient: [ux, along_y], f: format!("{kappa:e}*({f})") }
    }
}

impl Solution {
    /// k left of x = 0.
    pub fn contrast(self) -> f64 {
        match self {
            Self::Jump(k) | Self::Wall { contrast: k, .. } => k,
            _ => 1.0,
        }
    }

    /// lo and hi of what σ·n may be on C, right of x = 0.
    pub fn ends(self) -> [f64; 2] {
        match self {
            Self::Below => [f64::NEG_INFINITY, 0.0],
            Self::ThreeStates(ends) | Self::Wall { ends, .. } | Self::MovingWall(ends) => ends,
            _ => [0.0, f64::INFINITY],
        }
    }

    /// A bound of |σ·n| on C.
    pub fn largest_flux(self) -> f64 {
        match self {
            // Left of x = 0 it is √k α r^{α − 1} with α < 2.
            Self::Jump(k) => 2.0 * k.sqrt(),
            _ => 1.0,
        }
    }

    /// The expressions for A = I, J(k) aside; `x` and `y` are operands: names, or in parentheses.
    pub fn texts(self, x: &str, y: &str) -> Texts {
        match self {
            Self::Smooth { grazing } => smooth(x, y, grazing),
            Self::Punch => punch(x, y),
            Self::Jump(k) => jump(x, y, k),
            Self::Pressed => {
                texts(format!("{y}^2/2 - {y}"), ["0".to_owned(), format!("{y} - 1")], "-1")
            }
            Self::Lifted => {
                texts(format!("1 + ({x}^2 - {y}^2)/4"), [format!("{x}/2"), format!("-{y}/2")], "0")
            }
            Self::Switching => switching(x, y),
            Self::Below => {
                let Texts { u, gradient, f } = smooth(x, y, 0.0);
                let negative = |text: String| format!("-({text})");
                Texts { u: negative(u), gradient: gradient.map(negative), f: negative(f) }
            }
            Self::ThreeStates(ends) => three_states(x, y, ends),
            Self::Wall { above, ends, .. } => wall(y, &format!("{above:e}"), ends),
            Self::MovingWall(ends) => wall(y, "5*cos(pi*t)", ends),
        }
    }
}

fn texts(u: String, gradient: [String; 2], f: &str) -> Texts {
    Texts { u, gradient, f: f.to_owned() }
}

fn smooth(x: &str, y: &str, grazing: f64) -> Texts {
    let (right, left) = (format!("max({x},0)"), format!("max(-{x}-{grazing:e},0)"));
    let gradient = [format!("3*{right}^2 + 3*{y}*{left}^2"), format!("-({left}^3)")];
    let f = format!("-6*{right} + 6*{y}*{left}");
    texts(format!("{right}^3 - {y}*{left}^3"), gradient, &f)
}

/// a
const A: &str = "0.55";

/// Real and imaginary part of s(z) = √(z − a) √(z + a).
fn root(x: &str, y: &str) -> [String; 2] {
    let size = format!("((({x}-{A})^2+{y}^2)^0.25*(({x}+{A})^2+{y}^2)^0.25)");
    let angle = format!("(0.5*atan2({y},{x}-{A}) + 0.5*atan2({y},{x}+{A}))");
    [format!("{size}*cos{angle}"), format!("{size}*sin{angle}")]
}

/// U' = 2 s(z).
fn punch(x: &str, y: &str) -> Texts {
    let [re, im] = root(x, y);
    let log = format!("0.5*ln((({x}+{re})^2 + ({y}+{im})^2)/{A}^2)");
    let u = format!("{x}*{re} - {y}*{im} - {A}^2*{log}");
    texts(u, [format!("2*{re}"), format!("-2*{im}")], "0")
}

/// u and σ·n = −∂u/∂y of all three states, with the r^{3/2} of both transitions.
fn three_states(x: &str, y: &str, [lo, hi]: [f64; 2]) -> Texts {
    let (beta, c) = ((lo - hi) / std::f64::consts::PI, 0.5 * lo + 0.5 * hi);
    let [re, im] = root(x, y);
    let xi = format!("(pi/2 - atan2({y} + {im}, {x} + {re}))");
    let eta = format!("(0.5*ln((({x} + {re})^2 + ({y} + {im})^2)/{A}^2))");
    let u = format!("-({c:e}*{y} + {beta:e}*({x}*{eta} + {y}*{xi} - {re}))");
    texts(u, [format!("-{beta:e}*{eta}"), format!("-({c:e} + {beta:e}*{xi})")], "0")
}

/// The wall with `above`, a number or an expression of t, given at y = 1.
fn wall(y: &str, above: &str, [lo, hi]: [f64; 2]) -> Texts {
    let flux = format!("max({lo:e}, min({hi:e}, -({above})))");
    // In contact u = t y has no term that cancels.
    let beyond = format!("(min({above} + {hi:e}, 0) + max({above} + {lo:e}, 0))");
    texts(format!("({beyond} - {flux}*{y})"), ["0".to_owned(), format!("-{flux}")], "0")
}

/// (1 ± sign x)/2 choose between the halves. On the left the angle is taken from the negative x axis,
/// so that u and λ keep all digits where they are small.
fn jump(x: &str, y: &str, k: f64) -> Texts {
    // β = α − 1 = (2/π) arctan 1/√k, without the cancellation. cos αθ = cos θ cos βθ − sin θ sin βθ, with
    // cos θ = x/r: where both halves meet, at x = 0, cos αθ alone would be off by ε, which a contrast of
    // 10¹⁰ turns into a u_D with a jump that is felt.
    let less = 2.0 / std::f64::consts::PI * (1.0 / k.sqrt()).atan();
    let (alpha, less, scale) =
        (format!("{:e}", 1.0 + less), format!("{less:e}"), format!("{:e}", 1.0 / k.sqrt()));
    let r = format!("sqrt({x}^2 + {y}^2)");
    let (theta, mirrored) = (format!("atan2({y},{x})"), format!("atan2({y},-{x})"));
    let (right, left) = (format!("(0.5 + 0.5*sign({x}))"), format!("(0.5 - 0.5*sign({x}))"));
    let on_right = format!("({x}*cos({less}*{theta}) - {y}*sin({less}*{theta}))");
    let on_left = format!("({y}*cos({less}*{mirrored}) - {x}*sin({less}*{mirrored}))");
    let u = format!("{r}^{less}*({right}*{on_right} - {left}*{scale}*{on_left})");
    let slope = format!("{alpha}*{r}^{less}");
    let along_x =
        format!("{slope}*({right}*cos({less}*{theta}) + {left}*{scale}*sin({less}*{mirrored}))");
    let along_y =
        format!("{slope}*(-{right}*sin({less}*{theta}) - {left}*{scale}*cos({less}*{mirrored}))");
    texts(u, [along_x, along_y], "0")
}

/// c = cos πt is 1 and −1 in turn; u = y²/2 + c₋ y + c₊ (1 + (x² − y²)/4).
fn switching(x: &str, y: &str) -> Texts {
    let (open, closed) = ("max(cos(pi*t),0)", "min(cos(pi*t),0)");
    let u = format!("{y}^2/2 + {closed}*{y} + {open}*(1 + ({x}^2 - {y}^2)/4)");
    let along_y = format!("{y} + {closed} - {open}*{y}/2");
    texts(u, [format!("{open}*{x}/2"), along_y], "-1")
}

#[cfg(test)]
mod tests;
