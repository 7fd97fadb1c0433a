//! What every baked module shows, whatever its model: its header, `Inputs`, `Outputs`, `Answer`.

use std::fmt::Write as _;

use super::fingerprint::Fingerprint;
use super::item::{Item, arrays, braced, items, read, structure, terms};
use super::meanings::{effect, meaning, said};
use super::text::{code, prose};
use signorini_image::checkout;
use signorini_problem::Problem;
use signorini_problem::functional::{wanted, windows};
use signorini_problem::inputs;
use signorini_problem::scalar::Scalar;
use signorini_scene::scene::Input;

/// The names and meanings of a scene's inputs and outputs.
#[derive(Debug, Clone)]
pub struct ModuleApi {
    pub(crate) title: String,
    /// The name of its file.
    pub(crate) file: String,
    /// Of scene, setting, mesh and default inputs.
    pub hash: u64,
    pub(crate) inputs: Vec<Item>,
    defaults: Vec<f64>,
    /// As the scene gives them.
    pub(crate) given_ranges: Vec<[f64; 2]>,
    pub(crate) outputs: Vec<Item>,
    /// Positions of outputs that are the bound over time.
    pub(crate) windows: Vec<usize>,
    /// The length of a step in time, where ticks are such.
    pub(crate) step: Option<f64>,
}

/// The meaning of every module's numbers.
pub(crate) const UNITS: &str = "Units are the scene's: lengths those of its mesh, fluxes A∇u those of its conductivity times u by length; \
                     a bound has that of (∫A∇u·∇u)^½. A flux is (A∇u)·n with the normal outward: positive where u rises \
                     towards the outside. Heat, which flows from high u to low, then flows in; water flows out where u is −head.";

/// The meaning of ticks that are steps of the length `STEP`.
pub(crate) const STEPS: &str = "A tick is a step of length STEP by the implicit Euler method, from where the last one has ended. Inputs act all through \
                     it; gaps and given values of u go on a line from those of the last tick. Bounds and intervals of a tick are about \
                     this one step; `window` bounds the error of the whole evolution.";

impl ModuleApi {
    /// That of `problem`.
    pub fn new(problem: &Problem) -> Self {
        let (scene, wanted) = (&problem.scene, wanted(&problem.scene));
        let effects = scene.inputs.iter().map(|input| effect(input) + &said(&input.unit));
        let meanings = wanted.iter().map(|output| meaning(output) + &said(&output.unit));
        Self {
            title: scene.title.clone(),
            file: scene.file().file_name().unwrap_or_default().to_string_lossy().into_owned(),
            hash: hash(problem),
            inputs: items(scene.inputs.iter().map(|input| input.name.value.as_str()), effects),
            defaults: scene.inputs.iter().map(|input| input.default).collect(),
            given_ranges: scene.inputs.iter().map(Input::interval).collect(),
            outputs: items(wanted.iter().map(|output| output.name.value.as_str()), meanings),
            windows: windows(scene),
            step: scene.step(),
        }
    }

    /// The ranges of the inputs in the scalar of the target; none where the scene declares none.
    pub fn ranges<R: Scalar>(&self) -> Vec<[R; 2]> {
        inputs::ranges(&self.given_ranges)
    }

    /// The outputs that are the bound over time.
    pub(super) fn told(&self) -> impl Iterator<Item = &str> {
        self.windows.iter().map(|&at| self.outputs[at].identifier.as_str())
    }

    /// Whether an input has a range.
    pub(super) fn has_ranges(&self) -> bool {
        !self.ranges::<f64>().is_empty()
    }

    /// Everything but the controller and its data; `model` is `full` or `condensed`, `about` its description, one
    /// paragraph of Markdown, and `features` are those of the kernel that it needs.
    pub fn source<R: Scalar>(&self, model: &str, about: String, features: &[&str]) -> String {
        self.header(about, features) + &self.types::<R>(model, features)
    }

    fn header(&self, about: String, features: &[&str]) -> String {
        let Self { title, file, hash, inputs, outputs, .. } = self;
        let mut lines = vec![
            prose(title),
            String::new(),
            about,
            String::new(),
            format!(
                "From {}, scene hash {hash:016x} (scene file, setting, mesh, default inputs).",
                code(file)
            ),
            format!("Written by `signorini bake` {}; do not edit.", env!("CARGO_PKG_VERSION")),
            String::new(),
            "```toml".to_owned(),
            dependency(features),
            "```".to_owned(),
            format!(
                "Kernel features: {}.",
                match features {
                    [] => "none".to_owned(),
                    features => features.join(", "),
                }
            ),
            String::new(),
            UNITS.to_owned(),
        ];
        if self.step.is_some() {
            lines.extend([String::new(), STEPS.to_owned()]);
        }
        let mut table = |kind: &str, items: &[Item]| {
            if !items.is_empty() {
                let head = format!("| {kind} | meaning |");
                lines.extend([String::new(), head, "|---|---|".to_owned()]);
                let row = |item: &Item| format!("| `{}` | {} |", item.identifier, item.doc);
                lines.extend(items.iter().map(row));
            }
        };
        table("input", inputs);
        table("output", outputs);
        let lines = lines.iter().map(|line| format!("//! {line}").trim_end().to_owned() + "\n");
        // A firmware needs not read all that a module offers.
        let allow = "\n#![allow(dead_code, unused_imports)]\n".to_owned();
        lines.chain([allow, VERSION.to_owned()]).collect()
    }

    fn types<R: Scalar>(&self, model: &str, features: &[&str]) -> String {
        let Self { hash, inputs, defaults, outputs, .. } = self;
        let mut text = format!(
            "
/// Every number of this module.
pub type Scalar = {scalar};
/// Which model of the scene this is.
pub const MODEL: &str = {model:?};
/// The scene that it was made of.
pub const SCENE_HASH: u64 = 0x{hash:016x};
/// The features of `signorini-device` that it needs.
pub const KERNEL_FEATURES: &[&str] = &{features:?};
/// Number of inputs.
pub const INPUTS: usize = {};
/// Number of outputs.
pub const OUTPUTS: usize = {};
",
            inputs.len(),
            outputs.len(),
            scalar = R::NAME,
        );
        if let Some(step) = self.step {
            let step = R::narrow(step);
            let _ = writeln!(
                text,
                "/// The length of a step in time.\npub const STEP: Scalar = {step:?};"
            );
        }
        text += &structure("Inputs", "What the controller sets.", inputs);
        let named = inputs.iter().zip(defaults);
        let defaults =
            braced(named.map(|(item, &x)| format!("{}: {:?}", item.identifier, R::narrow(x))));
        text += "
impl Inputs {
    /// The values that the scene gives.
";
        let _ = writeln!(text, "    pub const DEFAULT: Self = {defaults};");
        text += &(arrays("INPUTS", inputs) + &self.range_items::<R>() + "}\n" + &terms(inputs));
        text += &structure("Outputs", "What the controller reads.", outputs);
        text + "\nimpl Outputs {\n" + &arrays("OUTPUTS", outputs) + "}\n" + &read(outputs)
    }

    /// The ranges, and what takes a value into its own.
    fn range_items<R: Scalar>(&self) -> String {
        let end = |end: f64| match (end.is_finite(), end > 0.0) {
            (true, _) => format!("{:?}", R::narrow(end)),
            (false, true) => "Scalar::INFINITY".to_owned(),
            (false, false) => "Scalar::NEG_INFINITY".to_owned(),
        };
        let range = |[lo, hi]: &[f64; 2]| format!("[{}, {}]", end(*lo), end(*hi));
        let ranges: Vec<_> = self.given_ranges.iter().map(range).collect();
        let clamped = self.inputs.iter().enumerate().map(|(at, Item { identifier: name, .. })| {
            format!("{name}: signorini_device::ranges::clamp(self.{name}, Self::RANGES[{at}])")
        });
        format!(
            "
    /// The least and the largest value of each. A tick refuses what lies outside, by its number here.
    pub const RANGES: [[Scalar; 2]; INPUTS] = [{}];

    /// The nearest values within the ranges, for a caller who wants no refusal.
    pub fn clamped(self) -> Self {{
        {}
    }}
",
            ranges.join(", "),
            braced(clamped),
        )
    }
}

/// The module's data are laid out for one version of the kernel.
const VERSION: &str = concat!(
    "\n// Written for this kernel: bake the scene again for another one.\n",
    "const _: () = assert!(signorini_device::is_version(\"",
    env!("CARGO_PKG_VERSION"),
    "\"), \"baked for signorini-device ",
    env!("CARGO_PKG_VERSION"),
    "; bake the scene again\");\n"
);

/// The line of a Cargo.toml. The kernel is on no registry: it is found where the sources of the program stand that has baked this.
fn dependency(features: &[&str]) -> String {
    let (place, remark) = match (checkout::find(), checkout::sources()) {
        (Ok(root), _) => (root.join("kernel/device"), "the checkout that has baked this"),
        (_, Ok(root)) => {
            (root.join("kernel/device"), "what `signorini` has put there; keep a copy of all of it")
        }
        _ => ("kernel/device".into(), "the folder kernel/device of a checkout of signorini"),
    };
    format!(
        "signorini-device = {{ path = {place:?}, default-features = false, features = {features:?} }} # {remark}"
    )
}

/// The number of a scene: over all that its module's data are made of.
pub fn hash(problem: &Problem) -> u64 {
    let mut all = Fingerprint::default();
    all.take_scene(&problem.scene);
    problem.scene.inputs.iter().for_each(|input| all.take(&input.default.to_le_bytes()));
    // The command line may say another one.
    problem.scene.step().iter().for_each(|step| all.take(&step.to_le_bytes()));
    all.take_mesh(&problem.mesh);
    all.0
}
