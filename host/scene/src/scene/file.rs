//! From a file to the model: a scene that stands on its own, or a fragment of one.

use std::path::Path;

use super::Scene;
use super::document::{Document, document, load};
use super::fragment::read_fragment;
use super::read::read_scene;
use super::table::Table;
use crate::error::Result;

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
