//! The text of the statics, in a module of their own.

use std::fmt::Write as _;

use super::arrays::Baked;
use super::data::Pattern;
use super::imports::imports;
use super::items::named;
use super::list::Item;
use super::output::Output;
use signorini_solve::scalar::Scalar;

/// What they may name, with its place in the kernel.
const NAMES: &[(&str, &str)] = &[
    ("CellLoads", "discrete::assembly::CellLoads"),
    ("InitialTableau", "solve::dense::tableau::InitialTableau"),
    ("Neumann", "mesh::boundary::Neumann"),
    ("Robin", "mesh::boundary::Robin"),
    ("Cell", "bound::cells::Cell"),
    ("Cells", "bound::cells::Cells"),
    ("Quad", "bound::cells::Quad"),
    ("Triangle", "bound::cells::Triangle"),
    ("Curved", "bound::certificate::Curved"),
    ("Discretization", "bound::certificate::Discretization"),
    ("Metric", "bound::certificate::Metric"),
    ("Stability", "bound::certificate::Stability"),
    ("VertexData", "bound::conforming::VertexData"),
    ("EdgeCounts", "mesh::edges::EdgeCounts"),
    ("Edges", "mesh::edges::Edges"),
    ("Base", "device::full::Base"),
    ("EdgeTrace", "device::full::EdgeTrace"),
    ("CurvedPart", "device::full::CurvedPart"),
    ("CurvedSum", "device::full::CurvedSum"),
    ("Full", "device::full::Full"),
    ("Functional", "device::full::Functional"),
    ("Pattern", "device::full::Pattern"),
    ("Points", "device::full::Points"),
    ("Product", "device::full::Product"),
    ("Contribution", "device::full::Contribution"),
    ("Mesh", "Mesh"),
    ("Relaxation", "solve::Relaxation"),
    ("Factor", "solve::sparse::Factor"),
    ("Factored", "solve::sparse::Factored"),
    ("Stiffness", "discrete::stiffness::Stiffness"),
    ("Tensor", "Tensor"),
];

/// The statics, in a module of their own.
pub(super) fn listing<R: Scalar>(baked: &Baked<R>, data: &[Item]) -> String {
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
    let imports = imports(NAMES, &text, "    ");
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
        ground: Discretization {{
            mesh: Mesh::baked({}, {}, {}),
            edges: Edges::baked({}, {}, {}, {counts:?}),
            stiffness: Stiffness {{ triangles: {}, quads: {} }},
            cells: Cells::baked({}, {}, {}, {}, {}),
            metric: Metric {{ at_points: {}, place: {}, distortions: {} }},
            stability: Stability {{ largest: {:?}, weighed: {:?}, oblique: {:?} }},
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
        relaxation: Relaxation::{:?},
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
        at("QUAD_DISTORTIONS"),
        baked.stability.largest,
        baked.stability.weighed,
        baked.stability.oblique,
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
        baked.how.relaxation,
    ) + &factored(baked, &at)
}

/// The factor, where there is one.
fn factored<R: Scalar>(baked: &Baked<R>, at: &impl Fn(&str) -> String) -> String {
    if baked.factored.is_none() {
        return String::new();
    }
    format!(
        "
    /// The matrix by its factor.
    pub(super) static FACTORED: Factored<'static, Scalar, Index> = Factored {{
        factor: Factor::baked({}, {}, {}, {}, {}, {:?}),
        schur: {schur},
        scale: {},
        start: InitialTableau {{ blocks: {schur}, exchanged: {} }},
    }};
",
        at("PLACES"),
        at("COLUMNS"),
        at("ROWS"),
        at("ENTRIES"),
        at("INVERSE"),
        baked.counts,
        at("SCALE"),
        at("NONE"),
        schur = at("SCHUR"),
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
