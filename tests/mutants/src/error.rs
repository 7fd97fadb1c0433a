//! Errors are sentences.

/// With an error that is a sentence.
pub type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// The error that says this.
pub fn failed(why: impl Into<String>) -> Box<dyn std::error::Error> {
    why.into().into()
}
