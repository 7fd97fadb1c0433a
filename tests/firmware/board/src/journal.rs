//! Lines of a name and a number, bit for bit and without `core::fmt`: formatting would bring
//! kilobytes and panics into an image.
//!
//! ```text
//!   sweeps 2136          a count
//!   force f32 380725a1   the bits of a scalar
//!   u 4b6b0a7ec1d5f0a2   a digest of many scalars (FNV-1a over their bits)
//! ```

use signorini_kernel::Real;

/// A scalar whose bits can be told.
pub trait Bits: Real {
    /// What stands before its bits.
    const NAME: &'static str;
    /// Hexadecimal digits of its bits.
    const DIGITS: u32;
    /// Its bits.
    fn bits(self) -> u64;
}

impl Bits for f32 {
    const NAME: &'static str = " f32 ";
    const DIGITS: u32 = 8;
    fn bits(self) -> u64 {
        u64::from(self.to_bits())
    }
}

impl Bits for f64 {
    const NAME: &'static str = " f64 ";
    const DIGITS: u32 = 16;
    fn bits(self) -> u64 {
        self.to_bits()
    }
}

/// Where the lines go.
pub struct Journal<'a>(pub &'a mut dyn FnMut(&str));

impl Journal<'_> {
    /// A line of text.
    #[inline(never)]
    pub fn text(&mut self, text: &str) {
        self.0(text);
        self.0("\n");
    }

    /// A headline of two parts.
    pub fn title(&mut self, title: &str, more: &str) {
        self.0("# ");
        self.0(title);
        self.0(", ");
        self.text(more);
    }

    /// A count, in decimal digits.
    #[inline(never)]
    pub fn count(&mut self, name: &str, count: u32) {
        self.0(name);
        self.0(" ");
        self.decimal(count);
        self.0("\n");
    }

    /// Words, each followed by a blank, then counts.
    pub fn row(&mut self, words: &[&str], counts: &[u32]) {
        for word in words {
            self.0(word);
            self.0(" ");
        }
        for &count in counts {
            self.decimal(count);
            self.0(" ");
        }
        self.0("\n");
    }

    #[inline(never)]
    fn decimal(&mut self, count: u32) {
        let mut power = 1;
        while count / power > 9 {
            power *= 10;
        }
        while power > 0 {
            self.digit(u64::from(count / power % 10));
            power /= 10;
        }
    }

    /// The bits of a scalar.
    pub fn scalar<R: Bits>(&mut self, name: &str, x: R) {
        self.0(name);
        self.0(R::NAME);
        self.hexadecimal(x.bits(), R::DIGITS);
    }

    /// A count, and the bits of scalars: `5 3f800000 00000000`.
    pub fn record<R: Bits>(&mut self, count: u32, scalars: impl IntoIterator<Item = R>) {
        self.decimal(count);
        for scalar in scalars {
            self.0(" ");
            self.digits(scalar.bits(), R::DIGITS);
        }
        self.0("\n");
    }

    /// A digest of scalars.
    pub fn digest<R: Bits>(&mut self, name: &str, scalars: impl IntoIterator<Item = R>) {
        let mut hash = 0xcbf2_9ce4_8422_2325_u64;
        for scalar in scalars {
            for byte in scalar.bits().to_le_bytes() {
                hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
            }
        }
        self.0(name);
        self.0(" ");
        self.hexadecimal(hash, 16);
    }

    fn hexadecimal(&mut self, bits: u64, digits: u32) {
        self.digits(bits, digits);
        self.0("\n");
    }

    #[inline(never)]
    fn digits(&mut self, bits: u64, digits: u32) {
        for place in (0..digits).rev() {
            self.digit(bits >> (4 * place) & 15);
        }
    }

    fn digit(&mut self, digit: u64) {
        const DIGITS: &str = "0123456789abcdef";
        let at = digit as usize;
        self.0(DIGITS.get(at..at + 1).unwrap_or("?"));
    }
}
