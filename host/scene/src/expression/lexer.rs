//! Cuts a text into numbers, names and symbols.
//!
//! Numbers are `1`, `.5`, `1.`, `1e-3`; an `e` without digits after it begins a name.

use std::ops::Range;

use super::ParseError;

/// The kind of a token.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind {
    Number(f64),
    Name,
    /// One of `+ - * / ^ ( ) ,`.
    Symbol(char),
    End,
}

/// A token and the bytes it stands in.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Token {
    pub kind: Kind,
    pub span: Range<usize>,
}

/// The text and how far it has been read.
pub(super) struct Lexer<'a> {
    text: &'a str,
    position: usize,
}

impl<'a> Lexer<'a> {
    pub fn new(text: &'a str) -> Self {
        Self { text, position: 0 }
    }

    /// The next token; [`Kind::End`] at and after the end.
    pub fn next(&mut self) -> Result<Token, ParseError> {
        let rest = &self.text[self.position..];
        let start = self.text.len() - rest.trim_start().len();
        let rest = &self.text[start..];
        let (kind, length) = match rest.chars().next() {
            None => (Kind::End, 0),
            Some('0'..='9' | '.') => number(rest, start)?,
            Some(letter) if letter.is_ascii_alphabetic() => (Kind::Name, name_length(rest)),
            Some(symbol) if "+-*/^(),".contains(symbol) => (Kind::Symbol(symbol), 1),
            Some(other) => return Err(foreign(other, start)),
        };
        self.position = start + length;
        Ok(Token { kind, span: start..self.position })
    }
}

/// The number at the beginning of `rest`, which stands at byte `start`, and its length.
fn number(rest: &str, start: usize) -> Result<(Kind, usize), ParseError> {
    let whole = digits(rest);
    let fraction = rest[whole..].strip_prefix('.').map(digits);
    let mantissa = whole + fraction.map_or(0, |count| 1 + count);
    let length = mantissa + exponent(&rest[mantissa..]);
    let error = |message: String, hint: Option<String>| {
        Err(ParseError { message, span: start..start + length, hint })
    };
    match rest[..length].parse::<f64>() {
        Ok(value) if value.is_finite() => Ok((Kind::Number(value), length)),
        Ok(_) => error(
            format!("`{}` is beyond the largest number", &rest[..length]),
            Some(format!("the largest is {:e}", f64::MAX)),
        ),
        Err(_) => error("`.` without digits is no number".to_owned(), None),
    }
}

/// The length of an exponent such as `e-3` at the beginning of `rest`, 0 without digits.
fn exponent(rest: &str) -> usize {
    let Some(after) = rest.strip_prefix(['e', 'E']) else { return 0 };
    let unsigned = after.strip_prefix(['+', '-']).unwrap_or(after);
    match digits(unsigned) {
        0 => 0,
        count => rest.len() - unsigned.len() + count,
    }
}

fn digits(rest: &str) -> usize {
    rest.bytes().take_while(u8::is_ascii_digit).count()
}

fn name_length(rest: &str) -> usize {
    rest.bytes().take_while(|byte| byte.is_ascii_alphanumeric() || *byte == b'_').count()
}

/// A character that no expression holds, with its plain spelling where it has one.
fn foreign(character: char, start: usize) -> ParseError {
    let plain = match character {
        '×' | '·' | '⋅' => Some("*"),
        '÷' => Some("/"),
        '−' | '–' => Some("-"),
        '²' => Some("^2"),
        '³' => Some("^3"),
        'π' => Some("pi"),
        '[' | '{' => Some("("),
        ']' | '}' => Some(")"),
        _ => None,
    };
    let is_unit = "°%‰µμΩ℃€$".contains(character);
    let number = is_unit.then(|| {
        "numbers have no units here: write the number alone, in units that go together".to_owned()
    });
    ParseError {
        message: format!("unexpected character `{}`", character.escape_debug()),
        span: start..start + character.len_utf8(),
        hint: plain.map(|plain| format!("write `{plain}`")).or(number),
    }
}
