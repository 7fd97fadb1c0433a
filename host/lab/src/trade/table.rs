//! The tables of a study, for the terminal and for the report, and the whole study as the terminal shows it.

use std::fmt::Write;

use super::digits::{cost as cost_text, grouped, or_dash, percent};
use super::record::{FunctionCost, Point, Trade};
use super::target::Target;
use crate::baseline::Baseline;
use signorini_draw::{Column, Table, plain};

/// The settings that nothing beats in both cost and error, the cheapest first; the recommended one
/// stands out.
pub fn front(trade: &Trade) -> Table {
    let mut points: Vec<&Point> = trade.points.iter().filter(|point| point.pareto).collect();
    points.sort_by(|a, b| a.cost().total_cmp(&b.cost()));
    let taken = trade.recommendation.point.as_ref();
    let chosen = taken.and_then(|taken| points.iter().position(|point| point.name == taken.name));
    let number =
        |&(name, text): &Figure| Column::number(name, move |point: &&Point| text(trade, point));
    let mut columns = vec![
        Column::words("setting", |point: &&Point| point.name.clone()),
        Column::number("unknowns", |point: &&Point| grouped(point.unknowns as u64)),
        // The exact method has none.
        Column::number("sweeps", |point: &&Point| {
            or_dash((point.sweeps > 0).then_some(point.sweeps.into()), grouped)
        }),
    ];
    columns.extend(costs(trade.target).iter().map(number));
    let [of_u, of_s, bound] = ERRORS.each_ref().map(number);
    columns.extend([
        of_u,
        Column::number("force %", |point: &&Point| percent(point.error.force, trade.force)),
        of_s,
        bound,
        Column::number("bound/error", |point: &&Point| {
            let both = point.bound.zip(point.error.combined);
            or_dash(both.map(|(bound, error)| bound / error), plain)
        }),
    ]);
    Table::new(&columns, points).choosing(chosen)
}

/// A figure of a point: its name and its text.
pub type Figure = (&'static str, fn(&Trade, &Point) -> String);

/// Errors and the bound in percent of the energy norm.
pub const ERRORS: [Figure; 3] = [
    ("error of u_h %", |trade, point| percent(point.error.energy, trade.energy)),
    ("error of s, τ %", |trade, point| {
        or_dash(point.error.combined, |error| percent(error, trade.energy))
    }),
    ("bound of s, τ %", |trade, point| or_dash(point.bound, |bound| percent(bound, trade.energy))),
];

/// The costs on a target; bytes for RAM and flash.
pub fn costs(target: Target) -> &'static [Figure] {
    const ON_HOST: [Figure; 2] = [
        ("cycles", |_, point| cost_text(point.cycles)),
        ("cycles/unknown", |_, point| cost_text(point.cycles_per_unknown)),
    ];
    const ON_BOARD: [Figure; 3] = [
        ("instructions", |_, point| or_dash(point.instructions, grouped)),
        ("RAM, bytes", |_, point| or_dash(point.ram_bytes, grouped)),
        ("flash, bytes", |_, point| or_dash(point.flash_bytes, grouped)),
    ];
    if target == Target::Host { &ON_HOST } else { &ON_BOARD }
}

/// The tables beside the front, with their headings.
pub fn further(trade: &Trade) -> [(String, Table); 2] {
    let named = |heading: &str, table| (heading.to_owned(), table);
    [
        named("Other solvers on the same matrices", baselines(trade)),
        named("What micromath does to the solution", math(trade)),
    ]
}

fn baselines(trade: &Trade) -> Table {
    let columns = [
        Column::words("solver", |solver: &&Baseline| solver.solver.clone()),
        Column::words("problem", |solver: &&Baseline| solver.problem.clone()),
        Column::number("unknowns", |solver: &&Baseline| grouped(solver.unknowns as u64)),
        Column::words("start", |solver: &&Baseline| solver.start.clone()),
        Column::number("iterations", |solver: &&Baseline| grouped(solver.iterations.into())),
        Column::number("cycles", |solver: &&Baseline| cost_text(solver.cycles)),
        Column::number("slowest", |solver: &&Baseline| cost_text(solver.worst)),
        Column::number("spread %", |solver: &&Baseline| percent(solver.cycles_spread, 1.0)),
        Column::number("ratio", |solver: &&Baseline| cost_text(solver.ratio)),
        Column::number("algebraic error", |solver: &&Baseline| plain(solver.algebraic_error)),
    ];
    Table::new(&columns, &trade.baselines)
}

fn math(trade: &Trade) -> Table {
    let change = |part: Option<f64>| or_dash(part, |part| percent(part, 1.0));
    let columns = [
        Column::words("function", |of: &&FunctionCost| of.function.clone()),
        Column::words("used in", |of: &&FunctionCost| of.used_in.clone()),
        Column::number("energy %", |of: &&FunctionCost| change(of.energy)),
        Column::number("force %", |of: &&FunctionCost| change(of.force)),
        Column::number("length %", |of: &&FunctionCost| change(of.length)),
        Column::number("sweeps", |of: &&FunctionCost| {
            or_dash(of.sweeps, |more| format!("{more:+}").replace('-', "−"))
        }),
        Column::number("calls", |of: &&FunctionCost| grouped(of.calls)),
        Column::number("instructions saved a call", |of: &&FunctionCost| plain(of.saved)),
        Column::words("remark", |of: &&FunctionCost| of.note.clone().unwrap_or_default()),
    ];
    Table::new(&columns, &trade.math)
}

/// `120 combinations not measured: REASON (80); REASON (40)`; nothing when all were.
pub fn skipped(trade: &Trade) -> Option<String> {
    let reasons = trade.skipped_reasons.iter();
    let reasons: Vec<String> = reasons
        .map(|skipped| format!("{} ({})", skipped.reason, grouped(skipped.count as u64)))
        .collect();
    let plural = if trade.skipped == 1 { "" } else { "s" };
    let count = grouped(trade.skipped as u64);
    let text = format!("{count} combination{plural} not measured: {}", reasons.join("; "));
    (trade.skipped > 0).then(|| text.trim_end_matches(": ").to_owned())
}

/// The front, other solvers, micromath, what was skipped, and last what to take.
pub fn text(trade: &Trade) -> String {
    let measured = grouped(trade.points.len() as u64);
    let mut text = format!(
        "{} ({}) on the {}: what nothing beats among {measured} settings\n{}",
        trade.title,
        trade.scene,
        trade.target.title(),
        front(trade).text()
    );
    let _ = writeln!(text, "errors: true ones, {}; force: of the contact force", trade.truth);
    for (heading, table) in further(trade).iter().filter(|(_, table)| !table.rows.is_empty()) {
        let _ = write!(text, "\n{heading}\n{}", table.text());
    }
    trade.notes.iter().for_each(|note| text += &format!("* {note}\n"));
    let skipped = skipped(trade).map_or(String::new(), |skipped| skipped + "\n");
    let _ = write!(text, "\n{skipped}{}\n", trade.recommendation.text);
    text
}

#[cfg(test)]
mod tests {
    use super::super::tests::trade;
    use super::*;

    #[test]
    fn a_person_can_read_it() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/src/trade/table.txt");
        let found = text(&trade("levee", 40));
        let expected = std::fs::read_to_string(file).unwrap_or_default();
        assert_eq!(found, expected, "found:\n{found}");
    }

    #[test]
    fn nothing_found_is_said_in_few_lines() {
        let mut trade = trade("levee", 0);
        trade.baselines.clear();
        trade.math.clear();
        trade.skipped = 0;
        let text = text(&trade);
        assert!(!text.contains("Other solvers") && !text.contains("not measured"), "{text}");
        assert!(text.lines().count() < 8, "{text}");
    }
}
