//! A scene that stores u, and what its inputs do tick after tick, drawn at random.
//!
//! Each moving datum has an input of its own. A step holds f, fluxes, limits, coefficients and ambients at their last value; u_D and
//! gaps go linearly ([`Trajectory::on_line`]): a finer step that plays the same data takes those between two ticks.

use std::fmt::Write;
use std::path::Path;

use super::function::{Function, Rough};
use super::mesh::{self, Kind, MeshPlan, Outline, Regions};
use super::posed::{Ends, Hold, turned};
use signorini_problem::Problem;
use signorini_problem::random::Random;
use signorini_scene::error::Result;
use signorini_scene::mesh::Mesh;
use signorini_scene::scene::Scene;
use signorini_solve::ScalarKind;

#[derive(Debug, Clone)]
pub struct Trajectory {
    pub hold: Hold,
    pub kind: Kind,
    pub scalar: ScalarKind,
    pub sweeps: Option<u32>,
    pub text: String,
    pub step: f64,
    /// u at the start; nothing for a steady one.
    pub initial: Option<String>,
    pub mesh: Mesh,
    pub log: Vec<Vec<f64>>,
    /// Whether gaps and values are linear along edges.
    pub is_affine: bool,
    /// Whether an input goes linearly in a step, or holds its value at the end of it.
    pub on_line: Vec<bool>,
}

impl Trajectory {
    /// Case `number` of the run with this seed.
    pub fn draw(seed: u64, number: u32) -> Self {
        let mut random = Random::of_case(seed, number);
        let kind = random.pick(&[Kind::Triangles, Kind::Quads, Kind::Both]);
        let plan = plan(&mut random, kind);
        let drawn = mesh::draw(&mut random, &plan);
        let (text, on_line) = (String::new(), Vec::new());
        let is_affine = random.chance(0.5);
        let mut drawing = Drawing { random, is_affine, text, on_line };
        let time = drawing.materials(&drawn.mesh);
        let names: Vec<&str> = drawn.mesh.curves.iter().map(|curve| curve.name.as_str()).collect();
        let hold = drawing.boundaries(&names);
        let Drawing { mut random, text, on_line, .. } = drawing;
        let is_stated = hold == Hold::Contact || random.chance(0.5);
        let initial = is_stated
            .then(|| Function::draw(&mut random, 1.0, Rough::Kinked, 3.0).times(0.3).value());
        Self {
            hold,
            kind,
            scalar: random.pick(&[ScalarKind::F64, ScalarKind::F64, ScalarKind::F32]),
            sweeps: random.chance(0.5).then(|| random.log(1.0, 40.0) as u32),
            text,
            step: time * random.log(1e-4, 10.0),
            initial,
            mesh: drawn.mesh,
            log: log(&mut random, on_line.len()),
            is_affine,
            on_line,
        }
    }

    /// The scene by steps of dt over `parts`, in a setting of its own if there is any text of one.
    pub fn scene(&self, parts: u32, setting: &str) -> Result<Scene> {
        Scene::parse(&(self.scene_text(parts) + setting), Path::new("scene.toml"))
    }

    pub fn scene_text(&self, parts: u32) -> String {
        let initial = self.initial.as_ref().map(|of| format!("initial = \"{of}\"\n"));
        let step = self.step / f64::from(parts);
        format!("{}[time]\nstep = {step:e}\n{}", self.text, initial.unwrap_or_default())
    }

    /// Inputs of tick `tick`, counted from 0, at the end of part `part` of `parts` of its step.
    pub fn inputs(&self, tick: usize, [part, parts]: [u32; 2], problem: &Problem) -> Vec<f64> {
        let inputs = problem.scene.inputs.iter();
        let defaults = || inputs.map(|input| input.default).collect();
        let last = tick.checked_sub(1).map_or_else(defaults, |last| self.log[last].clone());
        let share = f64::from(part) / f64::from(parts);
        let values = last.iter().zip(&self.log[tick]).zip(&self.on_line);
        let value = |((&from, &to), &on_line): ((&f64, &f64), &bool)| match on_line {
            true => from + share * (to - from),
            false => to,
        };
        values.map(value).collect()
    }
}

fn plan(random: &mut Random, kind: Kind) -> MeshPlan {
    MeshPlan {
        cells: random.log(4.0, 60.0) as u32,
        kind,
        outline: random.pick(&[Outline::Whole, Outline::Whole, Outline::Corner]),
        regions: random.pick(&[Regions::Halves, Regions::Layers, Regions::Scattered]),
        moved: if random.chance(0.5) { random.between(0.0, 0.25) } else { 0.0 },
        graded: random.chance(0.2),
        split: random.chance(0.3),
        map: [[1.0, 0.0], [0.0, 1.0]],
    }
}

/// Jumps, ramps and rests of each input.
fn log(random: &mut Random, inputs: usize) -> Vec<Vec<f64>> {
    let ticks = 4 + random.below(9) as usize;
    let mut values = vec![0.0; inputs];
    let mut slopes = vec![0.0; inputs];
    let tick = |_| {
        for (value, slope) in values.iter_mut().zip(&mut slopes) {
            match random.below(4) {
                0 => (*value, *slope) = (random.between(-1.0, 1.0), 0.0),
                1 => *slope = random.between(-0.3, 0.3),
                _ => *value = f64::clamp(*value + *slope, -1.0, 1.0),
            }
        }
        values.clone()
    };
    (0..ticks).map(tick).collect()
}

struct Drawing {
    random: Random,
    is_affine: bool,
    text: String,
    on_line: Vec<bool>,
}

impl Drawing {
    /// A and c of each material; returns a time in which u spreads over the domain.
    fn materials(&mut self, mesh: &Mesh) -> f64 {
        let random = &mut self.random;
        let (contrast, rare) = (random.pick(&[1.0, 10.0, 1e3]), random.below(4) == 0);
        self.text += "title = \"random\"\nmesh = \"mesh.msh\"\n";
        let mut time = 0.0_f64;
        for (at, surface) in mesh.surfaces.iter().enumerate() {
            let size = random.log(1.0 / contrast, contrast.max(1.000_001));
            let ratio: f64 = if random.chance(0.3) { random.log(1.0, 30.0) } else { 1.0 };
            let along = random.between(0.0, 3.0).sin_cos();
            let [xx, xy, yy] = turned([size * ratio.sqrt(), size / ratio.sqrt()], along);
            let own = random.log(1.0 / contrast, contrast.max(1.000_001));
            let capacity = if rare && at > 0 { 0.0 } else { own };
            time = time.max(capacity / size);
            let _ = writeln!(self.text, "[material.{}]", surface.name);
            let _ = writeln!(self.text, "conductivity = [\"{xx:e}\", \"{xy:e}\", \"{yy:e}\"]");
            let _ = writeln!(self.text, "capacity = {capacity:e}");
        }
        time
    }

    /// A term of this size at most: affine in the place, a wave, or a kink.
    fn bend(&mut self, size: f64) -> String {
        let [a, b] = [0.5; 2].map(|most| size * self.random.between(-most, most));
        match if self.is_affine { 2 } else { self.random.below(6) } {
            0 => format!("+{size:e}*sin({:e}*x+3*y)", self.random.between(1.0, 6.0)),
            1 => format!("+{size:e}*(abs(x-{:e})-1)", self.random.between(-0.9, 0.9)),
            _ => format!("+{a:e}*x+{b:e}*y"),
        }
    }

    /// An input of its own for a datum, affine in the place or another function of it.
    fn input(&mut self, of: &str, field: &str, size: f64, rough: Rough) {
        let [a, b] = [0.2; 2].map(|most| size * self.random.between(-most, most));
        let pattern = match self.random.chance(0.4) {
            true => Function::draw(&mut self.random, 1.0, rough, 5.0).times(size).value(),
            false => format!("{:e}+{a:e}*x+{b:e}*y", 0.6 * size),
        };
        self.input_of(of, field, &pattern);
    }

    fn input_of(&mut self, of: &str, field: &str, pattern: &str) {
        let _ = writeln!(self.text, "[input.p{}]\nof = \"{of}\"", self.on_line.len());
        let _ = writeln!(self.text, "field = \"{field}\"\npattern = \"{pattern}\"\ndefault = 0");
        self.on_line.push(matches!(field, "value" | "gap"));
    }

    fn boundaries(&mut self, names: &[&str]) -> Hold {
        let hold = match self.random.below(10) {
            0..6 => Hold::Dirichlet,
            6..9 => Hold::Robin,
            _ => Hold::Contact,
        };
        let f = self.random.between(-3.0, 3.0);
        let _ = writeln!(self.text, "[source]\nf = {f:e}");
        if self.random.chance(0.8) {
            self.input("source", "f", 10.0, Rough::Jumping);
        }
        let holding = self.random.below(names.len() as u32) as usize;
        for (at, name) in names.iter().enumerate() {
            match (hold, self.random.below(6)) {
                _ if at == (holding + 1) % names.len() => self.contact(name),
                (Hold::Dirichlet, _) if at == holding => self.dirichlet(name),
                (Hold::Robin, _) if at == holding => self.robin(name),
                (Hold::Dirichlet | Hold::Robin, 1) => self.robin(name),
                (_, 2) => self.neumann(name),
                _ => self.contact(name),
            }
        }
        hold
    }

    fn boundary(&mut self, name: &str, kind: &str, data: &str) {
        let _ = writeln!(self.text, "[boundary.{name}]\nkind = \"{kind}\"\n{data}");
    }

    /// Above every gap.
    fn dirichlet(&mut self, name: &str) {
        let value = format!("value = \"1.1{}\"", self.bend(0.3));
        self.boundary(name, "dirichlet", &value);
        if self.random.chance(0.6) {
            let pattern = self.bend(0.2);
            self.input_of(name, "value", &format!("0.5{pattern}"));
        }
    }

    fn robin(&mut self, name: &str) {
        let (h, ambient) = (self.random.log(0.03, 30.0), self.random.between(-0.5, 0.5));
        self.boundary(name, "robin", &format!("coefficient = {h:e}\nambient = {ambient:e}"));
        match self.random.below(3) {
            0 => self.input(name, "ambient", 1.0, Rough::Kinked),
            1 => {
                // h stays above a tenth of itself.
                let pattern = 0.9 * h;
                let _ = writeln!(self.text, "[input.p{}]\nof = \"{name}\"", self.on_line.len());
                let _ = writeln!(self.text, "field = \"coefficient\"\npattern = {pattern:e}");
                self.text += "default = 0\nrange = [-1, 1]\n";
                self.on_line.push(false);
            }
            _ => {}
        }
    }

    fn neumann(&mut self, name: &str) {
        let flux = self.random.between(-0.5, 0.5);
        self.boundary(name, "neumann", &format!("flux = {flux:e}"));
        if self.random.chance(0.5) {
            self.input(name, "flux", 1.0, Rough::Jumping);
        }
    }

    fn contact(&mut self, name: &str) {
        let ends = match Ends::draw(&mut self.random) {
            Ends::Below => Ends::Both,
            ends => ends,
        };
        let bend = self.bend(0.2);
        let limit = match ends {
            Ends::Both => format!("flux = -0.3\nlimit = {:e}", self.random.log(0.1, 10.0)),
            _ => String::new(),
        };
        self.boundary(name, "contact", &format!("gap = \"-0.5{bend}\"\n{limit}"));
        if self.random.chance(0.5) {
            let pattern = self.bend(0.15);
            self.input_of(name, "gap", &format!("0.15{pattern}"));
        }
    }
}
