//! The tables of a study, for the terminal and for the report.

use super::digits::{cost as cost_text, grouped, or_dash, percent};
use super::picture::cost;
use super::record::{Point, Trade};
use signorini_draw::{Listing, plain};

fn texts<const N: usize>(names: [&str; N]) -> Vec<String> {
    names.map(str::to_owned).to_vec()
}

/// The settings that nothing beats in both cost and error, the cheapest first; the recommended one
/// stands out.
pub fn front(trade: &Trade) -> Listing {
    let mut points: Vec<&Point> = trade.points.iter().filter(|point| point.pareto).collect();
    let price = |point: &Point| cost(&trade.target, point).unwrap_or(f64::INFINITY);
    points.sort_by(|a, b| price(a).total_cmp(&price(b)));
    let taken = trade.recommendation.point.as_ref();
    let marked = taken.and_then(|taken| points.iter().position(|point| point.name == taken.name));
    let mut header = texts(["setting", "unknowns", "sweeps"]);
    header.extend(cost_header(&trade.target));
    header.extend(texts([
        "error of u_h %",
        "force %",
        "error of s, τ %",
        "bound of s, τ %",
        "bound/error",
    ]));
    Listing { header, rows: points.iter().map(|point| front_row(trade, point)).collect(), marked }
}

/// The columns of a target's costs.
fn cost_header(target: &str) -> Vec<String> {
    if target == "host" {
        texts(["cycles", "cycles/unknown"])
    } else {
        texts(["instructions", "RAM, bytes", "flash, bytes"])
    }
}

/// What a point costs on a target, column by column; bytes for RAM and flash.
pub fn costs(target: &str, point: &Point) -> Vec<String> {
    if target == "host" {
        vec![cost_text(point.cycles), cost_text(point.cycles_per_unknown)]
    } else {
        let counts = [point.instructions, point.ram_bytes, point.flash_bytes];
        counts.map(|count| or_dash(count, grouped)).to_vec()
    }
}

fn front_row(trade: &Trade, point: &Point) -> Vec<String> {
    // The exact method has none.
    let sweeps = or_dash((point.sweeps > 0).then_some(point.sweeps.into()), grouped);
    let mut row = vec![point.name.clone(), grouped(point.unknowns as u64), sweeps];
    row.extend(costs(&trade.target, point));
    let ratio = point.bound.zip(point.error.combined).map(|(bound, error)| bound / error);
    row.extend([
        percent(point.error.energy, trade.energy),
        percent(point.error.force, trade.force),
        or_dash(point.error.combined, |error| percent(error, trade.energy)),
        or_dash(point.bound, |bound| percent(bound, trade.energy)),
        or_dash(ratio, plain),
    ]);
    row
}

/// Other solvers on the same matrices.
pub fn baselines(trade: &Trade) -> Listing {
    let header = texts([
        "solver",
        "problem",
        "unknowns",
        "start",
        "iterations",
        "cycles",
        "slowest",
        "spread %",
        "ratio",
        "algebraic error",
        "error %",
    ]);
    let rows = trade.baselines.iter().map(|solver| {
        let error = solver.error.map(|error| error.energy);
        vec![
            solver.solver.clone(),
            solver.problem.clone(),
            grouped(solver.unknowns as u64),
            solver.start.clone(),
            grouped(solver.iterations.into()),
            cost_text(solver.cycles),
            cost_text(solver.worst),
            percent(solver.cycles_spread, 1.0),
            cost_text(solver.ratio),
            plain(solver.algebraic_error),
            or_dash(error, |error| percent(error, trade.energy)),
        ]
    });
    Listing { header, rows: rows.collect(), marked: None }
}

/// What the functions of micromath do to the solution.
pub fn math(trade: &Trade) -> Listing {
    let header = texts([
        "function",
        "used in",
        "energy %",
        "force %",
        "length %",
        "sweeps",
        "calls",
        "instructions saved a call",
        "remark",
    ]);
    let rows = trade.math.iter().map(|function| {
        vec![
            function.function.clone(),
            function.used_in.clone(),
            or_dash(function.energy, |change| percent(change, 1.0)),
            or_dash(function.force, |change| percent(change, 1.0)),
            or_dash(function.length, |change| percent(change, 1.0)),
            or_dash(function.sweeps, |more| format!("{more:+}").replace('-', "−")),
            grouped(function.calls),
            plain(function.saved),
            function.note.clone().unwrap_or_default(),
        ]
    });
    Listing { header, rows: rows.collect(), marked: None }
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
