//! The text of a module's `Controller`: one set of methods, whatever the model.
//!
//! ```text
//!   new ─► tick(inputs) ─► Answer { outputs, report }       as often as inputs come
//!          tick_within(inputs, limits, deadline)            the same, cut off where time is short
//!          reset()                                          back to new
//! ```

/// What is the model's own.
#[derive(Debug, Clone)]
pub(super) struct Parts<'a> {
    /// Fields of the struct, a line each, with their comments.
    pub fields: &'a str,
    /// The same with what they are before the first tick.
    pub values: &'a str,
    /// How the first tick starts.
    pub first: &'a str,
    /// From where each tick answers.
    pub from: &'a str,
    /// When a tick ends within [`Parts::limits`].
    pub ends: &'a str,
    /// The value of `LIMITS`.
    pub limits: &'a str,
    /// Whether `tick_within` reads its limits.
    pub is_limited: bool,
    /// What refuses inputs outside their ranges; empty where they have none.
    pub check: &'a str,
    /// The body of `tick_within`, down to an `Ok` with the answer.
    pub tick: &'a str,
    /// That of `reset`.
    pub reset: &'a str,
}

/// The struct and its methods.
pub(super) fn controller(parts: &Parts) -> String {
    let Parts { fields, values, first, from, ends, limits, is_limited, check, tick, reset } = parts;
    let name = if *is_limited { "limits" } else { "_" };
    format!(
        "
/// When a tick ends: {ends}.
pub const LIMITS: Limits<Scalar> = {limits};

/// All memory of the scene; can initialise a `static`.
#[derive(Debug)]
pub struct Controller {{
{fields}}}

impl Controller {{
    /// Before the first tick, which {first}.
    pub const fn new() -> Self {{
        Self {{
{values}        }}
    }}

    /// Answers for these inputs, {from}.
    ///
    /// # Errors
    /// Inputs outside [`Inputs::RANGES`], that are not finite, or so large that data, answers or outputs may overflow; the
    /// last answer stays.
    pub fn tick(&mut self, inputs: Inputs) -> Result<Answer, Error> {{
        self.tick_within(inputs, LIMITS, &mut Deadline::never())
    }}

    /// The same with limits of the caller's and until a deadline. Whatever ends it, the answer is feasible and the
    /// report says how wrong it can be.
    ///
    /// # Errors
    /// As for [`Controller::tick`].
    pub fn tick_within<F: FnMut() -> u32>(
        &mut self,
        inputs: Inputs,
        {name}: Limits<Scalar>,
        deadline: &mut Deadline<F>,
    ) -> Result<Answer, Error> {{
{check}{tick}    }}

    /// Forgets all ticks: the next one is the first again.
    pub fn reset(&mut self) {{
{reset}    }}
}}

impl Default for Controller {{
    fn default() -> Self {{
        Self::new()
    }}
}}
"
    )
}
