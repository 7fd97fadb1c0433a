//! The records of all scenes as the main report shows them.

use std::collections::BTreeMap;

use super::digits::or_dash;
use super::front::sentence;
use super::picture::picture;
use super::record::{Point, Trade};
use super::records::Records;
use super::table::{ERRORS, Figure, costs, front, further, skipped};
use super::target::Target;
use super::verdict::{self, certificate, knob_values};
use crate::baseline;
use crate::baseline::Baseline;
use signorini_draw::{Column, Table, TradePanel, TradeStudy, Tradeoff};

/// The scene whose study is the example, where there is one of it.
const EXAMPLE: &str = "levee";

pub fn section(records: &Records) -> Tradeoff {
    let scenes = scenes(records);
    Tradeoff {
        targets: [&records.host, &records.m4f].into_iter().filter_map(|of| target(of)).collect(),
        findings: certificate(&records.host).into_iter().collect(),
        sizes: records.sizes.as_ref().map(baseline::table).unwrap_or_default(),
        of_sizes: records.sizes.as_ref().map(baseline::findings).unwrap_or_default(),
        scenes: scenes.iter().map(panel).collect(),
    }
}

/// What the studies on one target say together; nothing where there is none.
fn target(trades: &[Trade]) -> Option<TradeStudy> {
    let example = trades.iter().find(|trade| trade.scene == EXAMPLE).or(trades.first())?;
    let knobs = verdict::table(&knob_values(trades), example.target);
    let further = vec![("Which choices pay, counted over all scenes".to_owned(), knobs)];
    Some(TradeStudy { front: taken(trades), further, notes: Vec::new(), ..study(example) })
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

/// A row for each scene of a target: what to take there and, on the host, how much longer general solvers take.
fn taken(trades: &[Trade]) -> Table {
    let mut columns = vec![
        Column::words("scene", |trade: &&Trade| trade.scene.clone()),
        Column::words("take", |trade: &&Trade| recommended(trade, |point| point.name.clone())),
    ];
    let number = |&(name, text): &Figure| {
        Column::number(name, move |trade: &&Trade| recommended(trade, |point| text(trade, point)))
    };
    let target = trades.first().map_or(Target::Host, |trade| trade.target);
    columns.extend(ERRORS.iter().chain(costs(target)).map(number));
    if target == Target::Host {
        columns.extend(OTHERS.map(|(solver, title)| {
            Column::number(solver, move |trade: &&Trade| or_dash(warm_ratio(trade, solver), times))
                .titled(title)
        }));
    }
    Table::new(&columns, trades)
}

/// General solvers, with what their columns say.
const OTHERS: [(&str, &str); 2] = [
    ("Clarabel", "Clarabel, condensed, warm: cycles over the kernel’s"),
    ("OSQP", "OSQP, condensed, warm: cycles over the kernel’s"),
];

/// The words of `text` on the recommended setting; a dash where there is none.
fn recommended(trade: &Trade, text: impl FnOnce(&Point) -> String) -> String {
    or_dash(trade.recommendation.point.as_ref(), text)
}

/// Cycles of a warm solve of the condensed problem over those of the kernel.
fn warm_ratio(trade: &Trade, solver: &str) -> Option<f64> {
    let same = |found: &&Baseline| {
        found.solver == solver && found.problem == "condensed" && found.start == "warm"
    };
    trade.baselines.iter().find(same).map(|found| found.ratio)
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
        let [host, on_board] = &found.targets[..] else { panic!("{:?}", found.targets) };
        let [levee, pit] = &host.front.rows[..] else { panic!("{:?}", host.front) };
        assert_eq!((levee.cells.len(), &*levee.cells[0]), (9, "levee"));
        assert_eq!(pit.cells[7..], ["24.0×", "150×"]);
        assert!(host.picture.title.starts_with("levee: error over cost"));
        assert_eq!(on_board.front.rows.len(), 1);
        assert_ne!(on_board.front.rows[0].cells[1], "–");
        assert_eq!(found.scenes[1].studies.len(), 2);
        let page = html(&Report { tradeoff: Some(found), ..Report::default() });
        assert_eq!(page.matches("<details class=\"card\">").count(), 2);
        assert!(page.contains("On the Cortex-M4F") && page.contains("Speed for accuracy"));
        assert!(!page.contains("NaN"));
    }

    #[test]
    fn what_would_not_fit_a_board_has_no_numbers_there() {
        let mut board = Trade { target: Target::M4f, ..trade("pit", 8) };
        board.recommendation.point = None;
        board.baselines.clear();
        let found = section(&Records { m4f: vec![board], ..Records::default() });
        assert_eq!(found.targets[0].front.rows[0].cells[1..], ["–"; 7]);
    }

    #[test]
    fn without_a_record_the_section_says_how_to_get_one() {
        let found = section(&Records::default());
        let page = html(&Report { tradeoff: Some(found), ..Report::default() });
        assert!(page.contains("No committed trade record: run <code>signorini trade</code>"));
    }
}
