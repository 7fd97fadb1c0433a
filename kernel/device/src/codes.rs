//! What a controller says, as numbers and words: for callers in C, and for whatever else knows no Rust enum.
//!
//! ```text
//!   Error   ─► Refusal        why a call has no answer, and the number of the culprit
//!   Ended   ─► ended          what ended a tick
//!   Verdict ─► bounded        whether there is a bound, or why there is none
//! ```
//! Each number keeps its meaning; what is new gets a new one.

use core::ffi::CStr;

use signorini_kernel::Real;
use signorini_kernel::error::{Array, Error};
use signorini_kernel::report::Ended;
use signorini_kernel::verdict::Verdict;

/// An enum whose values have a number, a word in C's spelling, and a meaning.
macro_rules! codes {
    ($(#[$doc:meta])* $name:ident { $(#[doc = $meaning:literal] $variant:ident = $code:literal $word:literal,)+ }) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        #[repr(i32)]
        pub enum $name {
            $(#[doc = $meaning] $variant = $code,)+
        }

        impl $name {
            /// All of them, in the order of their numbers.
            pub const ALL: &'static [Self] = &[$(Self::$variant),+];

            /// Its word, such as `INPUT_OUT_OF_RANGE`.
            pub const fn word(self) -> &'static CStr {
                match self {
                    $(Self::$variant => $word,)+
                }
            }

            /// What it means, a sentence.
            pub const fn meaning(self) -> &'static str {
                match self {
                    $(Self::$variant => $meaning,)+
                }
            }

            /// The value of this number.
            pub fn of_code(code: i32) -> Option<Self> {
                Self::ALL.iter().copied().find(|value| *value as i32 == code)
            }
        }
    };
}

codes! {
    /// Why a call has no answer.
    Refusal {
        /// There is an answer.
        Ok = 0 c"OK",
        /// A pointer that must not be null is.
        NullPointer = 1 c"NULL_POINTER",
        /// The state was never initialised, or is another controller's: of another scene, scalar, model or version.
        ForeignState = 2 c"FOREIGN_STATE",
        /// The state has changed since it was sealed last.
        UnsealedState = 3 c"UNSEALED_STATE",
        /// The checksum does not fit the state: some of its bytes have changed.
        DamagedState = 4 c"DAMAGED_STATE",
        /// An input lies outside its range, or is not a number: the culprit is its number.
        InputOutOfRange = 5 c"INPUT_OUT_OF_RANGE",
        /// An input is infinite, not a number, or too large for the scalar: the culprit is its number.
        InputNotFinite = 6 c"INPUT_NOT_FINITE",
        /// Data, the answer or an output would overflow with these inputs.
        Overflow = 7 c"OVERFLOW",
        /// Inputs bring the limit of a contact edge's flux below its least value: the culprit is the edge's number.
        EmptyRange = 8 c"EMPTY_RANGE",
        /// Inputs make a transfer coefficient negative: the culprit is the edge's number.
        NegativeCoefficient = 9 c"NEGATIVE_COEFFICIENT",
        /// With these inputs there is no solution: the loads push a part away and nothing holds it.
        NoSolution = 10 c"NO_SOLUTION",
        /// With these inputs the solution is not unique: the loads on a part balance by themselves.
        NotUnique = 11 c"NOT_UNIQUE",
        /// With these inputs no edge can take the surplus of a part.
        NoWayOut = 12 c"NO_WAY_OUT",
        /// Data and code do not belong together; never of a library as it was baked.
        Inconsistent = 13 c"INCONSISTENT",
    }
}

codes! {
    /// What ended a tick: [`Ended`].
    EndedCode {
        /// The solution of the discrete problem, but for rounding.
        Exact = 0 c"EXACT",
        /// The certified error is small enough.
        Accurate = 1 c"ACCURATE",
        /// More sweeps would hardly change the answer.
        Settled = 2 c"SETTLED",
        /// The sweeps allowed are used up.
        OutOfSweeps = 3 c"OUT_OF_SWEEPS",
        /// The time is used up.
        OutOfTime = 4 c"OUT_OF_TIME",
        /// The answer overflows: do not use it.
        NotFinite = 5 c"NOT_FINITE",
    }
}

codes! {
    /// Whether there is a bound on the error, or why there is none: [`Verdict`].
    Bounded {
        /// There is a bound.
        Certified = 0 c"CERTIFIED",
        /// None: only contact edges can take the surplus of a part, and one would be pulled at.
        Pulled = 1 c"PULLED",
        /// None: contact alone holds the domain, and no edge is pressed hard enough.
        Unpressed = 2 c"UNPRESSED",
        /// None: a given value lies below the gap where they meet.
        BelowGap = 3 c"BELOW_GAP",
        /// None, whatever the inputs: the data do not allow for one.
        Unavailable = 4 c"UNAVAILABLE",
        /// None: the numbers overflow.
        BoundNotFinite = 5 c"BOUND_NOT_FINITE",
        /// None: the scene asks for none.
        NotAsked = 6 c"NOT_ASKED",
    }
}

/// The refusal of an error, and the number of its culprit, 0 where it has none.
///
/// ```
/// use signorini_device::codes::{Refusal, refusal};
/// use signorini_kernel::error::Error;
///
/// let (why, input) = refusal(&Error::InputOutOfRange { input: 1 });
/// assert_eq!((why, input), (Refusal::InputOutOfRange, 1));
/// assert_eq!((why as i32, why.word()), (5, c"INPUT_OUT_OF_RANGE"));
/// ```
pub fn refusal(error: &Error) -> (Refusal, usize) {
    match *error {
        Error::InputOutOfRange { input } => (Refusal::InputOutOfRange, input),
        Error::NotFinite { of: Array::Inputs, at } => (Refusal::InputNotFinite, at),
        Error::NotFinite { .. } => (Refusal::Overflow, 0),
        Error::EmptyRange { contact } => (Refusal::EmptyRange, contact),
        Error::NegativeRobin { edge } => (Refusal::NegativeCoefficient, edge),
        Error::NoSolution { .. } => (Refusal::NoSolution, 0),
        Error::NotUnique { .. } => (Refusal::NotUnique, 0),
        Error::NoWayOut { .. } => (Refusal::NoWayOut, 0),
        _ => (Refusal::Inconsistent, 0),
    }
}

/// What ended a tick.
pub fn ended(ended: Ended) -> EndedCode {
    match ended {
        Ended::Exact => EndedCode::Exact,
        Ended::Accurate => EndedCode::Accurate,
        Ended::Settled => EndedCode::Settled,
        Ended::OutOfSweeps => EndedCode::OutOfSweeps,
        Ended::OutOfTime => EndedCode::OutOfTime,
        Ended::NotFinite => EndedCode::NotFinite,
    }
}

/// Whether there is a bound.
pub fn bounded<R: Real>(verdict: &Verdict<R>) -> Bounded {
    match verdict {
        Verdict::Certified(_) => Bounded::Certified,
        Verdict::Pulled { .. } => Bounded::Pulled,
        Verdict::Unpressed => Bounded::Unpressed,
        Verdict::BelowGap => Bounded::BelowGap,
        Verdict::Unavailable => Bounded::Unavailable,
        Verdict::NotFinite => Bounded::BoundNotFinite,
        Verdict::NotAsked => Bounded::NotAsked,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_kernel::error::CellId;
    use signorini_kernel::verdict::Certificate;

    #[test]
    fn numbers_count_up_and_read_back() {
        for (at, refusal) in (0..).zip(Refusal::ALL) {
            assert_eq!((*refusal as i32, Refusal::of_code(at)), (at, Some(*refusal)));
        }
        for (at, ended) in (0..).zip(EndedCode::ALL) {
            assert_eq!((*ended as i32, EndedCode::of_code(at)), (at, Some(*ended)));
        }
        for (at, bounded) in (0..).zip(Bounded::ALL) {
            assert_eq!((*bounded as i32, Bounded::of_code(at)), (at, Some(*bounded)));
        }
        assert_eq!(Refusal::of_code(Refusal::ALL.len() as i32), None);
        assert_eq!(Refusal::of_code(-1), None);
    }

    #[test]
    fn words_and_meanings_differ() {
        for (at, one) in Refusal::ALL.iter().enumerate() {
            for other in Refusal::ALL.iter().take(at) {
                assert!(one.word() != other.word() && one.meaning() != other.meaning());
            }
        }
        assert_eq!(EndedCode::OutOfTime.word(), c"OUT_OF_TIME");
        assert_eq!(Bounded::BelowGap.word(), c"BELOW_GAP");
        assert_eq!(Refusal::Ok.meaning().trim(), "There is an answer.");
    }

    #[test]
    fn culprits_keep_their_numbers() {
        let input = Error::NotFinite { of: Array::Inputs, at: 3 };
        assert_eq!(refusal(&input), (Refusal::InputNotFinite, 3));
        let output = Error::NotFinite { of: Array::Outputs, at: 3 };
        assert_eq!(refusal(&output), (Refusal::Overflow, 0));
        for (error, expected) in [
            (Error::InputOutOfRange { input: 2 }, (Refusal::InputOutOfRange, 2)),
            (Error::EmptyRange { contact: 7 }, (Refusal::EmptyRange, 7)),
            (Error::NegativeRobin { edge: 9 }, (Refusal::NegativeCoefficient, 9)),
            (Error::NoSolution { cell: 1 }, (Refusal::NoSolution, 0)),
            (Error::NotUnique { cell: 1 }, (Refusal::NotUnique, 0)),
            (Error::NoWayOut { cell: 1 }, (Refusal::NoWayOut, 0)),
            (Error::Degenerate(CellId::Quad(1)), (Refusal::Inconsistent, 0)),
        ] {
            assert_eq!(refusal(&error), expected);
        }
    }

    #[test]
    fn reports_are_told_by_name() {
        for (of, code) in [
            (Ended::Exact, EndedCode::Exact),
            (Ended::Accurate, EndedCode::Accurate),
            (Ended::Settled, EndedCode::Settled),
            (Ended::OutOfSweeps, EndedCode::OutOfSweeps),
            (Ended::OutOfTime, EndedCode::OutOfTime),
            (Ended::NotFinite, EndedCode::NotFinite),
        ] {
            assert_eq!(ended(of), code);
        }
        for (of, code) in [
            (Verdict::Certified(Certificate::<f32>::default()), Bounded::Certified),
            (Verdict::Pulled { edge: 1 }, Bounded::Pulled),
            (Verdict::Unpressed, Bounded::Unpressed),
            (Verdict::BelowGap, Bounded::BelowGap),
            (Verdict::Unavailable, Bounded::Unavailable),
            (Verdict::NotFinite, Bounded::BoundNotFinite),
            (Verdict::NotAsked, Bounded::NotAsked),
        ] {
            assert_eq!(bounded(&of), code);
        }
    }
}
