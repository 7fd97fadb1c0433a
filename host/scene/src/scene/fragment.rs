//! A fragment: a file that extends a scene and changes how it is solved.
//!
//! ```toml
//! extends = "levee.toml"   # beside the fragment; its mesh stays beside it
//! title = "levee, quick"   # optional
//! [setting]                # in place of the one of the scene
//! cells = "quads"
//! ```

use std::path::Path;

use super::Scene;
use super::document::load;
use super::entry::Entry;
use super::read::read_scene;
use super::setting::read_setting;
use super::table::Table;
use crate::error::Result;

/// The scene that the fragment `root` extends, with the fragment's title and setting.
///
/// Path and text remain those of the extended scene, where its values stand.
pub(super) fn read_fragment(root: &Table, extends: &Entry) -> Result<Scene> {
    if let Some(error) = root.foreign("a fragment", &["extends", "title", "setting"]) {
        let hint = "a file that extends another changes [setting] and title alone";
        return Err(error.hint(hint).into());
    }
    let name = extends.text()?.value;
    if name.is_empty() {
        return Err(extends.expected("the path of a scene file").into());
    }
    let folder = root.document.path.parent().unwrap_or(Path::new(""));
    let path = folder.join(name);
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
    if let Some(table) = root.table("setting")? {
        scene.setting = Some(read_setting(&table)?);
    }
    scene.fragment = Some(root.document.path.clone());
    Ok(scene)
}
