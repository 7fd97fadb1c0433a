//! Statics of a module as they are written: their text, and their bytes on the target.

use std::fmt::{Debug, Write as _};

use crate::text::{array, imports};

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

    /// Writes an array of numbers.
    pub fn numbers<R: Debug>(&mut self, name: &str, doc: &str, entries: &[R]) -> String {
        self.array::<R>(name, doc, "Scalar", entries)
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

    /// The module that holds them: `names` are items of the kernel that they may use, `own` what they take from the
    /// module around it.
    pub fn module(&self, names: &str, own: &str) -> String {
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
pub(crate) fn lines(entries: impl Iterator<Item = String>) -> String {
    let lines: String = entries.map(|entry| format!("\n            {entry},")).collect();
    if lines.is_empty() { "&[]".to_owned() } else { format!("&[{lines}\n        ]") }
}

/// A record in one line.
pub(crate) fn record<const N: usize>(name: &str, fields: [(&str, String); N]) -> String {
    let fields = fields.map(|(field, value)| format!("{field}: {value}"));
    format!("{name} {{ {} }}", fields.join(", "))
}

/// A record with a line for each field; its last line is indented by so much.
pub(crate) fn tall_record<const N: usize>(
    name: &str,
    indent: usize,
    fields: [(&str, String); N],
) -> String {
    let fields = fields.map(|(field, value)| format!("\n{:indent$}    {field}: {value},", ""));
    format!("{name} {{{}\n{:indent$}}}", fields.concat(), "")
}

/// The name of an input's or output's array.
pub(crate) fn named(identifier: &str, what: &str) -> String {
    format!("{}_{what}", identifier.trim_end_matches('_').to_ascii_uppercase())
}
