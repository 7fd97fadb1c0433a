//! What every baked module shows, whatever its model: its header, `Inputs`, `Outputs`, `Answer`.

use std::fmt::Write as _;

use super::item::{Item, braced, from_array, items, names, read, structure, terms, to_array};
use super::meanings::{effect, meaning, said};
use super::text::{code, prose};
use signorini_image::checkout;
use signorini_problem::Problem;
use signorini_problem::functional::wanted;
use signorini_problem::inputs;
use signorini_problem::scalar::Scalar;
use signorini_scene::scene::Input;

/// The names and meanings of a scene's inputs and outputs.
#[derive(Debug, Clone)]
pub struct ModuleApi {
    title: String,
    file: String,
    hash: u64,
    inputs: Vec<Item>,
    defaults: Vec<f64>,
    ranges: Vec<[f64; 2]>,
    outputs: Vec<Item>,
}

/// The meaning of every module's numbers.
pub(crate) const UNITS: &str = "Units are the scene's: lengths those of its mesh, fluxes A∇u those of its conductivity times u by length; \
                     a bound has that of (∫A∇u·∇u)^½. A flux is (A∇u)·n with the normal outward: positive where u rises \
                     towards the outside. Heat, which flows from high u to low, then flows in; water flows out where u is −head.";

/// What a model says of itself in the header.
#[derive(Debug, Clone)]
pub struct About<'a> {
    /// `full` or `condensed`.
    pub model: &'a str,
    /// Its description, one paragraph of Markdown.
    pub text: &'a str,
    /// The features of the kernel that it needs.
    pub features: &'a [&'a str],
}

impl ModuleApi {
    /// That of `problem`.
    pub fn new(problem: &Problem) -> Self {
        let names = problem.scene.inputs.iter().map(|input| input.name.value.as_str());
        let inputs = items(
            names,
            problem.scene.inputs.iter().map(|input| effect(input) + &said(&input.unit)),
        );
        let wanted = wanted(&problem.scene);
        let names = wanted.iter().map(|output| output.name.value.as_str());
        let outputs =
            items(names, wanted.iter().map(|output| meaning(output) + &said(&output.unit)));
        let file =
            problem.scene.file().file_name().unwrap_or_default().to_string_lossy().into_owned();
        Self {
            title: problem.scene.title.clone(),
            file,
            hash: hash(problem),
            inputs,
            defaults: problem.scene.inputs.iter().map(|input| input.default).collect(),
            ranges: problem.scene.inputs.iter().map(Input::interval).collect(),
            outputs,
        }
    }

    /// The ranges of the inputs in the scalar of the target; none where the scene declares none.
    pub fn ranges<R: Scalar>(&self) -> Vec<[R; 2]> {
        inputs::ranges(&self.ranges)
    }

    /// Whether an input has a range.
    pub(super) fn has_ranges(&self) -> bool {
        !self.ranges::<f64>().is_empty()
    }

    /// Everything but the controller and its data.
    pub fn source<R: Scalar>(&self, about: &About) -> String {
        self.header(about) + &self.types::<R>(about)
    }

    /// Identifiers of the inputs, in the order of the scene.
    pub fn inputs(&self) -> impl Iterator<Item = &str> {
        self.inputs.iter().map(|item| item.identifier.as_str())
    }

    /// Identifiers of the outputs.
    pub fn outputs(&self) -> impl Iterator<Item = &str> {
        self.outputs.iter().map(|item| item.identifier.as_str())
    }

    /// The scene's title and the name of its file.
    pub(crate) fn title(&self) -> &str {
        &self.title
    }

    pub(crate) fn file(&self) -> &str {
        &self.file
    }

    /// Inputs and outputs, with what they mean.
    pub(crate) fn input_items(&self) -> &[Item] {
        &self.inputs
    }

    pub(crate) fn output_items(&self) -> &[Item] {
        &self.outputs
    }

    /// The ranges as the scene gives them.
    pub(crate) fn given_ranges(&self) -> &[[f64; 2]] {
        &self.ranges
    }

    /// The hash of scene, setting, mesh and default inputs.
    pub fn hash(&self) -> u64 {
        self.hash
    }

    fn header(&self, about: &About) -> String {
        let Self { title, file, hash, inputs, outputs, .. } = self;
        let features: Vec<_> = about.features.iter().map(|name| format!("{name:?}")).collect();
        let mut lines = vec![
            prose(title),
            String::new(),
            about.text.to_owned(),
            String::new(),
            format!(
                "From {}, scene hash {hash:016x} (scene file, setting, mesh, default inputs).",
                code(file)
            ),
            format!("Written by `signorini bake` {}; do not edit.", env!("CARGO_PKG_VERSION")),
            String::new(),
            "```toml".to_owned(),
            dependency(&features),
            "```".to_owned(),
            format!("Kernel features: {}.", features_or_none(about.features)),
            String::new(),
            UNITS.to_owned(),
        ];
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

    fn types<R: Scalar>(&self, about: &About) -> String {
        let mut text = String::new();
        let _ = write!(
            text,
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
pub const INPUTS: usize = {inputs};
/// Number of outputs.
pub const OUTPUTS: usize = {outputs};
",
            scalar = R::NAME,
            model = about.model,
            hash = self.hash,
            features = about.features,
            inputs = self.inputs.len(),
            outputs = self.outputs.len(),
        );
        text += &structure("Inputs", "What the controller sets.", &self.inputs);
        let defaults = self.defaults.iter().map(|&x| format!("{:?}", R::narrow(x)));
        let defaults = self.inputs().zip(defaults).map(|(name, x)| format!("{name}: {x}"));
        let defaults = braced("Self", defaults);
        text += "
impl Inputs {
    /// The values that the scene gives.
";
        let _ = writeln!(text, "    pub const DEFAULT: Self = {defaults};");
        text += &names("INPUTS", &self.inputs);
        text += &from_array("INPUTS", &self.inputs);
        text += &to_array("INPUTS", &self.inputs);
        text += &self.range_items::<R>();
        text += "}\n";
        text += &terms(&self.inputs);
        text += &structure("Outputs", "What the controller reads.", &self.outputs);
        text += "\nimpl Outputs {\n";
        text += &names("OUTPUTS", &self.outputs);
        text += &from_array("OUTPUTS", &self.outputs);
        text += &to_array("OUTPUTS", &self.outputs);
        text + "}\n" + &read(&self.outputs)
    }
}

impl ModuleApi {
    /// The ranges, and what takes a value into its own.
    fn range_items<R: Scalar>(&self) -> String {
        let end = |end: f64| match (end.is_finite(), end > 0.0) {
            (true, _) => format!("{:?}", R::narrow(end)),
            (false, true) => "Scalar::INFINITY".to_owned(),
            (false, false) => "Scalar::NEG_INFINITY".to_owned(),
        };
        let range = |[lo, hi]: &[f64; 2]| format!("[{}, {}]", end(*lo), end(*hi));
        let ranges: Vec<_> = self.ranges.iter().map(range).collect();
        let clamped = self.inputs().enumerate().map(|(at, name)| {
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
            braced("Self", clamped),
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

/// The line of a Cargo.toml. The kernel is on no registry: it is found where the checkout stands that has baked this.
fn dependency(features: &[String]) -> String {
    let (place, remark) = match checkout::find() {
        Ok(root) => {
            (root.join("kernel/device").display().to_string(), "the checkout that has baked this")
        }
        Err(_) => {
            ("kernel/device".to_owned(), "the folder kernel/device of a checkout of signorini")
        }
    };
    let features = features.join(", ");
    format!(
        "signorini-device = {{ path = {place:?}, default-features = false, features = [{features}] }} # {remark}"
    )
}

/// The features by name.
fn features_or_none(features: &[&str]) -> String {
    if features.is_empty() { "none".to_owned() } else { features.join(", ") }
}

/// FNV-1a over what the data are made of.
fn hash(problem: &Problem) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut take = |bytes: &[u8]| {
        for &byte in bytes {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    };
    take(problem.scene.text.as_bytes());
    // A fragment's setting is no part of that text.
    problem.scene.setting.iter().for_each(|setting| take(format!("{setting:?}").as_bytes()));
    problem.scene.inputs.iter().for_each(|input| take(&input.default.to_le_bytes()));
    let mesh = &problem.mesh;
    mesh.vertices.as_flattened().iter().for_each(|x| take(&x.to_le_bytes()));
    let corners = mesh.triangles.as_flattened().iter().chain(mesh.quads.as_flattened());
    corners.for_each(|vertex| take(&vertex.to_le_bytes()));
    for surface in &mesh.surfaces {
        take(surface.name.as_bytes());
        surface.cells.iter().for_each(|cell| take(&cell.to_le_bytes()));
    }
    for curve in &mesh.curves {
        take(curve.name.as_bytes());
        curve.edges.as_flattened().iter().for_each(|vertex| take(&vertex.to_le_bytes()));
    }
    hash
}
