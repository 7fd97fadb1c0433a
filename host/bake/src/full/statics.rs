//! Statics of a module as they are written: their text, and their bytes on the target.

use std::fmt::{Debug, Write as _};

use crate::text::array;

/// What has been written so far.
#[derive(Debug, Default)]
pub(super) struct Statics {
    pub text: String,
    /// Those of the arrays.
    pub bytes: usize,
}

impl Statics {
    /// Writes an array of entries that are `T` on the target, and returns what borrows it; an empty one needs no static.
    pub fn array<T>(&mut self, name: &str, doc: &str, of: &str, entries: &[impl Debug]) -> String {
        self.spelt::<T>(name, doc, of, entries.len(), &array(entries, 4))
    }

    /// The same with its value as text.
    pub fn spelt<T>(
        &mut self,
        name: &str,
        doc: &str,
        of: &str,
        length: usize,
        value: &str,
    ) -> String {
        if length == 0 {
            return "&[]".to_owned();
        }
        let doc = doc.replace('[', "\\[").replace(']', "\\]");
        let _ =
            write!(self.text, "\n    /// {doc}\n    static {name}: [{of}; {length}] = {value};\n");
        self.bytes += size_of::<T>() * length;
        format!("&{name}")
    }
}

/// Records of an array that nothing else names, one a line.
pub(super) fn lines(entries: &[String]) -> String {
    let lines: String = entries.iter().map(|entry| format!("\n            {entry},")).collect();
    if entries.is_empty() { "&[]".to_owned() } else { format!("&[{lines}\n        ]") }
}

/// The name of an input's or output's array.
pub(super) fn named(identifier: &str, what: &str) -> String {
    format!("{}_{what}", identifier.trim_end_matches('_').to_ascii_uppercase())
}
