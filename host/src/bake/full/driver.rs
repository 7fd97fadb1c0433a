//! The text of the `Controller`: memory of exactly the scene's size, and the tick.

use std::fmt::Write as _;

use super::arrays::How;
use super::items::Item;
use super::rescaling::Rescaling;
use super::source::imports;
use crate::scalar::Scalar;

/// What the controller may name, with its place in the kernel.
const NAMES: &[(&str, &str)] = &[
    ("Error", "Error"),
    ("Libm", "Libm"),
    ("Micromath", "Micromath"),
    ("Robin", "boundary::Robin"),
    ("Neumann", "boundary::Neumann"),
    ("Curved", "certificate::Curved"),
    ("DataMemory", "full::DataMemory"),
    ("Memory", "full::Memory"),
    ("OwnedRows", "rows::OwnedRows"),
    ("Certificate", "certificate::Certificate"),
    ("Verdict", "certificate::Verdict"),
    ("Deadline", "tick::Deadline"),
    ("Limits", "tick::Limits"),
    ("Progress", "tick::Progress"),
    ("Report", "tick::Report"),
];

/// The struct with its memory, and what it does.
pub(super) fn controller<R: Scalar>(
    fields: &[Item],
    how: &How<R>,
    rescaling: &Rescaling,
) -> String {
    let text = body(fields, how, rescaling);
    imports(NAMES, &text, "") + &text
}

fn body<R: Scalar>(fields: &[Item], how: &How<R>, rescaling: &Rescaling) -> String {
    let mut text = format!(
        "
/// When a tick ends: {}.
pub const LIMITS: Limits<Scalar> =
    Limits {{ error: {:?}, share: {:?}, sweeps: {} }};

/// All memory of the scene; can initialise a `static`.
#[derive(Debug)]
pub struct Controller {{
",
        ends(how),
        how.limits.error,
        how.limits.share,
        how.limits.sweeps
    );
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

";
    let _ = writeln!(text, "    /// Answers for these inputs, {}.", from(how));
    text += "    ///
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
";
    if how.cold {
        text += "        self.progress = Progress::NONE;\n";
    }
    text += &rescaling.before;
    text += "        let memory = Memory {
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
    text += "                ..DataMemory::default()
            },
            progress: &mut self.progress,
        };
        let mut outputs = [0.0; OUTPUTS];
";
    let _ = writeln!(
        text,
        "        let report = data::FULL.{}(&inputs.to_array(), limits, deadline, memory, &mut outputs)?;",
        call(how)
    );
    text += &rescaling.after;
    text + "        Ok(Answer { outputs: Outputs::from_array(outputs), report })
    }
}

impl Default for Controller {
    fn default() -> Self {
        Self::new()
    }
}
" + &rescaling.items
}

/// What ends a tick.
fn ends<R: Scalar>(how: &How<R>) -> &'static str {
    match (how.limits.share > R::ZERO, how.certified) {
        (false, _) => "after exactly so many sweeps",
        (true, false) => "once the residual is down to rounding",
        (true, true) => {
            "once sweeps have brought the algebraic part of the error bound down to this share of it"
        }
    }
}

/// Where a tick starts.
fn from<R: Scalar>(how: &How<R>) -> &'static str {
    if how.cold { "from a cold start" } else { "from where the last tick ended" }
}

/// The kernel's tick.
fn call<R: Scalar>(how: &How<R>) -> String {
    let math = if how.fast { "Micromath" } else { "Libm" };
    match how.certified {
        true if !how.fast => "tick".to_owned(),
        true => format!("tick_with::<{math}, _, _>"),
        false => format!("tick_uncertified::<{math}, _, _>"),
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
