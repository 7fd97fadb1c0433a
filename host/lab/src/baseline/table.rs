//! The study of sizes as a table.

use super::verdict::verdict;
use super::{Size, Sizes};
use crate::baseline::record::Baseline;
use signorini_draw::{Column, Table};

/// A line of the table: a solver on a problem, cold and warm.
struct Line<'s> {
    problem: &'s str,
    solver: &'s str,
    starts: [Option<&'s Baseline>; 2],
}

/// A line for each solver and size.
pub fn table(sizes: &Sizes) -> String {
    format!(
        "Other solvers on the same matrices, at equal error: {}\n\
         Ratio: to the kernel's fastest in f64 on that problem; ±: (largest − smallest)/median.\n{}\n",
        sizes.title,
        Table::new(&columns(), sizes.rows.iter().flat_map(lines)).text()
    )
}

/// A start's figure for a column.
type Figure = fn(&Baseline) -> String;

fn columns<'s>() -> Vec<Column<'s, Line<'s>>> {
    let mut columns = vec![
        Column::words("unknowns", |line: &Line| {
            line.found().next().map_or(0, |b| b.unknowns).to_string()
        }),
        Column::words("problem", |line: &Line| line.problem.to_owned()),
        Column::words("solver", |line: &Line| line.solver.to_owned()),
    ];
    for (start, cycles) in ["cold kcyc", "warm kcyc"].into_iter().enumerate() {
        let figures: [(&str, Figure); 4] = [
            (cycles, |b| format!("{:.1}", 1e-3 * b.cycles)),
            ("±", |b| format!("{:.0} %", 100.0 * b.cycles_spread)),
            ("iter", |b| b.iterations.to_string()),
            ("ratio", |b| format!("{:.2}", b.ratio)),
        ];
        columns.extend(figures.map(|(name, figure)| {
            Column::number(name, move |line: &Line| {
                line.starts[start].map_or("–".to_owned(), figure)
            })
        }));
    }
    columns.push(Column::number("error/target", |line: &Line| {
        let errors = line.found().map(|b| b.algebraic_error / b.target);
        format!("{:.0e}", errors.fold(0.0, f64::max))
    }));
    columns
}

impl<'s> Line<'s> {
    fn found(&self) -> impl Iterator<Item = &'s Baseline> {
        self.starts.into_iter().flatten()
    }
}

/// The solvers of a size, each once.
fn lines(size: &Size) -> Vec<Line<'_>> {
    let mut lines: Vec<Line> = Vec::new();
    for baseline in &size.baselines {
        let (problem, solver) = (baseline.problem.as_str(), baseline.solver.as_str());
        if lines.iter().any(|line| (line.problem, line.solver) == (problem, solver)) {
            continue;
        }
        let of = |start: &str| {
            let same = |b: &&Baseline| b.problem == problem && b.solver == solver;
            size.baselines.iter().filter(same).find(|b| b.start == start)
        };
        lines.push(Line { problem, solver, starts: ["cold", "warm"].map(of) });
    }
    lines
}

/// Sentences that follow from the table, size by size, and the remarks.
pub fn findings(sizes: &Sizes) -> Vec<String> {
    let verdicts = sizes.rows.iter().map(|size| verdict(size.unknowns, &size.baselines));
    verdicts.chain(sizes.notes.iter().cloned()).collect()
}
