//! What a call of a function costs in f32 with libm and with micromath, as `cost` prints it.
//!
//! Each is called for 64 arguments; the load, the store and the loop that any of them needs are what the row
//! `negation` counts. libm takes sine, cosine and tangent in f64, so that the f64 helpers in this image are
//! libm's own.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use micromath::{F32, F32Ext};
use signorini_firmware::meter::{Meter, run};
use signorini_kernel::Error;

/// Arguments of a count.
const COUNT: usize = 64;

#[entry]
fn main() -> ! {
    run(|meter| {
        accurate(meter.kind("f32 libm"))?;
        fast(meter.kind("f32 micromath"))
    })
}

/// So many arguments in equal steps between two, both left out.
fn between(low: f32, high: f32) -> [f32; COUNT] {
    let step = (high - low) / COUNT as f32;
    let mut arguments = [low + 0.5 * step; COUNT];
    arguments.iter_mut().enumerate().for_each(|(at, x)| *x += at as f32 * step);
    arguments
}

/// Arguments by the function's domain.
struct Arguments {
    /// Of sine, cosine and tangent: a turn to either side.
    angles: [f32; COUNT],
    /// Of the inverse functions: inside (−1, 1).
    ratios: [f32; COUNT],
    /// Of roots, logarithms and powers: positive, both sides of 1.
    positive: [f32; COUNT],
    /// Of the exponential.
    exponents: [f32; COUNT],
}

impl Arguments {
    fn new() -> Self {
        black_box(Self {
            angles: between(-6.3, 6.3),
            ratios: between(-1.0, 1.0),
            positive: between(0.0, 4.0),
            exponents: between(-4.0, 4.0),
        })
    }
}

#[inline(never)]
fn accurate(meter: &mut Meter) -> Result<(), Error> {
    let given = Arguments::new();
    one(meter, "negation", &given.angles, |x| -x)?;
    one(meter, "sqrt", &given.positive, libm::sqrtf)?;
    one(meter, "sin", &given.angles, libm::sinf)?;
    one(meter, "cos", &given.angles, libm::cosf)?;
    one(meter, "tan", &given.angles, libm::tanf)?;
    one(meter, "asin", &given.ratios, libm::asinf)?;
    one(meter, "acos", &given.ratios, libm::acosf)?;
    one(meter, "atan", &given.angles, libm::atanf)?;
    two(meter, "atan2", &given.ratios, &given.angles, libm::atan2f)?;
    one(meter, "exp", &given.exponents, libm::expf)?;
    one(meter, "ln", &given.positive, libm::logf)?;
    two(meter, "powf", &given.positive, &given.exponents, libm::powf)
}

#[inline(never)]
fn fast(meter: &mut Meter) -> Result<(), Error> {
    let given = Arguments::new();
    one(meter, "negation", &given.angles, |x| -x)?;
    one(meter, "sqrt", &given.positive, |x| F32(x).sqrt().0)?;
    one(meter, "sin", &given.angles, |x| F32(x).sin().0)?;
    one(meter, "cos", &given.angles, |x| F32(x).cos().0)?;
    one(meter, "tan", &given.angles, |x| F32(x).tan().0)?;
    one(meter, "asin", &given.ratios, |x| F32(x).asin().0)?;
    one(meter, "acos", &given.ratios, F32Ext::acos)?;
    one(meter, "atan", &given.angles, |x| F32(x).atan().0)?;
    two(meter, "atan2", &given.ratios, &given.angles, |y, x| F32(y).atan2(F32(x)).0)?;
    one(meter, "exp", &given.exponents, |x| F32(x).exp().0)?;
    one(meter, "ln", &given.positive, |x| F32(x).ln().0)?;
    two(meter, "powf", &given.positive, &given.exponents, |x, n| F32(x).powf(F32(n)).0)
}

/// Counts a function of one argument. Arguments and values go through memory that the compiler knows nothing
/// of, one at a time.
fn one(
    meter: &mut Meter,
    name: &str,
    given: &[f32; COUNT],
    function: impl Fn(f32) -> f32,
) -> Result<(), Error> {
    meter.count(name, "call", COUNT, || {
        for x in black_box(given) {
            black_box(function(*x));
        }
        Ok(())
    })
}

/// Counts a function of two arguments.
fn two(
    meter: &mut Meter,
    name: &str,
    left: &[f32; COUNT],
    right: &[f32; COUNT],
    function: impl Fn(f32, f32) -> f32,
) -> Result<(), Error> {
    meter.count(name, "call", COUNT, || {
        for (x, y) in black_box(left).iter().zip(black_box(right)) {
            black_box(function(*x, *y));
        }
        Ok(())
    })
}
