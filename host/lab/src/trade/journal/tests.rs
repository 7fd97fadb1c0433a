//! Interruptions at every byte, shards, fingerprints, numbers to the bit.

use proptest::prelude::*;
use tempfile::{TempDir, tempdir};

use super::*;
use crate::trade::record::{Point, PointError};
use crate::trade::tests as fixtures;
use signorini_scene::Setting;
use signorini_scene::setting::Omega;

const OF: &str = "levee, its mesh";

fn folder() -> TempDir {
    tempdir().unwrap()
}

fn open(folder: &TempDir, shard: &str) -> Journal {
    Journal::open(folder.path(), shard.parse().unwrap(), OF).unwrap()
}

fn point(value: f64) -> Point {
    Point {
        name: "quads \"1\"\nf32 · ω".to_owned(),
        error: PointError { energy: value, combined: None, l2: -value, ..PointError::default() },
        bound: Some(value),
        cycles: value,
        instructions: Some(u64::MAX),
        setting: Setting { omega: Omega::Fixed(value), ..Setting::default() },
        ..fixtures::point(7)
    }
}

#[test]
fn an_interruption_anywhere_costs_the_line_it_cut_and_no_other() {
    let whole = folder();
    let mut journal = open(&whole, "1/1");
    (0..3_u32).for_each(|case| journal.add(&format!("case {case}"), &case).unwrap());
    drop(journal);
    let text = fs::read(whole.path().join("points.jsonl")).unwrap();
    let ends = text.iter().enumerate().filter(|(_, byte)| **byte == b'\n');
    let ends: Vec<usize> = ends.map(|(at, _)| at).collect();
    for length in 0..=text.len() {
        let cut = folder();
        fs::write(cut.path().join("points.jsonl"), &text[..length]).unwrap();
        let mut journal = open(&cut, "1/1");
        let is_known = |journal: &Journal, case: u32| {
            let found = journal.known(&format!("case {case}"));
            found.inspect(|found: &u32| assert_eq!(*found, case)).is_some()
        };
        for (case, end) in ends.iter().enumerate() {
            assert_eq!(is_known(&journal, case as u32), length >= *end, "{length}");
        }
        let missing: Vec<u32> = (0..3).filter(|case| !is_known(&journal, *case)).collect();
        missing.iter().for_each(|case| journal.add(&format!("case {case}"), case).unwrap());
        drop(journal);
        let resumed = open(&cut, "1/1");
        assert!((0..3).all(|case| is_known(&resumed, case)), "{length}");
    }
}

#[test]
fn shards_merge_to_the_whole() {
    let folder = folder();
    let cases: Vec<String> = (0..7).map(|case| format!("case {case}")).collect();
    let mut journals = [open(&folder, "1/2"), open(&folder, "2/2")];
    for (shard, journal) in ["1/2", "2/2"].into_iter().zip(&mut journals) {
        let shard: Shard = shard.parse().unwrap();
        for (case, key) in cases.iter().enumerate().filter(|(case, _)| shard.takes(*case)) {
            journal.add(key, &point(case as f64)).unwrap();
        }
    }
    drop(journals);
    fs::write(folder.path().join("points-old.jsonl"), "someone's").unwrap();
    let merged = open(&folder, "1/1");
    for (case, key) in cases.iter().enumerate() {
        assert_eq!(merged.known(key), Some(point(case as f64)), "{key}");
    }
    merged.close().unwrap();
    let left: Vec<_> =
        fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(left, ["points-old.jsonl"]);
}

#[test]
fn another_fingerprint_is_replaced_and_never_mixed() {
    let folder = folder();
    let stale =
        |shard: &str| Journal::open(folder.path(), shard.parse().unwrap(), "stale").unwrap();
    stale("1/2").add("case", &1).unwrap();
    stale("1/1").add("case", &1).unwrap();
    let mut journal = open(&folder, "1/1");
    assert_eq!(journal.known::<i32>("case"), None);
    journal.add("case", &2).unwrap();
    drop(journal);
    assert_eq!(open(&folder, "2/2").known("case"), Some(2));
    assert_eq!(stale("2/3").known("case"), Some(1), "that of shard 1/2 is not ours to empty");
    assert!(!fs::read_to_string(folder.path().join("points.jsonl")).unwrap().contains("stale"));
}

#[test]
fn what_json_cannot_hold_is_refused_and_leaves_no_trace() {
    let folder = folder();
    let mut journal = open(&folder, "1/1");
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(matches!(journal.add("case", &point(value)), Err(Error::Check(_))));
    }
    assert_eq!(journal.known::<Point>("case"), None);
    assert_eq!(fs::read(folder.path().join("points.jsonl")).unwrap(), b"");
}

#[test]
fn two_runs_do_not_share_a_journal() {
    let folder = folder();
    let first = open(&folder, "1/2");
    let second = Journal::open(folder.path(), "1/2".parse().unwrap(), OF).unwrap_err();
    assert!(second.to_string().contains("points-1-of-2.jsonl: another run"), "{second}");
    open(&folder, "2/2");
    drop(first);
    open(&folder, "1/2");
}

#[test]
fn a_value_of_another_kind_is_not_known() {
    let folder = folder();
    let mut journal = open(&folder, "1/1");
    journal.add("case", &"skipped: no room".to_owned()).unwrap();
    assert_eq!(journal.known::<Point>("case"), None);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]
    #[test]
    fn every_finite_number_survives_to_the_bit(bits: u64) {
        let value = f64::from_bits(bits);
        prop_assume!(value.is_finite());
        let text = serde_json::to_string(&point(value)).unwrap();
        let read: Point = serde_json::from_str(&text).unwrap();
        prop_assert_eq!(read.cycles.to_bits(), bits);
        let value_read: Value = serde_json::from_str(&text).unwrap();
        prop_assert_eq!(Point::deserialize(value_read).unwrap().bound.unwrap().to_bits(), bits);
    }
}
