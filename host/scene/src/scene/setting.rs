//! `[setting]`: how to solve the scene, with what excludes what.

use signorini_kernel::element::QuadElement;
use toml::de::DeValue;

use super::entry::Entry;
use super::table::Table;
use crate::error::{InputError, Result};
use crate::goal::Goal;
use crate::setting::{CellKind, MathKind, Method, ModelKind, Omega, Precision, Setting, Start};

const KEYS: [&str; 13] = [
    "refine",
    "error",
    "cells",
    "element",
    "scalar",
    "math",
    "model",
    "solver",
    "start",
    "omega",
    "sweeps",
    "share",
    "certificate",
];

const CELLS: [(&str, CellKind); 2] =
    [("triangles", CellKind::Triangles), ("quads", CellKind::Quads)];
const ELEMENTS: [(&str, QuadElement); 2] =
    [("parametric", QuadElement::Parametric), ("nonparametric", QuadElement::Nonparametric)];
const SCALARS: [(&str, Precision); 3] =
    [("f32", Precision::F32), ("f64", Precision::F64), ("f32+f64", Precision::Mixed)];
const MATHS: [(&str, MathKind); 2] = [("libm", MathKind::Libm), ("micromath", MathKind::Micromath)];
const MODELS: [(&str, ModelKind); 2] =
    [("full", ModelKind::Full), ("condensed", ModelKind::Condensed)];
const SOLVERS: [(&str, Option<Method>); 4] = [
    ("auto", None),
    ("sweeps", Some(Method::Sweeps)),
    ("factor", Some(Method::Factor)),
    ("exact", Some(Method::Exact)),
];
const STARTS: [(&str, Start); 2] = [("cold", Start::Cold), ("warm", Start::Warm)];

/// Six refinements make 4096 cells of one.
const FINEST: u32 = 6;

/// Reads `[setting]`; what is left out is as in [`Setting::default`].
pub(super) fn read_setting(table: &Table) -> Result<Setting> {
    table.only("the setting", &KEYS)?;
    let default = Setting::default();
    let setting = Setting {
        refine: read(table, "refine", |entry| entry.whole(0..=FINEST))?.unwrap_or(default.refine),
        error: read(table, "error", goal)?,
        cells: choice(table, "cells", &CELLS)?,
        element: choice(table, "element", &ELEMENTS)?.unwrap_or(default.element),
        scalar: choice(table, "scalar", &SCALARS)?,
        math: choice(table, "math", &MATHS)?.unwrap_or(default.math),
        model: choice(table, "model", &MODELS)?,
        solver: choice(table, "solver", &SOLVERS)?.flatten(),
        start: choice(table, "start", &STARTS)?.unwrap_or(default.start),
        omega: read(table, "omega", omega)?.unwrap_or(default.omega),
        sweeps: read(table, "sweeps", |entry| entry.whole(1..=u32::MAX))?,
        share: read(table, "share", |entry| entry.inside(0.0, 1.0))?,
        certificate: read(table, "certificate", Entry::boolean)?.unwrap_or(default.certificate),
    };
    match contradiction(&setting) {
        None => Ok(setting),
        Some((key, message, hint)) => Err(error(table, key, message).hint(hint).into()),
    }
}

fn read<'a, T>(
    table: &Table<'a>,
    key: &str,
    as_what: impl Fn(&Entry<'a>) -> Result<T>,
) -> Result<Option<T>> {
    table.get(key).as_ref().map(as_what).transpose()
}

fn choice<T: Copy>(table: &Table, key: &str, choices: &[(&str, T)]) -> Result<Option<T>> {
    read(table, key, |entry| Ok(entry.choice(choices)?.value))
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
fn error(table: &Table, key: &str, message: &str) -> InputError {
    table.get(key).map_or_else(|| table.absent(key), |entry| entry.error(message))
}

/// The first key that contradicts another one, why, and what to do.
fn contradiction(setting: &Setting) -> Option<(&'static str, &'static str, &'static str)> {
    let Setting { scalar, math, model, start, omega, sweeps, share, certificate, .. } = *setting;
    let exact = setting.solver == Some(Method::Exact);
    let condensed = model == Some(ModelKind::Condensed) || (exact && model.is_none());
    let factored = setting.solver == Some(Method::Factor);
    let full_only = "remove it, or take model = \"full\"";
    let rules = [
        (
            setting.error.is_some() && setting.refine > 0,
            "refine",
            "excludes `error`, which says how fine the mesh becomes",
            "remove one of them",
        ),
        (
            sweeps.is_some() && share.is_some(),
            "share",
            "excludes `sweeps`: one of them says when to stop",
            "remove one of them",
        ),
        (
            share.is_some() && !certificate,
            "share",
            "a share of the error bound, which certificate = false leaves out",
            "write certificate = true, or a number of sweeps",
        ),
        (
            share.is_some() && condensed,
            "share",
            "the condensed model has no share to stop at",
            "remove it, or write a number of sweeps",
        ),
        (
            factored && condensed,
            "solver",
            "a factor is for the full model",
            "write solver = \"exact\", or take model = \"full\"",
        ),
        (
            exact && !condensed,
            "solver",
            "the exact method is for the condensed model",
            "write solver = \"factor\", or take model = \"condensed\"",
        ),
        (
            sweeps.is_some() && exact,
            "sweeps",
            "the exact method takes no number of sweeps",
            "remove it, or write solver = \"sweeps\"",
        ),
        (
            sweeps.is_some() && factored,
            "sweeps",
            "a factor takes no sweeps",
            "remove it, or write solver = \"sweeps\"",
        ),
        (
            share.is_some() && factored,
            "share",
            "a factor leaves nothing of the bound to sweeps",
            "remove it, or write solver = \"sweeps\"",
        ),
        (
            scalar == Some(Precision::Mixed) && factored,
            "scalar",
            "a factor is for one number format",
            "write f32 or f64, or solver = \"sweeps\"",
        ),
        (
            matches!(omega, Omega::Fixed(_)) && condensed,
            "omega",
            "the condensed model has its own relaxation factor",
            full_only,
        ),
        (
            start == Start::Cold && condensed,
            "start",
            "the condensed model has no cold start",
            full_only,
        ),
        (
            math == MathKind::Micromath && condensed,
            "math",
            "the condensed model has no search for ω, the one that takes square roots of either kind",
            full_only,
        ),
        (
            scalar == Some(Precision::Mixed) && condensed,
            "scalar",
            "the condensed model is solved in one number format",
            "write f32 or f64, or take model = \"full\"",
        ),
        (
            math == MathKind::Micromath && scalar.is_some_and(|scalar| scalar != Precision::F32),
            "math",
            "micromath is for f32 alone",
            "write scalar = \"f32\", or math = \"libm\"",
        ),
    ];
    let broken = rules.into_iter().find(|(broken, ..)| *broken);
    broken.map(|(_, key, message, hint)| (key, message, hint))
}
