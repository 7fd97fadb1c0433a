//! The scene file as text, and errors that show a place in it.

use std::fmt::Display;
use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use toml::de::DeTable;

use super::Located;
use crate::error::{InputError, Result, line_of};
use crate::expression::{Expression, ParseError, Variables};
use crate::faults::Faults;

const LARGEST_FILE: usize = 1 << 20;

/// A scene file as text.
pub(super) struct Document {
    pub path: PathBuf,
    pub text: Arc<str>,
    /// What is wrong with it, as far as it has been read.
    pub faults: Faults,
}

impl Document {
    /// The tables and values of the text; the TOML reader itself limits how deep they nest.
    pub fn parse(&self) -> Result<DeTable<'_>> {
        let root = DeTable::parse(&self.text).map_err(|error| {
            let span = error.span().unwrap_or(0..0);
            let wrong = InputError::new(format!("not TOML: {}", error.message()));
            let hint = match self.text.starts_with("$MeshFormat") {
                true => Some("this is a mesh: `signorini new` writes a scene for it".to_owned()),
                false => value_before(&self.text, span.start).and_then(correction),
            };
            let wrong = wrong.file(&self.path).excerpt(&self.text, span);
            match hint {
                Some(hint) => wrong.hint(hint),
                None => wrong,
            }
        })?;
        Ok(root.into_inner())
    }

    /// The error that `at` is wrong.
    pub fn error<T>(&self, at: &Located<T>, message: impl Display) -> InputError {
        at.error(&self.path, &self.text, message)
    }
}

/// The file at `path`.
pub(super) fn load(path: &Path) -> Result<Document> {
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(LARGEST_FILE as u64 + 1).read_to_end(&mut bytes))
        .map_err(|error| unreadable(path, error.to_string()))?;
    document(&bytes, path)
}

pub(super) fn document(bytes: &[u8], path: &Path) -> Result<Document> {
    if bytes.len() > LARGEST_FILE {
        return Err(unreadable(path, format!("longer than {LARGEST_FILE} bytes")).into());
    }
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = line_of(bytes, error.valid_up_to());
        unreadable(path, "not UTF-8 text".to_owned()).line(line)
    })?;
    Ok(Document { path: path.to_owned(), text: text.into(), faults: Faults::default() })
}

/// The value behind the `=` of the line that a byte stands in, where the byte is no part of the key.
fn value_before(text: &str, at: usize) -> Option<&str> {
    let at = text.floor_char_boundary(at);
    let start = text[..at].rfind('\n').map_or(0, |newline| newline + 1);
    let line = text[start..].lines().next()?;
    let (key, value) = line.split_once('=')?;
    let value = value.split_once('#').map_or(value, |(value, _)| value);
    (start + key.len() < at).then(|| value.trim())
}

/// How a value that TOML cannot read is written, unless it is more than one number or expression.
fn correction(value: &str) -> Option<String> {
    if value.is_empty() {
        return Some("write a value behind the `=`".to_owned());
    }
    if value.contains(['"', '\'', '[', '{']) {
        return None;
    }
    if let Ok(number) = value.parse::<f64>() {
        return Some(format!("write `{number:?}`"));
    }
    let begins_a_number = value.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
    match Expression::parse(value, Variables::SpaceTime) {
        Err(ParseError { hint, .. }) if begins_a_number => hint,
        _ => Some(format!("texts and expressions stand in quotes: write `\"{value}\"`")),
    }
}

fn unreadable(path: &Path, message: String) -> InputError {
    InputError::new(message).file(path).hint("a scene is a TOML file")
}
