//! The study of sizes as a table.

use comfy_table::{CellAlignment, ContentArrangement, Table, presets};

use super::verdict::verdict;
use super::{Size, Sizes};
use crate::baseline::record::Baseline;

const HEADER: [&str; 12] = [
    "unknowns",
    "problem",
    "solver",
    "cold kcyc",
    "±",
    "iter",
    "ratio",
    "warm kcyc",
    "±",
    "iter",
    "ratio",
    "error/target",
];

/// One line a solver and size.
pub fn table(sizes: &Sizes) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING);
    table.set_content_arrangement(ContentArrangement::Disabled).set_header(HEADER);
    for size in &sizes.rows {
        lines(size).into_iter().for_each(|line| {
            table.add_row(line);
        });
    }
    for column in table.column_iter_mut().skip(3) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    format!(
        "Other solvers on the same matrices, at equal error: {}\n\
         Ratio: to the kernel's fastest in f64 on that problem; ±: (largest − smallest)/median.\n\
         {table}\n",
        sizes.title
    )
}

/// What the table says, size by size, and the remarks.
pub fn findings(sizes: &Sizes) -> Vec<String> {
    let verdicts = sizes.rows.iter().map(|size| verdict(size.unknowns, &size.baselines));
    verdicts.chain(sizes.notes.iter().cloned()).collect()
}

fn lines(size: &Size) -> Vec<Vec<String>> {
    let mut names: Vec<(&str, &str)> = Vec::new();
    for baseline in &size.baselines {
        let name = (baseline.problem.as_str(), baseline.solver.as_str());
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names.into_iter().map(|(problem, solver)| line(size, problem, solver)).collect()
}

fn line(size: &Size, problem: &str, solver: &str) -> Vec<String> {
    let of = |start: &str| {
        let mut all = size.baselines.iter();
        all.find(|b| b.problem == problem && b.solver == solver && b.start == start)
    };
    let both = [of("cold"), of("warm")];
    let unknowns = both.iter().flatten().next().map_or(0, |b| b.unknowns);
    let mut line = vec![unknowns.to_string(), problem.to_owned(), solver.to_owned()];
    both.iter().for_each(|baseline| line.extend(figures(*baseline)));
    let errors = both.iter().flatten().map(|b| b.algebraic_error / b.target);
    line.push(format!("{:.0e}", errors.fold(0.0, f64::max)));
    line
}

fn figures(baseline: Option<&Baseline>) -> [String; 4] {
    let Some(b) = baseline else { return std::array::from_fn(|_| "–".to_owned()) };
    [
        format!("{:.1}", 1e-3 * b.cycles),
        format!("{:.0} %", 100.0 * b.cycles_spread),
        b.iterations.to_string(),
        format!("{:.2}", b.ratio),
    ]
}
