//! The Rust text of the condensed model.

use std::fmt::Write as _;

use signorini_contact::dense::blocks::{count, padded};

use super::arrays::{Baked, Solver};
use super::sizes::sizes;
use super::statics::{self, written};
use crate::Bakes;
use crate::controller::{self, Parts, state};
use crate::module_api::ModuleApi;
use crate::text::imports;

/// The module.
pub fn source<R: Bakes>(face: &ModuleApi, baked: &Baked<R>) -> String {
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
    let mut text = face.source::<R>("condensed", about, &baked.kernel_features());
    let mut own = constants(baked) + &controller(face, baked);
    if baked.steps.is_some() {
        own += &state(baked.handed_on());
    }
    text += &imports(NAMES, &own, "");
    let outputs = face.outputs.iter().map(|item| item.identifier.as_str());
    text + &own + &written(outputs, baked).module(statics::NAMES, "Scalar")
}

/// Items of the kernel that the module may use.
const NAMES: &str = "\
    condensed::ControllerStorage condensed::Exchanges condensed::Phased condensed::Effort \
    condensed::Swept contact::method::Linear contact::method::Sweeps \
    contact::modes::ArrayModalStorage contact::steps::ArrayStepStorage contact::storage::ArrayStorage \
    contact::storage::ArrayTableauStorage";

fn constants<R: Bakes>(baked: &Baked<R>) -> String {
    let (contact, sweeps) = (baked.contact, baked.sweeps);
    let mut text = format!(
        "
/// Contact edges; the unknowns follow them along the boundary.
pub const CONTACT: usize = {contact};
/// Contact edges, filled up to whole blocks.
const PADDED: usize = {padded};
/// Columns of the error bound's factor.
const COLUMNS: usize = {columns};
",
        padded = padded(contact),
        columns = baked.columns(),
    );
    let mut blocks =
        format!("/// Blocks of the tableau.\nconst BLOCKS: usize = {};\n", count(contact));
    let terms = format!("const TERMS: usize = {};\n", baked.terms());
    if baked.modes.is_some() {
        text += &blocks.replace("the tableau", "the matrix");
        text += &format!("/// The constant, inputs and modes.\n{terms}");
        blocks.clear();
    } else if baked.steps.is_some() {
        text += &format!("/// The constant, inputs, and what a tick leaves to the next.\n{terms}");
    }
    let purpose = match baked.solver() {
        Solver::Linear => return text,
        Solver::TwoPhases => return text + &blocks,
        Solver::Sweeps => "from the last tick's answer",
        Solver::Exchanges(most) => {
            let _ = write!(
                text,
                "{blocks}/// Most edges that may change sides in one tick; where more want to, the next ticks go on.
pub const PIVOTS: u32 = {most};
"
            );
            "where the exchanges do not suffice"
        }
    };
    let _ = write!(
        text,
        "/// Projected SOR: {purpose}.
pub const SWEEPS: Sweeps<Scalar> =
    Sweeps {{ omega: {:?}, tolerance: {:?}, most: LIMITS.sweeps }};
",
        sweeps.omega, sweeps.tolerance
    );
    text
}

fn controller<R: Bakes>(face: &ModuleApi, baked: &Baked<R>) -> String {
    let solver = baked.solver();
    let ends = match solver {
        Solver::Linear => "with the solution, for nothing is in contact",
        Solver::Sweeps => "with complementarity, or after so many sweeps",
        Solver::TwoPhases => "with the solution, after [`WORST_EXCHANGES`] at most",
        Solver::Exchanges(_) => {
            "with the solution; where [`PIVOTS`] do not suffice, after so many sweeps"
        }
    };
    let is_limited = matches!(solver, Solver::Sweeps | Solver::Exchanges(_));
    let sweeps = if is_limited { baked.sweeps.most } else { 0 };
    let (storage, zeros) = memory(baked);
    let effort = match solver {
        Solver::Linear | Solver::TwoPhases => "Effort::NONE",
        Solver::Sweeps => "Effort { sweeps: SWEEPS, ..Effort::NONE }",
        Solver::Exchanges(_) => "Effort { pivots: PIVOTS, sweeps: SWEEPS }",
    };
    let parts = Parts {
        first: match &baked.steps {
            None => "begins with the answer to the scene's own inputs",
            Some(_) => "is a step from the start",
        },
        from: match baked.cold {
            true => "from the answer to the scene's own inputs",
            false => "from where the last tick ended",
        },
        ends,
        limits: &format!("Limits {{ error: 0.0, share: 0.0, sweeps: {sweeps} }}"),
        is_cold: baked.cold,
        storage: &storage,
        zeros: &zeros,
        lent: ["data::SYSTEM", effort],
    };
    controller::controller(&parts, face, &baked.exclusions) + "\npub use data::SYSTEM;\n"
}

/// The type of the memory, and what it is before the first tick.
fn memory<R: Bakes>(baked: &Baked<R>) -> (String, String) {
    let (kind, sizes) = match (&baked.modes, &baked.steps) {
        (Some(_), _) => ("ArrayModalStorage", "PADDED, COLUMNS, BLOCKS, TERMS"),
        (None, Some(_)) => ("ArrayStepStorage", "PADDED, COLUMNS, TERMS"),
        (None, None) => ("ArrayStorage", "PADDED, COLUMNS"),
    };
    let spans = if baked.varying_spans() > 0 { ", PADDED" } else { "" };
    let tableau = "ArrayTableauStorage<Scalar, PADDED, BLOCKS>";
    let (solver, zeros) = match baked.solver() {
        Solver::Linear => ("Linear".to_owned(), "Linear"),
        Solver::Sweeps => ("Swept".to_owned(), "Swept"),
        Solver::TwoPhases => (format!("Phased<{tableau}>"), "Phased(ArrayTableauStorage::zeros())"),
        Solver::Exchanges(_) => {
            (format!("Exchanges<{tableau}>"), "Exchanges(ArrayTableauStorage::zeros())")
        }
    };
    (
        format!("ControllerStorage<{kind}<Scalar, {sizes}{spans}>, {solver}>"),
        format!("ControllerStorage {{ iterate: {kind}::zeros(), solver: {zeros} }}"),
    )
}
