//! A place in the file, and how numbers are read from there in each encoding.
//!
//! The file is a sequence of sections `$Name` … `$EndName`; these markers and `$PhysicalNames` are
//! text in every encoding. Inside, a record is a line of numbers in ASCII and the bare numbers in
//! binary. A number never continues on the next line: a record with one missing is found on its
//! own line.

use crate::error::{InputError, line_of};
use crate::mesh::assemble::draft::Parsed;

/// How the numbers inside a section are written.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// Moves forward through the bytes of a file; never past their end.
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
    pub(super) encoding: Encoding,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, encoding: Encoding::Ascii }
    }

    /// The byte offset; files are below 2 GiB.
    pub(super) fn at(&self) -> u32 {
        self.at as u32
    }

    /// Bytes of the whole file.
    pub(super) fn length(&self) -> usize {
        self.bytes.len()
    }

    fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    /// An error at a byte offset: the line of a text, the offset in a binary file.
    pub(super) fn error(&self, at: u32, message: impl Into<String>) -> InputError {
        match self.encoding {
            Encoding::Ascii => InputError::new(message).line(line_of(self.bytes, at as usize)),
            _ => InputError::new(format!("byte {at}: {}", message.into())),
        }
    }

    fn expected(&self, at: u32, what: &str, found: &[u8]) -> Box<InputError> {
        let found = excerpt(found);
        Box::new(self.error(at, format!("expected {what}, found {found}")))
    }

    /// Goes on to the next byte that is not blank, over any number of lines.
    pub(super) fn skip_blank_lines(&mut self) {
        let blanks = self.rest().iter().take_while(|byte| byte.is_ascii_whitespace()).count();
        self.at += blanks;
    }

    /// The rest of the line without blanks around it; the line is text in every encoding.
    pub(super) fn line(&mut self) -> &'a [u8] {
        let rest = self.rest();
        let length = rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
        self.at += (length + 1).min(rest.len());
        rest[..length].trim_ascii()
    }

    /// Begins a record.
    pub(super) fn begin(&mut self) {
        if self.encoding == Encoding::Ascii {
            self.skip_blank_lines();
        }
    }

    /// Ends a record: in ASCII the line must be over.
    pub(super) fn end(&mut self) -> Parsed<()> {
        if self.encoding != Encoding::Ascii {
            return Ok(());
        }
        let at = self.at();
        match self.line() {
            b"" => Ok(()),
            found => Err(self.expected(at, "the end of the line", found)),
        }
    }

    /// The next word of the line, empty at its end.
    fn word(&mut self) -> &'a [u8] {
        let rest = self.rest();
        let blank = |byte: &&u8| byte.is_ascii_whitespace() && **byte != b'\n';
        let start = rest.iter().take_while(blank).count();
        let length = rest[start..].iter().take_while(|byte| !byte.is_ascii_whitespace()).count();
        self.at += start + length;
        &rest[start..start + length]
    }

    fn parse<T: std::str::FromStr>(&mut self, what: &str) -> Parsed<T> {
        let word = self.word();
        let number = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        let at = (self.at - word.len()) as u32;
        number.ok_or_else(|| match word.iter().all(u8::is_ascii_digit) && !word.is_empty() {
            true => Box::new(self.error(at, format!("{what} is too large: {}", excerpt(word)))),
            false => self.expected(at, what, word),
        })
    }

    /// A word in ASCII, else N bytes, of which `number` takes the lowest first.
    fn number<T: std::str::FromStr, const N: usize>(
        &mut self,
        what: &str,
        number: fn([u8; N]) -> T,
    ) -> Parsed<T> {
        if self.encoding == Encoding::Ascii {
            return self.parse(what);
        }
        let Some(mut bytes) = self.rest().first_chunk().copied() else {
            return Err(self.expected(self.at(), what, b""));
        };
        self.at += N;
        if self.encoding == Encoding::BigEndian {
            bytes.reverse();
        }
        Ok(number(bytes))
    }

    /// A signed number, 32 bits in binary.
    pub(super) fn int(&mut self, what: &str) -> Parsed<i32> {
        self.number(what, i32::from_le_bytes)
    }

    /// A number that is not negative, 32 bits in binary and up to 64 in ASCII.
    pub(super) fn natural(&mut self, what: &str) -> Parsed<u64> {
        if self.encoding == Encoding::Ascii {
            return self.parse(what);
        }
        let at = self.at();
        let number = self.int(what)?;
        u64::try_from(number).map_err(|_| self.expected(at, what, number.to_string().as_bytes()))
    }

    /// A number that is not negative, 64 bits in binary.
    pub(super) fn size(&mut self, what: &str) -> Parsed<u64> {
        self.number(what, u64::from_le_bytes)
    }

    /// A floating-point number, perhaps not finite.
    pub(super) fn float(&mut self, what: &str) -> Parsed<f64> {
        self.number(what, f64::from_le_bytes)
    }

    /// A count of records with at least so many numbers each.
    pub(super) fn count(&mut self, what: &str, numbers: usize) -> Parsed<usize> {
        let at = self.at();
        let count = self.size(what)?;
        self.bounded(at, count, what, numbers)
    }

    /// Such a count on a line of its own, text in every encoding.
    pub(super) fn count_line(&mut self, what: &str, numbers: usize) -> Parsed<usize> {
        self.begin();
        let at = self.at();
        let count = self.parse(what)?;
        match self.line() {
            b"" => self.bounded(at, count, what, numbers),
            found => Err(self.expected(at, "the end of the line", found)),
        }
    }

    /// Refuses a count beyond what the rest of the file can hold, so that memory reserved for it
    /// stays bounded by the file. A number takes a digit and a blank, or 4 bytes.
    fn bounded(&self, at: u32, count: u64, what: &str, numbers: usize) -> Parsed<usize> {
        let width = if self.encoding == Encoding::Ascii { 2 } else { 4 };
        let room = self.rest().len() / (numbers * width);
        match usize::try_from(count) {
            Ok(count) if count <= room => Ok(count),
            _ => {
                let message = format!("{what}: {count} are announced, {room} at most can follow");
                Err(self.error(at, message).hint("the file is cut off or damaged").into())
            }
        }
    }

    /// Opens the next section: its offset and its name without `$`; none at the end of the file.
    pub(super) fn open_section(&mut self) -> Parsed<Option<(u32, &'a [u8])>> {
        self.skip_blank_lines();
        let at = self.at();
        match self.line() {
            b"" => Ok(None),
            [b'$', name @ ..] if !name.starts_with(b"End") => Ok(Some((at, name))),
            found => Err(self.expected(at, "the beginning of a section, like `$Nodes`", found)),
        }
    }

    /// Closes a section that was read.
    pub(super) fn close_section(&mut self, name: &[u8]) -> Parsed<()> {
        self.skip_blank_lines();
        let at = self.at();
        match self.line() {
            [b'$', b'E', b'n', b'd', closed @ ..] if closed == name => Ok(()),
            found => {
                let marker = format!("`$End{}`", String::from_utf8_lossy(name));
                Err(self.expected(at, &marker, found))
            }
        }
    }

    /// Passes over a section that is of no interest, up to the line that closes it.
    pub(super) fn skip_section(&mut self, opened: u32, name: &[u8]) -> Parsed<()> {
        while !self.rest().is_empty() {
            if self.line().strip_prefix(b"$End") == Some(name) {
                return Ok(());
            }
        }
        let message = format!("the section {} is never closed", excerpt(name));
        Err(self.error(opened, message).hint("the file is cut off or damaged").into())
    }
}

/// A piece of the file that is safe to show.
fn excerpt(found: &[u8]) -> String {
    match found {
        b"" => "nothing".into(),
        [start @ .., _] if start.len() >= 40 => {
            format!("`{}…`", found[..40].escape_ascii())
        }
        _ => match std::str::from_utf8(found) {
            Ok(text) => format!("`{text}`"),
            Err(_) => format!("`{}`", found.escape_ascii()),
        },
    }
}
