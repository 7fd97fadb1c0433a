//! Random scenes with inputs on every field and outputs of every kind.

use signorini_bake::Bakes;
use signorini_bake::condensed::{Baked, Work};
use signorini_condense::{CondensedModel, condense};
use signorini_problem::Problem;
use signorini_scene::mesh::Mesh;
use signorini_solve::Solution;
use signorini_solve::fixtures::full_at;
use signorini_tests::random::{Random, tensor};

use crate::mesh::{KINDS, regular, scattered};
use crate::standard::posed;

/// Solves to the end.
pub const EXACT: Work = Work { pivots: Some(1000), sweeps: 50 };

/// A scene with its condensed model.
pub struct Model {
    pub what: String,
    pub problem: Problem,
    pub condensate: CondensedModel,
}

impl Model {
    pub fn new(what: String, problem: Problem) -> Result<Self, String> {
        let condensate = condense(&problem).map_err(|error| format!("{what}: {error}"))?;
        Ok(Self { what, problem, condensate })
    }

    /// A random one: 2 to `2 * most` edges along the bottom, up to three sides more.
    /// `None` where u_D lies below ψ for the default inputs.
    pub fn random(seed: u64, most: u32) -> Option<Self> {
        let random = &mut Random::new(seed);
        let text = text(random);
        let (n, cells) = (1 + random.below(most), KINDS[random.below(3) as usize]);
        let moved = random.below(3) > 0;
        let mesh = if moved { scattered(random, n, cells) } else { regular(n, cells) };
        let what = format!("seed {seed}, {cells:?} {n}");
        match Self::of_text(what, &text, mesh) {
            Ok(model) => Some(model),
            Err(error) if error.contains("lies below the gap") => None,
            Err(error) => panic!("{error}\n{text}"),
        }
    }

    pub fn of_text(what: String, text: &str, mesh: Mesh) -> Result<Self, String> {
        let problem = posed(text, mesh).map_err(|error| format!("{what}: {error}"))?;
        Self::new(what, problem)
    }

    pub fn baked<R: Bakes>(&self, work: Work) -> Baked<R> {
        let baked = Baked::new(&self.condensate, work, true);
        baked.unwrap_or_else(|error| panic!("{}: {error}", self.what))
    }

    /// The full problem at these inputs, solved directly: its outputs in the order of the condensed ones.
    /// `None` where u_D lies below ψ.
    pub fn full(&self, inputs: &[f64]) -> Option<(Problem, Solution, Vec<Option<f64>>)> {
        let p: Vec<f64> = std::iter::once(1.0).chain(inputs.iter().copied()).collect();
        full_at(&self.problem, &p).ok()
    }
}

/// A factor with three digits.
fn factor(random: &mut Random) -> f64 {
    (1e3 * random.between(-1.0, 1.0)).round() / 1e3
}

fn affine(random: &mut Random) -> String {
    let [a, b, c] = [(); 3].map(|()| factor(random));
    format!("{a} + {b}*x + {c}*y")
}

/// Smooth, and of any sign.
fn bent(random: &mut Random) -> String {
    let (a, b) = (factor(random), factor(random));
    format!("{} + {a}*x^2 + {b}*cos(2*x + y)", affine(random))
}

fn pattern(random: &mut Random) -> String {
    match random.below(3) {
        0 => factor(random).to_string(),
        1 => affine(random),
        _ => bent(random),
    }
}

/// The sides of the rectangle, the bottom touching always, one other at least held.
fn text(random: &mut Random) -> String {
    let mut text = "mesh = \"none.msh\"\n".to_owned();
    for name in ["left", "right"] {
        let [xx, xy, yy] = tensor(random).map(|entry| format!("{entry:e}"));
        let vary = if random.below(3) == 0 { " + (1 + x)^2" } else { "" };
        text += &format!("[material.{name}]\nconductivity = [\"{xx}{vary}\", {xy}, {yy}]\n");
    }
    text += &format!("[source]\nf = \"{}\"\n", bent(random));
    let value = bent(random);
    let mut inputs = vec![("source", "f")];
    let held = random.below(3) as usize;
    let sides = ["left", "right", "top"].into_iter().enumerate();
    let names = std::iter::once(("contact", 3));
    let kinds = sides.map(|(at, name)| {
        let kind = if at == held { 5 + random.below(3) } else { random.below(9) };
        (name, kind)
    });
    for (name, kind) in names.chain(kinds.collect::<Vec<_>>()) {
        let (keys, fields): (String, &[&str]) = match kind {
            0..=2 => (format!("neumann\"\nflux = \"{}\"", bent(random)), &["flux"]),
            3..=4 => {
                let lift = 0.3 * factor(random);
                let flux = bent(random);
                let keys = format!("contact\"\ngap = \"{value} + {lift}*y\"\nflux = \"{flux}\"");
                (keys, &["gap", "flux"])
            }
            5..=6 => {
                let ambient = bent(random);
                (
                    format!("robin\"\ncoefficient = \"2 + x*y\"\nambient = \"{ambient}\""),
                    &["ambient"],
                )
            }
            _ => (format!("dirichlet\"\nvalue = \"{value} + 0.1*y\""), &["value"]),
        };
        text += &format!("[boundary.{name}]\nkind = \"{keys}\n");
        inputs.extend(fields.iter().map(|field| (name, *field)));
        text += &format!("[output.{name}]\nkind = \"flux\"\nof = \"{name}\"\n");
    }
    for (at, (of, field)) in inputs.into_iter().enumerate() {
        if random.below(3) == 0 {
            continue;
        }
        let default = f64::from(random.below(64)) / 64.0;
        text += &format!(
            "[input.p{at}]\nof = \"{of}\"\nfield = \"{field}\"\npattern = \"{}\"\ndefault = {default}\n",
            pattern(random)
        );
    }
    let at = [random.between(-0.9, 0.9), random.between(0.1, 0.9)];
    text += "[output.force]\nkind = \"force\"\n[output.length]\nkind = \"length\"\n";
    text +=
        "[output.below]\nkind = \"length\"\nof = \"contact\"\n[output.bound]\nkind = \"bound\"\n";
    text + &format!("[output.probe]\nkind = \"probe\"\nat = {at:?}\n")
}
