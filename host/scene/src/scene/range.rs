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

/// Reads the least and the largest value, finite numbers in the unit of the input.
pub(super) fn read_range(entry: &Entry) -> Result<Located<[f64; 2]>> {
    let [first, second] = entry.pair("the least and the largest value")?;
    let (lo, hi) = (first.number()?, second.number()?);
    if lo <= hi {
        return Ok(entry.at.with([lo, hi]));
    }
    let [lo, hi] = [lo, hi].map(shown);
    let error = entry.error(format_args!("from {lo} to {hi} there is no value"));
    Err(error.hint(format!("write the smaller number first: [{hi}, {lo}]")).into())
}

impl Input {
    /// The least and the largest value that it may have: all numbers where there is no range.
    pub fn interval(&self) -> [f64; 2] {
        self.range.as_ref().map_or([f64::NEG_INFINITY, f64::INFINITY], |range| range.value)
    }

    /// The least or the largest value that it may have; its default where there is no range.
    pub fn end(&self, is_largest: bool) -> f64 {
        self.range.as_ref().map_or(self.default, |range| range.value[usize::from(is_largest)])
    }

    /// Why the input may not have this value, in a sentence; nothing where it may.
    pub fn refusal(&self, value: f64) -> Option<String> {
        let [lo, hi] = self.range.as_ref()?.value;
        if lo <= value && value <= hi {
            return None;
        }
        let ([value, lo, hi], name) = ([value, lo, hi].map(shown), &self.name.value);
        Some(format!("{value} is outside the range of `{name}`, [{lo}, {hi}]"))
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
