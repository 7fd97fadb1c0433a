//! The records of all scenes as the main report shows them.

use std::collections::BTreeMap;

use super::digits::or_dash;
use super::front::sentence;
use super::picture::picture;
use super::record::{Point, Trade};
use super::records::Records;
use super::table::{ERRORS, costs, front, further, skipped};
use super::target::Target;
use super::verdict::{certificate, knob_values, sentences};
use crate::baseline;
use crate::baseline::Baseline;
use signorini_draw::{Column, Table, TradePanel, TradeStudy, Tradeoff, plain};

pub fn section(records: &Records) -> Tradeoff {
    let all = || records.host.iter().chain(&records.m4f);
    let mut findings = sentences(&knob_values(all()));
    findings.extend(certificate(&records.host));
    let scenes = scenes(records);
    Tradeoff {
        summary: summary(&scenes),
        findings,
        sizes: records.sizes.as_ref().map(baseline::table).unwrap_or_default(),
        of_sizes: records.sizes.as_ref().map(baseline::findings).unwrap_or_default(),
        scenes: scenes.iter().map(panel).collect(),
    }
}

/// A scene by its name: its study on the host and that on the M4F.
type Scene<'r> = (&'r str, [Option<&'r Trade>; 2]);

/// The scenes of both targets in the order of their names.
fn scenes(records: &Records) -> Vec<Scene<'_>> {
    let mut scenes = BTreeMap::<&str, [Option<&Trade>; 2]>::new();
    for (at, trades) in [&records.host, &records.m4f].into_iter().enumerate() {
        for trade in trades {
            scenes.entry(&trade.scene).or_default()[at].get_or_insert(trade);
        }
    }
    scenes.into_iter().collect()
}

/// A row for each scene: what to take, and how much longer general solvers take.
fn summary(scenes: &[Scene]) -> Table {
    let number = |name: &str, at: usize, text: fn(&Trade, &Point) -> String| {
        Column::number(name, move |(_, on): &&Scene| taken(on[at], text))
    };
    let setting = |name: &str, at: usize| {
        Column::words(name, move |(_, on): &&Scene| taken(on[at], |_, point| point.name.clone()))
    };
    let mut columns = vec![
        Column::words("scene", |(name, _): &&Scene| (*name).to_owned()),
        setting("take on the host", 0),
    ];
    columns.extend(ERRORS.map(|(name, text)| number(name, 0, text)));
    columns.push(number("cycles/unknown", 0, |_, point| plain(point.cycles_per_unknown)));
    columns.push(setting("take on the M4F", 1));
    columns.extend(costs(Target::M4f).iter().map(|&(name, text)| {
        Column::number(name, move |(_, on): &&Scene| taken(on[1], |_, point| text(point)))
    }));
    columns.extend(["Clarabel", "OSQP"].map(|solver| {
        Column::number(solver, move |(_, on): &&Scene| or_dash(warm_ratio(on[0], solver), times))
    }));
    Table::new(&columns, scenes)
}

/// The words of `text` on the recommended setting; a dash where there is none.
fn taken(trade: Option<&Trade>, text: impl FnOnce(&Trade, &Point) -> String) -> String {
    let both = trade.and_then(|trade| Some((trade, trade.recommendation.point.as_ref()?)));
    or_dash(both, |(trade, point)| text(trade, point))
}

/// Cycles of a warm solve of the condensed problem over those of the kernel.
fn warm_ratio(trade: Option<&Trade>, solver: &str) -> Option<f64> {
    let same = |found: &&Baseline| {
        found.solver == solver && found.problem == "condensed" && found.start == "warm"
    };
    trade?.baselines.iter().find(same).map(|found| found.ratio)
}

fn times(ratio: f64) -> String {
    format!("{}×", super::digits::cost(ratio))
}

fn panel((name, on): &Scene) -> TradePanel {
    let trades = || on.iter().flatten();
    TradePanel {
        name: (*name).to_owned(),
        title: trades().next().map(|trade| trade.title.clone()).unwrap_or_default(),
        studies: trades().map(|trade| study(trade)).collect(),
    }
}

fn study(trade: &Trade) -> TradeStudy {
    let truth = format!("Errors are distances to {}", trade.truth);
    let taken = trade.recommendation.point.as_ref().map(|point| sentence(trade, point));
    TradeStudy {
        heading: format!("On the {}", trade.target.title()),
        recommendation: taken.unwrap_or_else(|| trade.recommendation.text.clone()),
        notes: [truth].into_iter().chain(skipped(trade)).collect(),
        picture: picture(trade),
        front: front(trade),
        further: further(trade).into(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::trade;
    use super::*;
    use signorini_draw::{Report, html};

    #[test]
    fn a_row_a_scene_with_both_targets() {
        let board = Trade { target: Target::M4f, ..trade("pit", 8) };
        let records = Records {
            host: vec![trade("levee", 8), trade("pit", 8)],
            m4f: vec![board],
            sizes: None,
        };
        let found = section(&records);
        let [levee, pit] = &found.summary.rows[..] else { panic!("{:?}", found.summary) };
        let (levee, pit) = (&levee.cells, &pit.cells);
        assert_eq!((levee.len(), &*levee[0], &*levee[6]), (12, "levee", "–"));
        assert_eq!((&*pit[10], &*pit[11]), ("24.0×", "150×"));
        assert_ne!(pit[6], "–");
        assert_eq!(found.scenes[1].studies.len(), 2);
        let page = html(&Report { tradeoff: Some(found), ..Report::default() });
        assert_eq!(page.matches("<details").count(), 2);
        assert!(page.contains("On the Cortex-M4F") && page.contains("Speed for accuracy"));
        assert!(!page.contains("NaN"));
    }

    #[test]
    fn what_would_not_fit_a_board_has_no_numbers_there() {
        let mut board = Trade { target: Target::M4f, ..trade("pit", 8) };
        board.recommendation.point = None;
        board.baselines.clear();
        let found = section(&Records { m4f: vec![board], ..Records::default() });
        assert_eq!(found.summary.rows[0].cells[1..], ["–"; 11]);
    }

    #[test]
    fn without_a_record_the_section_says_how_to_get_one() {
        let found = section(&Records::default());
        let page = html(&Report { tradeoff: Some(found), ..Report::default() });
        assert!(page.contains("No committed trade record: run <code>signorini trade</code>"));
    }
}
