//! Why a controller refuses a call, as a number and a word: for callers in C.

use signorini_kernel::error::{Array, Error};

signorini_kernel::codes! {
    /// Why a call has no answer.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
        /// Inputs bring the limit of a contact flux below its least value: the culprit is the number of the one that leaves least room.
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
        /// With these inputs two boundary edges that meet exclude each other's values of u: a gap and a Dirichlet value, or two
        /// gaps. The culprit is the number of their vertex among those where that can be.
        Excluded = 14 c"EXCLUDED",
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
/// assert_eq!(why.code(), 5);
/// ```
pub fn refusal(error: &Error) -> (Refusal, usize) {
    match *error {
        Error::InputOutOfRange { input } => (Refusal::InputOutOfRange, input),
        Error::NotFinite { of: Array::Inputs, at } => (Refusal::InputNotFinite, at),
        Error::NotFinite { .. } => (Refusal::Overflow, 0),
        Error::EmptyRange { input } => (Refusal::EmptyRange, input),
        Error::NegativeRobin { edge } => (Refusal::NegativeCoefficient, edge),
        Error::Excluded { at } => (Refusal::Excluded, at),
        Error::ForeignState => (Refusal::ForeignState, 0),
        Error::DamagedState => (Refusal::DamagedState, 0),
        Error::NoSolution { .. } => (Refusal::NoSolution, 0),
        Error::NotUnique { .. } => (Refusal::NotUnique, 0),
        Error::NoWayOut { .. } => (Refusal::NoWayOut, 0),
        _ => (Refusal::Inconsistent, 0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_kernel::codes::{Code, word};
    use signorini_kernel::error::CellId;
    use signorini_kernel::report::Ended;
    use signorini_kernel::verdict::{Certificate, Verdict};

    #[test]
    fn numbers_count_up_and_read_back() {
        for codes in [Refusal::CODES, Ended::CODES, Verdict::<f32>::CODES] {
            for (at, code) in (0..).zip(codes) {
                assert_eq!((code.number, word(codes, at)), (at, Some(code.word)));
            }
        }
        assert_eq!(word(Refusal::CODES, Refusal::CODES.len() as i32), None);
        assert_eq!(word(Refusal::CODES, -1), None);
    }

    #[test]
    fn words_and_meanings_differ() {
        let all = || Refusal::CODES.iter().map(|code| code.word).zip(Refusal::MEANINGS);
        for (at, (word, meaning)) in all().enumerate() {
            assert!(all().take(at).all(|(other, meant)| other != word && meant != meaning));
        }
        assert_eq!(all().count(), Refusal::CODES.len());
        let known = |codes: &'static [Code], code| word(codes, code);
        assert_eq!(known(Ended::CODES, Ended::OutOfTime.code()), Some(c"OUT_OF_TIME"));
        let below = Verdict::<f32>::BelowGap.code();
        assert_eq!(known(Verdict::<f32>::CODES, below), Some(c"BELOW_GAP"));
        let first = Refusal::MEANINGS.first().map(|meaning| meaning.trim());
        assert_eq!(first, Some("There is an answer."));
    }

    #[test]
    fn culprits_keep_their_numbers() {
        let input = Error::NotFinite { of: Array::Inputs, at: 3 };
        assert_eq!(refusal(&input), (Refusal::InputNotFinite, 3));
        let output = Error::NotFinite { of: Array::Outputs, at: 3 };
        assert_eq!(refusal(&output), (Refusal::Overflow, 0));
        for (error, expected) in [
            (Error::InputOutOfRange { input: 2 }, (Refusal::InputOutOfRange, 2)),
            (Error::EmptyRange { input: 7 }, (Refusal::EmptyRange, 7)),
            (Error::Excluded { at: 3 }, (Refusal::Excluded, 3)),
            (Error::NegativeRobin { edge: 9 }, (Refusal::NegativeCoefficient, 9)),
            (Error::ForeignState, (Refusal::ForeignState, 0)),
            (Error::DamagedState, (Refusal::DamagedState, 0)),
            (Error::NoSolution { cell: 1 }, (Refusal::NoSolution, 0)),
            (Error::NotUnique { cell: 1 }, (Refusal::NotUnique, 0)),
            (Error::NoWayOut { cell: 1 }, (Refusal::NoWayOut, 0)),
            (Error::Degenerate(CellId::Quad(1)), (Refusal::Inconsistent, 0)),
        ] {
            assert_eq!(refusal(&error), expected);
        }
    }

    #[test]
    fn values_have_the_numbers_of_their_words() {
        for (at, ended) in (0..).zip([
            Ended::Exact,
            Ended::Accurate,
            Ended::Settled,
            Ended::OutOfSweeps,
            Ended::OutOfTime,
            Ended::NotFinite,
        ]) {
            assert_eq!(ended.code(), at);
        }
        for (at, verdict) in (0..).zip([
            Verdict::Certified(Certificate::<f32>::default()),
            Verdict::Pulled { edge: 1 },
            Verdict::Unpressed,
            Verdict::BelowGap,
            Verdict::Unavailable,
            Verdict::NotFinite,
            Verdict::NotAsked,
        ]) {
            assert_eq!(verdict.code(), at);
        }
    }
}
