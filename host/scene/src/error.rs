//! Failures of the host, with the exit status each kind ends in.
//!
//! Wrong input is one message: `FILE:LINE: CULPRIT: what was found, what was expected`, a hint, and
//! where the text is at hand the place underlined. Everything else is an I/O failure.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use miette::{Diagnostic, NamedSource, SourceSpan};
use thiserror::Error;

/// Any failure of the host.
#[derive(Debug, Error, Diagnostic)]
pub enum Error {
    /// The scene, the mesh or the command line is wrong: exit status 2.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Input(Box<InputError>),
    /// A file could not be written: exit status 1. (A file that cannot be read is wrong input.)
    #[error("{}: {cause}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The system's message.
        cause: std::io::Error,
    },
    /// A check of the main job failed: exit status 1.
    #[error("{0}")]
    Check(String),
}

/// Shorthand for results of the host.
pub type Result<T> = std::result::Result<T, Error>;

/// Wrong input: the culprit, what was expected, a hint.
#[derive(Debug, Default, Error, Diagnostic)]
pub struct InputError {
    file: Option<PathBuf>,
    line: Option<usize>,
    message: String,
    #[help]
    hint: Option<String>,
    #[source_code]
    text: Option<NamedSource<Arc<str>>>,
    #[label]
    underlined: Option<SourceSpan>,
    /// The time of a scene at which it is wrong.
    time: Option<f64>,
    /// Why the kernel refuses it.
    cause: Option<signorini_kernel::Error>,
    /// What else is wrong with the same input.
    #[related]
    others: Vec<InputError>,
}

/// Lines beyond this many bytes are not shown: they would bury the message.
const LONGEST_EXCERPT: usize = 400;

impl InputError {
    /// `message` names the culprit (`boundary.river.value`, `triangle 12`) and what was expected.
    pub fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), ..Self::default() }
    }

    /// The message, without its place.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// The file it stands in and the line, where they are known.
    pub fn place(&self) -> (Option<&Path>, Option<usize>) {
        (self.file.as_deref(), self.line)
    }

    /// The hint.
    pub fn said_hint(&self) -> Option<&str> {
        self.hint.as_deref()
    }

    /// The key that it is about, `boundary.river.value`, where its message begins with one.
    pub fn key(&self) -> Option<&str> {
        let (key, _) = self.message.split_once(": ")?;
        let is_key = !key.is_empty()
            && key.chars().all(|letter| letter.is_alphanumeric() || "._-\"".contains(letter))
            || key.contains('.') && key.contains('"');
        is_key.then_some(key)
    }

    /// Whether it underlines exactly these bytes.
    pub(crate) fn underlines(&self, bytes: &std::ops::Range<usize>) -> bool {
        self.underlined.is_some_and(|own| (own.offset(), own.len()) == (bytes.start, bytes.len()))
    }

    /// Adds what else is wrong with the same input.
    #[must_use]
    pub fn with_others(mut self, others: Vec<Self>) -> Self {
        self.others.extend(others);
        self
    }

    /// What else is wrong with the same input.
    pub fn others(&self) -> &[Self] {
        &self.others
    }

    /// This fault and all others, each on its own.
    pub fn each(mut self) -> Vec<Self> {
        let others = std::mem::take(&mut self.others);
        std::iter::once(self).chain(others).collect()
    }

    /// Adds what to do about it.
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    /// Adds the file it stands in.
    pub fn file(mut self, file: &Path) -> Self {
        self.file = Some(file.to_owned());
        self
    }

    /// Adds the line, counted from 1.
    pub fn line(mut self, line: usize) -> Self {
        self.line = Some(line);
        self
    }

    /// Lays it on another line instead, of a file that is not shown.
    #[must_use]
    pub fn moved(self, file: &Path, line: usize) -> Self {
        Self { file: Some(file.to_owned()), line: Some(line), text: None, underlined: None, ..self }
    }

    /// Adds why the kernel refuses it.
    pub fn because(mut self, cause: signorini_kernel::Error) -> Self {
        self.cause = Some(cause);
        self
    }

    /// The time of a scene at which it is wrong, if it is so at some times alone.
    pub fn time(&self) -> Option<f64> {
        self.time
    }

    fn set_time(&mut self, time: f64) {
        self.message = format!("{} (at t = {time})", self.message);
        self.time = Some(time);
    }

    /// Adds the text and the byte range to underline; the line number follows from it.
    pub fn excerpt(mut self, text: &Arc<str>, span: std::ops::Range<usize>) -> Self {
        let start = text.floor_char_boundary(span.start);
        self.line = Some(line_of(text.as_bytes(), start));
        let end = text[start..].find('\n').map_or(text.len(), |length| start + length);
        let begin = text[..start].rfind('\n').map_or(0, |newline| newline + 1);
        if end - begin > LONGEST_EXCERPT {
            return self;
        }
        let name = self.file.as_deref().unwrap_or(Path::new("input")).display().to_string();
        self.text = Some(NamedSource::new(name, text.clone()));
        self.underlined = Some(span.into());
        self
    }
}

/// The line, counted from 1, in which a byte of a text stands.
pub fn line_of(text: &[u8], at: usize) -> usize {
    text.iter().take(at).filter(|&&byte| byte == b'\n').count() + 1
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{}:", file.display())?;
            if let Some(line) = self.line {
                write!(f, "{line}:")?;
            }
            write!(f, " ")?;
        }
        f.write_str(&self.message)
    }
}

impl From<InputError> for Error {
    fn from(error: InputError) -> Self {
        Self::Input(Box::new(error))
    }
}

/// Prints errors with their excerpt; on a terminal to its width, elsewhere without breaking lines, so
/// that a script finds file, line and key in one piece.
pub fn install_handler() {
    let on_terminal = std::io::IsTerminal::is_terminal(&std::io::stderr());
    // Fails only where a handler is installed already.
    let _ = miette::set_hook(Box::new(move |_| {
        let options = miette::MietteHandlerOpts::new().terminal_links(false).break_words(false);
        let options = if on_terminal { options } else { options.wrap_lines(false) };
        Box::new(options.build())
    }));
}

impl Error {
    fn input(&self) -> Option<&InputError> {
        match self {
            Self::Input(error) => Some(error),
            Self::Io { .. } | Self::Check(_) => None,
        }
    }

    /// The message, without the file that it stands in.
    pub fn reason(&self) -> String {
        self.input().map_or_else(|| self.to_string(), |error| error.message.clone())
    }

    /// Why the kernel refuses the input, where it is the kernel that does.
    pub fn cause(&self) -> Option<signorini_kernel::Error> {
        self.input()?.cause
    }

    /// Wraps an I/O failure with the file it concerns.
    pub fn io(path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_owned();
        move |cause| Self::Io { path, cause }
    }

    /// Adds at which time of a scene the input is wrong.
    pub fn at_time(mut self, time: f64) -> Self {
        if let Self::Input(error) = &mut self {
            error.set_time(time);
            error.others.iter_mut().for_each(|other| other.set_time(time));
        }
        self
    }

    /// All faults of wrong input, each on its own; any other failure alone.
    pub fn each(self) -> Vec<Self> {
        match self {
            Self::Input(fault) => fault.each().into_iter().map(Self::from).collect(),
            other @ (Self::Io { .. } | Self::Check(_)) => vec![other],
        }
    }

    /// The exit status that this failure ends in.
    pub fn exit_status(&self) -> u8 {
        if self.input().is_some() { 2 } else { 1 }
    }
}
