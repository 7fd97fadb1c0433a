//! A record as maps and a table of reasons.

use super::judge::Outcome;
use super::plan::remark;
use super::record::{Record, Row, heading, place};
use crate::record_file::word;
use crate::trade::digits::or_dash;
use signorini_draw::{Column, Extremes, ExtremesStudy, OutcomeMap, Square, Table, plain};

pub fn section(record: &Record) -> Extremes {
    let legend = record.definitions.iter();
    Extremes {
        summary: summary(record),
        legend: legend.map(|known| (word(&known.outcome), known.means.clone())).collect(),
        studies: record.studies().map(study).collect(),
        reasons: reasons(record),
    }
}

fn summary(record: &Record) -> String {
    format!("{} cases in {:.0} s: {}.", record.cases.len(), record.seconds, record.counts())
}

fn study(cases: &[Row]) -> ExtremesStudy {
    let Row { axis, axis2: across, .. } = &cases[0];
    let maps = match across {
        None => vec![(String::new(), strip(axis, cases))],
        Some(across) => {
            let map = |scalar: &str| (scalar.to_owned(), map(axis, across, scalar, cases));
            ["f64", "f32"].map(map).into()
        }
    };
    let rates = rates(cases).map_or(String::new(), |rates| format!("; {rates}"));
    let remark = remark(axis, across.as_deref()).to_owned() + &rates;
    ExtremesStudy { heading: heading(&cases[0]), remark, maps }
}

/// By which powers of the width the errors of u and σ fall between the two finest grids, in f64.
fn rates(cases: &[Row]) -> Option<String> {
    let of = |case: &Row| Some([case.value, case.error_u?, case.error_flux?]);
    let double = cases.iter().filter(|case| case.scalar == "f64");
    let all: Vec<_> = double.filter_map(of).collect();
    let [.., coarse, fine] = all[..] else { return None };
    let rate = |at: usize| (coarse[at] / fine[at]).ln() / (fine[0] / coarse[0]).ln();
    let [of_u, of_flux] = [1, 2].map(rate);
    Some(format!(
        "the error of ∇u falls with rate {of_u:.2}, that of the flux with rate {of_flux:.2}"
    ))
}

/// Columns along the axis, a row for each scalar.
fn strip(axis: &str, cases: &[Row]) -> OutcomeMap {
    let cases: Vec<&Row> = cases.iter().collect();
    let rows = ["f32", "f64"].map(str::to_owned).into();
    OutcomeMap {
        label: format!("outcomes over {axis}"),
        across: axis.split(':').next().unwrap_or(axis).to_owned(),
        ..squares(&cases, rows, |case| Some(case.scalar.clone()))
    }
}

/// Columns along the axis, rows along the other.
fn map(axis: &str, across: &str, scalar: &str, cases: &[Row]) -> OutcomeMap {
    let cases: Vec<&Row> = cases.iter().filter(|case| case.scalar == scalar).collect();
    let rows = distinct(cases.iter().filter_map(|case| case.value2));
    let rows = rows.into_iter().map(tick).collect();
    OutcomeMap {
        label: format!("outcomes over {axis} and {across} in {scalar}"),
        across: axis.to_owned(),
        up: across.to_owned(),
        ..squares(&cases, rows, |case| case.value2.map(tick))
    }
}

/// The cases by their place on the axis and by the name of their row.
fn squares(cases: &[&Row], rows: Vec<String>, name: impl Fn(&Row) -> Option<String>) -> OutcomeMap {
    let columns = distinct(cases.iter().map(|case| case.value));
    let square = |case: &&Row| {
        let column = columns.iter().position(|&value| value == case.value)?;
        let own = name(case)?;
        let row = rows.iter().position(|row| *row == own)?;
        Some(square([column, row], case))
    };
    OutcomeMap {
        columns: columns.iter().map(|&value| tick(value)).collect(),
        squares: cases.iter().filter_map(square).collect(),
        rows,
        ..OutcomeMap::default()
    }
}

fn distinct(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}

fn square(at: [usize; 2], case: &Row) -> Square {
    let ratio = case.error_over_bound.map(|ratio| format!("; error/bound {}", plain(ratio)));
    let note = if case.note.is_empty() { String::new() } else { format!(": {}", case.note) };
    Square {
        at,
        outcome: word(&case.outcome),
        text: case.sweeps.map_or(String::new(), abridged),
        words: format!(
            "{}: {}{note}{}",
            place(case),
            word(&case.outcome),
            ratio.unwrap_or_default()
        ),
    }
}

/// A count in at most four letters.
fn abridged(count: u32) -> String {
    match count {
        0..1000 => count.to_string(),
        1000..9950 => format!("{:.1}k", f64::from(count) / 1e3),
        9950..999_500 => format!("{:.0}k", f64::from(count) / 1e3),
        _ => format!("{:.1}M", f64::from(count) / 1e6),
    }
}

/// A place on an axis, as short as it can be told.
fn tick(value: f64) -> String {
    // Beside a whole number the difference counts.
    let (whole, beyond) = (value.round(), value - value.round());
    if (1.0..4.0).contains(&whole.abs()) && beyond != 0.0 && beyond.abs() <= 0.005 {
        let sign = if beyond < 0.0 { "−" } else { "+" };
        return format!("{}{sign}{}", tick(whole), tick(beyond.abs()));
    }
    // Too small for `plain`, whose powers of ten are normal numbers; those on the axes are powers of ten.
    let text = match value.is_subnormal() {
        true => plain(10_f64.powf(value.log10().round() + 300.0)).replace("10⁻", "10⁻³"),
        false => plain(two_digits(value)),
    };
    let (digits, power) = text.split_once('·').map_or((&*text, None), |(d, p)| (d, Some(p)));
    let digits = match digits.contains('.') {
        true => digits.trim_end_matches('0').trim_end_matches('.'),
        false => digits,
    };
    match (digits, power) {
        ("1", Some(power)) => power.to_owned(),
        (digits, Some(power)) => format!("{digits}·{power}"),
        (digits, None) => digits.to_owned(),
    }
}

/// Far from 1 two digits do.
fn two_digits(value: f64) -> f64 {
    let is_near = (1e-3..1e5).contains(&value.abs());
    if is_near { value } else { format!("{value:.1e}").parse().unwrap_or(value) }
}

fn reasons(record: &Record) -> Table {
    let columns = [
        Column::words("case", |case: &&Row| place(case)),
        Column::words("outcome", |case: &&Row| word(&case.outcome)),
        Column::number("error/bound", |case: &&Row| or_dash(case.error_over_bound, plain)),
        Column::number("sweeps", |case: &&Row| or_dash(case.sweeps, |sweeps| sweeps.to_string())),
        Column::words("reason", |case: &&Row| case.note.clone()),
    ];
    let mut cases: Vec<&Row> =
        record.cases.iter().filter(|case| case.outcome != Outcome::Correct).collect();
    cases.sort_by_key(|case| std::cmp::Reverse(case.outcome));
    Table::new(&columns, cases)
}

#[cfg(test)]
mod tests {
    use super::super::record::tests::fixture;
    use super::*;

    #[test]
    fn ticks_are_short() {
        let texts =
            [1e-12, 1e12, 1.0, 0.25, 1e-3, 2048.0, 1_048_576.0, -0.1, 0.0, 1e-320, 1.999_999]
                .map(tick);
        let expected =
            ["10⁻¹²", "10¹²", "1", "0.25", "0.001", "2048", "10⁶", "−0.1", "0", "10⁻³²⁰", "2−10⁻⁶"];
        assert_eq!(texts, expected);
        assert_eq!(
            [0, 999, 1234, 45_678, 1_000_000].map(abridged),
            ["0", "999", "1.2k", "46k", "1.0M"]
        );
    }

    #[test]
    fn a_map_a_scalar_for_pairs_and_a_strip_for_an_axis() {
        let found = section(&fixture());
        let [axis, pair] = &found.studies[..] else { panic!("{:?}", found.studies) };
        assert_eq!((axis.maps.len(), pair.maps.len()), (1, 2));
        assert_eq!(axis.maps[0].1.squares.len(), 8);
        let map = &pair.maps[1].1;
        assert_eq!((map.columns.len(), map.rows.len(), map.squares.len()), (2, 3, 6));
        assert_eq!(map.squares[3].at, [1, 1]);
        assert_eq!(found.reasons.rows.len(), 14);
        assert!(
            found.reasons.rows[0].cells[1] == "wrong"
                && found.reasons.rows[13].cells[1] == "certified-poor"
        );
    }

    #[test]
    fn rates_of_trapezoids_are_told() {
        let mut record = fixture();
        record.cases.truncate(2);
        for (at, case) in record.cases.iter_mut().enumerate() {
            let width = 0.5_f64.powi(at as i32);
            (case.value, case.error_u, case.error_flux) =
                (8.0 / width, Some(width.sqrt()), Some(3.0 * width));
        }
        let remark = section(&record).studies[0].remark.clone();
        assert!(
            remark.ends_with("∇u falls with rate 0.50, that of the flux with rate 1.00"),
            "{remark}"
        );
    }
}
