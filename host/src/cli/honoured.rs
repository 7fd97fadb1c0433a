//! The keys of `[setting]` that a command cannot follow: it refuses them instead of answering for another setting.
//!
//! ```text
//!   refine, cells, element,
//!   error                      every command: they are the mesh and its basis
//!   scalar                    every command; f32+f64 solve and trade alone, f64 no C header
//!   the rest                  solve, bake, trade, tick --baked
//! ```

use signorini_scene::error::{InputError, Result};
use signorini_scene::scene::Scene;
use signorini_scene::setting::{Method, ModelKind, Precision, Setting};

/// A command that follows a part of a setting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Command {
    /// The scene's own ticks, full and swept.
    Tick,
    /// The stages' data, full.
    Export,
    /// The dense problem as a C header.
    Condense,
}

impl Command {
    /// Whether it does what this value of a method's key says, in any case.
    fn does(self, key: &str, setting: &Setting) -> bool {
        match (self, key) {
            (Self::Tick | Self::Export, "model") => setting.model == Some(ModelKind::Full),
            (Self::Condense, "model") => setting.model == Some(ModelKind::Condensed),
            (Self::Tick, "solver") => setting.solver == Some(Method::Sweeps),
            _ => false,
        }
    }

    fn does_in(self, scalar: Option<Precision>) -> bool {
        match self {
            Self::Tick | Self::Export => scalar != Some(Precision::Mixed),
            Self::Condense => matches!(scalar, None | Some(Precision::F32)),
        }
    }

    /// Refuses the first key that it cannot follow; `scalar_given` where the command line has a scalar of its own.
    ///
    /// # Errors
    /// Such a key.
    pub fn check(self, scene: &Scene, scalar_given: bool) -> Result<()> {
        let Some(setting) = scene.setting else { return Ok(()) };
        let scalar = !scalar_given && !self.does_in(setting.scalar);
        let scalar = scalar.then_some("scalar").into_iter();
        let method = setting.of_method();
        let mut keys = scalar.chain(method.into_iter().filter(|key| !self.does(key, &setting)));
        let Some(key) = keys.next() else { return Ok(()) };
        let (what, hint) = self.words();
        let message = format!("setting.{key}: {what}");
        Err(InputError::new(message).file(scene.file()).hint(hint).into())
    }

    fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Tick => (
                "`tick` cannot follow it: it sweeps the full model, certified, in one scalar",
                "add --baked for the controller that `bake` writes for this setting, or remove the key",
            ),
            Self::Export => (
                "`export` cannot follow it: it writes data of the full model, not how to solve it",
                "remove the key, or write a controller that follows it with `bake`",
            ),
            Self::Condense => (
                "`condense` cannot follow it: it writes the condensed problem in f32, for other solvers",
                "remove the key, or write a controller that follows it with `bake`",
            ),
        }
    }
}
