//! The modules that tests bake, each once a run, and what is asked of each.
//!
//! ```text
//!   scene ─ bake, once ─► module ─┬─ image per board ─► played, measured, audited
//!                                 └─ library per board ─► played from C, audited
//! ```

use std::sync::Arc;

use crate::audit::kinds::Audit;
use crate::baked::{Failure, Recipe, bakes};
use crate::c::package::{self, Package, machine};
use crate::steps::Steps;
use signorini_image::board::{Board, M4, M4F, M7};
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
    /// Boards that its image is linked for, beside those that play it.
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
    const NONE: Self = Self::of(&[]);

    const fn of(short: &'static [&'static str]) -> Self {
        Self { short, more: &[] }
    }

    const fn and(short: &'static [&'static str], more: &'static [&'static str]) -> Self {
        Self { short, more }
    }

    /// The machines of a run.
    pub fn words(&self, is_whole: bool) -> Vec<&'static str> {
        let more = if is_whole { self.more } else { &[] };
        self.short.iter().chain(more).copied().collect()
    }
}

/// A condensed model in f32 that nothing is asked of.
const CONDENSED: Row = Row {
    scene: "",
    scalar: "f32",
    model: "--condensed",
    linked: &[],
    is_played: false,
    median: None,
    is_explained: false,
    worst: None,
    size: None,
    audit: None,
    c: Machines::NONE,
    c_played: Machines::NONE,
    c_counted: None,
};
const FULL: Row = Row { model: "--full", ..CONDENSED };

const ON_M4: Machines = Machines::of(&["m4"]);
const BOARDS: Machines = Machines::of(&["m4", "m4-soft", "m7"]);
/// One board, and the others in a whole run.
const M4_FIRST: Machines = Machines::and(&["m4"], &["m4-soft", "m7"]);
const M7_FIRST: Machines = Machines::and(&["m7"], &["m4", "m4-soft"]);
/// Boards of a whole run alone.
const M4_AT_LENGTH: Machines = Machines::and(&[], &["m4"]);
const M7_AT_LENGTH: Machines = Machines::and(&[], &["m7", "m4", "m4-soft"]);
/// Boards, and the machine at hand.
const ALL: Machines = Machines::of(&["m4", "m4-soft", "m7", "host"]);
/// For the program with six controllers.
const STATES: Machines = Machines::and(&["m4"], &["host"]);

const KIB: u64 = 1024;

/// Modules: what is condensed, then what is solved on its mesh; the leanest first.
pub const ROWS: [Row; 20] = [
    Row {
        scene: "tests/firmware/scenes/linear.toml",
        size: Some(("linear, condensed", 8 * KIB)),
        audit: Some(Audit::LINEAR),
        c: ON_M4,
        c_played: ON_M4,
        ..CONDENSED
    },
    Row {
        scene: "meshes/scenes/strip.toml",
        is_played: true,
        is_explained: true,
        size: Some(("strip, condensed, swept", 34 * KIB)),
        c: M4_FIRST,
        c_played: M4_FIRST,
        c_counted: Some(101),
        ..CONDENSED
    },
    Row {
        scene: "meshes/scenes/levee.toml",
        linked: &[M4, M4F, M7],
        is_played: true,
        is_explained: true,
        worst: Some(2.2),
        size: Some(("levee, condensed", 34 * KIB)),
        audit: Some(Audit::EXCHANGES),
        c: ALL,
        c_played: BOARDS,
        c_counted: Some(101),
        ..CONDENSED
    },
    // More than 50 000 unknowns, condensed to 96 contact edges, and to 64.
    Row {
        scene: "tests/firmware/scenes/levee-96.toml",
        is_played: true,
        median: Some(120_000),
        size: Some(("levee on 50 000 unknowns, condensed", 34 * KIB)),
        ..CONDENSED
    },
    Row {
        scene: "tests/firmware/scenes/levee-64.toml",
        is_played: true,
        median: Some(60_000),
        is_explained: true,
        ..CONDENSED
    },
    Row {
        scene: "meshes/scenes/slab.toml",
        is_played: true,
        is_explained: true,
        worst: Some(2.2),
        size: Some(("slab, condensed, on quads", 34 * KIB)),
        c: ALL,
        c_played: M4_FIRST,
        c_counted: Some(101),
        ..CONDENSED
    },
    Row {
        scene: "meshes/scenes/antiicing.toml",
        is_played: true,
        median: Some(350_000),
        is_explained: true,
        worst: Some(2.6),
        size: Some(("anti-icing, limits and modes", 48 * KIB)),
        c: M4_FIRST,
        c_played: M4_FIRST,
        c_counted: Some(101),
        ..CONDENSED
    },
    Row {
        scene: "tests/firmware/scenes/levee-swept.toml",
        size: Some(("levee, on triangles", 30 * KIB)),
        audit: Some(Audit::TRIANGLES),
        c: STATES,
        ..FULL
    },
    Row {
        scene: "tests/firmware/scenes/slab-swept.toml",
        size: Some(("slab, on quads, transfer laws", 38 * KIB)),
        audit: Some(Audit::QUADS),
        c: ON_M4,
        c_played: ON_M4,
        c_counted: Some(7),
        ..FULL
    },
    Row {
        scene: "tests/firmware/scenes/strip-swept.toml",
        is_played: true,
        is_explained: true,
        size: Some(("strip, on both", 38 * KIB)),
        audit: Some(Audit::BOTH),
        c: ON_M4,
        c_counted: Some(7),
        ..FULL
    },
    Row {
        scene: "tests/firmware/scenes/strip-factored.toml",
        is_played: true,
        size: Some(("strip, by a factor", 58 * KIB)),
        audit: Some(Audit::FACTOR),
        c: M4_FIRST,
        c_played: M4_FIRST,
        c_counted: Some(7),
        ..FULL
    },
    Row {
        scene: "tests/firmware/scenes/levee-plain.toml",
        audit: Some(Audit::PLAIN),
        c: M4_AT_LENGTH,
        c_played: M4_AT_LENGTH,
        ..FULL
    },
    // In f64, which hardly a board has a unit for.
    Row {
        scene: "meshes/scenes/levee.toml",
        scalar: "f64",
        c: M4_FIRST,
        c_played: M4_FIRST,
        ..CONDENSED
    },
    Row {
        scene: "meshes/scenes/slab.toml",
        scalar: "f64",
        c: M7_AT_LENGTH,
        c_played: M7_AT_LENGTH,
        ..CONDENSED
    },
    Row {
        scene: "tests/firmware/scenes/strip-swept.toml",
        scalar: "f64",
        c: M7_FIRST,
        c_played: M7_FIRST,
        ..FULL
    },
    // The levee under other names, in another scalar and another model, for a program with several controllers.
    Row { scene: "tests/firmware/scenes/levee-double.toml", scalar: "f64", c: STATES, ..CONDENSED },
    Row { scene: "tests/firmware/scenes/levee-full.toml", c: STATES, ..FULL },
    // Names that are words of C, and no input at all.
    Row {
        scene: "tests/firmware/scenes/words.toml",
        c: Machines::and(&["m4"], &["m7", "host"]),
        ..CONDENSED
    },
    Row {
        scene: "tests/firmware/scenes/bare.toml",
        c: Machines::and(&[], &["m4", "m7", "host"]),
        ..CONDENSED
    },
    // For the RTIC example that flies it.
    FLOWN,
];

/// The module of the RTIC example.
pub const FLOWN: Row = Row { scene: "meshes/scenes/antiicing.toml", ..FULL };

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

    /// The controller for C that [`bake_for_c`] has written.
    pub fn package(&self, word: &str) -> Result<Package, String> {
        Package::of(&self.recipe(), machine(word)?)
    }
}

/// The row of a scene in f32.
pub fn row(scene: &str, model: &str) -> Result<&'static Row, String> {
    let found = ROWS.iter().find(|row| {
        row.recipe().scene_name() == scene && row.model == model && row.scalar == "f32"
    });
    found.ok_or_else(|| format!("no module of {scene} {model}"))
}

/// Bakes each module that a run needs for C, a step each, with its libraries.
pub fn bake_for_c(steps: &mut Steps) {
    bake(steps, |words| !words.is_empty());
}

/// Bakes every module, a step each, with its libraries for C.
pub fn bake_all(steps: &mut Steps) {
    bake(steps, |_| true);
}

fn bake(steps: &mut Steps, is_asked: impl Fn(&[&str]) -> bool) {
    let is_whole = steps.is_whole();
    for row in &ROWS {
        let words = row.c.words(is_whole);
        let name = format!("{}, baked, for C on {} machines", row.name(), words.len());
        if is_asked(&words) && !steps.has(&name) {
            steps.compile(&name, || Ok(package::bake(&row.recipe(), &words).map(drop)?));
        }
    }
}

/// `Ok` where no module was baked twice.
pub fn baked_once() -> Result<(), String> {
    let (bakes, modules) = (bakes(), ROWS.len());
    println!("{bakes} bakes of {modules} modules");
    if bakes > modules { Err(format!("{bakes} bakes, {modules} modules")) } else { Ok(()) }
}
