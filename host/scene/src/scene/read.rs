//! From the file to the model: the sections of a scene that stands on its own, or a fragment: a file that extends a
//! scene and changes how it is solved.
//!
//! ```toml
//! extends = "levee.toml"   # beside the fragment; its mesh stays beside it
//! title = "levee, quick"   # optional
//! [setting]                # in place of the one of the scene
//! cells = "quads"
//! ```

use std::path::{Path, PathBuf};

use super::boundary::read_boundary;
use super::control::read_input;
use super::document::{Document, document, load};
use super::entry::Entry;
use super::material::read_material;
use super::output::read_output;
use super::setting::read_setting;
use super::table::Table;
use super::{Exact, Located, Material, Scene, Target, Time};
use crate::error::{Error, Result};
use crate::expression::{Expression, Variables};

/// Most tables `[KIND.NAME]` of a kind: names are looked up one by one, and each input has a field of its own.
const MOST_TABLES: usize = 256;

const SECTIONS: &str =
    "title, mesh, material, source, boundary, input, output, target, time, exact, setting, extends";

impl Scene {
    /// Reads and checks the scene file at `path`, and the one it extends, if it is a fragment; the
    /// mesh file is not touched.
    pub fn read(path: &Path) -> Result<Self> {
        read(&load(path)?)
    }

    /// Reads and checks the scene `text`; `path` names it in messages, and mesh and extended scene
    /// are found from there.
    pub fn parse(text: &str, path: &Path) -> Result<Self> {
        read(&document(text.as_bytes(), path)?)
    }
}

fn read(document: &Document) -> Result<Scene> {
    let entries = document.parse()?;
    let root = Table::root(document, &entries);
    match root.get("extends") {
        Some(extends) => read_fragment(&root, &extends),
        None => read_scene(&root),
    }
}

/// The scene that the fragment `root` extends, with the fragment's title and setting.
///
/// Path and text remain those of the extended scene, where its values stand.
fn read_fragment(root: &Table, extends: &Entry) -> Result<Scene> {
    if let Some(error) = root.foreign("a fragment", "extends, title, setting") {
        let hint = "a file that extends another changes [setting] and title alone";
        return Err(error.hint(hint).into());
    }
    let path = path_beside(extends, "the path of a scene file")?;
    // Reading a pipe would wait for whoever writes to it.
    if path.metadata().is_ok_and(|metadata| !metadata.is_file()) {
        let error = extends.error(format_args!("{} is no file", path.display()));
        return Err(error.hint("extend the scene that stands on its own").into());
    }
    let document = load(&path)?;
    let entries = document.parse()?;
    let extended = Table::root(&document, &entries);
    if extended.get("extends").is_some() {
        let path = document.path.display();
        let error = extends.error(format_args!("{path} extends another scene itself"));
        return Err(error.hint("extend the scene that stands on its own").into());
    }
    let mut scene = read_scene(&extended)?;
    if let Some(title) = root.get("title") {
        scene.title = title.text()?.value;
    }
    scene.setting = section(root, "setting", read_setting)?.or(scene.setting);
    scene.fragment = Some(root.document.path.clone());
    Ok(scene)
}

/// A scene that stands on its own.
fn read_scene(root: &Table) -> Result<Scene> {
    root.only("the scene", SECTIONS)?;
    let boundaries = at_least_one(root, "boundary", read_boundary)?;
    let materials = at_least_one(root, "material", read_material)?;
    let stores = materials.iter().any(Material::stores);
    Ok(Scene {
        title: read_title(root)?,
        mesh: read_mesh(root)?,
        source: read_source(root)?,
        inputs: each(root, "input", |table| read_input(table, &boundaries))?,
        outputs: each(root, "output", |table| read_output(table, &boundaries, &materials))?,
        materials,
        boundaries,
        target: section(root, "target", read_target)?,
        time: root.table("time")?.map(|table| read_time(&table, stores)).transpose()?,
        exact: section(root, "exact", read_exact)?,
        setting: section(root, "setting", read_setting)?,
        fragment: None,
        path: root.document.path.clone(),
        text: root.document.text.clone(),
    })
}

/// The table `[key]`, read, if there is one.
fn section<T>(root: &Table, key: &str, read: fn(&Table) -> Result<T>) -> Result<Option<T>> {
    root.table(key)?.as_ref().map(read).transpose()
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
    Ok(entry.at.with(path_beside(&entry, "the path of a mesh file")?))
}

/// The file that an entry names, seen from the folder of its own file.
fn path_beside(entry: &Entry, expected: &str) -> Result<PathBuf> {
    let name = entry.text()?.value;
    if name.is_empty() {
        return Err(entry.expected(expected).into());
    }
    Ok(entry.document.path.parent().unwrap_or(Path::new("")).join(name))
}

fn read_source(root: &Table) -> Result<Located<Expression>> {
    let Some(table) = root.table("source")? else {
        let key = "source.f".to_owned();
        return Ok(Located { value: Expression::constant(0.0), key, span: 0..0 });
    };
    table.only("the source", "f")?;
    table.require("f")?.expression(Variables::SpaceTime)
}

fn read_target(table: &Table) -> Result<Target> {
    table.only("the target", "ram, flash, tick, clock")?;
    let bytes = |key| table.get(key).as_ref().map(Entry::bytes).transpose();
    let positive = |key, unit| table.get(key).map(|entry| entry.positive(unit)).transpose();
    Ok(Target {
        ram: bytes("ram")?,
        flash: bytes("flash")?,
        tick: positive("tick", "seconds")?,
        clock: positive("clock", "hertz")?,
    })
}

/// `stores`: whether a material does, so that ticks are steps in time, of which a command may be asked for any number.
fn read_time(table: &Table, stores: bool) -> Result<Time> {
    table.only("the time", "step, end, initial")?;
    let step = table.require("step")?.positive("seconds")?;
    let end = if stores { table.get("end") } else { Some(table.require("end")?) };
    let end = end.map(|entry| match entry.positive("seconds")? {
        end if end >= step => Ok(end),
        end => {
            let message = format!("{end} comes before the first step, {step}");
            Err(Error::from(entry.error(message)))
        }
    });
    let initial = table.get("initial");
    if let Some(entry) = initial.as_ref().filter(|_| !stores) {
        let error = entry.error("no material stores u, so that nothing has a start");
        return Err(error.hint("give a material a `capacity`, or remove `initial`").into());
    }
    let is_steady = |entry: &Entry| entry.text().is_ok_and(|text| text.value == "steady");
    let initial = initial.filter(|entry| !is_steady(entry));
    let initial = initial.map(|entry| entry.expression(Variables::Space));
    Ok(Time { step, end: end.transpose()?, initial: initial.transpose()? })
}

fn read_exact(table: &Table) -> Result<Exact> {
    table.only("the exact solution", "u, gradient")?;
    let u = table.require("u")?.expression(Variables::SpaceTime)?;
    let [along_x, along_y] = table.require("gradient")?.pair("∂u/∂x, ∂u/∂y")?;
    let gradient =
        [along_x.expression(Variables::SpaceTime)?, along_y.expression(Variables::SpaceTime)?];
    Ok(Exact { u, gradient })
}
