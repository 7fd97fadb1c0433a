//! A scene as Rust source: one `static` of the kernel's [`Model`], in one scalar type.
//!
//! Numbers are written so that the compiler reads back the same bits. The whole problem is written,
//! whatever the scene needs of it; indices are `u16` where the mesh allows.

use std::fmt::Debug;
use std::fmt::Write as _;

use signorini_device::model::Model;
use signorini_kernel::error::Array;
use signorini_kernel::{Error, Index};

use signorini_bake::range::{refuse_lengths, refuse_squares};
use signorini_problem::scalar::Scalar;
use signorini_problem::{Approach, Assembled, Problem};
use signorini_scene::error::Result;
use signorini_scene::scene::Scene;
use signorini_solve::{choose_units, unfit};

/// The source text.
///
/// # Errors
/// What [`Approach::Export`] cannot treat; numbers that the scalar type cannot hold or compute with in the scene's
/// units.
pub fn source_of<R: Scalar>(problem: &Problem) -> Result<String> {
    Approach::Export.check(problem)?;
    refuse_squares::<R>(&problem.scene, &choose_units(problem)?)?;
    refuse_lengths::<R>(problem)?;
    let unfit = unfit::<R>(&problem.scene);
    let assembled = Assembled::<R>::new(problem).map_err(&unfit)?;
    assembled.system().map_err(&unfit)?;
    let start = assembled.start();
    let model = assembled.model(&problem.scene.title, &start);
    check(&model).map_err(&unfit)?;
    let half_edges = 3 * model.triangles.len() + 4 * model.quads.len();
    let addressable = (u16::LIMIT - 1) / size_of::<R>();
    let short =
        half_edges.max(model.vertices.len()) < u16::LIMIT && model.counts.edges() <= addressable;
    Ok(source(&problem.scene, &model, if short { "u16" } else { "u32" }))
}

/// What the kernel checks where it is used is checked here: the firmware has nobody to tell.
fn check<R: Scalar>(model: &Model<R, u32>) -> std::result::Result<(), Error> {
    model.boundary()?;
    let finite = |of, numbers: &[R]| match numbers.iter().position(|x| !x.finite()) {
        Some(at) => Err(Error::NotFinite { of, at }),
        None => Ok(()),
    };
    finite(Array::Vertices, &[model.unit])?;
    finite(Array::Unknowns, model.start)?;
    finite(Array::CellLoads, model.loads.triangles)?;
    finite(Array::CellLoads, model.loads.quads)?;
    finite(Array::Stiffness, model.stiffness.triangles.as_flattened())?;
    finite(Array::Stiffness, model.stiffness.quads.as_flattened())?;
    match model.tensors.iter().position(|tensor| !tensor.is_positive_definite()) {
        Some(at) => Err(Error::NotFinite { of: Array::Coefficients, at }),
        None => Ok(()),
    }
}

fn source<R: Scalar>(scene: &Scene, model: &Model<R, u32>, index: &str) -> String {
    let counts = model.counts;
    let half_edges = array("half_edges", model.half_edges);
    let file = scene.file().file_name().unwrap_or_default();
    let fields = [
        format!("title: {:?}", model.title),
        array("vertices", model.vertices),
        format!("unit: {:?}", model.unit),
        array("triangles", model.triangles),
        array("quads", model.quads),
        array("of_triangles", model.of_triangles),
        array("of_quads", model.of_quads),
        half_edges.replace(&u32::NONE.to_string(), "NONE"),
        format!("counts: {counts:?}"),
        array("tensors", model.tensors),
        "stiffness: Stiffness {".to_owned(),
        array("triangles", model.stiffness.triangles),
        array("quads", model.stiffness.quads),
        "}".to_owned(),
        "loads: CellLoads {".to_owned(),
        array("triangles", model.loads.triangles),
        array("quads", model.loads.quads),
        "}".to_owned(),
        array("neumann", model.neumann),
        array("robin", model.robin),
        array("contact_flux", model.contact_flux),
        array("gap", model.gap),
        array("start", model.start),
    ];
    let mut text = format!(
        "// {file:?} in {scalar}: {} unknowns, {} of them contact edges, {} triangles, {} quads.\n\
         // Written by scene_data {version}; do not edit.\n\n",
        counts.unknowns(),
        counts.contact,
        model.triangles.len(),
        model.quads.len(),
        scalar = R::NAME,
        version = env!("CARGO_PKG_VERSION"),
    );
    text += IMPORTS;
    let _ = write!(
        text,
        "/// The other side of a boundary edge.\nconst NONE: {index} = {index}::MAX;\n\n"
    );
    let sizes = [
        ("UNKNOWNS", counts.unknowns()),
        ("EDGES", counts.edges()),
        ("TRIANGLES", model.triangles.len()),
        ("QUADS", model.quads.len()),
    ];
    for (name, size) in sizes {
        let _ = writeln!(text, "/// {}\npub const {name}: usize = {size};", name.to_lowercase());
    }
    let _ = writeln!(text, "/// {}", model.title.escape_debug());
    let _ = writeln!(text, "pub static MODEL: Model<'static, {}, {index}> = Model {{", R::NAME);
    for field in fields {
        let separator = if field.ends_with('{') { "" } else { "," };
        let _ = writeln!(text, "    {field}{separator}");
    }
    text + "};\n"
}

/// What the fields below may name; a scene without Robin edges, say, leaves some of it unused.
const IMPORTS: &str = "\
#[allow(unused_imports)]
use signorini_device::{model::Model, kernel::{Tensor, assembly::CellLoads, mesh::boundary::{Neumann, Robin}, mesh::edges::EdgeCounts, stiffness::Stiffness}};

";

/// A field that is a slice. What [`Debug`] prints of numbers, arrays and records is Rust.
fn array<T: Debug>(name: &str, entries: &[T]) -> String {
    let mut text = format!("{name}: &[");
    let mut width = 0;
    for entry in entries {
        let entry = format!("{entry:?}, ");
        width += entry.len();
        if width > WIDTH || text.ends_with('[') {
            text.truncate(text.trim_end().len());
            text += "\n        ";
            width = entry.len();
        }
        text += &entry;
    }
    let kept = text.trim_end().len();
    text.truncate(kept);
    text + "]"
}

/// Columns of a line of numbers.
const WIDTH: usize = 92;
