//! Enums whose values have a number, a word in C's spelling, and a meaning: for callers in C, and for others that know no Rust
//! enum.
//!
//! ```text
//!   codes::Refusal (device)     why a call has no answer
//!   report::Ended              what ended a tick
//!   verdict::Verdict           whether there is a bound, or why there is none
//! ```
//! Each number keeps its meaning; a new value gets a new one.

use core::ffi::CStr;

/// A value of such an enum, apart from what it holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Code {
    /// Its number.
    pub number: i32,
    /// Its word, such as `INPUT_OUT_OF_RANGE`.
    pub word: &'static CStr,
}

/// The word of the code with this number.
///
/// ```
/// use signorini_kernel::codes::word;
/// use signorini_kernel::report::Ended;
///
/// assert_eq!(word(Ended::CODES, Ended::OutOfTime.code()), Some(c"OUT_OF_TIME"));
/// assert_eq!(word(Ended::CODES, -1), None);
/// ```
pub fn word(codes: &[Code], number: i32) -> Option<&'static CStr> {
    codes.iter().find(|code| code.number == number).map(|code| code.word)
}

/// Defines an enum with its codes; of the comment of a value the first line is its meaning.
#[doc(hidden)]
#[macro_export]
macro_rules! codes {
    ($(#[$about:meta])* $name:ident $(<$scalar:ident>)? {
        $(#[doc = $meaning:literal] $(#[doc = $more:literal])*
        $variant:ident $(($($held:tt)+))? $({ $($fields:tt)+ })? = $number:literal $word:literal,)+
    }) => {
        $(#[$about])*
        pub enum $name $(<$scalar>)? {
            $(#[doc = $meaning] $(#[doc = $more])* $variant $(($($held)+))? $({ $($fields)+ })?,)+
        }

        impl $(<$scalar>)? $name $(<$scalar>)? {
            /// Every code, in the order of the numbers.
            pub const CODES: &'static [$crate::codes::Code] = &[
                $($crate::codes::Code { number: $number, word: $word },)+
            ];

            /// What each of them means, a sentence: apart from the words, so that firmware holds none of it.
            pub const MEANINGS: &'static [&'static str] = &[$($meaning,)+];

            /// The number of this value.
            pub const fn code(&self) -> i32 {
                match self {
                    $(Self::$variant { .. } => $number,)+
                }
            }
        }
    };
}
