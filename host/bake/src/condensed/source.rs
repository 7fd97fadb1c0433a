//! The Rust text of the condensed model.

use std::fmt::Write as _;

use signorini_contact::dense::blocks::{count, padded};

use super::arrays::{Baked, Solver};
use super::sizes::sizes;
use super::statics::data;
use crate::controller::{self, Parts};
use crate::module_api::{About, ModuleApi};
use signorini_problem::scalar::Scalar;

/// The module.
pub fn source<R: Scalar>(face: &ModuleApi, baked: &Baked<R>) -> String {
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
    let features = baked.kernel_features();
    let about = About { model: "condensed", text: &about, features: &features };
    let mut text = face.source::<R>(&about);
    text += &imports(baked);
    text += &constants(baked);
    text += &controller(face, baked);
    text + &data(face, baked)
}

fn imports<R: Scalar>(baked: &Baked<R>) -> String {
    let is_modal = baked.modes.is_some();
    let one = if is_modal { "modes::ArrayModalStorage" } else { "storage::ArrayStorage" };
    let both = match is_modal {
        true => "{modes::ArrayModalStorage, storage::ArrayTableauStorage}",
        false => "storage::{ArrayStorage, ArrayTableauStorage}",
    };
    let method = |name| format!("use signorini_device::contact::method::{name};\n");
    let (method, storage) = match baked.solver() {
        Solver::Linear => (method("Linear"), one),
        Solver::Sweeps => (method("Sweeps"), one),
        Solver::Exchanges(_) => (method("Sweeps"), both),
        Solver::TwoPhases => (String::new(), both),
    };
    format!(
        "
{method}use signorini_device::contact::{storage};
use signorini_device::kernel::limits::{{Deadline, Limits}};
use signorini_device::{{Error, Report}};
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
    let mut blocks =
        format!("/// Blocks of the tableau.\nconst BLOCKS: usize = {};\n", count(contact));
    if let Some(modes) = &baked.modes {
        let terms = baked.inputs + modes.count;
        text += &blocks.replace("the tableau", "the matrix");
        let _ =
            write!(text, "/// The constant, inputs and modes.\nconst TERMS: usize = {terms};\n");
        blocks.clear();
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

fn controller<R: Scalar>(face: &ModuleApi, baked: &Baked<R>) -> String {
    let solver = baked.solver();
    let only = |text: &'static str| if is_exact(solver) { text } else { "" };
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
    let text = controller::controller(&Parts {
        fields: &format!(
            "    storage: {}{}>,\n{}",
            match baked.modes {
                Some(_) => "ArrayModalStorage<Scalar, PADDED, COLUMNS, BLOCKS, TERMS",
                None => "ArrayStorage<Scalar, PADDED, COLUMNS",
            },
            if baked.varying_spans() > 0 { ", PADDED" } else { "" },
            only("    tableau: ArrayTableauStorage<Scalar, PADDED, BLOCKS>,\n")
        ),
        values: &format!(
            "            storage: {}::zeros(),\n{}",
            if baked.modes.is_some() { "ArrayModalStorage" } else { "ArrayStorage" },
            only("            tableau: ArrayTableauStorage::zeros(),\n")
        ),
        first: "begins with the answer to the scene's own inputs",
        from: match baked.cold {
            true => "from the answer to the scene's own inputs",
            false => "from where the last tick ended",
        },
        ends,
        limits: &format!("Limits {{ error: 0.0, share: 0.0, sweeps: {sweeps} }}"),
        check: face.check(),
        is_limited,
        tick: &tick(face, baked),
        reset: &format!(
            "        self.storage.reset();\n{}",
            only("        self.tableau.reset();\n")
        ),
    });
    text + "\npub use data::SYSTEM;\n"
}

fn is_exact(solver: Solver) -> bool {
    matches!(solver, Solver::Exchanges(_) | Solver::TwoPhases)
}

/// The body of a tick.
fn tick<R: Scalar>(face: &ModuleApi, baked: &Baked<R>) -> String {
    const SWEEPS: &str = "Sweeps { most: limits.sweeps, ..SWEEPS }";
    let (model, set) = match baked.modes.is_some() {
        false => ("&data::SYSTEM", PLAIN),
        true if is_exact(baked.solver()) => ("&model", MODAL),
        true => ("&model", MODAL_SWEPT),
    };
    let method = match baked.solver() {
        Solver::Linear => "Linear".to_owned(),
        Solver::TwoPhases => format!("self.tableau.two_phases({model})?"),
        Solver::Sweeps => SWEEPS.to_owned(),
        Solver::Exchanges(_) => {
            format!(
                "{{
            let sweeps = {SWEEPS};
            self.tableau.method({model}, PIVOTS, sweeps)?
        }}"
            )
        }
    };
    let names: Vec<_> = face.inputs().collect();
    let listed: Vec<_> = std::iter::once("1.0").chain(names.iter().copied()).collect();
    let pattern = match names.is_empty() {
        true => "let Inputs {} = inputs;".to_owned(),
        false => format!("let Inputs {{ {} }} = inputs;", names.join(", ")),
    };
    let outputs = face.outputs().enumerate();
    let [before, solved, of_answer] = set;
    let value = |at: usize| of_answer.replace("NUMBER", &at.to_string());
    let outputs: String =
        outputs.map(|(at, name)| format!("            {name}: {}?,\n", value(at))).collect();
    format!(
        "{}        {pattern}
        let inputs = [{}];
{before}        let mut method = {method};
{solved}        let outputs = Outputs {{
{outputs}        }};
        Ok(Answer {{ outputs, report }})
",
        if baked.cold { "        self.reset();\n" } else { "" },
        listed.join(", "),
    )
}

/// What comes before the method, what solves with it, and an output.
const PLAIN: [&str; 3] = [
    "",
    "        let mut memory = self.storage.memory(&data::SYSTEM);
        let report = data::SYSTEM.tick(&inputs, &mut method, deadline, &mut memory)?;
",
    "data::SYSTEM.output(NUMBER, &inputs, &memory, &report)",
];

/// The same where a transfer coefficient changes; a tableau belongs to one of its values.
const MODAL: [&str; 3] = [
    "        if self.storage.set(&data::SYSTEM, &inputs)? {
            self.tableau.reset();
        }
        let (model, mut memory) = self.storage.at(&data::SYSTEM);
",
    "        let report = data::SYSTEM.tick(&model, &mut method, deadline, &mut memory)?;
",
    "model.output(NUMBER, memory.inputs, &memory.shared, &report)",
];

/// The same without a tableau.
const MODAL_SWEPT: [&str; 3] = [
    "        self.storage.set(&data::SYSTEM, &inputs)?;
        let (model, mut memory) = self.storage.at(&data::SYSTEM);
",
    MODAL[1],
    MODAL[2],
];
