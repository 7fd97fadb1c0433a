//! The Rust text of the condensed model.

use std::fmt::Write as _;

use signorini_kernel::condensed::blocks::{count, padded};

use super::arrays::{Baked, Solver};
use super::sizes::sizes;
use super::statics::data;
use crate::bake::face::{About, Face};
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
    let (method, storage) = match baked.solver() {
        Solver::Linear => ("Linear", "storage::Storage"),
        Solver::Sweeps => ("Sweeps", "storage::Storage"),
        Solver::Exchanges(_) => ("Sweeps", "storage::{Storage, TableauStorage}"),
    };
    format!(
        "
use signorini_kernel::Error;
use signorini_kernel::condensed::method::{method};
use signorini_kernel::condensed::{storage};
"
    )
}

fn constants<R: Scalar>(baked: &Baked<R>) -> String {
    let (contact, sweeps) = (baked.contact, baked.sweeps);
    let mut text = format!(
        "
/// Contact edges; the unknowns follow them along the boundary.
pub const CONTACT: usize = {contact};
/// The same, filled up to whole blocks.
const PADDED: usize = {padded};
/// Columns of the error bound's factor.
const COLUMNS: usize = {columns};
",
        padded = padded(contact),
        columns = baked.columns(),
    );
    let purpose = match baked.solver() {
        Solver::Linear => return text,
        Solver::Sweeps => "from the last tick's answer",
        Solver::Exchanges(most) => {
            let _ = write!(
                text,
                "/// Blocks of the tableau.
const BLOCKS: usize = {};
/// Most edges that may change sides in one tick; where more want to, the next ticks go on.
pub const PIVOTS: u32 = {most};
",
                count(contact)
            );
            "where the exchanges do not suffice"
        }
    };
    let _ = write!(
        text,
        "/// Projected SOR: {purpose}.
pub const SWEEPS: Sweeps<Scalar> =
    Sweeps {{ omega: {:?}, tolerance: {:?}, most: {} }};
",
        sweeps.omega, sweeps.tolerance, sweeps.most
    );
    text
}

fn controller<R: Scalar>(face: &Face, baked: &Baked<R>) -> String {
    let (method, is_exact) = match baked.solver() {
        Solver::Linear => ("let mut method = Linear;", false),
        Solver::Sweeps => ("let mut method = SWEEPS;", false),
        Solver::Exchanges(_) => {
            ("let mut method = self.tableau.method(&data::SYSTEM, PIVOTS, SWEEPS)?;", true)
        }
    };
    let only = |text: &'static str| if is_exact { text } else { "" };
    let names: Vec<_> = face.inputs().collect();
    let given: Vec<_> = std::iter::once("1.0").chain(names.iter().copied()).collect();
    let pattern = match names.is_empty() {
        true => "let Inputs {} = inputs;".to_owned(),
        false => format!("let Inputs {{ {} }} = inputs;", names.join(", ")),
    };
    let outputs = face.outputs().enumerate();
    let outputs: Vec<_> = outputs.map(|(at, name)| format!("{name}: output({at})?")).collect();
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
            storage: Storage::new(),
{}        }}
    }}

    /// Answers for these inputs, from {}.
    ///
    /// # Errors
    /// Inputs that are not finite; the last answer stays.
    pub fn tick(&mut self, inputs: Inputs) -> Result<Answer, Error> {{
{}        {pattern}
        let inputs = [{}];
        {method}
        let mut memory = self.storage.memory(&data::SYSTEM);
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
        if baked.cold {
            "the answer to the scene's own inputs"
        } else {
            "where the last tick ended"
        },
        if baked.cold { "        *self = Self::new();\n" } else { "" },
        given.join(", "),
        outputs.join(", "),
    )
}
