//! A list of statics, as text with its size in bytes.

use std::fmt::Debug;

use crate::text::array;

/// A static.
#[derive(Debug, Clone)]
pub(super) struct Item {
    pub name: String,
    pub doc: String,
    /// Its type.
    pub of: String,
    /// Its value.
    pub value: String,
    pub bytes: usize,
}

/// Arrays of the module; empty ones are left out.
#[derive(Debug, Default)]
pub(super) struct List(pub Vec<Item>);

impl List {
    /// An array of entries that are `T` on the target.
    pub fn put<T>(&mut self, name: &str, doc: &str, of: &str, entries: &[impl Debug]) {
        if entries.is_empty() {
            return;
        }
        self.0.push(Item {
            name: name.to_owned(),
            doc: doc.to_owned(),
            of: format!("[{of}; {}]", entries.len()),
            value: array(entries, 4),
            bytes: size_of::<T>() * entries.len(),
        });
    }
}
