//! Scenes whose data were chosen: curved, kinked and layered ones, on materials of any contrast and obliqueness.

use std::f64::consts::PI;
use std::fmt::Write;

use super::function::{Function, Rough};
use super::mesh::{self, MeshPlan};
use super::posed::{Ends, Hold, Posed, span, turned};
use signorini_problem::random::Random;

/// Draws one; `moving`: with inputs.
pub(super) fn draw(random: &mut Random, plan: &MeshPlan, moving: bool) -> Posed {
    let (sin, cos) = random.between(0.0, 2.0 * PI).sin_cos();
    let length = if random.chance(0.2) { random.log(1e-4, 1e4) } else { 1.0 };
    let lean = random.pick(&[0.0, 0.0, 0.5]);
    let map = match random.chance(0.5) {
        true => [[length, 0.0], [0.0, length]],
        false => [
            [length * cos, length * (lean * cos - sin)],
            [length * sin, length * (lean * sin + cos)],
        ],
    };
    let drawn = mesh::draw(random, &MeshPlan { map, ..*plan });
    let size = if random.chance(0.2) { random.log(1e-8, 1e8) } else { 1.0 };
    let names: Vec<&str> = drawn.mesh.curves.iter().map(|curve| curve.name.as_str()).collect();
    let steepest = random.pick(&[1.5, 1.5, 10.0, 1e3]);
    let (text, inputs) = (String::new(), Vec::new());
    let mut scene = Scene { random, length, size, steepest, moving, text, inputs };
    scene.text += "title = \"random\"\nmesh = \"mesh.msh\"\n";
    let stiffness = scene.materials(&drawn.mesh);
    let hold = scene.boundaries(&names, stiffness);
    let Scene { text, inputs, .. } = scene;
    Posed { scene: text, mesh: drawn.mesh, hold, inputs }
}

struct Scene<'r> {
    random: &'r mut Random,
    length: f64,
    /// Of u.
    size: f64,
    /// How often a wave or a layer of boundary data fits into the domain at most; of f not more often than 10 times.
    steepest: f64,
    moving: bool,
    text: String,
    inputs: Vec<f64>,
}

impl Scene<'_> {
    /// The materials; returns a number of the size of A.
    fn materials(&mut self, mesh: &signorini_scene::mesh::Mesh) -> f64 {
        let most = self.random.pick(&[1.0, 1.0, 1e2, 1e10]);
        let size = if self.random.chance(0.2) { self.random.log(1e-10, 1e10) } else { 1.0 };
        let mut stiffness = 0.0;
        for surface in &mesh.surfaces {
            let own = size * self.random.log(1.0 / most, most.max(1.000_001));
            stiffness += own;
            let entries = self.tensor(own).map(|entry| format!("\"{entry}\""));
            let _ = writeln!(self.text, "[material.{}]", surface.name);
            let _ = writeln!(self.text, "conductivity = [{}]", entries.join(", "));
        }
        stiffness
    }

    /// A of this size: isotropic or not, constant or not.
    fn tensor(&mut self, size: f64) -> [String; 3] {
        let random = &mut *self.random;
        let ratio = match random.below(6) {
            0 => random.log(1.0, 1e2),
            1 => random.log(1.0, 1e8),
            _ => 1.0,
        };
        let along = if random.chance(0.3) { (0.0, 1.0) } else { random.between(0.0, PI).sin_cos() };
        let entries = match ratio == 1.0 {
            true => [size, 0.0, size],
            false => turned([size * ratio.sqrt(), size / ratio.sqrt()], along),
        };
        let factor = match random.below(6) {
            0 => Function::draw(random, self.length, Rough::Kinked, 4.0).value(),
            _ => String::new(),
        };
        entries.map(|entry| match factor.is_empty() || entry == 0.0 {
            true => format!("{entry:e}"),
            false => format!("{entry:e}*(1.5+tanh({factor}))"),
        })
    }

    fn function(&mut self, size: f64, rough: Rough, most: f64) -> String {
        let steepest = self.steepest.min(most);
        Function::draw(self.random, self.length, rough, steepest).times(size).value()
    }

    fn boundaries(&mut self, names: &[&str], stiffness: f64) -> Hold {
        let wanted = match self.random.below(10) {
            0..6 => Hold::Dirichlet,
            6..8 => Hold::Robin,
            _ => Hold::Contact,
        };
        let flux = self.size * stiffness / self.length;
        let share = if wanted == Hold::Contact { 0.2 } else { 1.0 };
        let f = match self.random.chance(0.6) {
            true => self.function(share * flux / self.length, Rough::Jumping, 10.0),
            false => "0".to_owned(),
        };
        let _ = writeln!(self.text, "[source]\nf = \"{f}\"");
        if self.moving && self.random.chance(0.5) {
            self.input("source", "f", flux / self.length);
        }
        let value = self.function(self.size, Rough::Kinked, 1e3);
        let holding = self.random.below(names.len() as u32) as usize;
        let touching = (holding + 1) % names.len();
        for (at, name) in names.iter().enumerate() {
            let kind = match (wanted, self.random.below(6)) {
                (Hold::Dirichlet, _) if at == holding => "dirichlet",
                (Hold::Robin, _) if at == holding => "robin",
                _ if at == touching => "contact",
                (Hold::Dirichlet, 0..2) => "dirichlet",
                (Hold::Dirichlet | Hold::Robin, 2) => "robin",
                (_, 3) => "neumann",
                _ => "contact",
            };
            self.boundary(name, kind, wanted, &value, flux);
        }
        wanted
    }

    fn boundary(&mut self, name: &str, kind: &str, hold: Hold, value: &str, flux: f64) {
        let ends = Ends::draw(self.random);
        let body = match kind {
            "dirichlet" => format!("value = \"{value}\""),
            "neumann" => {
                let share = if hold == Hold::Contact { 0.1 } else { 1.0 };
                format!("flux = \"{}\"", self.function(share * flux, Rough::Jumping, 1e2))
            }
            "robin" => self.robin(flux),
            _ => self.contact(hold, value, flux, ends),
        };
        let _ = writeln!(self.text, "[boundary.{name}]\nkind = \"{kind}\"\n{body}");
        if self.moving && self.random.chance(0.3) {
            let field = match kind {
                "dirichlet" => "value",
                "robin" => "ambient",
                "contact" if self.random.chance(0.5) => "gap",
                "contact" if ends == Ends::Below => "limit",
                "contact" if ends == Ends::Both && self.random.chance(0.5) => "limit",
                _ => "flux",
            };
            let size = if matches!(field, "flux" | "limit") { flux } else { self.size };
            self.input(name, field, size);
        }
    }

    fn robin(&mut self, flux: f64) -> String {
        let most = self.random.pick(&[1e2, 1e10]);
        let h = flux / self.size * self.random.log(1.0 / most, most);
        let factor = match self.random.chance(0.3) {
            true => format!("*(1.2+tanh({}))", self.function(1.0, Rough::Kinked, 4.0)),
            false => String::new(),
        };
        let ambient = self.function(self.size, Rough::Jumping, 1e2);
        format!("coefficient = \"{h:e}{factor}\"\nambient = \"{ambient}\"")
    }

    /// ψ nowhere above u_D where u may not be below it, and likewise below; where contact alone holds the domain, loads press it
    /// against the ends.
    fn contact(&mut self, hold: Hold, value: &str, flux: f64, ends: Ends) -> String {
        let depth = self.random.log(0.01, 1.0);
        let below = self.function(depth, Rough::Kinked, 1e2);
        let (size, sign) = (self.size, if ends == Ends::Below { '+' } else { '-' });
        let gap = match hold {
            Hold::Dirichlet => format!("{value}{sign}{size:e}*abs({below})"),
            _ => format!("{size:e}*{below}"),
        };
        let end = match (hold, self.random.chance(0.5)) {
            (Hold::Contact, _) => {
                let press = flux * self.random.log(0.5, 50.0);
                format!("{:e}", if ends == Ends::Below { press } else { -press })
            }
            (_, true) => self.function(flux, Rough::Jumping, 1e2),
            (_, false) => "0".to_owned(),
        };
        let fluxes = match ends {
            Ends::Above => format!("flux = \"{end}\""),
            Ends::Below => format!("flux = \"-inf\"\nlimit = \"{end}\""),
            Ends::Both => format!("flux = \"{end}\"\nlimit = \"{end}+{}\"", self.span(flux)),
        };
        format!("gap = \"{gap}\"\n{fluxes}")
    }

    /// hi − lo, nowhere negative.
    fn span(&mut self, flux: f64) -> String {
        let span = flux * span(self.random);
        let factor = match self.random.chance(0.4) {
            true => format!("*(1.2+tanh({}))", self.function(1.0, Rough::Kinked, 4.0)),
            false => String::new(),
        };
        format!("{span:e}{factor}")
    }

    fn input(&mut self, of: &str, field: &str, size: f64) {
        let pattern = self.function(0.3 * size, Rough::Kinked, 10.0);
        let value = f64::from(self.random.between(-1.0, 1.0) as f32);
        let _ = writeln!(self.text, "[input.p{}]", self.inputs.len());
        let _ = writeln!(self.text, "of = \"{of}\"\nfield = \"{field}\"\npattern = \"{pattern}\"");
        let _ = writeln!(self.text, "default = {value:?}");
        self.inputs.push(value);
    }
}
