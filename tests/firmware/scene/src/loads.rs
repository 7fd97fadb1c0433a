//! The inputs of every tick, the same on every machine.
//!
//! Those of a log, if there is one; else they are drawn. The first tick has the defaults then. Of four others two are drawn evenly from the ranges and two are corners of them, one
//! after the other. An input without a range stays within a tenth of its default, or within ±0.1 where that is 0.

use signorini_board::draw::Draw;

use crate::scene::{INPUTS, Inputs, Scalar};

/// Ticks with drawn inputs that are played, the first included.
const DRAWN: usize = 101;

/// The log: for how many ticks inputs stay as they are, and the inputs; empty where there is none.
#[allow(clippy::needless_update, clippy::unnecessary_cast, reason = "whatever the log has")]
const LOG: &[(usize, Inputs)] = include!(concat!(env!("OUT_DIR"), "/log.rs"));

/// The inputs of all ticks that are played.
pub fn played() -> impl Iterator<Item = Inputs> {
    let logged = LOG.iter().flat_map(|&(ticks, inputs)| core::iter::repeat_n(inputs, ticks));
    logged.chain(loads().take(if LOG.is_empty() { DRAWN } else { 0 }))
}

/// A value of `tick` for an input.
fn value(tick: u32, part: Scalar, default: Scalar, [lo, hi]: [Scalar; 2]) -> Scalar {
    if !(lo.is_finite() && hi.is_finite()) {
        let unit = if default == 0.0 { 1.0 } else { default };
        return default + unit * (0.2 * part - 0.1);
    }
    match tick % 4 {
        0 | 1 => lo + (hi - lo) * part,
        _ if part < 0.5 => lo,
        _ => hi,
    }
}

/// The inputs, tick after tick, without an end.
pub fn loads() -> impl Iterator<Item = Inputs> {
    let mut draw = Draw::from_seed(0x5169_0e1d);
    (0..).map(move |tick| {
        if tick == 0 {
            return Inputs::DEFAULT;
        }
        let mut values: [Scalar; INPUTS] = Inputs::DEFAULT.to_array();
        for (value, range) in values.iter_mut().zip(Inputs::RANGES) {
            *value = self::value(tick, draw.part().into(), *value, range);
        }
        Inputs::from_array(values).clamped()
    })
}
