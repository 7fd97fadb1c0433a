//! The main job's tables, for the terminal and for the report.

use super::case::KnownScene;
use super::checks::Check;
use super::convergence::ConvergenceStudy;
use super::{OF_FLUX, OF_GRADIENT, OF_U};
use crate::cycles::median_and_spread;
use signorini_certify::ErrorBound;
use signorini_draw::{self as report, Column, Table};
use signorini_solve::norms::Errors;

fn of_scene<'c>(
    name: &str,
    cell: impl Fn(&KnownScene) -> String + 'c,
) -> Column<'c, &'c KnownScene> {
    Column::number(name, move |case: &&KnownScene| cell(case))
}

/// A distance to the exact solution, where one is known.
fn error(name: &str, pick: fn(&Errors) -> f64) -> Column<'_, &KnownScene> {
    of_scene(name, move |case| or_none(case.f64.certified.errors.as_ref().map(pick)))
}

/// A bound, where there is one.
fn bound(name: &str, pick: fn(&ErrorBound) -> f64) -> Column<'_, &KnownScene> {
    let text = move |bound: ErrorBound| format!("{:.2e}", pick(&bound));
    of_scene(name, move |case| case.f64.certified.bound.map_or("none".to_owned(), text))
}

fn or_none(value: Option<f64>) -> String {
    value.map_or("–".to_owned(), |value| format!("{value:.2e}"))
}

fn or_dash(count: usize) -> String {
    if count == 0 { "–".to_owned() } else { count.to_string() }
}

/// The main table: a row for each scene, tests with an exact solution last.
pub fn main_table(cases: &[KnownScene]) -> Table {
    let columns = [
        Column::words("scene", |case: &&KnownScene| case.name.clone()),
        of_scene("tri", |case| or_dash(case.cells[0])).titled("triangles"),
        of_scene("quad", |case| or_dash(case.cells[1])).titled("quads"),
        of_scene("unknowns", |case| case.unknowns.to_string()),
        of_scene("active", |case| format!("{}/{}", case.contact[0], case.contact[1]))
            .titled("active contact edges"),
        of_scene("∫λ", |case| format!("{:.5e}", case.force)).titled("contact force ∫λ"),
        of_scene("sweeps", |case| case.f64.certified.sweeps.to_string()),
        of_scene("|u−faer| f64", |case| format!("{:.0e}", case.f64.distance))
            .titled("largest distance of u to faer’s, over the range of u, f64"),
        of_scene("f32", |case| format!("{:.0e}", case.f32.distance)).titled("the same, f32"),
        error("|u−u_h|₁", |e| e.h1).titled(OF_GRADIENT),
        error("‖u−u_h‖", |e| e.l2).titled(OF_U),
        error("‖σ−σ_h‖", |e| e.flux).titled(OF_FLUX),
        of_scene("error", |case| or_none(case.f64.certified.error()))
            .titled("true error of s, τ (energy norms)"),
        bound("bound", |b| b.total).titled("bound on the error of s, τ (energy norms)"),
        bound("u_h bound", |b| b.of_u)
            .titled("bound on the gradient error of u_h, weighed by A (energy norm)"),
        of_scene("cyc/DOF/sweep", |case| {
            format!("{:.1} / {:.1}", case.f64.cost.sweep, case.f32.cost.sweep)
        })
        .titled("cycles / unknown / sweep, f64 / f32"),
        of_scene("kcyc/DOF", |case| {
            let [double, single] = [&case.f64, &case.f32].map(|run| 1e-3 * run.solve_cycles);
            format!("{double:.1} / {single:.1}")
        })
        .titled("kilocycles / unknown, f64 / f32"),
    ];
    let is_test = |case: &&KnownScene| case.f64.certified.errors.is_some();
    let (tests, real): (Vec<_>, Vec<_>) = cases.iter().partition(is_test);
    let cases = [real, tests].concat();
    Table::checked(&columns, cases, |case| case.checks.iter().all(|check| check.passed))
}

/// The main table with what its columns mean, for the terminal.
pub fn scenes(cases: &[KnownScene]) -> String {
    let over_error: Vec<f64> =
        cases.iter().flat_map(|case| case.outputs.over_error.iter().copied()).collect();
    format!(
        "Standard scenes: kernel in f64 and f32 against the faer reference and exact solutions\n{}\
         bound: guaranteed, in the energy norm, for the continuous s with the flux τ; error: their true one; \
         u_h bound: for the means over the edges, in ‖A^½∇(u − u_h)‖\n\
         |u−u_h|₁: gradient error of u, unweighed; ‖u−u_h‖ and ‖σ−σ_h‖: mean-square errors of u and of \
         the flux (L²)\n\
         intervals of outputs: half-widths {:.1} times the true errors in the median of {} with an exact value\n\
         cycles in f64 / f32: {}; a sweep reads {:.0} / {:.0} bytes and does {:.1} multiply-adds an \
         unknown, and takes {:.1} / {:.1} times as long as reading the matrix alone (medians)\n\
         all are steady: scenes whose materials store u are left out, `signorini tick` steps them in time",
        main_table(cases).text(),
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

fn middle(values: Vec<f64>) -> f64 {
    median_and_spread(values.into_iter().filter(|value| value.is_finite())).0
}

/// Errors on the finest grid, and rates over all of them.
pub fn convergence(studies: &[ConvergenceStudy]) -> String {
    type Finest<'s> = (&'s ConvergenceStudy, &'s Errors, f64);
    let rate = |at: usize| {
        Column::number("rate", move |(study, ..): &Finest| format!("{:.3}", study.rates[at]))
    };
    let columns = [
        Column::words("grid", |(study, ..): &Finest| study.name.clone()),
        Column::number("n", |(study, ..): &Finest| {
            let [first, last] = [study.n.first(), study.n.last()].map(|n| n.copied().unwrap_or(0));
            format!("{first}…{last}")
        }),
        Column::number("|u−u_h|₁", |(_, errors, _): &Finest| format!("{:.5e}", errors.h1)),
        rate(0),
        Column::number("‖u−u_h‖", |(_, errors, _): &Finest| format!("{:.5e}", errors.l2)),
        rate(1),
        Column::number("‖σ−σ_h‖", |(_, errors, _): &Finest| format!("{:.5e}", errors.flux)),
        rate(2),
        Column::number("∫λ", |(.., force): &Finest| format!("{force:.6}")),
    ];
    let finest = studies
        .iter()
        .filter_map(|study| Some((study, study.errors.last()?, *study.force.last()?)));
    let passed = |(study, ..): &Finest| study.checks.iter().all(|check| check.passed);
    let table = Table::checked(&columns, finest, passed).text();
    format!(
        "Convergence on grids of 2n × n squares, or trapezoids in their place: errors at the largest n, rates \
         over all\n{}",
        table.trim_end()
    )
}

/// A line for each claim, with the subject that comes nearest to breaking it.
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
