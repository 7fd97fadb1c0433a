//! A module that tests bake, and what is asked of it.

use std::sync::Arc;

use crate::audit::kinds::Audit;
use crate::baked::{Failure, Recipe};
use crate::c::package::{Package, machine};
use signorini_image::board::Board;
use signorini_image::module::Module;

/// A module and its columns.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    /// The scene's file.
    pub scene: &'static str,
    /// `f32` or `f64`.
    pub scalar: &'static str,
    /// `--condensed` or `--full`.
    pub model: &'static str,
    /// Whether a whole run alone has it: another row shows the same kind of code.
    pub is_at_length: bool,
    /// Boards that its image is linked for, beside those that play it: the first in every run, all in a whole one.
    pub linked: &'static [Board],
    /// Whether the board with 192 KiB plays it, bit for bit as the desk.
    pub is_played: bool,
    /// Instructions of a played tick that are allowed in the median.
    pub median: Option<u64>,
    /// Whether the statement of `bake` is compared with its image.
    pub is_explained: bool,
    /// How many times the instructions of the worst tick that is found may be proved; none: it is not looked for.
    pub worst: Option<f64>,
    /// Its name in the record of sizes, and the bytes of code that are allowed.
    pub size: Option<(&'static str, u64)>,
    /// Kinds of code that its image lacks and holds.
    pub audit: Option<Audit>,
    /// Machines that libraries for C are built for, by the words of `--board`.
    pub c: Machines,
    /// Machines that play it from C, bit for bit as the desk in Rust.
    pub c_played: Machines,
    /// Ticks of which a call from C is counted; none: it is not.
    pub c_counted: Option<usize>,
}

/// Words of `--board`: those of every run, and those that a whole run has beside them.
#[derive(Debug, Clone, Copy)]
pub struct Machines {
    short: &'static [&'static str],
    more: &'static [&'static str],
}

impl Machines {
    pub const NONE: Self = Self::of(&[]);

    /// These in every run.
    pub const fn of(short: &'static [&'static str]) -> Self {
        Self { short, more: &[] }
    }

    /// These in every run, and `more` in a whole one.
    pub const fn and(short: &'static [&'static str], more: &'static [&'static str]) -> Self {
        Self { short, more }
    }

    /// The machines of a run.
    pub fn words(&self, is_whole: bool) -> Vec<&'static str> {
        let more = if is_whole { self.more } else { &[] };
        self.short.iter().chain(more).copied().collect()
    }
}

impl Row {
    /// How it is baked.
    pub fn recipe(&self) -> Recipe {
        let scalar = Some(self.scalar.to_owned());
        Recipe { scalar, ..Recipe::of(self.scene, self.model) }
    }

    /// Its name in the names of steps.
    pub fn name(&self) -> String {
        let model = self.model.trim_start_matches('-');
        let scalar = if self.scalar == "f32" { "" } else { ", f64" };
        format!("{} {model}{scalar}", self.recipe().scene_name())
    }

    /// The module, baked by now or earlier in this run.
    pub fn module(&self) -> Result<Arc<Module>, Failure> {
        self.recipe().bake()
    }

    /// The controller for C that [`bake_for_c`](super::bake_for_c) has written.
    pub fn package(&self, word: &str) -> Result<Package, String> {
        Package::of(&self.recipe(), machine(word)?)
    }
}
