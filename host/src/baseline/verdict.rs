//! What the figures of one size say, in plain sentences.

use super::ring::{CASCADE, PIVOTS, PSOR};
use crate::trade::record::Baseline;

/// Who wins cold and warm, where PSOR loses and what to take there. Cold counts the full problem alone:
/// condensing is itself more than a solve. Conforming P1 solves another problem and is left out.
pub(super) fn verdict(unknowns: usize, baselines: &[Baseline]) -> String {
    let fair = |start: &'static str| {
        let reached = move |b: &&Baseline| b.algebraic_error <= b.target && b.start == start;
        baselines.iter().filter(reached).filter(|b| b.problem != "conforming P1")
    };
    let fastest =
        |of: Vec<&Baseline>| of.into_iter().min_by(|a, b| a.cycles.total_cmp(&b.cycles)).cloned();
    let on_full = |start| fair(start).filter(|b| b.problem == "full");
    // A factor that stands is no cold start.
    let cold = fastest(on_full("cold").filter(|b| !b.solver.ends_with("factor kept")).collect());
    let warm = fastest(fair("warm").collect());
    let warm_on_full = fastest(on_full("warm").collect());
    let (Some(cold), Some(warm), Some(warm_on_full)) = (cold, warm, warm_on_full) else {
        return format!("{unknowns} unknowns: nobody reached the error asked for.");
    };
    let cycles = |name: &str, start| fair(start).find(|b| b.solver == name).map(|b| b.cycles);
    let times = |name: &str, start, least: &Baseline| match cycles(name, start) {
        Some(cycles) => format!("{:.1}×", cycles / least.cycles),
        None => "–".to_owned(),
    };
    let mut text = format!(
        "{unknowns} unknowns. Cold: {} wins with {}; to it PSOR costs {}, Clarabel {}, OSQP {}. ",
        cold.solver,
        amount(cold.cycles),
        times(PSOR, "cold", &cold),
        times("Clarabel", "cold", &cold),
        times("OSQP", "cold", &cold),
    );
    text += &format!(
        "Warm: {} ({}) wins with {}; on the full problem {} with {}, to which PSOR costs {}. ",
        warm.solver,
        warm.problem,
        amount(warm.cycles),
        warm_on_full.solver,
        amount(warm_on_full.cycles),
        times(PSOR, "warm", &warm_on_full),
    );
    text + &advice(
        &cold,
        &warm_on_full,
        cycles(CASCADE, "cold"),
        cycles(PSOR, "cold"),
        cycles(PIVOTS, "warm"),
    )
}

fn advice(
    cold: &Baseline,
    warm_on_full: &Baseline,
    cascade: Option<f64>,
    psor: Option<f64>,
    pivots: Option<f64>,
) -> String {
    let mut text = String::new();
    let is_kernel = |b: &Baseline| b.solver.starts_with("kernel");
    let loses = match (is_kernel(cold), is_kernel(warm_on_full)) {
        (true, true) => None,
        (true, false) => Some(("warm", warm_on_full)),
        (false, true) => Some(("cold", cold)),
        (false, false) => Some(("cold and warm", warm_on_full)),
    };
    text += &match loses {
        None => "PSOR loses nowhere on the full problem.".to_owned(),
        Some((start, to)) => format!("PSOR loses {start}: take {}.", to.solver),
    };
    if let (Some(cascade), Some(psor)) = (cascade, psor) {
        text +=
            &format!(" A start from coarse to fine costs {:.2} of a cold PSOR.", cascade / psor);
    }
    if let Some(pivots) = pivots {
        text += &format!(" Condensed, a tick costs {}.", amount(pivots));
    }
    text
}

fn amount(cycles: f64) -> String {
    match cycles {
        1e6.. => format!("{:.1} Mcycles", 1e-6 * cycles),
        _ => format!("{:.1} kcycles", 1e-3 * cycles),
    }
}
