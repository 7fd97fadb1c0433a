//! The entries of a study's journal: its cases, and facts of the truth.

use serde::{Deserialize, Serialize};

use super::record::Point;
use signorini_scene::error::{Error, InputError};
use signorini_scene::scene::Scene;

/// A setting measured, or why it could not be.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) enum MeasuredSetting {
    Point(Box<Point>),
    Left(String),
}

/// The facts of the truth that a record states.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Facts {
    pub words: String,
    pub energy: f64,
    pub force: f64,
    pub length: f64,
}

impl MeasuredSetting {
    pub fn name(&self) -> &str {
        match self {
            Self::Point(point) => &point.name,
            Self::Left(reason) => reason,
        }
    }
}

pub(super) fn overflow(scene: &Scene) -> Error {
    InputError::new("the energy or the contact force of the solution overflows")
        .file(&scene.path)
        .hint("scale the data so that they are neither tiny nor huge")
        .into()
}

/// A mark of this very program: another build measures anew.
pub(crate) fn program() -> String {
    let bytes = std::env::current_exe().and_then(std::fs::read);
    let digest = |bytes: Vec<u8>| format!("{:016x}", digest(&bytes));
    bytes.map_or_else(|_| env!("CARGO_PKG_VERSION").to_owned(), digest)
}

pub(crate) fn digest<T: std::hash::Hash + ?Sized>(of: &T) -> u64 {
    use std::hash::{DefaultHasher, Hasher};
    let mut hasher = DefaultHasher::new();
    of.hash(&mut hasher);
    hasher.finish()
}
