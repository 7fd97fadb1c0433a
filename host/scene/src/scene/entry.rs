//! A value of the scene file, read as what it should be: text, number, expression, array.

use std::fmt::Display;
use std::ops::{Range, RangeInclusive};

use toml::Spanned;
use toml::de::{DeInteger, DeValue};

use super::document::Document;
use super::{Datum, Located};
use crate::error::{Error, InputError, Result};
use crate::expression::{Expression, Variables};

/// The value of a key.
pub(super) struct Entry<'a> {
    pub document: &'a Document,
    pub at: Located<&'a DeValue<'a>>,
}

impl<'a> Entry<'a> {
    /// The error that this value is wrong.
    pub fn error(&self, message: impl Display) -> InputError {
        self.document.error(&self.at, message)
    }

    /// A text.
    pub fn text(&self) -> Result<Located<String>> {
        match self.at.value {
            DeValue::String(text) if !self.is_open() => Ok(self.at.with(text.to_string())),
            _ => Err(self.expected("a text").into()),
        }
    }

    /// The text, if it is one.
    pub fn word(&self) -> Option<&'a str> {
        match self.at.value {
            DeValue::String(text) => Some(text),
            _ => None,
        }
    }

    /// Whether somebody is still to write it: a new scene has "?" there.
    pub fn is_open(&self) -> bool {
        self.word().is_some_and(|text| text.trim() == "?")
    }

    /// One of the words on the left, as what stands on the right.
    pub fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> Result<T> {
        let names = choices.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
        if self.is_open() {
            return Err(self.expected(&format!("one of: {names}")).into());
        }
        let word = self.text()?.value;
        match choices.iter().find(|(name, _)| *name == word) {
            Some(&(_, choice)) => Ok(choice),
            None => Err(self.error(format_args!("`{word}` is not one of: {names}")).into()),
        }
    }

    /// A finite number.
    pub fn number(&self) -> Result<f64> {
        let value = match self.at.value {
            DeValue::Integer(integer) => rounded(integer),
            DeValue::Float(float) => float.as_str().parse().unwrap_or(f64::NAN),
            _ => return Err(self.expected("a number").into()),
        };
        match value.is_finite() {
            true => Ok(value),
            false => Err(self.error("not a finite number").into()),
        }
    }

    /// A positive number; `unit` names its unit.
    pub fn positive(&self, unit: &str) -> Result<f64> {
        match self.number()? {
            value if value > 0.0 => Ok(value),
            value => {
                Err(self.error(format_args!("{value} is not a positive number of {unit}")).into())
            }
        }
    }

    /// A number between two others, neither of them.
    pub fn inside(&self, low: f64, high: f64) -> Result<f64> {
        match self.number()? {
            value if low < value && value < high => Ok(value),
            value => Err(self.error(format_args!("{value} is not inside ({low}, {high})")).into()),
        }
    }

    /// A positive whole number of bytes.
    pub fn bytes(&self) -> Result<u64> {
        self.natural()
            .filter(|&bytes| bytes > 0)
            .ok_or_else(|| self.expected("a positive whole number of bytes").into())
    }

    /// A whole number of this range.
    pub fn whole(&self, range: RangeInclusive<u32>) -> Result<u32> {
        let number = self.natural().and_then(|number| u32::try_from(number).ok());
        number.filter(|number| range.contains(number)).ok_or_else(|| {
            let (low, high) = range.into_inner();
            self.expected(&format!("a whole number from {low} to {high}")).into()
        })
    }

    fn natural(&self) -> Option<u64> {
        let DeValue::Integer(integer) = self.at.value else { return None };
        u64::from_str_radix(integer.as_str(), integer.radix()).ok()
    }

    /// True or false.
    pub fn boolean(&self) -> Result<bool> {
        match self.at.value {
            DeValue::Boolean(value) => Ok(*value),
            _ => Err(self.expected("true or false").into()),
        }
    }

    /// A number, or a text that is an expression in `variables`.
    pub fn expression(&self, variables: Variables) -> Result<Datum> {
        match self.at.value {
            DeValue::Integer(_) | DeValue::Float(_) => {
                Ok(self.at.with(Expression::constant(self.number()?)))
            }
            DeValue::String(text) if !self.is_open() => Expression::parse(text, variables)
                .map(|expression| self.at.with(expression))
                .map_err(|error| {
                    let at = Located { span: self.within(text, error.span), ..self.at.with(()) };
                    let input = self.document.error(&at, error.message);
                    Error::from(match error.hint {
                        Some(hint) => input.hint(hint),
                        None => input,
                    })
                }),
            _ => Err(self.expected("a number or an expression in quotes").into()),
        }
    }

    /// An expression in x, y and t.
    pub fn load(&self) -> Result<Datum> {
        self.expression(Variables::SpaceTime)
    }

    /// An expression in x and y, not negative where it is a constant; `wanted` ends the message where it is.
    pub fn not_negative(&self, wanted: &str, hint: &str) -> Result<Datum> {
        let coefficient = self.expression(Variables::Space)?;
        match coefficient.value.is_constant() {
            Some(value) if value < 0.0 => {
                Err(self.error(format_args!("{value} is negative{wanted}")).hint(hint).into())
            }
            _ => Ok(coefficient),
        }
    }

    /// An expression in x, y and t, or "inf" or "-inf", with quotes or without.
    pub fn end_of_range(&self) -> Result<Datum> {
        let word = match self.at.value {
            DeValue::String(text) => text.trim(),
            DeValue::Float(float) => float.as_str(),
            _ => "",
        };
        match word {
            "inf" | "+inf" => Ok(self.at.with(Expression::constant(f64::INFINITY))),
            "-inf" => Ok(self.at.with(Expression::constant(f64::NEG_INFINITY))),
            _ => self.load(),
        }
    }

    /// An array of entries.
    pub fn array(&self) -> Option<Vec<Self>> {
        let DeValue::Array(items) = self.at.value else { return None };
        let entry = |item: &'a Spanned<DeValue<'a>>| Self {
            document: self.document,
            at: Located { value: item.get_ref(), key: self.at.key.clone(), span: item.span() },
        };
        Some(items.iter().map(entry).collect())
    }

    /// An array of two entries; `what` they are.
    pub fn pair(&self, what: &str) -> Result<[Self; 2]> {
        self.array()
            .and_then(|items| items.try_into().ok())
            .ok_or_else(|| self.expected(&format!("an array of two: {what}")).into())
    }

    /// The error that a value of another kind was expected, or that none has been written yet.
    pub fn expected(&self, expected: &str) -> InputError {
        match self.is_open() {
            true => self.error("to be filled in").hint(format!("write {expected}")),
            false => self.error(format_args!("expected {expected}, found {}", self.kind())),
        }
    }

    fn kind(&self) -> String {
        match self.at.value {
            DeValue::String(text) => format!("the text {text:?}"),
            DeValue::Integer(integer) => format!("the number {integer}"),
            DeValue::Float(float) => format!("the number {float}"),
            DeValue::Boolean(value) => format!("{value}"),
            DeValue::Datetime(date) => format!("the date {date}"),
            DeValue::Array(items) => format!("an array of {}", items.len()),
            DeValue::Table(_) => "a table".to_owned(),
        }
    }

    /// The bytes of the file behind `part` of a text; the whole value where it is written with
    /// escapes, so that the two don't run in step.
    fn within(&self, text: &str, part: Range<usize>) -> Range<usize> {
        let written = self.document.text.get(self.at.span.clone()).unwrap_or_default();
        match written.find(text) {
            Some(offset) => {
                let start = self.at.span.start + offset;
                start + part.start..start + part.end
            }
            None => self.at.span.clone(),
        }
    }
}

/// A whole number of any size, rounded.
fn rounded(integer: &DeInteger<'_>) -> f64 {
    let text = integer.as_str();
    match i64::from_str_radix(text, integer.radix()) {
        Ok(value) => value as f64,
        Err(_) if integer.radix() == 10 => text.parse().unwrap_or(f64::NAN),
        Err(_) => {
            u128::from_str_radix(text, integer.radix()).map_or(f64::NAN, |value| value as f64)
        }
    }
}
