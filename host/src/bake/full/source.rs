//! The Rust text of the full model.

use std::fmt::Write as _;

use super::arrays::{Baked, Output};
use super::data::Pattern;
use super::items::{Item, memory, named, sizes, statics};
use crate::bake::face::About;
use crate::scalar::Scalar;

/// The module.
pub fn source<R: Scalar>(baked: &Baked<R>) -> String {
    let index = baked.index();
    let (data, fields) = match index {
        "u16" => (statics::<R, u16>(baked), memory::<R, u16>(baked)),
        _ => (statics::<R, u32>(baked), memory::<R, u32>(baked)),
    };
    let (features, sizes, counts) = (baked.features(), sizes(baked), baked.counts);
    let about = format!(
        "The full model in {}: {} unknowns, {} of them contact edges, on {} triangles and {} quads. \
         {} bytes of RAM in a [`Controller`], {} bytes of data in flash.",
        R::NAME,
        counts.unknowns(),
        counts.contact,
        baked.triangles.len(),
        baked.quads.len(),
        sizes.ram,
        sizes.flash
    );
    let report = "signorini_kernel::tick::Report<Scalar>";
    let about = About { model: "full", text: &about, features: &features, report };
    let mut text = baked.face.source::<R>(&about);
    let _ = write!(text, "\n/// Positions in the arrays.\ntype Index = {index};\n");
    text += &required(&features);
    let controller = controller(&fields);
    text += &imports(OUTER, &controller, "");
    text += &controller;
    text += &module(baked, &data);
    text
}

/// The build fails, and says why, where the kernel lacks code for the scene.
fn required(features: &[&str]) -> String {
    let assertion = |name: &&str| {
        let constant = name.to_ascii_uppercase();
        format!(
            "const _: () = assert!(signorini_kernel::features::{constant}, \"signorini-kernel \
             lacks its feature `{name}`\");\n"
        )
    };
    "\n".to_owned() + &features.iter().map(assertion).collect::<String>()
}

/// What controller and data may name, with its place in the kernel.
const OUTER: &[(&str, &str)] = &[
    ("Error", "Error"),
    ("Robin", "boundary::Robin"),
    ("Neumann", "boundary::Neumann"),
    ("Curved", "certificate::Curved"),
    ("DataMemory", "full::DataMemory"),
    ("Memory", "full::Memory"),
    ("OwnedRows", "rows::OwnedRows"),
    ("Deadline", "tick::Deadline"),
    ("Limits", "tick::Limits"),
    ("Progress", "tick::Progress"),
];

const INNER: &[(&str, &str)] = &[
    ("CellLoads", "assembly::CellLoads"),
    ("Neumann", "boundary::Neumann"),
    ("Robin", "boundary::Robin"),
    ("Cell", "cells::Cell"),
    ("Cells", "cells::Cells"),
    ("Quad", "cells::Quad"),
    ("Triangle", "cells::Triangle"),
    ("Curved", "certificate::Curved"),
    ("Ground", "certificate::Ground"),
    ("Metric", "certificate::Metric"),
    ("VertexData", "conforming::VertexData"),
    ("EdgeCounts", "edges::EdgeCounts"),
    ("Edges", "edges::Edges"),
    ("Base", "full::Base"),
    ("Chord", "full::Chord"),
    ("CurvedPart", "full::CurvedPart"),
    ("CurvedSum", "full::CurvedSum"),
    ("Full", "full::Full"),
    ("Functional", "full::Functional"),
    ("Pattern", "full::Pattern"),
    ("Points", "full::Points"),
    ("Product", "full::Product"),
    ("Share", "full::Share"),
    ("Mesh", "Mesh"),
    ("Stiffness", "stiffness::Stiffness"),
    ("Tensor", "Tensor"),
];

/// `use` of those names that the text, comments aside, has as words.
fn imports(known: &[(&str, &str)], text: &str, indent: &str) -> String {
    let code = text.lines().filter(|line| !line.trim_start().starts_with("///"));
    let text = code.collect::<Vec<_>>().join("\n");
    let is_named = |name: &str| {
        text.match_indices(name).any(|(at, _)| {
            let before = text[..at].chars().next_back().unwrap_or(' ');
            let after = text[at + name.len()..].chars().next().unwrap_or(' ');
            let inside = |letter: char| letter.is_alphanumeric() || letter == '_';
            !inside(before) && !inside(after)
        })
    };
    let used = known.iter().filter(|(name, _)| is_named(name));
    let line = |(_, path): &(&str, &str)| format!("{indent}use signorini_kernel::{path};\n");
    "\n".to_owned() + &used.map(line).collect::<String>()
}

fn controller(fields: &[Item]) -> String {
    let mut text = "
/// When a tick ends: once sweeps have brought the algebraic part of the error bound down to a tenth of it.
pub const LIMITS: Limits<Scalar> = Limits { error: 0.0, share: 0.1, sweeps: 10_000 };

/// All memory of the scene; can initialise a `static`.
#[derive(Debug)]
pub struct Controller {
"
    .to_owned();
    for Item { name, doc, of, .. } in fields {
        let _ = writeln!(text, "    /// {doc}\n    {name}: {of},");
    }
    text += "}

impl Controller {
    /// Before the first tick, which starts cold.
    pub const fn new() -> Self {
        Self {
";
    for Item { name, value, .. } in fields {
        let _ = writeln!(text, "            {name}: {value},");
    }
    text += "        }
    }

    /// Answers for these inputs, from where the last tick ended.
    ///
    /// # Errors
    /// Inputs that are not finite, or whose loads are not; the last answer stays.
    pub fn tick(&mut self, inputs: Inputs) -> Result<Answer, Error> {
        self.tick_within(inputs, LIMITS, &mut Deadline::never())
    }

    /// The same with limits of the caller's and until a deadline.
    ///
    /// # Errors
    /// As for [`Controller::tick`].
    pub fn tick_within<F: FnMut() -> u32>(
        &mut self,
        inputs: Inputs,
        limits: Limits<Scalar>,
        deadline: &mut Deadline<F>,
    ) -> Result<Answer, Error> {
        let memory = Memory {
            tick: signorini_kernel::tick::Memory {
                rows: self.rows.of(&data::FULL.ground.edges)?,
";
    let has = |field: &str| fields.iter().any(|item| item.name == field);
    for field in ["load", "active", "vertices", "bubbles", "tau", "u"] {
        let place = if has(field) { format!("&mut self.{field}") } else { "&mut []".to_owned() };
        let _ = writeln!(text, "                {field}: {place},");
    }
    text += "            },
            data: DataMemory {
";
    for (field, of) in VARYING {
        if has(field) {
            let _ = writeln!(text, "                {of}: &mut self.{field},");
        }
    }
    text + "                ..DataMemory::default()
            },
            progress: &mut self.progress,
        };
        let mut outputs = [0.0; OUTPUTS];
        let report = data::FULL.tick(&inputs.to_array(), limits, deadline, memory, &mut outputs)?;
        Ok(Answer { outputs: Outputs::from_array(outputs), report })
    }
}

impl Default for Controller {
    fn default() -> Self {
        Self::new()
    }
}
"
}

/// Fields of the controller, as the kernel's `DataMemory` calls them.
const VARYING: [(&str, &str); 11] = [
    ("source_of_triangles", "triangles"),
    ("source_of_quads", "quads"),
    ("neumann", "neumann"),
    ("robin", "robin"),
    ("contact_flux", "contact_flux"),
    ("gap", "gap"),
    ("gap_ends", "gap_ends"),
    ("dirichlet", "dirichlet"),
    ("dirichlet_ends", "dirichlet_ends"),
    ("curved", "curved"),
    ("transfer", "transfer"),
];

/// The statics, in a module of their own.
fn module<R: Scalar>(baked: &Baked<R>, data: &[Item]) -> String {
    let mut text = String::new();
    for Item { name, doc, of, value, .. } in data {
        let _ = write!(text, "\n    /// {}\n", doc.replace('[', "\\[").replace(']', "\\]"));
        let value = match name.as_str() {
            "HALF_EDGES" => value.replace(&u32::MAX.to_string(), "Index::MAX"),
            _ => value.clone(),
        };
        let _ = writeln!(text, "    static {name}: {of} = {value};");
    }
    text += &full(baked, data);
    let imports = imports(INNER, &text, "    ");
    format!(
        "
/// The scene: what stays from tick to tick.
#[rustfmt::skip]
#[allow(clippy::all)]
mod data {{
    use super::{{Index, Scalar}};{imports}{text}}}
"
    )
}

fn full<R: Scalar>(baked: &Baked<R>, data: &[Item]) -> String {
    let at = |name: &str| {
        let known = data.iter().any(|item| item.name == name);
        if known { format!("&{name}") } else { "&[]".to_owned() }
    };
    let (counts, has_bound) = (baked.counts, baked.data.has_bound);
    let patterns = baked.data.patterns.iter().zip(baked.face.inputs());
    let patterns: Vec<_> = patterns.map(|(of, input)| pattern(of, input, &at)).collect();
    let outputs = baked.outputs.iter().zip(baked.face.outputs());
    let outputs: Vec<_> =
        outputs.map(|(of, name)| functional(of, &at(&named(name, "EDGES")))).collect();
    let sums = baked.data.curved_sums.iter().enumerate().map(|(number, bent)| {
        let [parts, energy] = ["PARTS", "ENERGY"].map(|of| at(&format!("CURVED_{number}_{of}")));
        format!("CurvedSum {{ edge: {}, parts: {parts}, energy: {energy} }}", bent.edge)
    });
    let sums: Vec<_> = sums.collect();
    format!(
        "
    /// All of it.
    pub(super) static FULL: Full<'static, Scalar, Index> = Full {{
        ground: Ground {{
            mesh: Mesh::baked({}, {}, {}),
            edges: Edges::baked({}, {}, {}, {counts:?}),
            stiffness: Stiffness {{ triangles: {}, quads: {} }},
            cells: Cells::baked({}, {}, {}, {}, {}),
            metric: Metric {{ at_points: {}, place: {} }},
            reach: {:?},
        }},
        base: Base {{
            loads: CellLoads {{ triangles: {}, quads: {} }},
            neumann: {},
            robin: {},
            contact_flux: {},
            gap: {},
            dirichlet: {},
            ends: VertexData {{ gap: {}, given: {} }},
            curved: {},
            curved_sums: &{},
            transfer: {},
        }},
        patterns: &{},
        oscillation: {},
        outputs: &{},
        has_bound: {has_bound},
        corners: {},
        start: {:?},
        omega: {:?},
    }};
",
        at("VERTICES"),
        at("TRIANGLES"),
        at("QUADS"),
        at("EDGES_OF_TRIANGLES"),
        at("EDGES_OF_QUADS"),
        at("HALF_EDGES"),
        at("STIFFNESS_OF_TRIANGLES"),
        at("STIFFNESS_OF_QUADS"),
        at("PACKED_TRIANGLES"),
        at("PACKED_QUADS"),
        at("VERTEX_WEIGHTS"),
        at("EDGE_WEIGHTS"),
        at("ORDER"),
        at("METRIC"),
        at("METRIC_PLACE"),
        baked.reach,
        at("SOURCE_OF_TRIANGLES"),
        at("SOURCE_OF_QUADS"),
        at("NEUMANN"),
        at("ROBIN"),
        at("CONTACT_FLUX"),
        at("GAP"),
        at("DIRICHLET"),
        at("GAP_ENDS"),
        at("DIRICHLET_ENDS"),
        at("CURVED"),
        lines(&sums),
        at("TRANSFER"),
        lines(&patterns),
        at("OSCILLATION"),
        lines(&outputs),
        at("CORNERS"),
        baked.start,
        baked.omega,
    )
}

fn lines(entries: &[String]) -> String {
    let lines: String = entries.iter().map(|entry| format!("\n            {entry},")).collect();
    if entries.is_empty() { "[]".to_owned() } else { format!("[{lines}\n        ]") }
}

fn pattern<R>(pattern: &Pattern<R>, input: &str, at: &impl Fn(&str) -> String) -> String {
    let own = |what: &str| at(&named(input, what));
    match pattern {
        Pattern::Source { .. } => {
            let (triangles, quads) = (own("TO_TRIANGLES"), own("TO_QUADS"));
            format!("Pattern::Source {{ triangles: {triangles}, quads: {quads} }}")
        }
        Pattern::Neumann(_) => format!("Pattern::Neumann({})", own("PATTERN")),
        Pattern::ContactFlux(_) => format!("Pattern::ContactFlux({})", own("PATTERN")),
        Pattern::Gap(_) => format!("Pattern::Gap({})", own("PATTERN")),
        Pattern::Value(_) => format!("Pattern::Value({})", own("PATTERN")),
        Pattern::Ambient { .. } => {
            let (integrals, points) = (own("PATTERN"), own("AT_POINTS"));
            format!("Pattern::Ambient {{ integrals: {integrals}, points: {points} }}")
        }
    }
}

fn functional<R>(output: &Output<R>, edges: &str) -> String {
    match output {
        Output::Flux(_) => format!("Functional::Flux({edges})"),
        Output::Force(_) => format!("Functional::Force({edges})"),
        Output::Length(_) => format!("Functional::Length({edges})"),
        Output::Probe(_) => format!("Functional::Probe({edges})"),
        Output::Bound => "Functional::Bound".to_owned(),
    }
}
