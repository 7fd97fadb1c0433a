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

use super::boundary::{kind_of, read_boundary};
use super::control::read_input;
use super::document::{Document, document, load};
use super::draft::{Draft, bounded, unit, unread};
use super::entry::Entry;
use super::keys::{Section, tables};
use super::material::read_material;
use super::output::{Groups, read_output};
use super::setting::read_setting;
use super::table::{Table, to_name};
use super::{Condition, Exact, Located, Material, Named, Scene, Target, Time};
use crate::error::{Error, InputError, Result};
use crate::expression::{Expression, Variables};

/// Most tables `[KIND.NAME]` of a kind: names are looked up one by one, and each input has a field of its own.
pub(super) const MOST_TABLES: usize = 256;

impl Scene {
    /// Reads and checks the scene file at `path`, and the one it extends, if it is a fragment; the
    /// mesh file is not touched.
    ///
    /// # Errors
    /// Everything that is wrong with it: the first fault, and all others behind it.
    pub fn read(path: &Path) -> Result<Self> {
        Self::draft(path)?.finish()
    }

    /// Reads and checks the scene `text`; `path` names it in messages, and mesh and extended scene
    /// are found from there.
    ///
    /// # Errors
    /// As for [`Scene::read`].
    pub fn parse(text: &str, path: &Path) -> Result<Self> {
        read(document(text.as_bytes(), path)?)?.finish()
    }

    /// Reads the scene file at `path` as far as it can be read.
    ///
    /// # Errors
    /// A file that cannot be opened, or is no TOML.
    pub fn draft(path: &Path) -> Result<Draft> {
        read(load(path)?)
    }
}

fn read(document: Document) -> Result<Draft> {
    let entries = document.parse()?;
    let root = Table::root(&document, &entries);
    let draft = match root.get("extends") {
        Some(extends) => match read_fragment(&root, &extends) {
            Ok(draft) => draft,
            // What else is wrong is told with it.
            Err(error) => {
                document.faults.add(error);
                root.table("setting").as_ref().map(read_setting);
                root.note_open();
                let lacking = extends.expected("a scene that stands on its own");
                drop(entries);
                return Err(document.faults.into_result().err().unwrap_or(lacking.into()));
            }
        },
        None => read_scene(&root),
    };
    root.note_open();
    drop(entries);
    Ok(Draft { faults: faults(document, draft.faults), ..draft })
}

/// The faults of a document, then those of the one that it extends.
fn faults(document: Document, extended: Vec<InputError>) -> Vec<InputError> {
    let mut all = document.faults.into_vec();
    all.extend(extended);
    all
}

/// The scene that the fragment `root` extends, with the fragment's title and setting.
///
/// Path and text remain those of the extended scene, where its values stand.
fn read_fragment(root: &Table, extends: &Entry) -> Result<Draft> {
    let hint = "a file that extends another changes [setting] and title alone";
    root.only_among("a fragment", &["extends", "title", "setting"], hint);
    let path = extended_path(extends)?;
    let document = load(&path)
        .map_err(|error| extends.error(format_args!("{}: {}", path.display(), error.reason())))?;
    let entries = document.parse()?;
    let extended = Table::root(&document, &entries);
    if extended.get("extends").is_some() {
        let path = document.path.display();
        let error = extends.error(format_args!("{path} extends another scene itself"));
        return Err(error.hint("extend the scene that stands on its own").into());
    }
    let mut draft = read_scene(&extended);
    let scene = &mut draft.scene;
    if let Some(title) = root.get("title") {
        scene.title = root.keep(title.text()).map_or_else(String::new, |title| title.value);
    }
    let setting = root.table("setting").and_then(|table| read_setting(&table));
    scene.setting = setting.or(scene.setting);
    scene.fragment = Some(root.document.path.clone());
    extended.note_open();
    drop(entries);
    Ok(Draft { faults: document.faults.into_vec(), ..draft })
}

/// The file that a fragment extends.
fn extended_path(extends: &Entry) -> Result<PathBuf> {
    let path = path_beside(extends, "the path of a scene file")?;
    // Reading a pipe would wait for whoever writes to it.
    if path.metadata().is_ok_and(|metadata| !metadata.is_file()) {
        let error = extends.error(format_args!("{} is no file", path.display()));
        return Err(error.hint("extend the scene that stands on its own").into());
    }
    Ok(path)
}

/// A scene that stands on its own; its faults are still in its document.
fn read_scene(root: &Table) -> Draft {
    let top: Vec<_> = Section::of("", None).into_iter().flat_map(Section::names).collect();
    let allowed = [top, tables()].concat();
    root.only_among("the scene", &allowed, &format!("allowed here: {}", allowed.join(", ")));
    let tables =
        at_least_one(root, "boundary", |table| Some((kind_of(table), read_boundary(table))));
    let kinds = tables.iter().map(|(_, of)| of.as_ref().and_then(|(kind, _)| *kind)).collect();
    let read = |(name, of): Named<(_, Option<Condition>)>| (name, of.and_then(|(_, of)| of));
    let boundaries: Vec<Named<Condition>> = tables.into_iter().map(read).collect();
    let materials = at_least_one(root, "material", read_material);
    let stores = materials.iter().any(|(_, of)| of.as_ref().is_none_or(Material::stores));
    let inputs = each(root, "input", |table| read_input(table, &boundaries));
    let groups = Groups { boundaries: &boundaries, materials: &materials };
    let outputs = each(root, "output", |table| read_output(table, groups));
    let mesh = read_mesh(root);
    let open = mesh.is_none().then(|| "mesh".to_owned());
    let open = open.into_iter().chain(unread(&boundaries)).chain(unread(&materials)).collect();
    let scene = Scene {
        title: read_title(root),
        mesh: mesh.unwrap_or_else(|| root.missing("mesh", PathBuf::new())),
        source: read_source(root)
            .unwrap_or_else(|| root.missing("source", Expression::constant(0.0))),
        inputs: inputs.into_iter().filter_map(|(_, input)| input).collect(),
        outputs: outputs.into_iter().filter_map(|(_, output)| output).collect(),
        materials: materials
            .into_iter()
            .map(|(name, of)| of.unwrap_or_else(|| unit(name)))
            .collect(),
        boundaries: boundaries.into_iter().map(|(name, of)| bounded(name, of)).collect(),
        target: root.table("target").and_then(|table| read_target(&table)),
        time: root.table("time").and_then(|table| read_time(&table, stores)),
        exact: root.table("exact").and_then(|table| read_exact(&table)),
        setting: root.table("setting").and_then(|table| read_setting(&table)),
        fragment: None,
        path: root.document.path.clone(),
        text: root.document.text.clone(),
    };
    Draft { scene, kinds, open, faults: Vec::new() }
}

/// The tables `[key.NAME]` by name, each read.
fn each<T>(root: &Table, key: &str, read: impl Fn(&Table) -> Option<T>) -> Vec<Named<T>> {
    let tables = root.tables(key);
    if let Some(table) = tables.get(MOST_TABLES) {
        let message = format!("{} tables [{key}.…], expected at most {MOST_TABLES}", tables.len());
        let fault = root.document.error(&table.name, message);
        root.document.faults.note(fault.hint("join groups of the mesh that have the same data"));
        return Vec::new();
    }
    tables.iter().map(|table| (table.name.clone(), read(table))).collect()
}

fn at_least_one<T>(root: &Table, key: &str, read: impl Fn(&Table) -> Option<T>) -> Vec<Named<T>> {
    let known = root.document.faults.count();
    let all = each(root, key, read);
    if all.is_empty() && root.document.faults.count() == known {
        root.document.faults.note(root.absent(key).hint(to_name(key)));
    }
    all
}

fn read_title(root: &Table) -> String {
    let title = root.get("title").and_then(|entry| root.keep(entry.text()));
    let of_file =
        || root.document.path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    title.map_or_else(of_file, |title| title.value)
}

fn read_mesh(root: &Table) -> Option<Located<PathBuf>> {
    root.read("mesh", |entry| Ok(entry.at.with(path_beside(entry, "the path of a mesh file")?)))
}

/// The file that an entry names, seen from the folder of its own file.
fn path_beside(entry: &Entry, expected: &str) -> Result<PathBuf> {
    let name = entry.text()?.value;
    if name.is_empty() {
        return Err(entry.expected(expected).into());
    }
    Ok(entry.document.path.parent().unwrap_or(Path::new("")).join(name))
}

fn read_source(root: &Table) -> Option<Located<Expression>> {
    let Some(table) = root.table("source") else {
        let key = "source.f".to_owned();
        return Some(Located { value: Expression::constant(0.0), key, span: 0..0 });
    };
    table.only("source", None);
    table.load("f")
}

fn read_target(table: &Table) -> Option<Target> {
    table.only("target", None);
    let bytes = |key| table.read_some(key, Entry::bytes);
    let positive = |key, unit| table.read_some(key, |entry| entry.positive(unit));
    let (ram, flash) = (bytes("ram"), bytes("flash"));
    let (tick, clock) = (positive("tick", "seconds"), positive("clock", "hertz"));
    Some(Target { ram: ram?, flash: flash?, tick: tick?, clock: clock? })
}

/// `stores`: whether a material does, so that ticks are steps in time, of which a command may be asked for any number.
fn read_time(table: &Table, stores: bool) -> Option<Time> {
    table.only("time", None);
    let step = table.read("step", |entry| entry.positive("seconds"));
    let late = |entry: &Entry| match entry.positive("seconds")? {
        end if step.is_none_or(|step| end >= step) => Ok(end),
        end => {
            let step = step.unwrap_or(end);
            let message = format!("{end} comes before the first step, {step}");
            Err(Error::from(entry.error(message)))
        }
    };
    let end = match stores {
        true => table.read_some("end", late),
        false => table.read("end", late).map(Some),
    };
    if let Some(entry) = table.get("initial").filter(|_| !stores) {
        let fault = entry.error("no material stores u, so that nothing has a start");
        let hint = "give a material a `capacity`, or remove `initial`";
        table.document.faults.note(fault.hint(hint));
    }
    let initial = table.read_or("initial", None, |entry| match entry.word() {
        Some("steady") => Ok(None),
        _ => entry.expression(Variables::Space).map(Some),
    });
    Some(Time { step: step?, end: end?, initial: initial? })
}

fn read_exact(table: &Table) -> Option<Exact> {
    table.only("exact", None);
    let u = table.load("u");
    let gradient = table.read("gradient", |entry| {
        let [along_x, along_y] = entry.pair("∂u/∂x, ∂u/∂y")?;
        Ok([along_x.load()?, along_y.load()?])
    });
    Some(Exact { u: u?, gradient: gradient? })
}
