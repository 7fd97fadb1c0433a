//! A problem with a known solution, posed at any scale, and the same problem at scale 1.
//!
//! With u, A, f, ψ, q, h the problem at scale 1, c a length, X₀ a shift, s a load and a stiffness,
//! ```text
//!   X = X₀ + c x    s u(x)    a A(x)    (s a/c²) f(x)    s ψ(x)    (s a/c) q(x)    (a/c) h
//! ```
//! is a problem again, and its solution s u. Energy norms are s √a times, edge fluxes s a times those at
//! scale 1. The mesh at scale 1 is worked out from the coordinates that are stored, which is exact: next to X₀
//! differences of doubles are.

use std::fmt::Write;
use std::mem::replace;

use super::grid::Grid;
use super::solution::{Shear, Solution, Texts};
use signorini_scene::Mesh;
use signorini_scene::mesh::Curve;

/// Factors that change numbers, not the problem.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    /// c
    pub length: f64,
    /// X₀ = Y₀, in units of c.
    pub shift: f64,
    /// s
    pub load: f64,
    /// a
    pub stiffness: f64,
}

impl Scales {
    /// Nothing is changed.
    pub const ONE: Self = Self { length: 1.0, shift: 0.0, load: 1.0, stiffness: 1.0 };

    /// s √a: what energy norms are measured in.
    pub fn energy(&self) -> f64 {
        self.load * self.stiffness.sqrt()
    }

    pub fn placed(&self, mesh: Mesh) -> Mesh {
        let place = |x: f64| self.length * (x + self.shift);
        Mesh { vertices: mesh.vertices.iter().map(|point| point.map(place)).collect(), ..mesh }
    }

    /// The mesh at scale 1.
    pub fn unplaced(&self, mesh: Mesh) -> Mesh {
        let back = |x: f64| (x - self.length * self.shift) / self.length;
        Mesh { vertices: mesh.vertices.iter().map(|point| point.map(back)).collect(), ..mesh }
    }

    /// The name of a coordinate at scale 1.
    fn coordinate(&self, name: &str) -> String {
        if (self.length, self.shift) == (1.0, 0.0) {
            return name.to_owned();
        }
        format!("(({name} - {:e})/{:e})", self.length * self.shift, self.length)
    }
}

/// The condition on a boundary curve; its data are those of the solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hold {
    /// u = u_D.
    Dirichlet,
    /// σ·n = g.
    Neumann,
    /// σ·n = h (u_ext − u), with this h at scale 1.
    Robin(f64),
    /// u ≥ 0, σ·n ≥ 0.
    Contact,
    /// u ≥ ψ = u, σ·n ≥ q one below σ·n: pressed together everywhere.
    Pressed,
}

/// A curve of which some edges stay; σ·n is given on the rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Split {
    /// The curve: `bottom`, `right`, `top`, `left`.
    pub of: &'static str,
    /// The position of the edges that stay.
    pub edges: [usize; 2],
}

/// A problem with a known solution, at a scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Posed {
    /// u
    pub solution: Solution,
    /// The map that turns it oblique.
    pub shear: Shear,
    pub grid: Grid,
    pub scales: Scales,
    /// Conditions on bottom, right, top and left.
    pub sides: [Hold; 4],
    /// A curve of which a part alone has its condition.
    pub split: Option<Split>,
    /// Ends of σ·n on C, where they are not those that the solution asks for.
    pub ends: Option<[f64; 2]>,
}

/// The sides by name, with their outward normals.
const SIDES: [(&str, [f64; 2]); 4] =
    [("bottom", [0.0, -1.0]), ("right", [1.0, 0.0]), ("top", [0.0, 1.0]), ("left", [-1.0, 0.0])];

impl Posed {
    /// At scale 1 on a grid, with contact below and u given elsewhere.
    pub fn new(solution: Solution, grid: Grid) -> Self {
        let sides = [Hold::Contact, Hold::Dirichlet, Hold::Dirichlet, Hold::Dirichlet];
        let (shear, scales) = (Shear::NONE, Scales::ONE);
        Self { solution, shear, grid, scales, sides, split: None, ends: None }
    }

    pub fn at_scale_one(self) -> Self {
        Self { scales: Scales::ONE, ..self }
    }

    pub fn mesh(&self) -> Mesh {
        let mut mesh = self.scales.placed(self.grid.mesh());
        if let Some(split) = self.split {
            let rest = mesh.curves.iter_mut().find(|curve| curve.name == split.of).map(|curve| {
                let [from, to] = split.edges;
                let kept = curve.edges.drain(from..to).collect();
                Curve { name: "rest".to_owned(), edges: replace(&mut curve.edges, kept) }
            });
            mesh.curves.extend(rest);
            mesh.curves.retain(|curve| !curve.edges.is_empty());
        }
        mesh
    }

    /// Its scene on the mesh `mesh.msh`, with the exact solution.
    pub fn scene(&self) -> String {
        let Scales { length: c, load: s, stiffness: a, .. } = self.scales;
        let texts = self.texts();
        let mut text = "title = \"extreme\"\nmesh = \"mesh.msh\"\n".to_owned();
        for (name, k) in [("left", self.solution.contrast()), ("right", 1.0)] {
            let entries = self.shear.tensor().map(|entry| format!("\"{:e}\"", a * k * entry));
            let _ = writeln!(text, "[material.{name}]\nconductivity = [{}]", entries.join(", "));
        }
        let _ = writeln!(text, "[source]\nf = \"{}\"", times(s * a / c / c, &texts.f));
        let mesh = self.mesh();
        let named = |name: &str| mesh.curves.iter().any(|curve| curve.name == name);
        for ((name, normal), hold) in SIDES.into_iter().zip(self.sides) {
            if named(name) {
                text += &self.boundary(name, normal, hold, &texts);
            }
        }
        if let (Some(split), true) = (self.split, named("rest")) {
            let normal = SIDES.iter().find(|side| side.0 == split.of).map_or([0.0; 2], |s| s.1);
            text += &self.boundary("rest", normal, Hold::Neumann, &texts);
        }
        let [ux, uy] = texts.gradient.each_ref().map(|slope| times(s / c, slope));
        let u = times(s, &texts.u);
        let _ = writeln!(text, "[exact]\nu = \"{u}\"\ngradient = [\"{ux}\", \"{uy}\"]");
        text
    }

    fn texts(&self) -> Texts {
        let [x, y] = ["x", "y"].map(|name| self.scales.coordinate(name));
        self.shear.texts(self.solution, &x, &y)
    }

    /// σ·n at scale 1.
    fn flux(&self, [nx, ny]: [f64; 2], texts: &Texts) -> String {
        let ([axx, axy, ayy], [ux, uy]) = (self.shear.tensor(), &texts.gradient);
        let (along_x, along_y) = (nx * axx + ny * axy, nx * axy + ny * ayy);
        let sum = match (along_x, along_y) {
            (0.0, along_y) => format!("{along_y:e}*({uy})"),
            (along_x, 0.0) => format!("{along_x:e}*({ux})"),
            _ => format!("({along_x:e}*({ux}) + {along_y:e}*({uy}))"),
        };
        self.on_both_halves(sum)
    }

    /// k times as large left of x = 0.
    fn on_both_halves(&self, text: String) -> String {
        let (x, k) = (self.scales.coordinate("x"), self.solution.contrast());
        if k == 1.0 {
            return text;
        }
        format!("((0.5 + 0.5*sign({x})) + {k:e}*(0.5 - 0.5*sign({x})))*{text}")
    }

    /// The ends of the flux on C, where they are not 0 and ∞.
    fn limits(&self) -> String {
        let Scales { length: c, load: s, stiffness: a, .. } = self.scales;
        let text = |end: f64| {
            // Loads next to infinity stay what they are: numbers.
            let scaled = (s * a / c * end).clamp(-f64::MAX, f64::MAX);
            match (end.is_finite(), self.ends) {
                (true, None) => self.on_both_halves(format!("{scaled:e}")),
                (true, Some(_)) => format!("{scaled:e}"),
                (false, _) => end.to_string(),
            }
        };
        match self.ends.unwrap_or(self.solution.ends()) {
            [0.0, f64::INFINITY] => String::new(),
            ends => {
                let [least, most] = ends.map(text);
                format!("\nflux = \"{least}\"\nlimit = \"{most}\"")
            }
        }
    }

    fn boundary(&self, name: &str, normal: [f64; 2], hold: Hold, texts: &Texts) -> String {
        let Scales { length: c, load: s, stiffness: a, .. } = self.scales;
        let flux = self.flux(normal, texts);
        let [given, out] = [times(s, &texts.u), times(s * a / c, &flux)];
        let body = match hold {
            Hold::Dirichlet => format!("kind = \"dirichlet\"\nvalue = \"{given}\""),
            Hold::Neumann => format!("kind = \"neumann\"\nflux = \"{out}\""),
            Hold::Robin(h) => {
                let ambient = times(s, &format!("({} + ({flux})/{h:e})", texts.u));
                let h = a / c * h;
                format!("kind = \"robin\"\ncoefficient = \"{h:e}\"\nambient = \"{ambient}\"")
            }
            Hold::Contact => format!("kind = \"contact\"{}", self.limits()),
            Hold::Pressed => {
                let less = times(s * a / c, &format!("({flux} - 1)"));
                format!("kind = \"contact\"\ngap = \"{given}\"\nflux = \"{less}\"")
            }
        };
        format!("[boundary.{name}]\n{body}\n")
    }
}

/// The product, without a factor that says nothing.
fn times(factor: f64, text: &str) -> String {
    if factor == 1.0 { text.to_owned() } else { format!("{factor:e}*({text})") }
}
