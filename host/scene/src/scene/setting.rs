//! `[setting]`: how to solve the scene, with what excludes what.

use signorini_kernel::element::QuadElement;
use toml::de::DeValue;

use super::entry::Entry;
use super::exclusions;
use super::table::Table;
use crate::error::Result;
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
    let mut setting = Setting::default();
    let of = &mut setting;
    let are_right = [
        table.set("refine", &mut of.refine, |entry| entry.whole(0..=FINEST)),
        table.set("error", &mut of.error, goal),
        table.set("cells", &mut of.cells, |entry| entry.choice(&CELLS)),
        table.set("element", &mut of.element, |entry| entry.choice(&ELEMENTS)),
        table.set("scalar", &mut of.scalar, |entry| entry.choice(&SCALARS)),
        table.set("math", &mut of.math, |entry| entry.choice(&MATHS)),
        table.set("model", &mut of.model, |entry| entry.choice(&MODELS)),
        table.set("solver", &mut of.solver, solver),
        table.set("start", &mut of.start, |entry| entry.choice(&STARTS)),
        table.set("omega", &mut of.omega, omega),
        table.set("sweeps", &mut of.sweeps, |entry| entry.whole(1..=u32::MAX)),
        table.set("share", &mut of.share, |entry| entry.inside(0.0, 1.0)),
        table.set("certificate", &mut of.certificate, Entry::boolean),
        table.set("memory", &mut of.memory, |entry| entry.whole(0..=MOST_STATES)),
    ];
    if are_right.contains(&false) {
        return None;
    }
    let Some([key, message, hint]) = exclusions::broken(table) else { return Some(setting) };
    let error = table.require(key)?.error(message);
    table.document.faults.note(error.hint(hint));
    None
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
    entry.choice(&SOLVERS)
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
