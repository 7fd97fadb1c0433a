//! The catalogue's solutions, with +G and T(s, κ).

use std::f64::consts::PI;

use super::{Written, substitute};
use crate::polynomial::Polynomial;

/// A solution with A = k where X < 0 and 1 where X > 0, in contact where it should be (q = 0).
#[derive(Clone, Debug)]
pub struct TwoMaterials {
    /// The name in the catalogue.
    pub name: String,
    u: String,
    gradient: [String; 2],
    source: String,
    gap: String,
    left: f64,
}

impl TwoMaterials {
    fn new(name: String, u: &str, [gx, gy]: [&str; 2]) -> Self {
        let gradient = [gx.to_owned(), gy.to_owned()];
        let zero = || "0".to_owned();
        Self { name, u: u.to_owned(), gradient, source: zero(), gap: zero(), left: 1.0 }
    }

    /// A: smooth, with a source.
    pub fn a() -> Self {
        let u = "max(X,0)^3 - Y*max(-X,0)^3";
        let gradient = ["3*max(X,0)^2 + 3*Y*max(-X,0)^2", "-(max(-X,0)^3)"];
        let source = "-6*max(X,0) + 6*Y*max(-X,0)".to_owned();
        Self { source, ..Self::new("A".to_owned(), u, gradient) }
    }

    /// B: the generic free boundary.
    pub fn b() -> Self {
        let root = "1.5*sqrt(sqrt(X^2+Y^2))";
        let slope = |of: &str| format!("{root}*{of}(0.5*atan2(Y,X))");
        let gradient = [slope("cos"), format!("-{}", slope("sin"))];
        let u = "sqrt(X^2+Y^2)^1.5*cos(1.5*atan2(Y,X))";
        Self::new("B".to_owned(), u, gradient.each_ref().map(String::as_str))
    }

    /// H(a): a punch with two free points.
    pub fn h(a: f64) -> Self {
        let modulus = format!("((X-{a})^2+Y^2)^0.25*((X+{a})^2+Y^2)^0.25");
        let angle = format!("(0.5*atan2(Y,X-{a}) + 0.5*atan2(Y,X+{a}))");
        let [re, im] = ["cos", "sin"].map(|of| format!("{modulus}*{of}{angle}"));
        let log = format!("ln(((X+{re})^2 + (Y+{im})^2)/{a}^2)");
        let u = format!("X*{re} - Y*{im} - {a}^2*0.5*{log}");
        Self::new(format!("H({a:.2})"), &u, [&format!("2*{re}"), &format!("-2*{im}")])
    }

    /// H_g(a): the same over a concave gap.
    pub fn h_gap(a: f64) -> Self {
        let sum = Self::h(a).plus(&Polynomial::new([([2, 0], -1.0), ([0, 2], 1.0)]));
        Self { name: format!("H_g({a:.2})"), ..sum }
    }

    /// J(k): A jumps from k to 1.
    pub fn jump(k: f64) -> Self {
        let alpha = 2.0 - 2.0 / PI * k.sqrt().atan();
        let (left, right) = ("(0.5 - 0.5*sign(X))", "(0.5 + 0.5*sign(X))");
        let (angle, from_left) = ("atan2(Y,X)", "(pi - atan2(Y,X))");
        let (c, below) = (k.powf(-0.5), alpha - 1.0);
        let radius = "sqrt(X^2+Y^2)";
        let u = format!(
            "{radius}^{alpha}*({right}*cos({alpha}*{angle}) - {left}*{c}*sin({alpha}*{from_left}))"
        );
        let slope = |of: [&str; 2]| {
            format!(
                "{alpha}*{radius}^{below}*({}{right}*{}({below}*{angle}) {}{left}*{c}*{}({below}*{from_left}))",
                if of[0] == "sin" { "-" } else { "" },
                of[0],
                if of[0] == "sin" { "-" } else { "+" },
                of[1]
            )
        };
        let gradient = [slope(["cos", "sin"]), slope(["sin", "cos"])];
        let name = format!("J({k:.1e})");
        Self { left: k, ..Self::new(name, &u, gradient.each_ref().map(String::as_str)) }
    }

    /// +G: any G with ∂G/∂Y = 0 at the bottom and, where A jumps, ∂G/∂X = 0 at X = 0.
    #[must_use]
    pub fn plus(self, g: &Polynomial) -> Self {
        let sum = |text: &str, of: &Polynomial| format!("{text} + {}", of.text());
        let [along_x, along_y] = g.gradient();
        let a = conductivity(self.left);
        Self {
            name: format!("{} + G", self.name),
            u: sum(&self.u, g),
            gradient: [sum(&self.gradient[0], &along_x), sum(&self.gradient[1], &along_y)],
            source: format!("{} - {a}*({})", self.source, g.laplacian().text()),
            gap: sum(&self.gap, g),
            left: self.left,
        }
    }

    /// A G for [`TwoMaterials::plus`] that does for jumps too.
    pub fn lift(factors: [f64; 4]) -> Polynomial {
        Polynomial::new([[2, 0], [0, 2], [3, 0], [0, 3]].into_iter().zip(factors))
    }

    /// T(s, κ): the pull-back by (x, y) ↦ (x − s y, κ y); s = 0 where A jumps, on a vertical line.
    pub fn transformed(&self, s: f64, kappa: f64) -> Written {
        let back = |text: &str| substitute(text, &format!("(X-{s}*Y)"), &format!("({kappa}*Y)"));
        let [gx, gy] = self.gradient.each_ref().map(|entry| back(entry));
        let entries = [kappa + s * s / kappa, s / kappa, 1.0 / kappa];
        let scaled = |factor: &str| entries.map(|entry| format!("{entry}*{factor}"));
        Written {
            u: back(&self.u),
            gradient: [gx.clone(), format!("{kappa}*({gy}) - {s}*({gx})")],
            source: format!("{kappa}*({})", back(&self.source)),
            regions: [scaled(&format!("{}", self.left)), scaled("1")],
            tensor: scaled(&back(&conductivity(self.left))),
            gap: back(&self.gap),
            flux: "0".to_owned(),
        }
    }

    /// The scene of the catalogue.
    pub fn written(&self) -> Written {
        self.transformed(0.0, 1.0)
    }
}

/// A as one expression: `left` where X < 0, 1 where X > 0.
fn conductivity(left: f64) -> String {
    if left == 1.0 { "1".to_owned() } else { format!("(0.5*(1+{left}) + 0.5*(1-{left})*sign(X))") }
}
