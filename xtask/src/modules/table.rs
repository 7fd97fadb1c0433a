//! The table of modules, a row each: boards, machines for C, sizes, audits.

use super::row::{Machines, Row};
use crate::audit::kinds::Audit;
use signorini_image::board::{M4, M4F, M7};

/// A condensed model in f32 that nothing is asked of.
const CONDENSED: Row = Row {
    scene: "",
    scalar: "f32",
    model: "--condensed",
    is_at_length: false,
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
/// One board, and the others in a whole run.
const M4_FIRST: Machines = Machines::and(&["m4"], &["m4-soft", "m7"]);
/// With every core in a whole run.
const BOARDS: Machines = Machines::and(&["m4"], &["m4-soft", "m7", "m33"]);
const M7_FIRST: Machines = Machines::and(&["m7"], &["m4", "m4-soft"]);
/// These, and the machine at hand.
const ALL: Machines = Machines::and(&["m4", "host"], &["m4-soft", "m7", "m33"]);
/// For the program with several controllers.
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
        linked: &[M4F, M4, M7],
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
        is_at_length: true,
        is_played: true,
        median: Some(120_000),
        size: Some(("levee on 50 000 unknowns, condensed", 34 * KIB)),
        ..CONDENSED
    },
    Row {
        scene: "tests/firmware/scenes/levee-64.toml",
        is_at_length: true,
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
        size: Some(("levee, on triangles", 31 * KIB)),
        audit: Some(Audit::TRIANGLES),
        c: STATES,
        ..FULL
    },
    Row {
        scene: "tests/firmware/scenes/slab-swept.toml",
        is_at_length: true,
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
    // Steps in time, with limits and a coefficient that changes; the RTIC example flies it.
    Row {
        scene: "meshes/scenes/antiicing-warm.toml",
        is_played: true,
        median: Some(4_000_000),
        size: Some(("anti-icing, in time", 58 * KIB)),
        c: STATES,
        c_played: ON_M4,
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
        is_at_length: true,
        audit: Some(Audit::PLAIN),
        c: ON_M4,
        c_played: ON_M4,
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
        is_at_length: true,
        c: M7_FIRST,
        c_played: M7_FIRST,
        ..CONDENSED
    },
    Row {
        scene: "tests/firmware/scenes/strip-swept.toml",
        scalar: "f64",
        is_at_length: true,
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
        is_at_length: true,
        c: Machines::of(&["m4", "m7", "host"]),
        ..CONDENSED
    },
];
