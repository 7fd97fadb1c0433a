//! Functions of x and y drawn at random: sums of c φ(z), z = a x + b y + d, with their derivatives.
//!
//! ```text
//!   ∇ = Σ c φ′(z) (a, b),   ∇∇ᵀ = Σ c φ″(z) (a, b)(a, b)ᵀ
//! ```

use signorini_problem::random::Random;

/// φ
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shape {
    Constant,
    Linear,
    Quadratic,
    Cubic,
    Sine,
    /// tanh
    Layer,
    /// exp(−z²)
    Bell,
    /// max(z, 0)³/6: a kink in its second derivative
    Hump,
    /// |z|
    Kink,
    /// max(z, 0)
    Corner,
    /// sign z
    Step,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rough {
    /// Two derivatives that are continuous.
    Smooth,
    /// Continuous.
    Kinked,
    /// Piecewise continuous.
    Jumping,
}

/// c φ(a x + b y + d)
#[derive(Debug, Clone, Copy)]
struct Term {
    factor: f64,
    shape: Shape,
    wave: [f64; 2],
    offset: f64,
}

/// A sum of such terms, in coordinates in units of `length`, the size of the domain: z changes by about 1 there.
#[derive(Debug, Clone)]
pub struct Function {
    terms: Vec<Term>,
    length: f64,
}

impl Shape {
    /// φ, φ′ and φ″ of the operand `z`.
    fn texts(self, z: &str) -> [String; 3] {
        let texts = |texts: [&str; 3]| texts.map(|text| text.replace('z', z));
        match self {
            Self::Constant => texts(["1", "0", "0"]),
            Self::Linear => texts(["z", "1", "0"]),
            Self::Quadratic => texts(["z^2/2", "z", "1"]),
            Self::Cubic => texts(["z^3/6", "z^2/2", "z"]),
            Self::Sine => texts(["sin(z)", "cos(z)", "-sin(z)"]),
            Self::Layer => texts(["tanh(z)", "(1-tanh(z)^2)", "-2*tanh(z)*(1-tanh(z)^2)"]),
            Self::Bell => texts(["exp(-z^2)", "-2*z*exp(-z^2)", "(4*z^2-2)*exp(-z^2)"]),
            Self::Hump => texts(["max(z,0)^3/6", "max(z,0)^2/2", "max(z,0)"]),
            Self::Kink => texts(["abs(z)", "sign(z)", "0"]),
            Self::Corner => texts(["max(z,0)", "(0.5+0.5*sign(z))", "0"]),
            Self::Step => texts(["sign(z)", "0", "0"]),
        }
    }

    fn draw(random: &mut Random, rough: Rough) -> Self {
        use Shape::{Bell, Constant, Cubic, Hump, Layer, Linear, Quadratic, Sine};
        let smooth = [Constant, Linear, Quadratic, Cubic, Sine, Layer, Bell, Hump];
        match rough {
            Rough::Jumping if random.chance(0.1) => Self::Step,
            Rough::Kinked | Rough::Jumping if random.chance(0.2) => {
                random.pick(&[Self::Kink, Self::Corner])
            }
            _ => random.pick(&smooth),
        }
    }
}

impl Term {
    /// `steepest`: how often a wave or a layer fits into the domain at most.
    fn draw(random: &mut Random, rough: Rough, steepest: f64) -> Self {
        let shape = Shape::draw(random, rough);
        let steep = match shape {
            Shape::Sine | Shape::Layer | Shape::Bell => random.log(0.5, steepest.max(1.0)),
            _ => random.log(0.5, 2.0),
        };
        let angle = match random.below(4) {
            0 => 0.0,
            1 => 0.5 * std::f64::consts::PI,
            _ => random.between(0.0, 2.0 * std::f64::consts::PI),
        };
        let wave = match random.below(8) {
            0 => [steep, 0.0],
            1 => [0.0, steep],
            _ => [steep * angle.cos(), steep * angle.sin()],
        };
        let through = [random.between(-1.0, 1.0), random.between(0.0, 1.0)];
        let offset = -(wave[0] * through[0] + wave[1] * through[1]);
        Self { factor: random.signed_log(0.1, 2.0), shape, wave, offset }
    }
}

impl Function {
    /// One to three terms of size 1.
    pub fn draw(random: &mut Random, length: f64, rough: Rough, steepest: f64) -> Self {
        let count = 1 + random.below(3);
        let terms = (0..count).map(|_| Term::draw(random, rough, steepest)).collect();
        Self { terms, length }
    }

    /// A smooth function of the coordinate `axis` alone.
    pub fn draw_along(random: &mut Random, axis: usize, steepest: f64) -> Self {
        let mut function = Self::draw(random, 1.0, Rough::Smooth, steepest);
        for term in &mut function.terms {
            let steep = term.wave[0].hypot(term.wave[1]);
            term.wave = [0.0; 2];
            term.wave[axis] = steep;
        }
        function
    }

    /// The function, `factor` times as large.
    pub fn times(mut self, factor: f64) -> Self {
        self.terms.iter_mut().for_each(|term| term.factor *= factor);
        self
    }

    pub fn value(&self) -> String {
        self.sum(0, |_| 1.0)
    }

    /// ∂/∂x or ∂/∂y.
    pub fn slope(&self, axis: usize) -> String {
        self.sum(1, |term| term.wave[axis] / self.length)
    }

    pub fn second(&self, axes: [usize; 2]) -> String {
        self.sum(2, |term| term.wave[axes[0]] / self.length * (term.wave[axes[1]] / self.length))
    }

    /// Σ c · weight · φ⁽ᵒʳᵈᵉʳ⁾(z), in parentheses.
    fn sum(&self, order: usize, weight: impl Fn(&Term) -> f64) -> String {
        let operand = |name: &str| match self.length {
            1.0 => name.to_owned(),
            length => format!("(({name} - 0e0)/{length:e})"),
        };
        let [x, y] = ["x", "y"].map(operand);
        let mut texts = Vec::new();
        for term in &self.terms {
            let [a, b] = term.wave;
            let z = format!("({a:e}*{x}+{b:e}*{y}+{:e})", term.offset);
            let (factor, text) = (term.factor * weight(term), &term.shape.texts(&z)[order]);
            if factor != 0.0 && text != "0" {
                texts.push(format!("{factor:e}*{text}"));
            }
        }
        if texts.is_empty() { "0".to_owned() } else { format!("({})", texts.join("+")) }
    }
}
