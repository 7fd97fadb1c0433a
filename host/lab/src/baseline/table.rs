//! The study of sizes as a table, and the figures of each size in plain sentences.

use super::Sizes;
use super::benchmark::PSOR;
use super::series::Baseline;
use crate::trade::digits::or_dash;
use signorini_draw::{Column, Table};

/// A line of the table: the starts of a solver on a problem.
type Line<'s> = &'s [Baseline];

/// A line for each solver and size.
pub fn table(sizes: &Sizes) -> Table {
    let is_same = |a: &Baseline, b: &Baseline| (&a.problem, &a.solver) == (&b.problem, &b.solver);
    let lines = sizes.rows.iter().flat_map(|size| size.baselines.chunk_by(is_same));
    Table::new(&columns(), lines)
}

/// A start's figure for a column.
type Figure = fn(&Baseline) -> String;

fn columns<'s>() -> Vec<Column<'s, Line<'s>>> {
    let mut columns = vec![
        Column::words("unknowns", |line: &Line| line[0].unknowns.to_string()),
        Column::words("problem", |line: &Line| line[0].problem.clone()),
        Column::words("solver", |line: &Line| line[0].solver.clone()),
    ];
    for (start, cycles) in [("cold", "cold, kilocycles"), ("warm", "warm, kilocycles")] {
        let figures: [(&str, Figure); 4] = [
            (cycles, |b| format!("{:.1}", 1e-3 * b.cycles)),
            ("±", |b| format!("{:.0} %", 100.0 * b.cycles_spread)),
            ("iterations", |b| b.iterations.to_string()),
            ("ratio", |b| format!("{:.2}", b.ratio)),
        ];
        columns.extend(figures.map(|(name, figure)| {
            Column::number(name, move |line: &Line| {
                or_dash(line.iter().find(|b| b.start == start), figure)
            })
        }));
    }
    columns.push(Column::number("error/target", |line: &Line| {
        let errors = line.iter().map(|b| b.algebraic_error / b.target);
        format!("{:.0e}", errors.fold(0.0, f64::max))
    }));
    columns
}

/// What the table is of, sentences that follow from it, size by size, and the remarks.
pub fn findings(sizes: &Sizes) -> Vec<String> {
    let matrices = format!("On the same matrices, at equal error. {}", sizes.title);
    let columns = "The ratio is to the kernel’s fastest in f64 on that problem, ± (largest − smallest)/median.";
    let verdicts = sizes.rows.iter().map(|size| verdict(size.unknowns, &size.baselines));
    let all = [matrices, columns.to_owned()].into_iter().chain(verdicts);
    all.chain(sizes.notes.iter().cloned()).collect()
}

/// The part of PSOR's cycles that is less by more than noise.
const AHEAD: f64 = 0.95;

/// The winners cold and warm, where PSOR loses, and what to take there. Cold counts the full problem alone:
/// condensing is itself more than a solve.
fn verdict(unknowns: usize, baselines: &[Baseline]) -> String {
    let fair = |start: &'static str| {
        let reached = move |b: &&Baseline| b.algebraic_error <= b.target && b.start == start;
        baselines.iter().filter(reached)
    };
    // A factor that stands is no cold start.
    let is_cold = |b: &&Baseline| b.problem == "full" && !b.solver.ends_with("factor kept");
    let cold = fastest(fair("cold").filter(is_cold));
    let warm = fastest(fair("warm").filter(|b| b.problem == "full"));
    let (Some(first), Some(overall)) = (cold.first(), fastest(fair("warm")).first().copied())
    else {
        return format!("{unknowns} unknowns: nobody reached the error asked for.");
    };
    format!(
        "{unknowns} unknowns. Cold: {} with {}. {} Warm: {} ({}) with {}. {}",
        first.solver,
        amount(first.cycles),
        losses("Cold,", &cold),
        overall.solver,
        overall.problem,
        amount(overall.cycles),
        losses("Warm, on the full problem,", &warm),
    )
}

/// From the fastest on.
fn fastest<'b>(of: impl Iterator<Item = &'b Baseline>) -> Vec<&'b Baseline> {
    let mut sorted: Vec<&Baseline> = of.collect();
    sorted.sort_by(|a, b| a.cycles.total_cmp(&b.cycles));
    sorted
}

/// The solvers that PSOR, with the ω it finds itself, loses to by more than repeats differ, and by how much.
fn losses(start: &str, sorted: &[&Baseline]) -> String {
    let Some(fastest) = sorted.first() else {
        return format!("{start} nobody reaches the error.");
    };
    let Some(psor) = sorted.iter().find(|b| b.solver == PSOR).map(|b| b.cycles) else {
        return format!("{start} PSOR does not reach the error: take {}.", fastest.solver);
    };
    let ahead = sorted.iter().filter(|b| b.cycles < AHEAD * psor);
    let ahead: Vec<String> =
        ahead.map(|b| format!("{} ({:.2})", b.solver, b.cycles / psor)).collect();
    match ahead.as_slice() {
        [] => format!("{start} PSOR loses to nobody."),
        ahead => format!("{start} PSOR loses (part of its cycles): take {}.", ahead.join(", or ")),
    }
}

fn amount(cycles: f64) -> String {
    match cycles {
        1e6.. => format!("{:.1} Mcycles", 1e-6 * cycles),
        _ => format!("{:.1} kcycles", 1e-3 * cycles),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn baseline(solver: &str, start: &str, problem: &str, cycles: f64) -> Baseline {
        let [start, problem] = [start, problem].map(str::to_owned);
        let plain = crate::trade::tests::baseline(solver, 1.0, 1);
        Baseline { problem, start, cycles, algebraic_error: 0.5, target: 1.0, ..plain }
    }

    #[test]
    fn psor_loses_to_whoever_is_ahead_of_it_whosever_they_are() {
        let mut far = baseline("Clarabel", "cold", "full", 1.0);
        far.algebraic_error = 2.0;
        let all = [
            baseline(PSOR, "cold", "full", 10e6),
            baseline("kernel PSOR f64, coarse to fine", "cold", "full", 4e6),
            baseline("faer active set", "cold", "full", 7e6),
            baseline("OSQP", "cold", "full", 9.8e6),
            baseline("faer active set, factor kept", "cold", "full", 1e6),
            far,
            baseline(PSOR, "warm", "full", 2e6),
            baseline("OSQP", "warm", "full", 3e6),
            baseline("kernel pivoting f64", "warm", "condensed", 2e3),
        ];
        assert_eq!(
            verdict(100, &all),
            "100 unknowns. Cold: kernel PSOR f64, coarse to fine with 4.0 Mcycles. Cold, PSOR loses (part of its \
             cycles): take kernel PSOR f64, coarse to fine (0.40), or faer active set (0.70). Warm: kernel pivoting \
             f64 (condensed) with 2.0 kcycles. Warm, on the full problem, PSOR loses to nobody."
        );
        let without = verdict(100, &[all[1].clone(), all[8].clone()]);
        assert!(without.contains("Cold, PSOR does not reach the error: take kernel"), "{without}");
        assert!(
            without.ends_with("Warm, on the full problem, nobody reaches the error."),
            "{without}"
        );
        let cut = verdict(100, &all[1..2]);
        assert_eq!(cut, "100 unknowns: nobody reached the error asked for.");
    }
}
