//! The functions that a device takes from a library.

/// A function that micromath has; sinh, cosh and tanh are made of its exp.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Elementary {
    /// √a
    Sqrt,
    /// sin a
    Sin,
    /// cos a
    Cos,
    /// tan a
    Tan,
    /// arcsin a
    Asin,
    /// arccos a
    Acos,
    /// arctan a
    Atan,
    /// The angle of the point (b, a).
    Atan2,
    /// eᵃ
    Exp,
    /// ln a
    Ln,
    /// aᵇ
    Power,
}

impl Elementary {
    /// Every function.
    pub const ALL: [Self; 11] = [
        Self::Sqrt,
        Self::Sin,
        Self::Cos,
        Self::Tan,
        Self::Asin,
        Self::Acos,
        Self::Atan,
        Self::Atan2,
        Self::Exp,
        Self::Ln,
        Self::Power,
    ];

    /// Its name in libm and micromath.
    pub fn name(self) -> &'static str {
        const NAMES: [&str; 11] =
            ["sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "ln", "powf"];
        NAMES[self as usize]
    }
}
