//! The text that makes a module's `Controller` of the kernel's: the scene's types and constants, its memory, an alias.

use std::fmt::Debug;

use crate::module_api::ModuleApi;

/// The parts that are the model's own.
#[derive(Debug, Clone)]
pub(super) struct Parts<'a> {
    /// How the first tick starts.
    pub first: &'a str,
    /// From where each tick answers.
    pub from: &'a str,
    /// When a tick ends within [`Parts::limits`].
    pub ends: &'a str,
    /// The value of `LIMITS`.
    pub limits: &'a str,
    /// Whether every tick starts anew.
    pub is_cold: bool,
    /// The type of the memory.
    pub storage: &'a str,
    /// The memory before the first tick.
    pub zeros: &'a str,
    /// The model that is lent to the memory, and how it is solved.
    pub lent: [&'a str; 2],
}

/// The alias, and the scene behind it, whose inputs have to meet the rows of `exclusions`.
pub(super) fn controller(parts: &Parts, api: &ModuleApi, exclusions: &[impl Debug]) -> String {
    let Parts { first, from, ends, limits, is_cold, storage, zeros, lent: [model, setup] } = parts;
    let exclusions = match exclusions {
        [] => String::new(),
        rows => format!(
            "
    fn exclusions(&self) -> &[Scalar] {{
        &{rows:?}
    }}
"
        ),
    };
    let windows = told(&api.told().collect::<Vec<_>>());
    let ranges = if api.has_ranges() { "&Inputs::RANGES" } else { "&[]" };
    format!(
        "
use signorini_device::controller;
use signorini_device::kernel::limits::{{Deadline, Limits}};
use signorini_device::{{Error, Report}};

/// When a tick ends: {ends}.
pub const LIMITS: Limits<Scalar> = {limits};

/// The answer of a tick.
pub type Answer = controller::Answer<Outputs, Scalar>;

/// All memory of the scene; can initialise a `static`. The first tick {first}, each answers {from}. Refused are inputs outside
/// [`Inputs::RANGES`], and those with which boundary values exclude each other.
pub type Controller = controller::Controller<Scene>;

/// The scene, as [`Controller`] takes it.
#[derive(Debug, Clone, Copy)]
pub struct Scene;

impl controller::Scene for Scene {{
    type Scalar = Scalar;
    type Inputs = Inputs;
    type Outputs = Outputs;
    type Storage = {storage};

    fn ranges(&self) -> &[[Scalar; 2]] {{
        {ranges}
    }}
{exclusions}{windows}
    fn limits(&self) -> Limits<Scalar> {{
        LIMITS
    }}

    fn is_cold(&self) -> bool {{
        {is_cold}
    }}

    fn lend<T>(
        &self,
        take: impl FnOnce(
            &<Self::Storage as controller::Storage<Scalar>>::Model<'_>,
            &<Self::Storage as controller::Storage<Scalar>>::Setup<'_>,
        ) -> T,
    ) -> T {{
        take(&{model}, &{setup})
    }}
}}

impl controller::Baked for Scene {{
    const CONTROLLER: Controller = Controller::of(Scene, {zeros});
}}
"
    )
}

/// The function that puts the bound over time into these outputs.
fn told(windows: &[&str]) -> String {
    if windows.is_empty() {
        return String::new();
    }
    let puts = windows.iter().map(|name| format!("        outputs.{name} = window;\n"));
    format!(
        "
    const TELLS_WINDOW: bool = true;

    fn tell(&self, outputs: &mut Outputs, window: Scalar) {{
{}    }}
",
        puts.collect::<String>()
    )
}

/// The state that outlives the program, of a model that steps in time: so many numbers.
pub(super) fn state(numbers: impl std::fmt::Display) -> String {
    format!(
        "
/// All that the next tick takes from the last one: plain numbers, sealed. [`Controller::state`] gives it, and
/// [`Controller::restore`] goes on from it with the same bits.
pub type State = signorini_device::State<Scalar, {numbers}>;

impl controller::Lasting for Scene {{
    type State = State;

    const HASH: u64 = SCENE_HASH;
}}
"
    )
}
