//! From the file to the model: the sections of a scene.

use std::path::{Path, PathBuf};

use super::boundary::read_boundary;
use super::control::{read_input, read_output};
use super::entry::Entry;
use super::material::read_material;
use super::setting::read_setting;
use super::table::Table;
use super::{Exact, Located, Scene, Target, Time};
use crate::error::Result;
use crate::expression::{Expression, Variables};

/// Most tables `[KIND.NAME]` of a kind: names are looked up one by one, and each input has a field of its own.
const MOST_TABLES: usize = 256;

const SECTIONS: [&str; 12] = [
    "title", "mesh", "material", "source", "boundary", "input", "output", "target", "time",
    "exact", "setting", "extends",
];

/// A scene that stands on its own.
pub(super) fn read_scene(root: &Table) -> Result<Scene> {
    root.only("the scene", &SECTIONS)?;
    let boundaries = at_least_one(root, "boundary", read_boundary)?;
    Ok(Scene {
        title: read_title(root)?,
        mesh: read_mesh(root)?,
        materials: at_least_one(root, "material", read_material)?,
        source: read_source(root)?,
        inputs: each(root, "input", |table| read_input(table, &boundaries))?,
        outputs: each(root, "output", |table| read_output(table, &boundaries))?,
        boundaries,
        target: root.table("target")?.as_ref().map(read_target).transpose()?,
        time: root.table("time")?.as_ref().map(read_time).transpose()?,
        exact: root.table("exact")?.as_ref().map(read_exact).transpose()?,
        setting: root.table("setting")?.as_ref().map(read_setting).transpose()?,
        fragment: None,
        path: root.document.path.clone(),
        text: root.document.text.clone(),
    })
}

/// The tables `[key.NAME]`, each read.
fn each<T>(root: &Table, key: &str, read: impl Fn(&Table) -> Result<T>) -> Result<Vec<T>> {
    let tables = root.tables(key)?;
    if let Some(table) = tables.get(MOST_TABLES) {
        let message = format!("{} tables [{key}.…], expected at most {MOST_TABLES}", tables.len());
        let error = root.document.error(&table.name, message);
        return Err(error.hint("join groups of the mesh that have the same data").into());
    }
    tables.iter().map(read).collect()
}

fn at_least_one<T>(root: &Table, key: &str, read: impl Fn(&Table) -> Result<T>) -> Result<Vec<T>> {
    let all = each(root, key, read)?;
    if all.is_empty() {
        let hint =
            format!("write [{key}.NAME] with the name of a group of the mesh, or [{key}.default]");
        return Err(root.absent(key).hint(hint).into());
    }
    Ok(all)
}

fn read_title(root: &Table) -> Result<String> {
    match root.get("title") {
        Some(entry) => Ok(entry.text()?.value),
        None => {
            Ok(root.document.path.file_stem().unwrap_or_default().to_string_lossy().into_owned())
        }
    }
}

fn read_mesh(root: &Table) -> Result<Located<PathBuf>> {
    let entry = root.require("mesh")?;
    let name = entry.text()?.value;
    if name.is_empty() {
        return Err(entry.expected("the path of a mesh file").into());
    }
    let folder = root.document.path.parent().unwrap_or(Path::new(""));
    Ok(entry.at.with(folder.join(name)))
}

fn read_source(root: &Table) -> Result<Located<Expression>> {
    let Some(table) = root.table("source")? else {
        let key = "source.f".to_owned();
        return Ok(Located { value: Expression::constant(0.0), key, span: 0..0 });
    };
    table.only("the source", &["f"])?;
    table.require("f")?.expression(Variables::SpaceTime)
}

fn read_target(table: &Table) -> Result<Target> {
    table.only("the target", &["ram", "flash", "tick", "clock"])?;
    let bytes = |key| table.get(key).as_ref().map(Entry::bytes).transpose();
    let positive = |key, unit| table.get(key).map(|entry| entry.positive(unit)).transpose();
    Ok(Target {
        ram: bytes("ram")?,
        flash: bytes("flash")?,
        tick: positive("tick", "seconds")?,
        clock: positive("clock", "hertz")?,
    })
}

fn read_time(table: &Table) -> Result<Time> {
    table.only("the time", &["step", "end"])?;
    let step = table.require("step")?.positive("seconds")?;
    let entry = table.require("end")?;
    let end = entry.positive("seconds")?;
    if end < step {
        return Err(entry.error(format_args!("{end} comes before the first step, {step}")).into());
    }
    Ok(Time { step, end })
}

fn read_exact(table: &Table) -> Result<Exact> {
    table.only("the exact solution", &["u", "gradient"])?;
    let u = table.require("u")?.expression(Variables::SpaceTime)?;
    let [along_x, along_y] = table.require("gradient")?.pair("∂u/∂x, ∂u/∂y")?;
    let gradient =
        [along_x.expression(Variables::SpaceTime)?, along_y.expression(Variables::SpaceTime)?];
    Ok(Exact { u, gradient })
}
