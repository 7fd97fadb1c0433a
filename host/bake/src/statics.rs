//! Statics of a module as they are written: their text, and their bytes on the target.

use std::fmt::{Debug, Write as _};

use crate::imports::imports;
use crate::text::array;

/// The text so far.
#[derive(Debug, Default)]
pub(crate) struct Statics {
    pub text: String,
    /// Bytes of the arrays.
    pub bytes: usize,
}

impl Statics {
    /// Writes an array of entries that are `T` on the target, and returns what borrows it; an empty one needs no static.
    pub fn array<T>(&mut self, name: &str, doc: &str, of: &str, entries: &[impl Debug]) -> String {
        self.spelt::<T>(name, doc, of, entries.len(), &array(entries, 4))
    }

    /// Writes an array whose value is this text.
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

    /// The module that holds them: `names` are what they may name, with its place in the kernel, `own` what they take from
    /// the module around it.
    pub fn module(&self, names: &[(&str, &str)], own: &str) -> String {
        let text = &self.text;
        let imports = imports(names, text, "    ");
        format!(
            "
/// The scene: what stays from tick to tick.
#[rustfmt::skip]
#[allow(clippy::all)]
mod data {{
    use super::{{{own}}};{imports}{text}}}
"
        )
    }
}

/// Records of an array that nothing else names, one a line.
pub(crate) fn lines(entries: &[String]) -> String {
    let lines: String = entries.iter().map(|entry| format!("\n            {entry},")).collect();
    if entries.is_empty() { "&[]".to_owned() } else { format!("&[{lines}\n        ]") }
}

/// The name of an input's or output's array.
pub(crate) fn named(identifier: &str, what: &str) -> String {
    format!("{}_{what}", identifier.trim_end_matches('_').to_ascii_uppercase())
}
