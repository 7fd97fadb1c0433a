//! The text of the `Controller`: memory of exactly the scene's size, and the tick.

use std::fmt::Write as _;

use super::SHARE;
use super::items::Item;
use super::source::imports;

/// What the controller may name, with its place in the kernel.
const NAMES: &[(&str, &str)] = &[
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

/// The struct with its memory, and what it does.
pub(super) fn controller(fields: &[Item]) -> String {
    let text = body(fields);
    imports(NAMES, &text, "") + &text
}

fn body(fields: &[Item]) -> String {
    let mut text = format!(
        "
/// When a tick ends: once sweeps have brought the algebraic part of the error bound down to this share of it.
pub const LIMITS: Limits<Scalar> = Limits {{ error: 0.0, share: {SHARE:?}, sweeps: 10_000 }};

/// All memory of the scene; can initialise a `static`.
#[derive(Debug)]
pub struct Controller {{
"
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
