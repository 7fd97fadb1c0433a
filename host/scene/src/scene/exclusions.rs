//! Keys of the setting that exclude each other: one table, which the reader and the schema go by.

use serde_json::{Value as Json, json};
use toml::de::DeValue;

use super::table::Table;

/// A condition on keys of a table.
#[derive(Debug, Clone, Copy)]
enum When {
    /// The key is written.
    Written(&'static str),
    /// It is left out.
    Left(&'static str),
    /// It is one of these words.
    Is(&'static str, &'static [&'static str]),
    /// It is a number > 0.
    Positive(&'static str),
    /// It is a number.
    Number(&'static str),
    /// It is `false`.
    False(&'static str),
    /// All conditions of one of these lists hold.
    Any(&'static [&'static [When]]),
}

/// Conditions that exclude each other, with what is told then.
type Rule = (&'static [When], &'static str, &'static str, &'static str);

use When::{Any, False, Is, Left, Number, Positive, Written};

const EXACT: When = Is("solver", &["exact"]);
const FACTOR: When = Is("solver", &["factor"]);
const MIXED: When = Is("scalar", &["f32+f64"]);
const FAST: When = Is("math", &["micromath"]);
const MODEL: When = Is("model", &["condensed"]);
const CONDENSED: When =
    Any(&[&[MODEL], &[EXACT, Left("model")], &[Written("memory"), Left("model")]]);
const FULL: When = Is("model", &["full"]);

const ONE: &str = "remove one of them";
const SWEEP: &str = "remove it, or write solver = \"sweeps\"";
const TO_FULL: &str = "remove it, or take model = \"full\"";
const ROOTS: &str =
    "the condensed model has no search for ω, the one that takes square roots of either kind";
const SHARE: &str = "a share of the error bound, which certificate = false leaves out";

#[rustfmt::skip] // A table.
const RULES: [Rule; 16] = [
    (&[Written("error"), Positive("refine")], "refine", "excludes `error`, which says how fine the mesh becomes", ONE),
    (&[Written("sweeps"), Written("share")], "share", "excludes `sweeps`: one of them says when to stop", ONE),
    (&[Written("share"), False("certificate")], "share", SHARE, "write certificate = true, or a number of sweeps"),
    (&[Written("share"), CONDENSED], "share", "the condensed model has no share to stop at", "remove it, or write a number of sweeps"),
    (&[FACTOR, CONDENSED], "solver", "a factor is for the full model", "write solver = \"exact\", or take model = \"full\""),
    (&[Written("memory"), FULL], "memory", "states are those of a condensed model", "remove it, or take model = \"condensed\""),
    (&[EXACT, FULL], "solver", "the exact method is for the condensed model", "write solver = \"factor\", or take model = \"condensed\""),
    (&[Written("sweeps"), EXACT], "sweeps", "the exact method takes no number of sweeps", SWEEP),
    (&[Written("sweeps"), FACTOR], "sweeps", "a factor takes no sweeps", SWEEP),
    (&[Written("share"), FACTOR], "share", "a factor leaves nothing of the bound to sweeps", SWEEP),
    (&[MIXED, FACTOR], "scalar", "a factor is for one number format", "write f32 or f64, or solver = \"sweeps\""),
    (&[Number("omega"), CONDENSED], "omega", "the condensed model has its own relaxation factor", TO_FULL),
    (&[Is("start", &["cold"]), CONDENSED], "start", "the condensed model has no cold start", TO_FULL),
    (&[FAST, CONDENSED], "math", ROOTS, TO_FULL),
    (&[MIXED, CONDENSED], "scalar", "the condensed model is solved in one number format", "write f32 or f64, or take model = \"full\""),
    (&[FAST, Is("scalar", &["f64", "f32+f64"])], "math", "micromath is for f32 alone", "write scalar = \"f32\", or math = \"libm\""),
];

/// Of the first rule that a setting breaks: the key to blame, why, and what to do.
pub(super) fn broken(setting: &Table) -> Option<[&'static str; 3]> {
    let is_broken = |(all, ..): &Rule| all.iter().all(|when| when.holds(setting));
    RULES.into_iter().find(is_broken).map(|(_, key, message, hint)| [key, message, hint])
}

/// What the schema says of them.
pub(super) fn in_schema() -> Json {
    let not = |all: &[When]| json!({ "not": { "allOf": schemas(all) } });
    RULES.iter().map(|(all, ..)| not(all)).collect()
}

fn schemas(all: &[When]) -> Vec<Json> {
    all.iter().map(|when| when.schema()).collect()
}

impl When {
    fn holds(self, table: &Table) -> bool {
        let found = |key| table.get(key);
        match self {
            Written(key) => found(key).is_some(),
            Left(key) => found(key).is_none(),
            Is(key, words) => {
                found(key).and_then(|entry| entry.word()).is_some_and(|word| words.contains(&word))
            }
            Positive(key) => found(key).is_some_and(|entry| entry.number().is_ok_and(|n| n > 0.0)),
            Number(key) => found(key).is_some_and(|entry| entry.number().is_ok()),
            False(key) => {
                found(key).is_some_and(|entry| matches!(entry.at.value, DeValue::Boolean(false)))
            }
            Any(lists) => lists.iter().any(|all| all.iter().all(|when| when.holds(table))),
        }
    }

    fn schema(self) -> Json {
        let has =
            |key: &str, value: Json| json!({ "required": [key], "properties": { key: value } });
        match self {
            Written(key) => json!({ "required": [key] }),
            Left(key) => json!({ "not": { "required": [key] } }),
            Is(key, words) => has(key, json!({ "enum": words })),
            Positive(key) => has(key, json!({ "type": "number", "exclusiveMinimum": 0 })),
            Number(key) => has(key, json!({ "type": "number" })),
            False(key) => has(key, json!({ "const": false })),
            Any(lists) => {
                let lists = lists.iter().map(|all| json!({ "allOf": schemas(all) }));
                json!({ "anyOf": lists.collect::<Vec<_>>() })
            }
        }
    }
}
