//! TOML with places: tables that know their key and the bytes they stand in.
//!
//! A table is asked which keys it may hold ([`Table::only`]), so that a misspelt key is reported as such; then its
//! entries are read one by one. What is wrong is noted in the document, and the reader goes on.
//! Serde could read the same into structs, but its errors carry no path of keys, and an enum chosen
//! by `kind` loses the places.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use super::document::Document;
use super::entry::Entry;
use super::keys::Section;
use super::{Datum, Located};
use crate::error::{InputError, Result};
use crate::expression::Expression;

/// A table, its name located at the header.
pub(super) struct Table<'a> {
    pub document: &'a Document,
    pub name: Located<String>,
    entries: &'a DeTable<'a>,
}

impl<'a> Table<'a> {
    /// The table of the whole document.
    pub fn root(document: &'a Document, entries: &'a DeTable<'a>) -> Self {
        let name = Located { value: String::new(), key: String::new(), span: 0..0 };
        Self { document, name, entries }
    }

    /// Notes keys that a table with this header, and of this kind, does not have.
    pub fn only(&self, header: &str, kind: Option<&str>) {
        let Some(section) = Section::of(header, kind) else { return };
        let allowed: Vec<_> = section.names().collect();
        self.only_among(section.what, &allowed, &format!("allowed here: {}", allowed.join(", ")));
    }

    /// Notes keys other than `allowed`; `what` names the table in the message.
    pub fn only_among(&self, what: &str, allowed: &[&str], hint: &str) {
        let foreign = self.entries.keys().filter(|key| !allowed.contains(&key.get_ref().as_ref()));
        for key in foreign {
            let at = self.locate(key.get_ref(), key.span(), ());
            let fault = self.document.error(&at, format_args!("unknown key of {what}"));
            self.document.faults.note(fault.hint(hint));
        }
    }

    /// The value that was read, or nothing: then its fault is noted.
    pub fn keep<T>(&self, read: Result<T>) -> Option<T> {
        self.document.faults.keep(read)
    }

    /// The value of `key`, which must be there, read.
    pub fn read<T>(&self, key: &str, read: impl FnOnce(&Entry<'a>) -> Result<T>) -> Option<T> {
        let entry = self.require(key)?;
        self.keep(read(&entry))
    }

    /// The value of `key`, read; `default` if the key is absent, nothing if its value is wrong.
    pub fn read_or<T>(
        &self,
        key: &str,
        default: T,
        read: impl FnOnce(&Entry<'a>) -> Result<T>,
    ) -> Option<T> {
        self.get(key).map_or(Some(default), |entry| self.keep(read(&entry)))
    }

    /// The value of `key` if there is one, read; nothing if it is wrong.
    pub fn read_some<T>(
        &self,
        key: &str,
        read: impl FnOnce(&Entry<'a>) -> Result<T>,
    ) -> Option<Option<T>> {
        self.read_or(key, None, |entry| read(entry).map(Some))
    }

    /// Puts the value of `key`, read, in its place, where the key is there; says whether nothing is wrong with it.
    pub fn set<T, V: Into<T>>(
        &self,
        key: &str,
        place: &mut T,
        read: impl FnOnce(&Entry<'a>) -> Result<V>,
    ) -> bool {
        let Some(entry) = self.get(key) else { return true };
        self.keep(read(&entry)).map(|value| *place = value.into()).is_some()
    }

    /// The value of `key`, if there is one.
    pub fn get(&self, key: &str) -> Option<Entry<'a>> {
        let value = self.entries.get(key)?;
        let at = self.locate(key, value.span(), value.get_ref());
        Some(Entry { document: self.document, at })
    }

    /// The value of `key`; where there is none, that is noted.
    pub fn require(&self, key: &str) -> Option<Entry<'a>> {
        let entry = self.get(key);
        if entry.is_none() {
            let under = match self.name.key.as_str() {
                "" => "at the top of the scene".to_owned(),
                table => format!("under [{table}]"),
            };
            let hint = format!("add `{key} = …` {under}");
            self.document.faults.note(self.absent(key).hint(hint));
        }
        entry
    }

    /// The error that `key` is missing.
    pub fn absent(&self, key: &str) -> InputError {
        self.document.error(&self.missing(key, ()), "missing")
    }

    /// An expression in x, y and t, which must be there.
    pub fn load(&self, key: &str) -> Option<Datum> {
        self.read(key, Entry::load)
    }

    /// The value of `key`, read; a constant if the key is absent.
    pub fn or_constant(
        &self,
        key: &str,
        default: f64,
        read: impl FnOnce(&Entry<'a>) -> Result<Datum>,
    ) -> Option<Datum> {
        let default = self.missing(key, Expression::constant(default));
        self.read_or(key, default, read)
    }

    /// The table under `key`, if there is one.
    pub fn table(&self, key: &str) -> Option<Self> {
        let (name, value) = self.entries.get_key_value(key)?;
        self.keep(self.subtable(name, value))
    }

    /// The tables under the table `key`, `[key.NAME]`, in the order of the file.
    pub fn tables(&self, key: &str) -> Vec<Self> {
        let Some(parent) = self.table(key) else { return Vec::new() };
        let mut entries: Vec<_> = parent.entries.iter().collect();
        entries.sort_by_key(|(name, _)| name.span().start);
        let header = format!("{key}.NAME");
        let is_key = |name: &str| Section::all(&header).any(|of| of.names().any(|own| own == name));
        let (nameless, entries): (Vec<_>, Vec<_>) =
            entries.into_iter().partition(|(name, value)| {
                is_key(name.get_ref()) && !matches!(value.get_ref(), DeValue::Table(_))
            });
        // One fault for all keys that stand there.
        if let Some((name, _)) = nameless.first() {
            let at = parent.locate(name.get_ref(), name.span(), ());
            let fault = self.document.error(&at, format_args!("[{key}] has no keys of its own"));
            self.document.faults.note(fault.hint(to_name(key)));
        }
        let table = |(name, value)| parent.keep(parent.subtable(name, value));
        entries.into_iter().filter_map(table).collect()
    }

    fn subtable(
        &self,
        name: &'a Spanned<DeString<'a>>,
        value: &'a Spanned<DeValue<'a>>,
    ) -> Result<Self> {
        match value.get_ref() {
            DeValue::Table(entries) => {
                let name = self.locate(name.get_ref(), name.span(), name.get_ref().to_string());
                Ok(Self { document: self.document, name, entries })
            }
            found => {
                let at = self.locate(name.get_ref(), value.span(), found);
                let hint = format!("write [{}] and its keys below it", at.key);
                let entry = Entry { document: self.document, at };
                Err(entry.expected("a table").hint(hint).into())
            }
        }
    }

    /// Notes each value that is still to be filled in and that no reader has come to.
    pub fn note_open(&self) {
        for (name, value) in self.entries {
            let at = self.locate(name.get_ref(), value.span(), value.get_ref());
            note_open(&Entry { document: self.document, at });
        }
    }

    /// Something that the file leaves out: it stands where the table begins.
    pub fn missing<T>(&self, key: &str, value: T) -> Located<T> {
        self.locate(key, self.name.span.clone(), value)
    }

    fn locate<T>(&self, key: &str, span: Range<usize>, value: T) -> Located<T> {
        Located { value, key: header(&self.name.key, key), span }
    }
}

fn note_open(entry: &Entry) {
    let document = entry.document;
    match entry.at.value {
        DeValue::Table(entries) => {
            let name = entry.at.with(String::new());
            Table { document, name, entries }.note_open();
        }
        DeValue::Array(_) => entry.array().iter().flatten().for_each(note_open),
        _ if entry.is_open() && !document.faults.underline(&entry.at.span) => {
            document.faults.note(entry.expected("a value"));
        }
        _ => {}
    }
}

/// What to write above the keys of a table that needs a name.
pub(super) fn to_name(table: &str) -> String {
    match table {
        "boundary" | "material" => format!(
            "write [{table}.NAME] with the name of a group of the mesh, or [{table}.default]"
        ),
        _ => format!("write [{table}.NAME] with a name of your choice"),
    }
}

/// The key of a table or value inside another table, in quotes where TOML asks for them.
pub(super) fn header(table: &str, key: &str) -> String {
    let bare = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-';
    let key = match key.bytes().all(bare) && !key.is_empty() {
        true => key.to_owned(),
        // Its escapes are those of TOML, but for one.
        false => serde_json::Value::from(key).to_string().replace('\u{7f}', "\\u007f"),
    };
    if table.is_empty() { key } else { format!("{table}.{key}") }
}
