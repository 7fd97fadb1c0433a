//! Sound scenes whose inputs act on every kind of load, and their controllers, which take inputs of any bits.

use std::path::Path;
use std::sync::LazyLock;

use signorini_bake::condensed::Work;
use signorini_bake::{condensed, full};
use signorini_condense::condense;
use signorini_problem::Problem;
use signorini_scene::mesh::Mesh;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::scene::Scene;

use super::bytes::Bits;

/// Inputs of each scene.
pub const INPUTS: usize = 5;

const INPUTS_AND_OUTPUTS: &str = r#"
input.lift = { of = "source", field = "f", pattern = "1 + x*y" }
input.gap = { of = "contact", field = "gap", pattern = "x" }
input.flux = { of = "contact", field = "flux", pattern = "1" }
input.bent = { of = "contact", field = "gap", pattern = "0.1*cos(3*x)" }
output.force = { kind = "force" }
output.through = { kind = "flux", of = "contact" }
output.length = { kind = "length" }
output.mean = { kind = "mean", of = "contact" }
output.probe = { kind = "probe", at = [0.3, 0.4] }
"#;

/// Where there is one.
const BOUND: &str = r#"
output.bound = { kind = "bound" }
"#;

/// Held by Dirichlet values, by a transfer law; with A that varies.
pub const TEXTS: [&str; 2] = [
    r#"
mesh = "none.msh"
material.left.conductivity = ["2", "0.5", "1"]
material.right.conductivity = "3 + x"
boundary.dirichlet = { kind = "dirichlet", value = "1 + 0.1*x" }
boundary.contact = { kind = "contact" }
input.value = { of = "dirichlet", field = "value", pattern = "1" }
"#,
    r#"
mesh = "none.msh"
material.default.conductivity = "0.5"
source.f = "-1"
boundary.dirichlet = { kind = "robin", coefficient = "2", ambient = "x" }
boundary.contact = { kind = "contact", gap = "-0.2*x^2", flux = "-0.1" }
input.ambient = { of = "dirichlet", field = "ambient", pattern = "y" }
"#,
];

/// Held by Dirichlet values, with a flux between two ends; for full models alone.
pub const LIMITED: [&str; 1] = [r#"
mesh = "none.msh"
material.default.conductivity = "1 + 0.5*x"
boundary.dirichlet = { kind = "dirichlet", value = "0.5*x" }
boundary.contact = { kind = "contact", gap = "0.2*x", flux = "-0.3", limit = "0.4" }
input.value = { of = "dirichlet", field = "value", pattern = "1" }
"#];

/// A scene of [`TEXTS`] or [`LIMITED`] on its mesh.
pub fn of(text: &str) -> Option<(Scene, Mesh)> {
    let bound = if text.contains("certificate = false") { "" } else { BOUND };
    // Both ends of a flux with a limit are fixed in a module.
    let rest = match text.contains(", limit = ") {
        true => INPUTS_AND_OUTPUTS
            .replace("of = \"contact\", field = \"flux\"", "of = \"source\", field = \"f\""),
        false => INPUTS_AND_OUTPUTS.to_owned(),
    };
    let text = format!("{text}{rest}{bound}");
    let scene = Scene::parse(&text, Path::new("sound.toml")).ok()?;
    let cells = if text.contains("robin") { Cells::Mixed } else { Cells::Triangles };
    Some((scene, grid(2, cells)))
}

const WORKS: [Work; 3] = [
    Work { pivots: Some(100), sweeps: 20 },
    Work { pivots: Some(2), sweeps: 3 },
    Work { pivots: None, sweeps: 6 },
];

/// Sweeps or a factor, with a bound and without.
const WAYS: [&str; 4] = [
    "setting = { model = \"full\", solver = \"sweeps\" }\n",
    "setting = { model = \"full\", solver = \"sweeps\", certificate = false }\n",
    "setting = { model = \"full\", solver = \"factor\" }\n",
    "setting = { model = \"full\", solver = \"factor\", certificate = false }\n",
];

/// Scalars with models of all scenes that are baked once.
pub trait Kept: Bits + 'static {
    /// The condensed models, with every method.
    fn condensed() -> &'static [condensed::Baked<Self>];

    /// The full models.
    fn full() -> &'static [full::Baked<Self>];
}

fn bake_condensed<R: Bits>() -> Vec<condensed::Baked<R>> {
    let model = |text: &&str| {
        let (scene, mesh) = of(text).expect("a sound scene");
        condense(&Problem::new(&scene, mesh).expect("a problem")).expect("a condensed model")
    };
    let baked = |model| {
        let baked = |work| condensed::Baked::new(&model, work, true);
        WORKS.map(|work| baked(work).expect("numbers of ordinary size"))
    };
    TEXTS.iter().map(model).flat_map(baked).collect()
}

fn bake_full<R: Bits>() -> Vec<full::Baked<R>> {
    let baked = |text: String| {
        let (scene, mesh) = of(&text).expect("a sound scene");
        full::Baked::new(&Problem::new(&scene, mesh).expect("a problem")).expect("a model")
    };
    let all = TEXTS.iter().chain(&LIMITED);
    all.flat_map(|text| WAYS.map(|way| format!("{text}{way}"))).map(baked).collect()
}

impl Kept for f64 {
    fn condensed() -> &'static [condensed::Baked<Self>] {
        static ALL: LazyLock<Vec<condensed::Baked<f64>>> = LazyLock::new(bake_condensed);
        &ALL
    }

    fn full() -> &'static [full::Baked<Self>] {
        static ALL: LazyLock<Vec<full::Baked<f64>>> = LazyLock::new(bake_full);
        &ALL
    }
}

impl Kept for f32 {
    fn condensed() -> &'static [condensed::Baked<Self>] {
        static ALL: LazyLock<Vec<condensed::Baked<f32>>> = LazyLock::new(bake_condensed);
        &ALL
    }

    fn full() -> &'static [full::Baked<Self>] {
        static ALL: LazyLock<Vec<full::Baked<f32>>> = LazyLock::new(bake_full);
        &ALL
    }
}
