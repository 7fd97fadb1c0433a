//! Structured values out of arbitrary bytes.
//!
//! Every read succeeds: behind the end there are zeros. A value takes its bytes from the front, so that a
//! fuzzer that changes one byte changes one value.

use signorini_bake::Bakes;
use signorini_tolerances::twins::AFTER_EXTREMES;

/// Bytes that have not been read yet.
#[derive(Debug, Clone)]
pub struct Bytes<'a> {
    rest: &'a [u8],
}

/// A choice that belongs to the bytes as a whole.
pub fn sum(data: &[u8]) -> u8 {
    data.iter().fold(0, |sum, &byte| sum.wrapping_add(byte))
}

/// A scalar that any bits are.
pub trait Bits: Bakes {
    /// The scalar with these bits, the low ones where it has fewer.
    fn of_bits(bits: u64) -> Self;
}

impl Bits for f64 {
    fn of_bits(bits: u64) -> Self {
        Self::from_bits(bits)
    }
}

impl Bits for f32 {
    fn of_bits(bits: u64) -> Self {
        Self::from_bits(bits as u32)
    }
}

impl<'a> Bytes<'a> {
    /// Begins with the first byte of `data`.
    pub fn new(data: &'a [u8]) -> Self {
        Self { rest: data }
    }

    /// The next byte.
    pub fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.rest.split_first() else { return 0 };
        self.rest = rest;
        first
    }

    /// The next eight, the first one lowest.
    pub fn bits(&mut self) -> u64 {
        u64::from_le_bytes([(); 8].map(|()| self.byte()))
    }

    /// A number of 0..bound; 0 where that is empty.
    pub fn below(&mut self, bound: usize) -> usize {
        usize::from(self.byte()) % bound.max(1)
    }

    /// True or false.
    pub fn flag(&mut self) -> bool {
        self.byte() & 1 == 1
    }

    /// The bytes that are left.
    pub fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// A scalar: mostly a tame one, some of any size, and some of any bits.
    pub fn real<R: Bits>(&mut self) -> R {
        let kind = self.byte();
        match kind {
            0..=159 => R::narrow(f64::from(self.byte() as i8) / 16.0),
            160..=215 => {
                let exponent = 8 * i32::from(self.byte() as i8);
                let mantissa = 1.0 + f64::from(kind & 7) / 8.0;
                let sign = if kind & 8 == 0 { 1.0 } else { -1.0 };
                R::narrow(sign * mantissa * 2f64.powi(exponent))
            }
            216..=239 => R::of_bits(self.bits()),
            _ => self.edge(kind),
        }
    }

    /// A scalar at an end of the range.
    fn edge<R: Bits>(&self, kind: u8) -> R {
        let largest = (R::ONE - R::EPSILON * R::HALF) / R::TINY * R::TWO * R::TWO;
        match kind & 7 {
            0 => R::narrow(f64::NAN),
            1 => R::narrow(f64::INFINITY),
            2 => R::narrow(f64::NEG_INFINITY),
            3 => largest,
            4 => -largest,
            5 => R::TINY,
            6 => R::of_bits(1),
            _ => -R::ZERO,
        }
    }

    /// So many of them.
    pub fn reals<R: Bits>(&mut self, count: usize) -> Vec<R> {
        (0..count).map(|_| self.real()).collect()
    }

    /// So many fixed groups of them.
    pub fn groups<R: Bits, const N: usize>(&mut self, count: usize) -> Vec<[R; N]> {
        (0..count).map(|_| [(); N].map(|()| self.real())).collect()
    }

    /// Spans of so many contact edges: mostly none, ∞ on every edge; else, by the last byte of all, some of any bits.
    pub fn spans<R: Bits>(&mut self, count: usize) -> Vec<R> {
        let span = |bytes: &mut Self| match bytes.below(6) {
            0 => R::INFINITY,
            1 => -R::INFINITY,
            2 => R::ZERO,
            _ => bytes.real(),
        };
        match self.rest.last() {
            Some(0xc0..) => (0..count).map(|_| span(self)).collect(),
            _ => Vec::new(),
        }
    }

    /// `reals`, of which a finite one only where `wild` is not set.
    pub fn given<R: Bits>(&mut self, count: usize, wild: bool) -> Vec<R> {
        let tame = |x: R| if wild || x.finite() { x } else { R::ONE };
        (0..count).map(|_| tame(self.real())).collect()
    }
}

/// The bits of numbers, which tell −0 from 0 and one NaN from another.
pub fn bits<R: Bakes>(numbers: &[R]) -> Vec<u64> {
    numbers.iter().map(|x| x.wide().to_bits()).collect()
}

/// Asserts that an answer after extreme ticks is that of a cold start.
pub fn check_settled<R: Bakes>(what: &str, found: &[R], cold: &[R]) {
    let size = cold.iter().fold(R::ONE, |most, x| most.or_larger(x.magnitude()));
    let off = found.iter().zip(cold);
    let off = off.fold(R::ZERO, |most, (&x, &cold)| most.or_larger((x - cold).magnitude()));
    AFTER_EXTREMES.check(what, off.wide() / size.wide() * f64::EPSILON / R::EPSILON.wide());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_of_the_range_are_what_they_are_called() {
        let bytes = Bytes::new(&[]);
        let of = |kind: u8| (bytes.edge::<f64>(kind), bytes.edge::<f32>(kind));
        assert!(of(0).0.is_nan() && of(0).1.is_nan());
        assert_eq!((of(1), of(2).0), ((f64::INFINITY, f32::INFINITY), f64::NEG_INFINITY));
        assert_eq!((of(3), of(4).0), ((f64::MAX, f32::MAX), f64::MIN));
        assert_eq!(of(5), (f64::MIN_POSITIVE, f32::MIN_POSITIVE));
        assert_eq!((of(6).0.to_bits(), of(6).1.to_bits()), (1, 1));
    }

    #[test]
    fn behind_the_end_there_are_zeros() {
        let mut bytes = Bytes::new(&[7, 0x10, 200]);
        assert_eq!(bytes.real::<f64>(), 1.0);
        assert_eq!((bytes.below(9), bytes.byte(), bytes.bits(), bytes.flag()), (2, 0, 0, false));
        assert_eq!(bytes.reals::<f32>(2), [0.0; 2]);
    }
}
