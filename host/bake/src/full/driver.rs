//! The text of the `Controller`: memory of exactly the scene's size, and the tick.

use std::fmt::Write as _;

use signorini_kernel::device::limits::Limits;

use super::arrays::{Baked, TickOptions};
use super::imports::imports;
use super::list::Item;
use super::rescaling::Rescaling;
use crate::controller::{self, Parts};
use signorini_solve::scalar::Scalar;

/// What the controller may name, with its place in the kernel.
const NAMES: &[(&str, &str)] = &[
    ("Error", "Error"),
    ("Libm", "Libm"),
    ("Micromath", "Micromath"),
    ("Robin", "mesh::boundary::Robin"),
    ("Neumann", "mesh::boundary::Neumann"),
    ("Iterate", "solve::dense::Iterate"),
    ("Curved", "bound::certificate::Curved"),
    ("DataMemory", "device::full::DataMemory"),
    ("Memory", "device::full::Memory"),
    ("OwnedRows", "discrete::rows::OwnedRows"),
    ("Certificate", "bound::certificate::Certificate"),
    ("Verdict", "bound::certificate::Verdict"),
    ("Exact", "solve::sparse::Exact"),
    ("Deadline", "device::limits::Deadline"),
    ("Limits", "device::limits::Limits"),
    ("CertifiedSweeps", "device::tick::CertifiedSweeps"),
    ("Progress", "device::tick::Progress"),
    ("Substitutions", "device::tick::Substitutions"),
    ("UncertifiedSweeps", "device::tick::UncertifiedSweeps"),
    ("Report", "Report"),
];

/// The struct with its memory, and what it does.
pub(super) fn controller<R: Scalar>(
    fields: &[Item],
    baked: &Baked<R>,
    rescaling: &Rescaling,
) -> String {
    let text = body(fields, baked, rescaling);
    imports(NAMES, &text, "") + &text
}

fn body<R: Scalar>(fields: &[Item], baked: &Baked<R>, rescaling: &Rescaling) -> String {
    let how = &baked.how;
    let (mut members, mut values) = (String::new(), String::new());
    for Item { name, doc, of, value, .. } in fields {
        let _ = writeln!(members, "    /// {doc}\n    {name}: {of},");
        let _ = writeln!(values, "            {name}: {value},");
    }
    let Limits { error, share, sweeps } = how.limits;
    let text = controller::controller(&Parts {
        fields: &members,
        values: &values,
        first: "starts cold",
        from: if how.cold { "from a cold start" } else { "from where the last tick ended" },
        ends: ends(baked),
        limits: &format!("Limits {{ error: {error:?}, share: {share:?}, sweeps: {sweeps} }}"),
        is_limited: true,
        tick: &tick(fields, baked, rescaling),
        reset: "        self.progress = Progress::NONE;\n",
    });
    text + &rescaling.items
}

/// The body of a tick.
fn tick<R: Scalar>(fields: &[Item], baked: &Baked<R>, rescaling: &Rescaling) -> String {
    let mut text = if baked.how.cold { "        self.reset();\n" } else { "" }.to_owned();
    text += &rescaling.before;
    let has = |field: &str| fields.iter().any(|item| item.name == field);
    let place = |field: &str| {
        if has(field) { format!("&mut self.{field}") } else { "&mut []".to_owned() }
    };
    let is_factored = baked.factored.is_some();
    if is_factored {
        text += &exact(&place);
    }
    text += "        let memory = Memory {
            tick: signorini_kernel::device::tick::Memory {
                rows: self.rows.of(&data::FULL.ground.edges)?,
";
    for field in ["load", "active", "vertices", "bubbles", "tau", "u"] {
        let _ = writeln!(text, "                {field}: {},", place(field));
    }
    text += "            },
            data: DataMemory {
";
    for (field, of) in VARYING {
        if has(field) {
            let _ = writeln!(text, "                {of}: &mut self.{field},");
        }
    }
    text += "                ..DataMemory::default()
            },
            progress: &mut self.progress,
        };
        let mut outputs = [0.0; OUTPUTS];
";
    let _ = writeln!(
        text,
        "        let method = {};
        let report = data::FULL.tick(&inputs.to_array(), method, limits, deadline, memory, &mut outputs)?;",
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

/// The exact solver with its memory.
fn exact(place: &impl Fn(&str) -> String) -> String {
    format!(
        "        let contact = signorini_kernel::solve::sparse::Memory {{
            tableau: {},
            exchanged: {},
            columns: [{}, {}],
            load: {},
            iterate: Iterate {{
                x: {},
                residual: {},
                scratch: {},
                open: {},
            }},
        }};
        let mut exact = Exact::new(data::FACTORED, contact)?;
",
        place("tableau"),
        place("exchanged"),
        place("column"),
        place("next_column"),
        place("reduced"),
        place("openings"),
        place("balance"),
        place("change"),
        place("open"),
    )
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
