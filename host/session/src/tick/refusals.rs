//! Sentences on ticks that have no answer.

use super::TickRecord;

/// How many of `ticks` have no answer, by why, with the time of the first.
pub fn refusals(ticks: &[TickRecord]) -> Vec<String> {
    unsolvable(ticks).into_iter().chain(excluded(ticks)).collect()
}

/// How many ticks have no solution or no single one, and when the first.
fn unsolvable(ticks: &[TickRecord]) -> Option<String> {
    let why = "have no solution or more than one, the first {}: contact alone holds a part of the domain, and the loads do not push it on";
    refused(ticks, TickRecord::is_unsolvable, why)
}

/// How many ticks have data that exclude each other, and when the first.
fn excluded(ticks: &[TickRecord]) -> Option<String> {
    let why = "have data that exclude each other where boundaries meet, the first {}: no u is both above the one and below the other";
    refused(ticks, TickRecord::is_excluded, why)
}

/// A sentence on the ticks that have no answer, with the place of the first in `why`.
fn refused(ticks: &[TickRecord], is: fn(&TickRecord) -> bool, why: &str) -> Option<String> {
    let refused = || ticks.iter().filter(|tick| is(tick));
    let first = refused().next()?;
    let place = format!("at t = {} ({})", first.time, first.status.name());
    Some(format!(
        "{} of {} ticks {}. Their rows are empty; each next one goes on from the last answer",
        refused().count(),
        ticks.len(),
        why.replace("{}", &place),
    ))
}
