//! `[setting]`: how to solve the scene, with what excludes what.

use signorini_kernel::element::QuadElement;
use toml::de::DeValue;

use super::entry::Entry;
use super::table::Table;
use crate::error::{InputError, Result};
use crate::goal::Goal;
use crate::setting::{CellKind, MathKind, Method, ModelKind, Omega, Precision, Setting, Start};

pub(super) const CELLS: [(&str, CellKind); 2] =
    [("triangles", CellKind::Triangles), ("quads", CellKind::Quads)];
pub(super) const ELEMENTS: [(&str, QuadElement); 2] =
    [("parametric", QuadElement::Parametric), ("nonparametric", QuadElement::Nonparametric)];
pub(super) const SCALARS: [(&str, Precision); 3] =
    [("f32", Precision::F32), ("f64", Precision::F64), ("f32+f64", Precision::Mixed)];
pub(super) const MATHS: [(&str, MathKind); 2] =
    [("libm", MathKind::Libm), ("micromath", MathKind::Micromath)];
pub(super) const MODELS: [(&str, ModelKind); 2] =
    [("full", ModelKind::Full), ("condensed", ModelKind::Condensed)];
pub(super) const SOLVERS: [(&str, Option<Method>); 4] = [
    ("auto", None),
    ("sweeps", Some(Method::Sweeps)),
    ("factor", Some(Method::Factor)),
    ("exact", Some(Method::Exact)),
];
pub(super) const STARTS: [(&str, Start); 2] = [("cold", Start::Cold), ("warm", Start::Warm)];

/// Six refinements make 4096 cells of one.
pub(super) const FINEST: u32 = 6;

/// More states than any mesh that is condensed has modes.
pub(super) const MOST_STATES: u32 = 10_000;

/// Reads `[setting]`; what is left out is as in [`Setting::default`].
pub(super) fn read_setting(table: &Table) -> Option<Setting> {
    table.only("setting", None);
    let default = Setting::default();
    let refine = table.read_or("refine", default.refine, |entry| entry.whole(0..=FINEST));
    let error = table.read_some("error", goal);
    let cells = choice(table, "cells", &CELLS);
    let element = choice(table, "element", &ELEMENTS);
    let scalar = choice(table, "scalar", &SCALARS);
    let math = choice(table, "math", &MATHS);
    let model = choice(table, "model", &MODELS);
    let solver = table.read_or("solver", None, solver);
    let start = choice(table, "start", &STARTS);
    let omega = table.read_or("omega", default.omega, omega);
    let sweeps = table.read_some("sweeps", |entry| entry.whole(1..=u32::MAX));
    let share = table.read_some("share", |entry| entry.inside(0.0, 1.0));
    let certificate = table.read_or("certificate", default.certificate, Entry::boolean);
    let memory = table.read_some("memory", |entry| entry.whole(0..=MOST_STATES));
    let setting = Setting {
        refine: refine?,
        error: error?,
        cells: cells?,
        element: element?.unwrap_or(default.element),
        scalar: scalar?,
        math: math?.unwrap_or(default.math),
        model: model?,
        solver: solver?,
        start: start?.unwrap_or(default.start),
        omega: omega?,
        sweeps: sweeps?,
        share: share?,
        certificate: certificate?,
        memory: memory?,
    };
    match contradiction(&setting) {
        None => Some(setting),
        Some((key, message, hint)) => {
            table.document.faults.note(error_at(table, key, message).hint(hint));
            None
        }
    }
}

fn choice<T: Copy>(table: &Table, key: &str, choices: &[(&str, T)]) -> Option<Option<T>> {
    table.read_some(key, |entry| Ok(entry.choice(choices)?.value))
}

/// A scene says what a device does; what is for the desk alone is told.
fn solver(entry: &Entry) -> Result<Option<Method>> {
    if matches!(&entry.at.value, DeValue::String(word) if word == "multigrid") {
        let hint = "leave it out, and give `signorini solve --solver multigrid`";
        return Err(entry
            .error("`multigrid` is a solver of the desk, no device has it")
            .hint(hint)
            .into());
    }
    Ok(entry.choice(&SOLVERS)?.value)
}

fn omega(entry: &Entry) -> Result<Omega> {
    match entry.at.value {
        DeValue::String(word) if word == "auto" => Ok(Omega::Auto),
        DeValue::Integer(_) | DeValue::Float(_) => Ok(Omega::Fixed(entry.inside(0.0, 2.0)?)),
        _ => Err(entry.expected("\"auto\" or a number inside (0, 2)").into()),
    }
}

fn goal(entry: &Entry) -> Result<Goal> {
    let found = match &entry.at.value {
        DeValue::String(text) => text.parse().ok(),
        _ => entry.number().ok().filter(|&most| most > 0.0).map(Goal::Energy),
    };
    let expected = || entry.expected("a number > 0, such as 0.01, or a part such as \"5%\"");
    found.ok_or_else(|| expected().into())
}

/// The error that the value of `key` does not go with another.
fn error_at(table: &Table, key: &str, message: &str) -> InputError {
    table.get(key).map_or_else(|| table.absent(key), |entry| entry.error(message))
}

/// The first key that contradicts another one, why, and what to do.
fn contradiction(setting: &Setting) -> Option<(&'static str, &'static str, &'static str)> {
    const ONE: &str = "remove one of them";
    const BOUND: &str = "write certificate = true, or a number of sweeps";
    const NUMBER: &str = "remove it, or write a number of sweeps";
    const SWEEP: &str = "remove it, or write solver = \"sweeps\"";
    const EXACT: &str = "write solver = \"exact\", or take model = \"full\"";
    const FACTOR: &str = "write solver = \"factor\", or take model = \"condensed\"";
    const CONDENSED: &str = "remove it, or take model = \"condensed\"";
    const ONE_FORMAT: &str = "write f32 or f64, or solver = \"sweeps\"";
    const FORMAT: &str = "write f32 or f64, or take model = \"full\"";
    const FULL: &str = "remove it, or take model = \"full\"";
    const SINGLE: &str = "write scalar = \"f32\", or math = \"libm\"";
    let Setting { scalar, model, omega, certificate, .. } = *setting;
    let twice = setting.error.is_some() && setting.refine > 0;
    let [swept, shared] = [setting.sweeps.is_some(), setting.share.is_some()];
    let [exact, factored] = [Method::Exact, Method::Factor].map(|of| setting.solver == Some(of));
    let remembers = setting.memory.is_some();
    let condensed =
        model == Some(ModelKind::Condensed) || ((exact || remembers) && model.is_none());
    let [mixed, fast] = [scalar == Some(Precision::Mixed), setting.math == MathKind::Micromath];
    let [fixed, cold] = [matches!(omega, Omega::Fixed(_)), setting.start == Start::Cold];
    let wide = scalar.is_some_and(|scalar| scalar != Precision::F32);
    let of_bound = "a share of the error bound, which certificate = false leaves out";
    let roots =
        "the condensed model has no search for ω, the one that takes square roots of either kind";
    let rules = [
        (twice, "refine", "excludes `error`, which says how fine the mesh becomes", ONE),
        (swept && shared, "share", "excludes `sweeps`: one of them says when to stop", ONE),
        (shared && !certificate, "share", of_bound, BOUND),
        (shared && condensed, "share", "the condensed model has no share to stop at", NUMBER),
        (factored && condensed, "solver", "a factor is for the full model", EXACT),
        (remembers && !condensed, "memory", "states are those of a condensed model", CONDENSED),
        (exact && !condensed, "solver", "the exact method is for the condensed model", FACTOR),
        (swept && exact, "sweeps", "the exact method takes no number of sweeps", SWEEP),
        (swept && factored, "sweeps", "a factor takes no sweeps", SWEEP),
        (shared && factored, "share", "a factor leaves nothing of the bound to sweeps", SWEEP),
        (mixed && factored, "scalar", "a factor is for one number format", ONE_FORMAT),
        (fixed && condensed, "omega", "the condensed model has its own relaxation factor", FULL),
        (cold && condensed, "start", "the condensed model has no cold start", FULL),
        (fast && condensed, "math", roots, FULL),
        (
            mixed && condensed,
            "scalar",
            "the condensed model is solved in one number format",
            FORMAT,
        ),
        (fast && wide, "math", "micromath is for f32 alone", SINGLE),
    ];
    let (_, key, message, hint) = rules.into_iter().find(|(is_broken, ..)| *is_broken)?;
    Some((key, message, hint))
}
