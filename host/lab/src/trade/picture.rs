//! A study as the report draws it: error over cost, the front named.

use std::collections::BTreeSet;

use super::digits;
use super::record::{Point, Trade};
use signorini_draw::{ParetoPlot, ParetoPoint};

/// Colours that the picture tells apart.
const MOST_SERIES: usize = 6;

/// The groups that may give points their colour, the most telling first.
const GROUPS: [fn(&Point) -> String; 4] = [
    |point| format!("{}, {}", point.model, point.refinement()),
    Point::refinement,
    |point| point.model.clone(),
    |point| point.scalar.clone(),
];

pub fn picture(trade: &Trade) -> ParetoPlot {
    let (series, group) = series(&trade.points);
    let recommended = trade.recommendation.point.as_ref();
    let point = |point: &Point| ParetoPoint {
        name: point.name.clone(),
        note: note(trade, point),
        cost: point.cost(),
        error: point.error.energy,
        bound: point.bound,
        series: series.iter().position(|name| *name == group(point)).unwrap_or(0),
        front: point.pareto,
        recommended: recommended.is_some_and(|taken| taken.name == point.name),
    };
    ParetoPlot {
        title: format!("{}: error over cost on the {}", trade.scene, trade.target.title()),
        cost: format!("{} a tick", trade.target.cost_unit()),
        size: trade.energy,
        points: trade.points.iter().map(point).collect(),
        series,
    }
}

/// The names of the colours, and which is a point's.
fn series(points: &[Point]) -> (Vec<String>, fn(&Point) -> String) {
    let names = |group: fn(&Point) -> String| {
        let names: BTreeSet<String> = points.iter().map(group).collect();
        names.into_iter().collect::<Vec<String>>()
    };
    let candidates = GROUPS.map(|group| (names(group), group));
    let telling = |found: &(Vec<String>, _)| (2..=MOST_SERIES).contains(&found.0.len());
    candidates
        .into_iter()
        .find(telling)
        .unwrap_or((vec!["a setting".to_owned()], |_| "a setting".to_owned()))
}

/// `12 300 cycles a tick, error 1.23 %, bound 4.56 %`
fn note(trade: &Trade, point: &Point) -> String {
    let cost = digits::cost(point.cost());
    let error = digits::percent(point.error.energy, trade.energy);
    let bound = digits::or_dash(point.bound, |bound| digits::percent(bound, trade.energy));
    format!("{cost} {} a tick, error {error} %, bound {bound} %", trade.target.cost_unit())
}

#[cfg(test)]
mod tests {
    use super::super::tests::trade;
    use super::*;
    use signorini_draw::{escape, pareto_file};

    fn drawn(trade: &Trade) -> String {
        let svg = pareto_file(&picture(trade));
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        svg
    }

    #[test]
    fn every_point_of_the_front_is_named() {
        for count in [1, 2, 12, 60] {
            let trade = trade("levee", count);
            let svg = drawn(&trade);
            let front = trade.points.iter().filter(|point| point.pareto);
            for point in front {
                assert!(svg.contains(&format!(">{}<", escape(&point.name))), "{}", point.name);
            }
            assert_eq!(svg.matches("class=\"ring\"").count(), 2, "in the picture and its legend");
        }
    }

    #[test]
    fn points_without_bound_cost_or_error_do_no_harm() {
        let mut trade = trade("levee", 20);
        trade.points.iter_mut().for_each(|point| point.bound = None);
        trade.recommendation.point = None;
        let svg = drawn(&trade);
        assert!(!svg.contains("certified bound") && !svg.contains("recommended"));
        trade.points[0].error.energy = f64::NAN;
        trade.points[1].error.energy = 0.0;
        trade.energy = 0.0;
        assert!(!drawn(&trade).contains(" %</text>"), "percents of nothing");
        trade.points.iter_mut().for_each(|point| {
            (point.cycles, point.instructions) = (f64::NAN, None);
        });
        assert!(drawn(&trade).contains("no setting with a cost and an error"));
        trade.points.clear();
        drawn(&trade);
    }

    #[test]
    fn colours_tell_at_most_six_groups_apart() {
        let mut trade = trade("levee", 60);
        assert_eq!(picture(&trade).series.len(), 4, "two models, two levels");
        for (at, point) in trade.points.iter_mut().enumerate() {
            point.level = at as u32;
        }
        assert_eq!(picture(&trade).series, ["condensed", "full"]);
        trade.points.truncate(1);
        assert_eq!(picture(&trade).series, ["a setting"]);
    }
}
