//! The text of the `Controller`: memory of exactly the scene's size, and the tick.

use std::fmt::Write as _;

use signorini_kernel::limits::Limits;

use super::arrays::{Baked, TickOptions};
use super::imports::imports;
use super::rescaling::Rescaling;
use crate::controller::{self, Parts};
use signorini_problem::scalar::Scalar;

/// What the controller may name, with its place in the kernel.
const NAMES: &[(&str, &str)] = &[
    ("Error", "Error"),
    ("Libm", "kernel::Libm"),
    ("Micromath", "kernel::Micromath"),
    ("ArrayStorage", "full::ArrayStorage"),
    ("Lengths", "full::Lengths"),
    ("Certificate", "kernel::Certificate"),
    ("Verdict", "kernel::Verdict"),
    ("sparse", "sparse"),
    ("Exact", "sparse::Exact"),
    ("Deadline", "kernel::limits::Deadline"),
    ("Limits", "kernel::limits::Limits"),
    ("CertifiedSweeps", "tick::CertifiedSweeps"),
    ("Substitutions", "tick::Substitutions"),
    ("UncertifiedSweeps", "tick::UncertifiedSweeps"),
    ("Report", "Report"),
];

/// The struct with its memory, and what it does.
pub(super) fn controller<R: Scalar>(baked: &Baked<R>, rescaling: &Rescaling) -> String {
    let text = body(baked, rescaling);
    imports(NAMES, &text, "") + &text
}

fn body<R: Scalar>(baked: &Baked<R>, rescaling: &Rescaling) -> String {
    let how = &baked.how;
    let (fields, values) = memory(baked);
    let Limits { error, share, sweeps } = how.limits;
    let text = controller::controller(&Parts {
        fields: &fields,
        values: &values,
        check: baked.face.check(),
        first: "starts cold",
        from: if how.cold { "from a cold start" } else { "from where the last tick ended" },
        ends: ends(baked),
        limits: &format!("Limits {{ error: {error:?}, share: {share:?}, sweeps: {sweeps} }}"),
        is_limited: true,
        tick: &tick(baked, rescaling),
        reset: "        self.storage.reset();\n",
    });
    lengths(baked) + &text + &rescaling.items
}

/// How long its memory is: the kernel works it out of the statics, when the module is compiled.
fn lengths<R: Scalar>(baked: &Baked<R>) -> String {
    let own = "
/// How long the arrays are that change.
const LENGTHS: Lengths = Lengths::of(&data::FULL);
";
    let exchanges = "
/// Blocks, numbers and flags of the exchanges on contact edges.
const EXCHANGES: [usize; 3] = sparse::storage::lengths(LENGTHS.active);
";
    own.to_owned() + if baked.factored.is_some() { exchanges } else { "" }
}

/// The fields of the struct, and what they are before the first tick.
fn memory<R: Scalar>(baked: &Baked<R>) -> (String, String) {
    let mut fields = format!(
        "    /// Rows, iterate, and the data that inputs change.
    storage: ArrayStorage<
        Scalar,
        Index,
        {},
        {{ LENGTHS.rows }},
        {{ LENGTHS.numbers.sum() }},
        {{ LENGTHS.active }},
        {{ LENGTHS.neumann }},
        {{ LENGTHS.robin }},
        {{ LENGTHS.curved }},
    >,
",
        baked.width()
    );
    let mut values = "            storage: ArrayStorage::zeros(),\n".to_owned();
    if baked.factored.is_some() {
        fields += "    /// Exchanges on the contact edges.
    exchanges: sparse::ArrayStorage<Scalar, { EXCHANGES[0] }, { EXCHANGES[1] }, { EXCHANGES[2] }>,
";
        values += "            exchanges: sparse::ArrayStorage::zeros(),\n";
    }
    (fields, values)
}

/// The body of a tick.
fn tick<R: Scalar>(baked: &Baked<R>, rescaling: &Rescaling) -> String {
    let mut text = if baked.how.cold { "        self.reset();\n" } else { "" }.to_owned();
    text += &rescaling.before;
    let is_factored = baked.factored.is_some();
    if is_factored {
        text += "        let exchanges = self.exchanges.memory(LENGTHS.active)?;
        let mut exact = Exact::new(data::FACTORED, exchanges)?;
";
    }
    let _ = write!(
        text,
        "        let memory = self.storage.memory(&data::FULL, &LENGTHS)?;
        let mut outputs = [0.0; OUTPUTS];
        let method = {};
        let report = data::FULL.tick(&inputs.to_array(), method, limits, deadline, memory, &mut outputs)?;
",
        method(baked),
    );
    text += if is_factored {
        "        let exchanges = exact.solved().map_or(0, |solved| solved.pivots);
        let report = Report { exchanges, ..report.into() };
"
    } else {
        "        let report = Report::from(report);\n"
    };
    text += &rescaling.after;
    text + "        Ok(Answer { outputs: Outputs::from_array(outputs), report })\n"
}

/// What ends a tick.
fn ends<R: Scalar>(baked: &Baked<R>) -> &'static str {
    let how = &baked.how;
    match (how.limits.share > R::ZERO, how.certified) {
        _ if baked.factored.is_some() => {
            "with the solution; where the factor does not find it, after these sweeps"
        }
        (false, _) => "after exactly so many sweeps",
        (true, false) => "once the residual is down to rounding",
        (true, true) => {
            "once sweeps have brought the algebraic part of the error bound down to this share of it"
        }
    }
}

/// How the kernel's tick comes to its answer.
fn method<R: Scalar>(baked: &Baked<R>) -> String {
    let TickOptions { fast, certified, .. } = baked.how;
    let math = if fast { "Micromath" } else { "Libm" };
    let sweeps = if certified { "CertifiedSweeps" } else { "UncertifiedSweeps" };
    match baked.factored {
        Some(_) => format!("Substitutions {{ exact: &mut exact, sweeps: {sweeps}({math}) }}"),
        None => format!("{sweeps}({math})"),
    }
}
