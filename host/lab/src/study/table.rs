//! The main job's tables, for the terminal and for the report.

use comfy_table::{CellAlignment, ContentArrangement, Table, presets};

use super::checks::Check;
use super::convergence::ConvergenceStudy;
use super::known::KnownScene;
use super::{OF_FLUX, OF_GRADIENT, OF_U};
use signorini_certify::ErrorBound;
use signorini_draw as report;
use signorini_solve::norms::Errors;

const HEADER: [&str; 17] = [
    "scene",
    "tri",
    "quad",
    "unknowns",
    "active",
    "∫λ",
    "sweeps",
    "|u−faer| f64",
    "f32",
    "|u−u_h|₁",
    "‖u−u_h‖",
    "‖σ−σ_h‖",
    "error",
    "bound",
    "u_h bound",
    "cyc/DOF/sweep",
    "kcyc/DOF",
];

/// The same columns for readers of the report, where a name may take several lines.
const REPORT_HEADER: [&str; 17] = [
    "scene",
    "triangles",
    "quads",
    "unknowns",
    "active contact edges",
    "contact force ∫λ",
    "sweeps",
    "largest distance of u to faer’s, over the range of u, f64",
    "the same, f32",
    OF_GRADIENT,
    OF_U,
    OF_FLUX,
    "true error of s, τ (energy norms)",
    "bound on the error of s, τ (energy norms)",
    "bound on the gradient error of u_h, weighed by A (energy norm)",
    "cycles / unknown / sweep, f64 / f32",
    "kilocycles / unknown, f64 / f32",
];

fn row(case: &KnownScene) -> Vec<String> {
    let certified = &case.f64.certified;
    let or_none =
        |value: Option<f64>| value.map_or("–".to_owned(), |value| format!("{value:.2e}"));
    let error = |pick: fn(&Errors) -> f64| or_none(certified.errors.as_ref().map(pick));
    let bound = |pick: fn(&ErrorBound) -> f64| {
        certified.bound.map_or("none".to_owned(), |bound| format!("{:.2e}", pick(&bound)))
    };
    let or_dash = |count: usize| if count == 0 { "–".to_owned() } else { count.to_string() };
    vec![
        case.name.clone(),
        or_dash(case.cells[0]),
        or_dash(case.cells[1]),
        case.unknowns.to_string(),
        format!("{}/{}", case.contact[0], case.contact[1]),
        format!("{:.5e}", case.force),
        certified.sweeps.to_string(),
        format!("{:.0e}", case.f64.distance),
        format!("{:.0e}", case.f32.distance),
        error(|e| e.h1),
        error(|e| e.l2),
        error(|e| e.flux),
        or_none(certified.error()),
        bound(|bound| bound.total),
        bound(|bound| bound.of_u),
        format!("{:.1} / {:.1}", case.f64.cost.sweep, case.f32.cost.sweep),
        format!("{:.1} / {:.1}", 1e-3 * case.f64.solve_cycles, 1e-3 * case.f32.solve_cycles),
    ]
}

fn passed(case: &KnownScene) -> bool {
    case.checks.iter().all(|check| check.passed)
}

/// One line a scene.
pub fn scenes(cases: &[KnownScene]) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(HEADER.iter().copied().chain(["ok"]));
    for case in cases {
        let mark = if passed(case) { "yes" } else { "NO" };
        table.add_row(row(case).into_iter().chain([mark.to_owned()]));
    }
    align(&mut table);
    let over_error: Vec<f64> =
        cases.iter().flat_map(|case| case.outputs.over_error.iter().copied()).collect();
    format!(
        "Standard scenes: kernel in f64 and f32 against the faer reference and exact solutions\n{table}\n\
         bound: guaranteed, in the energy norm, for the continuous s with the flux τ; error: their true one; \
         u_h bound: for the means over the edges, in ‖A^½∇(u − u_h)‖\n\
         |u−u_h|₁: gradient error of u, unweighed; ‖u−u_h‖ and ‖σ−σ_h‖: mean-square errors of u and of \
         the flux (L²)\n\
         intervals of outputs: half-widths {:.1} times the true errors in the median of {} with an exact value\n\
         cycles in f64 / f32: {}; a sweep reads {:.0} / {:.0} bytes and does {:.1} multiply-adds an \
         unknown, and takes {:.1} / {:.1} times as long as reading the matrix alone (medians)",
        middle(over_error.clone()),
        over_error.len(),
        crate::cycles::METHOD,
        median(cases, |case| case.f64.cost.bytes),
        median(cases, |case| case.f32.cost.bytes),
        median(cases, |case| case.f64.cost.multiply_adds),
        median(cases, |case| case.f64.cost.sweep / case.f64.cost.stream),
        median(cases, |case| case.f32.cost.sweep / case.f32.cost.stream),
    )
}

fn median(cases: &[KnownScene], pick: impl Fn(&KnownScene) -> f64) -> f64 {
    middle(cases.iter().map(pick).collect())
}

fn middle(mut values: Vec<f64>) -> f64 {
    values.retain(|value| value.is_finite());
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

/// Errors on the finest grid, and rates over all of them.
pub fn convergence(studies: &[ConvergenceStudy]) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_content_arrangement(ContentArrangement::Disabled);
    table.set_header([
        "grid",
        "n",
        "|u−u_h|₁",
        "rate",
        "‖u−u_h‖",
        "rate",
        "‖σ−σ_h‖",
        "rate",
        "∫λ",
        "ok",
    ]);
    for study in studies {
        let (Some(errors), Some(force)) = (study.errors.last(), study.force.last()) else {
            continue;
        };
        let [h1, l2, flux] = study.rates.map(|rate| format!("{rate:.3}"));
        let [first, last] = [study.n.first(), study.n.last()].map(|n| n.copied().unwrap_or(0));
        let passed = study.checks.iter().all(|check| check.passed);
        table.add_row([
            study.name.clone(),
            format!("{first}…{last}"),
            format!("{:.5e}", errors.h1),
            h1,
            format!("{:.5e}", errors.l2),
            l2,
            format!("{:.5e}", errors.flux),
            flux,
            format!("{force:.6}"),
            if passed { "yes" } else { "NO" }.to_owned(),
        ]);
    }
    align(&mut table);
    format!(
        "Convergence on grids of 2n × n squares, or trapezoids in their place: errors at the largest n, rates \
         over all\n{table}"
    )
}

fn align(table: &mut Table) {
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
}

/// The same table for the report.
pub fn for_report(cases: &[KnownScene]) -> report::Table {
    report::Table {
        header: REPORT_HEADER.map(str::to_owned).to_vec(),
        rows: cases
            .iter()
            .map(|case| report::TableRow { cells: row(case), passed: passed(case) })
            .collect(),
    }
}

/// One line a claim, with the subject that comes nearest to breaking it.
pub fn checks(all: &[&Check]) -> Vec<report::Check> {
    let mut claims: Vec<&str> = Vec::new();
    all.iter().for_each(|check| {
        if !claims.contains(&check.claim) {
            claims.push(check.claim);
        }
    });
    let worst = |claim: &&str| {
        let about = || all.iter().filter(|check| check.claim == *claim);
        let worst = about().max_by(|a, b| a.used.total_cmp(&b.used))?;
        Some(report::Check {
            claim: format!("{claim} ({} checks)", about().count()),
            found: format!("worst: {} ({})", worst.found, worst.subject),
            passed: about().all(|check| check.passed),
        })
    };
    claims.iter().filter_map(worst).collect()
}
