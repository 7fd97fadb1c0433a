//! The Rust text of the condensed model.

use std::fmt::{Debug, Write as _};

use signorini_kernel::condensed::blocks::{Block, count, padded};

use super::arrays::{Baked, Bound, Output};
use super::sizes::sizes;
use crate::bake::face::{About, Face};
use crate::bake::text::array;
use crate::scalar::Scalar;

/// The module.
pub fn source<R: Scalar>(face: &Face, baked: &Baked<R>) -> String {
    let bytes = sizes(baked);
    let about = format!(
        "The condensed model in {}: {} contact edges, everything else eliminated exactly; {}. {} bytes of \
         RAM in a [`Controller`], {} bytes of data in flash.",
        R::NAME,
        baked.contact,
        match baked.without_bound() {
            None => "with its error bound".to_owned(),
            Some(reason) => format!("without an error bound ({reason})"),
        },
        bytes.ram,
        bytes.flash
    );
    let report = "signorini_kernel::condensed::Report<Scalar>";
    let about = About { model: "condensed", text: &about, features: &[], report };
    let mut text = face.source::<R>(&about);
    text += &imports(baked);
    text += &constants(baked);
    text += &controller(face, baked);
    text + &data(face, baked)
}

fn imports<R: Scalar>(baked: &Baked<R>) -> String {
    let storage = match baked.work.pivots {
        Some(_) => "storage::{Storage, TableauStorage}",
        None => "storage::Storage",
    };
    format!(
        "
use signorini_kernel::Error;
use signorini_kernel::condensed::method::Sweeps;
use signorini_kernel::condensed::{storage};
"
    )
}

fn constants<R: Scalar>(baked: &Baked<R>) -> String {
    let (contact, sweeps) = (baked.contact, baked.sweeps);
    let mut text = format!(
        "
/// Contact edges.
pub const CONTACT: usize = {contact};
/// The same, filled up to whole blocks.
const PADDED: usize = {padded};
/// Columns of the error bound's factor.
const COLUMNS: usize = {columns};
",
        padded = padded(contact),
        columns = baked.columns(),
    );
    if let Some(most) = baked.work.pivots {
        let _ = write!(
            text,
            "/// Blocks of the tableau.
const BLOCKS: usize = {};
/// Most edges that may change sides in one tick; where more want to, the next ticks go on.
pub const PIVOTS: u32 = {most};
",
            count(contact)
        );
    }
    let _ = write!(
        text,
        "/// Projected SOR: {}.
pub const SWEEPS: Sweeps<Scalar> =
    Sweeps {{ omega: {:?}, tolerance: {:?}, most: {} }};
",
        match baked.work.pivots {
            Some(_) => "where the exchanges do not suffice",
            None => "from the last tick's answer",
        },
        sweeps.omega,
        sweeps.tolerance,
        sweeps.most
    );
    text
}

fn controller<R: Scalar>(face: &Face, baked: &Baked<R>) -> String {
    let is_exact = baked.work.pivots.is_some();
    let only = |text: &'static str| if is_exact { text } else { "" };
    let names: Vec<_> = face.inputs().collect();
    let given: Vec<_> = std::iter::once("1.0").chain(names.iter().copied()).collect();
    let pattern = match names.is_empty() {
        true => "let Inputs {} = inputs;".to_owned(),
        false => format!("let Inputs {{ {} }} = inputs;", names.join(", ")),
    };
    let outputs = face.outputs().enumerate();
    let outputs: Vec<_> = outputs.map(|(at, name)| format!("{name}: output({at})?")).collect();
    let method = match is_exact {
        true => "let mut method = self.tableau.method(&data::SYSTEM, PIVOTS, SWEEPS)?;",
        false => "let mut method = SWEEPS;",
    };
    format!(
        "
/// All memory of the scene; can initialise a `static`.
#[derive(Debug)]
pub struct Controller {{
    storage: Storage<Scalar, PADDED, COLUMNS>,
{}}}

impl Controller {{
    /// Before the first tick, which begins with the answer to the scene's own inputs.
    pub const fn new() -> Self {{
        Self {{
            storage: Storage::new(data::START),
{}        }}
    }}

    /// Answers for these inputs, from where the last tick ended.
    ///
    /// # Errors
    /// Inputs that are not finite; the last answer stays.
    pub fn tick(&mut self, inputs: Inputs) -> Result<Answer, Error> {{
        {pattern}
        let inputs = [{}];
        {method}
        let mut memory = self.storage.memory();
        let report = data::SYSTEM.tick(&inputs, &mut method, &mut memory)?;
        let x = memory.iterate.x;
        let output = |number| data::SYSTEM.output(number, &inputs, x, &report);
        let outputs = Outputs {{ {} }};
        Ok(Answer {{ outputs, report }})
    }}
}}

impl Default for Controller {{
    fn default() -> Self {{
        Self::new()
    }}
}}

pub use data::SYSTEM;
",
        only("    tableau: TableauStorage<Scalar, PADDED, BLOCKS>,\n"),
        only("            tableau: TableauStorage::new(),\n"),
        given.join(", "),
        outputs.join(", "),
    )
}

/// The statics, in a module of their own.
fn data<R: Scalar>(face: &Face, baked: &Baked<R>) -> String {
    let mut text = String::new();
    let mut names = Vec::new();
    put(&mut text, "MATRIX", "S, the lower triangle of its blocks.", "[[Scalar; 8]; 8]", {
        (baked.matrix.len(), blocks(&baked.matrix))
    });
    let start = match baked.work.pivots {
        Some(_) => {
            let doc = "The tableau of the scene's own inputs: where exchanges begin.";
            let value = (baked.start.blocks.len(), blocks(&baked.start.blocks));
            put(&mut text, "TABLEAU", doc, "[[Scalar; 8]; 8]", value);
            let value = (baked.start.exchanged.len(), array(&baked.start.exchanged, 4));
            put(&mut text, "OPEN", "The edges that are open in it.", "bool", value);
            "Start { blocks: &TABLEAU, exchanged: &OPEN }"
        }
        None => "Start { blocks: &[], exchanged: &[] }",
    };
    let _ = write!(
        text,
        "\n    /// The scaled openings for the scene's own inputs.\n    pub(super) const START: [Scalar; {}] \
         = {};\n",
        baked.start.x.len(),
        array(&baked.start.x, 4)
    );
    numbers(
        &mut text,
        "LOAD",
        "B by columns: what each input, the constant first, does.",
        &baked.load,
    );
    for (output, name) in baked.outputs.iter().zip(face.outputs()) {
        names.push(measure(&mut text, &name.to_ascii_uppercase(), output));
    }
    let certificate = match &baked.bound {
        Ok(bound) => certificate(&mut text, bound),
        Err(_) => "None".to_owned(),
    };
    let uses = match &baked.bound {
        Ok(bound) if bound.corners.is_empty() => "certificate::{Form, Vertex}, factor::Factor, ",
        Ok(_) => "certificate::{Corner, Form, Vertex}, factor::Factor, ",
        Err(_) => "",
    };
    format!(
        "
/// The scene: what stays from tick to tick.
#[rustfmt::skip]
#[allow(clippy::all)]
mod data {{
    use signorini_kernel::condensed::{{{uses}outputs::Measure, tableau::Start, Condensed}};

    use super::Scalar;
{text}
    /// All of it.
    pub static SYSTEM: Condensed<'static, Scalar> = Condensed {{
        contact: super::CONTACT,
        matrix: &MATRIX,
        start: {start},
        load: &LOAD,
        outputs: &[{}],
        certificate: {certificate},
    }};
}}
",
        names.iter().map(|name| format!("\n            {name},")).collect::<String>()
            + "\n        ",
    )
}

fn put(text: &mut String, name: &str, doc: &str, of: &str, (length, value): (usize, String)) {
    let _ = write!(text, "\n    /// {doc}\n    static {name}: [{of}; {length}] = {value};\n");
}

fn numbers<T: Debug>(text: &mut String, name: &str, doc: &str, numbers: &[T]) {
    put(text, name, doc, "Scalar", (numbers.len(), array(numbers, 4)));
}

/// A line a row of each block.
fn blocks<R: Debug>(blocks: &[Block<R>]) -> String {
    let block = |block: &Block<R>| {
        let rows: String = block.iter().map(|row| format!("\n        {row:?},")).collect();
        format!("\n        [{}],", rows.trim_start().trim_end_matches(','))
    };
    format!("[{}\n    ]", blocks.iter().map(block).collect::<String>())
}

fn measure<R: Debug>(text: &mut String, name: &str, output: &Output<R>) -> String {
    match output {
        Output::Linear { of_inputs, of_contact } => {
            numbers(text, &format!("{name}_OF_INPUTS"), "By the inputs.", of_inputs);
            numbers(text, &format!("{name}_OF_CONTACT"), "By the openings.", of_contact);
            format!(
                "Measure::Linear {{ of_inputs: &{name}_OF_INPUTS, of_contact: &{name}_OF_CONTACT }}"
            )
        }
        Output::Length { of_contact } => {
            numbers(text, &format!("{name}_OF_CONTACT"), "Lengths of the edges.", of_contact);
            format!("Measure::Length {{ of_contact: &{name}_OF_CONTACT }}")
        }
        Output::Bound => "Measure::Bound".to_owned(),
    }
}

fn certificate<R: Debug>(text: &mut String, bound: &Bound<R>) -> String {
    numbers(text, "FACTOR", "F by columns: inputs, openings, corrections.", &bound.columns);
    numbers(text, "NORMS", "The norms of its columns.", &bound.norms);
    let vertices = &bound.vertices;
    put(text, "VERTICES", "Contact vertices.", "Vertex<Scalar>", {
        (vertices.len(), array(vertices, 4))
    });
    numbers(text, "OSCILLATION", "The oscillation of each input.", &bound.oscillation);
    numbers(text, "LARGEST_LOAD", "The largest entry of each load.", &bound.largest_load);
    let floating = match bound.floating.is_empty() {
        true => "&[]",
        false => {
            numbers(text, "FLOATING", "The flux of a unit on each contact edge.", &bound.floating);
            "&FLOATING"
        }
    };
    let corners = bound.corners.iter().enumerate().map(|(at, (edge, excess))| {
        let name = format!("CORNER_{at}");
        numbers(text, &name, "u_D above the gap at an end of the contact.", excess);
        format!("Corner {{ edge: {edge}, excess: &{name} }}")
    });
    let corners: Vec<_> = corners.collect();
    format!(
        "Some(Form {{
            factor: Factor {{ columns: &FACTOR, norms: &NORMS }},
            vertices: &VERTICES,
            corners: &[{}],
            reach: {:?},
            floating: {floating},
            oscillation: &OSCILLATION,
            row_sum: {:?},
            largest_load: &LARGEST_LOAD,
            unit: {:?},
        }})",
        corners.join(", "),
        bound.reach,
        bound.row_sum,
        bound.unit
    )
}
