//! The values that an input may take: all from `lo` to `hi`.
//!
//! ```toml
//! [input.air]
//! range = [-20.0, 5.0]
//! ```
//! Whatever is worked out for a controller beforehand holds for the whole box of these ranges, and for nothing else. So
//! a value outside is refused wherever it comes from: the scene, the command line, a log, a device's tick.

use super::entry::Entry;
use super::{Input, Located};
use crate::error::Result;

/// A closed interval of finite numbers, in the unit of its input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InputRange {
    /// The least value.
    pub lo: f64,
    /// The largest value, not below `lo`.
    pub hi: f64,
}

impl InputRange {
    /// Whether it holds `value`. NaN is in no range.
    pub fn contains(&self, value: f64) -> bool {
        self.lo <= value && value <= self.hi
    }

    pub(super) fn read(entry: &Entry) -> Result<Located<Self>> {
        let [first, second] = entry.pair("the least and the largest value")?;
        let (lo, hi) = (first.number()?, second.number()?);
        if lo <= hi {
            return Ok(entry.at.with(Self { lo, hi }));
        }
        let [lo, hi] = [lo, hi].map(shown);
        let message = format!("from {lo} to {hi} there is no value");
        Err(entry
            .error(message)
            .hint(format!("write the smaller number first: [{hi}, {lo}]"))
            .into())
    }
}

impl Input {
    /// The least and the largest value that it may have: all numbers where there is no range.
    pub fn interval(&self) -> [f64; 2] {
        let range = self.range.as_ref().map(|range| [range.value.lo, range.value.hi]);
        range.unwrap_or([f64::NEG_INFINITY, f64::INFINITY])
    }

    /// Why the input may not have this value, in a sentence; nothing where it may.
    pub fn refusal(&self, value: f64) -> Option<String> {
        let range = self.range.as_ref()?.value;
        let InputRange { lo, hi } = range;
        let [value_shown, lo, hi] = [value, lo, hi].map(shown);
        let name = &self.name.value;
        let message = || format!("{value_shown} is outside the range of `{name}`, [{lo}, {hi}]");
        (!range.contains(value)).then(message)
    }
}

/// Numbers far from 1 with their power of ten, not with hundreds of zeros.
fn shown(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-5..1e16).contains(&size) && size.is_finite() {
        format!("{value:e}")
    } else {
        value.to_string()
    }
}
