//! A mutant as cargo-mutants lists it.

use serde::Deserialize;

/// Where something stands; lines and columns count from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
pub struct SourcePosition {
    pub line: usize,
    pub column: usize,
}

/// From one place to before another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
pub struct Span {
    pub start: SourcePosition,
    pub end: SourcePosition,
}

/// One change of one place.
#[derive(Debug, Clone, Deserialize)]
pub struct Mutant {
    pub file: String,
    pub span: Span,
    pub replacement: String,
    pub genre: String,
    pub name: String,
    /// Its number in the list, from 1.
    #[serde(skip)]
    pub id: u32,
}

impl Mutant {
    /// The mutants of a list in JSON.
    pub fn list(json: &str) -> Result<Vec<Self>, serde_json::Error> {
        let mut all: Vec<Self> = serde_json::from_str(json)?;
        all.iter_mut().zip(1..).for_each(|(mutant, id)| mutant.id = id);
        Ok(all)
    }
}
