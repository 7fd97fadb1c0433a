//! The Pareto front, and the setting to take.

use super::digits::whole;
use super::record::{Point, Recommendation, Trade};
use super::reference::EXACT;
use signorini_scene::Goal;

/// The user's wish: a budget, an error.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Wish {
    /// Most cycles of a tick on the host, most instructions on a board.
    pub budget: Option<f64>,
    /// Largest energy error.
    pub error: Option<Goal>,
}

impl Point {
    /// Cost of a tick: cycles on the host, instructions on a board.
    pub fn cost(&self) -> f64 {
        self.instructions.map_or(self.cycles, |instructions| instructions as f64)
    }
}

/// Marks the points than which no other is better in both cost and error.
pub fn mark(points: &mut [Point]) {
    let places: Vec<_> = points.iter().map(|point| (point.cost(), point.error.energy)).collect();
    for (point, &(cost, error)) in points.iter_mut().zip(&places) {
        point.pareto = !places.iter().any(|&(other, less)| other < cost && less < error);
    }
}

/// Slack within which an error counts as the best that a mesh allows for.
const AS_GOOD: f64 = 1.1;

/// The point for a wish: the cheapest that is accurate enough, the most accurate that is cheap enough. Without a wish
/// the cheapest that is as accurate as the scene's own mesh, solved in full, and says so, where any has a bound.
pub fn choose<'p>(trade: &'p Trade, wish: &Wish) -> Option<&'p Point> {
    let certified =
        *wish == Wish::default() && trade.points.iter().any(|point| point.bound.is_some());
    let points = || eligible(trade).filter(move |point| !certified || point.bound.is_some());
    let cheap = |point: &&Point| wish.budget.is_none_or(|budget| point.cost() <= budget);
    let most = match wish.error {
        Some(error) => Some(error.most(Some(trade.energy))),
        None if wish.budget.is_some() => None,
        None => {
            let own = points().filter(|point| point.is_on_own_mesh());
            own.map(|point| AS_GOOD * point.error.energy).min_by(f64::total_cmp)
        }
    };
    let good = |point: &&Point| most.is_none_or(|most| point.error.energy <= most);
    points().filter(cheap).filter(good).min_by(|a, b| match most {
        Some(_) => by_cost(a, b).then(by_error(a, b)),
        None => by_error(a, b).then(by_cost(a, b)),
    })
}

/// Points whose setting firmware can have too; where there is no other, all.
fn eligible(trade: &Trade) -> impl Iterator<Item = &Point> {
    let bakeable = |point: &Point| point.scalar != "f32+f64";
    let any = trade.points.iter().any(bakeable);
    trade.points.iter().filter(move |point| !any || bakeable(point))
}

fn by_cost(a: &Point, b: &Point) -> std::cmp::Ordering {
    a.cost().total_cmp(&b.cost())
}

fn by_error(a: &Point, b: &Point) -> std::cmp::Ordering {
    a.error.energy.total_cmp(&b.error.energy)
}

/// The point with its sentence; without one, what comes nearest.
pub fn recommend(trade: &Trade, wish: &Wish) -> Recommendation {
    match choose(trade, wish) {
        Some(point) => Recommendation { text: sentence(trade, point), point: Some(point.clone()) },
        None => Recommendation { text: nothing(trade, wish), point: None },
    }
}

/// Cost and use of `point`, in words.
pub fn sentence(trade: &Trade, point: &Point) -> String {
    let Point { name, error, bound, .. } = point;
    let certified = match (bound, error.combined) {
        (Some(bound), Some(combined)) => format!(
            "; its certified pair s, τ is off by {}, at most {} guaranteed",
            part(combined, trade.energy),
            part(*bound, trade.energy)
        ),
        _ => "; not certified".to_owned(),
    };
    let force = match trade.force {
        0.0 => String::new(),
        force => format!("; contact force within {}", part(error.force, force)),
    };
    // Next to a sharp bound, the error of what stands for the truth shows.
    let by = match trade.truth.as_str() {
        EXACT => "",
        _ => " Errors are distances to a finer solution, which has an error of its own.",
    };
    format!(
        "For {} {} a tick take {name}: energy error {}{certified}{force}.{by}",
        whole(point.cost()),
        trade.target.cost_unit(),
        part(error.energy, trade.energy)
    )
}

/// In percent of the whole; where that is no measure, as it is.
fn part(part: f64, whole: f64) -> String {
    let percent = 100.0 * part / whole.abs();
    if percent < 1000.0 { format!("{percent:.2} %") } else { format!("{part:.3e}") }
}

fn nothing(trade: &Trade, wish: &Wish) -> String {
    let cheapest = eligible(trade).min_by(|a, b| by_cost(a, b));
    let best = eligible(trade).min_by(|a, b| by_error(a, b));
    let (Some(cheapest), Some(best)) = (cheapest, best) else {
        return "No setting could be measured.".to_owned();
    };
    let unit = trade.target.cost_unit();
    let within = wish.budget.map(|budget| format!("within {} {unit}", whole(budget)));
    let asked = match (within, wish.error) {
        (Some(within), Some(_)) => format!("accurate enough {within}"),
        (Some(within), None) => within,
        _ => "accurate enough".to_owned(),
    };
    format!(
        "No setting measured is {asked}: the cheapest, {}, takes {} {unit} with an error of {:.3e}; the most accurate, {}, \
         takes {} with {:.3e}.",
        cheapest.name,
        whole(cheapest.cost()),
        cheapest.error.energy,
        best.name,
        whole(best.cost()),
        best.error.energy
    )
}
