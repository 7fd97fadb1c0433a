//! Shards: which of several processes measures which case of a campaign.
//!
//! Shard i of n takes the cases i − 1, i − 1 + n, i − 1 + 2n, … of the list, which is the same in every
//! process. Neighbours in the list cost about the same, so the shards do too.

use std::fmt;
use std::str::FromStr;

use signorini_scene::InputError;

/// One of `count` processes that share the cases of a campaign; written `i/n`, i counted from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    // 1 <= index <= count
    index: usize,
    count: usize,
}

impl Shard {
    /// All cases.
    pub const WHOLE: Self = Self { index: 1, count: 1 };

    /// Shard `index` of `count`; `None` unless 1 <= `index` <= `count`.
    pub fn new(index: usize, count: usize) -> Option<Self> {
        (1..=count).contains(&index).then_some(Self { index, count })
    }

    /// Whether there is no other.
    pub fn is_whole(self) -> bool {
        self.count == 1
    }

    /// How many processes there are.
    pub fn count(self) -> usize {
        self.count
    }

    /// Whether the case with this position in the list, counted from 0, belongs to this shard.
    pub fn takes(self, case: usize) -> bool {
        case % self.count == self.index - 1
    }

    /// `points.jsonl`, or `points-i-of-n.jsonl`.
    pub fn journal_name(self) -> String {
        match self {
            Self::WHOLE => "points.jsonl".to_owned(),
            Self { index, count } => format!("points-{index}-of-{count}.jsonl"),
        }
    }

    /// The shard whose journal has this name.
    pub fn of_journal(name: &str) -> Option<Self> {
        let numbers = name.strip_prefix("points")?.strip_suffix(".jsonl")?;
        let shard = match numbers.strip_prefix('-') {
            Some(numbers) => parse(numbers, "-of-")?,
            None => Self::WHOLE,
        };
        // `points-01-of-2.jsonl` is someone else's.
        (shard.journal_name() == name).then_some(shard)
    }
}

fn parse(text: &str, between: &str) -> Option<Shard> {
    let (index, count) = text.split_once(between)?;
    Shard::new(index.parse().ok()?, count.parse().ok()?)
}

impl FromStr for Shard {
    type Err = InputError;

    fn from_str(text: &str) -> Result<Self, InputError> {
        let expected = "--shard takes i/n with 1 <= i <= n, for example 2/4";
        parse(text, "/").ok_or_else(|| InputError::new(expected))
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn wrong_shards_are_told_what_is_expected() {
        for text in ["0/4", "5/4", "0/0", "1", "", "/", "1/", "-1/4", "1/2/3", "a/b", "1,5/2"] {
            let error = text.parse::<Shard>().expect_err(text);
            assert!(error.to_string().contains("for example 2/4"), "{text}: {error}");
        }
    }

    #[test]
    fn files_of_others_are_no_journals() {
        for name in
            ["points-old.jsonl", "points.json", "points-3-of-2.jsonl", "points-01-of-2.jsonl"]
        {
            assert_eq!(Shard::of_journal(name), None, "{name}");
        }
    }

    proptest! {
        #[test]
        fn every_case_has_exactly_one_shard(count in 1_usize..40, case: usize) {
            let shards = (1..=count).filter_map(|index| Shard::new(index, count));
            prop_assert_eq!(shards.filter(|shard| shard.takes(case)).count(), 1);
        }

        #[test]
        fn shards_differ_by_one_case_at_most(count in 1_usize..40, cases in 0_usize..400) {
            let shards = (1..=count).filter_map(|index| Shard::new(index, count));
            let loads = shards.map(|shard| (0..cases).filter(|&case| shard.takes(case)).count());
            let loads: Vec<usize> = loads.collect();
            prop_assert!(loads.iter().max().unwrap() - loads.iter().min().unwrap() <= 1);
        }

        #[test]
        fn a_shard_survives_its_text_and_its_file_name(count in 1_usize..999, index in 1_usize..999) {
            if let Some(shard) = Shard::new(index, count) {
                prop_assert_eq!(shard.to_string().parse::<Shard>().ok(), Some(shard));
                prop_assert_eq!(Shard::of_journal(&shard.journal_name()), Some(shard));
            }
        }
    }
}
