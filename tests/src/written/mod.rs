//! Exact solutions as scene files on (−1, 1) × (0, 1): contact at the bottom, any condition elsewhere.
//!
//! Expressions are in X and Y, which become x and y only when the file is written: till then a
//! transformation is a substitution.

mod catalogue;
mod smooth;

pub use catalogue::TwoMaterials;
pub use smooth::{Contact, Smooth};

/// The condition on a side other than the bottom.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The value of u.
    Dirichlet,
    /// The flux of u.
    Neumann,
    /// A transfer law with a coefficient that varies.
    Robin,
}

/// Names of the sides in the order in which their conditions are given.
pub const SIDES: [&str; 3] = ["left", "right", "top"];

/// A unit of length and a unit of u, by which everything is multiplied.
#[derive(Clone, Copy, Debug)]
pub struct Units {
    /// The half of the width of the domain.
    pub length: f64,
    /// The value that u = 1 becomes.
    pub value: f64,
}

impl Units {
    /// Neither is changed.
    pub const ONE: Self = Self { length: 1.0, value: 1.0 };

    /// `factor` times an expression in X and Y, as a string of the scene file.
    fn of(self, factor: f64, text: &str) -> String {
        let [x, y] = ["x", "y"].map(|name| format!("({name}/{:e})", self.length));
        format!("\"{factor:e}*({})\"", substitute(text, &x, &y))
    }
}

/// A solution with its data, as expressions in X and Y.
#[derive(Clone, Debug)]
pub struct Written {
    /// u.
    pub u: String,
    /// ∇u.
    pub gradient: [String; 2],
    /// f.
    pub source: String,
    /// A where x < 0 and where x > 0.
    pub regions: [[String; 3]; 2],
    /// A as one expression.
    pub tensor: [String; 3],
    /// ψ at the bottom.
    pub gap: String,
    /// q at the bottom.
    pub flux: String,
}

impl Written {
    /// The scene file with these conditions on [`SIDES`].
    pub fn scene(&self, sides: [Side; 3], units: Units) -> String {
        let Units { length, value } = units;
        let slope = value / length;
        let mut text = "mesh = \"none.msh\"\n".to_owned();
        for (name, tensor) in ["left", "right"].iter().zip(&self.regions) {
            let [xx, xy, yy] = tensor.each_ref().map(|entry| units.of(1.0, entry));
            text += &format!("[material.{name}]\nconductivity = [{xx}, {xy}, {yy}]\n");
        }
        text += &format!("[source]\nf = {}\n", units.of(slope / length, &self.source));
        let (gap, q) = (units.of(value, &self.gap), units.of(slope, &self.flux));
        text += &format!("[boundary.contact]\nkind = \"contact\"\ngap = {gap}\nflux = {q}\n");
        for (at, side) in sides.into_iter().enumerate() {
            text += &self.condition(at, side, units);
        }
        let [along_x, along_y] = self.gradient.each_ref().map(|entry| units.of(slope, entry));
        text += &format!("[exact]\nu = {}\n", units.of(value, &self.u));
        text + &format!("gradient = [{along_x}, {along_y}]\n")
    }

    /// The section of a side of [`SIDES`].
    fn condition(&self, at: usize, side: Side, units: Units) -> String {
        let Units { length, value } = units;
        let (sigma, h) = (self.outward(at), ["2+Y", "2+Y", "2+X"][at]);
        let keys = match side {
            Side::Dirichlet => format!("\"dirichlet\"\nvalue = {}", units.of(value, &self.u)),
            Side::Neumann => format!("\"neumann\"\nflux = {}", units.of(value / length, &sigma)),
            Side::Robin => {
                let ambient = units.of(value, &format!("{} + ({sigma})/({h})", self.u));
                let h = units.of(1.0 / length, h);
                format!("\"robin\"\ncoefficient = {h}\nambient = {ambient}")
            }
        };
        format!("[boundary.{}]\nkind = {keys}\n", SIDES[at])
    }

    /// σ·n on a side of [`SIDES`].
    fn outward(&self, side: usize) -> String {
        let ([gx, gy], [xx, xy, yy]) = (&self.gradient, &self.tensor);
        match side {
            0 => format!("-(({xx})*({gx}) + ({xy})*({gy}))"),
            1 => format!("({xx})*({gx}) + ({xy})*({gy})"),
            _ => format!("({xy})*({gx}) + ({yy})*({gy})"),
        }
    }
}

/// `text` with `x` for X and `y` for Y, at once.
fn substitute(text: &str, x: &str, y: &str) -> String {
    let piece = |letter: char| match letter {
        'X' => x.to_owned(),
        'Y' => y.to_owned(),
        other => other.to_string(),
    };
    text.chars().map(piece).collect()
}
