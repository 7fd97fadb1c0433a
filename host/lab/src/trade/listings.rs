//! The tables of a study, for the terminal and for the report.

use super::digits::{cost as cost_text, grouped, or_dash, percent};
use super::picture::cost;
use super::record::{FunctionCost, Point, Trade};
use crate::baseline::record::Baseline;
use signorini_draw::{Column, Table, plain};

/// The settings that nothing beats in both cost and error, the cheapest first; the recommended one
/// stands out.
pub fn front(trade: &Trade) -> Table {
    let mut points: Vec<&Point> = trade.points.iter().filter(|point| point.pareto).collect();
    let price = |point: &Point| cost(&trade.target, point).unwrap_or(f64::INFINITY);
    points.sort_by(|a, b| price(a).total_cmp(&price(b)));
    let taken = trade.recommendation.point.as_ref();
    let chosen = taken.and_then(|taken| points.iter().position(|point| point.name == taken.name));
    let of_energy = |part: f64| percent(part, trade.energy);
    let mut columns = vec![
        Column::words("setting", |point: &&Point| point.name.clone()),
        Column::number("unknowns", |point: &&Point| grouped(point.unknowns as u64)),
        // The exact method has none.
        Column::number("sweeps", |point: &&Point| {
            or_dash((point.sweeps > 0).then_some(point.sweeps.into()), grouped)
        }),
    ];
    columns.extend(
        costs(&trade.target)
            .iter()
            .map(|&(name, text)| Column::number(name, move |point: &&Point| text(point))),
    );
    columns.extend([
        Column::number("error of u_h %", |point: &&Point| of_energy(point.error.energy)),
        Column::number("force %", |point: &&Point| percent(point.error.force, trade.force)),
        Column::number("error of s, τ %", |point: &&Point| {
            or_dash(point.error.combined, of_energy)
        }),
        Column::number("bound of s, τ %", |point: &&Point| or_dash(point.bound, of_energy)),
        Column::number("bound/error", |point: &&Point| {
            let both = point.bound.zip(point.error.combined);
            or_dash(both.map(|(bound, error)| bound / error), plain)
        }),
    ]);
    Table::new(&columns, points).choosing(chosen)
}

/// A cost of a point: its name and its text.
pub type CostColumn = (&'static str, fn(&Point) -> String);

/// The columns of a target's costs; bytes for RAM and flash.
pub fn costs(target: &str) -> &'static [CostColumn] {
    const ON_HOST: [CostColumn; 2] = [
        ("cycles", |point| cost_text(point.cycles)),
        ("cycles/unknown", |point| cost_text(point.cycles_per_unknown)),
    ];
    const ON_BOARD: [CostColumn; 3] = [
        ("instructions", |point| or_dash(point.instructions, grouped)),
        ("RAM, bytes", |point| or_dash(point.ram_bytes, grouped)),
        ("flash, bytes", |point| or_dash(point.flash_bytes, grouped)),
    ];
    if target == "host" { &ON_HOST } else { &ON_BOARD }
}

/// Other solvers on the same matrices.
pub fn baselines(trade: &Trade) -> Table {
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

/// What the functions of micromath do to the solution.
pub fn math(trade: &Trade) -> Table {
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
