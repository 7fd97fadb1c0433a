//! `[setting]`: how to solve the scene, with what excludes what.

use signorini_kernel::element::QuadElement;
use toml::de::DeValue;

use super::entry::Entry;
use super::exclusions;
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
    match exclusions::broken(table) {
        None => Some(setting),
        Some([key, message, hint]) => {
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
