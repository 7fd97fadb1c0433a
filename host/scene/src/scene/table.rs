//! TOML with places: tables that know their key and the bytes they stand in.
//!
//! A table is asked first which keys it may hold ([`Table::only`]), so that a misspelt key is
//! reported as such and not as the absence of the right one; then its entries are read one by one.
//! Serde could read the same into structs, but its errors carry no path of keys, and an enum chosen
//! by `kind` loses the places.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use super::document::Document;
use super::entry::Entry;
use super::{Datum, Located};
use crate::error::{InputError, Result};
use crate::expression::{Expression, Variables};

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

    /// Refuses keys other than `allowed`, a list with commas; `what` names the table in the message.
    pub fn only(&self, what: &str, allowed: &str) -> Result<()> {
        let hint = || format!("allowed here: {allowed}");
        self.foreign(what, allowed).map_or(Ok(()), |error| Err(error.hint(hint()).into()))
    }

    /// The error of the first key that is not among `allowed`, still without a hint.
    pub fn foreign(&self, what: &str, allowed: &str) -> Option<InputError> {
        let foreign = self
            .entries
            .keys()
            .filter(|key| !allowed.split(", ").any(|known| key.get_ref() == known))
            .min_by_key(|key| key.span().start);
        foreign.map(|key| {
            let at = self.locate(key.get_ref(), key.span(), ());
            self.document.error(&at, format_args!("unknown key of {what}"))
        })
    }

    /// The value of `key`, if there is one.
    pub fn get(&self, key: &str) -> Option<Entry<'a>> {
        let value = self.entries.get(key)?;
        let at = self.locate(key, value.span(), value.get_ref());
        Some(Entry { document: self.document, at })
    }

    /// The value of `key`, which must be there.
    pub fn require(&self, key: &str) -> Result<Entry<'a>> {
        self.get(key).ok_or_else(|| {
            let under = match self.name.key.as_str() {
                "" => "at the top of the scene".to_owned(),
                table => format!("under [{table}]"),
            };
            self.absent(key).hint(format!("add `{key} = …` {under}")).into()
        })
    }

    /// The error that `key` is missing.
    pub fn absent(&self, key: &str) -> InputError {
        self.document.error(&self.missing(key, ()), "missing")
    }

    /// An expression in `variables`, 0 if the key is absent.
    pub fn expression_or_zero(&self, key: &str, variables: Variables) -> Result<Datum> {
        match self.get(key) {
            Some(entry) => entry.expression(variables),
            None => Ok(self.missing(key, Expression::constant(0.0))),
        }
    }

    /// An end of a range: an expression in `variables` or an infinity, `default` if the key is absent.
    pub fn end_of_range(&self, key: &str, default: f64, variables: Variables) -> Result<Datum> {
        match self.get(key) {
            Some(entry) => entry.end_of_range(variables),
            None => Ok(self.missing(key, Expression::constant(default))),
        }
    }

    /// The table under `key`, if there is one.
    pub fn table(&self, key: &str) -> Result<Option<Self>> {
        let Some((name, value)) = self.entries.get_key_value(key) else { return Ok(None) };
        self.subtable(name, value).map(Some)
    }

    /// The tables under the table `key`, `[key.NAME]`, in the order of the file.
    pub fn tables(&self, key: &str) -> Result<Vec<Self>> {
        let Some(parent) = self.table(key)? else { return Ok(Vec::new()) };
        let mut entries: Vec<_> = parent.entries.iter().collect();
        entries.sort_by_key(|(name, _)| name.span().start);
        entries.into_iter().map(|(name, value)| parent.subtable(name, value)).collect()
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

    /// Something that the file leaves out: it stands where the table begins.
    fn missing<T>(&self, key: &str, value: T) -> Located<T> {
        self.locate(key, self.name.span.clone(), value)
    }

    fn locate<T>(&self, key: &str, span: Range<usize>, value: T) -> Located<T> {
        let bare = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-';
        let key = match key.bytes().all(bare) && !key.is_empty() {
            true => key.to_owned(),
            false => format!("{key:?}"),
        };
        let key = match self.name.key.as_str() {
            "" => key,
            table => format!("{table}.{key}"),
        };
        Located { value, key, span }
    }
}
