//! Warm ticks on this machine: how many exchanges and sweeps a model takes for inputs of the declared ranges.

use signorini_kernel::report::Ended;

use super::dense::Done;
use super::{condensed, full};
use crate::Bakes;
use signorini_problem::inputs::{InputSpace, drawn};

/// Ticks of a trial after the first.
const TICKS: usize = 100;
/// A full model's ticks are long: as many after the first, and all of them where they take fewer updates of unknowns.
const FULL_TICKS: usize = 10;
const UPDATES: f64 = 5e7;

/// Work of a tick.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct TickWork<T> {
    /// Exchanges of the exact method.
    pub pivots: T,
    /// Sweeps.
    pub sweeps: T,
    /// Substitutions with a factor.
    pub rounds: T,
    /// Certificates of full models, and their measurements of the residual.
    pub looks: [T; 2],
    /// Whether no tick was cut off by its limits, the first one included.
    pub settled: bool,
}

/// Work of many ticks: the median of each number, and the most.
pub type Trial = TickWork<[u32; 2]>;

/// The trial of a condensed model, and what `price` makes of its median tick and of the longest.
pub fn of_condensed<R: Bakes>(
    baked: &condensed::Baked<R>,
    spaces: &[InputSpace],
    price: impl Fn(&Done) -> Option<f64>,
) -> (Trial, [Option<f64>; 2]) {
    let mut controller = condensed::Controller::new(baked);
    let (mut before, mut prices) = (condensed::Visited::default(), Vec::new());
    let ticks = drawn::<R>(spaces, TICKS).filter_map(|inputs| {
        let (_, report) = controller.tick(&inputs).ok()?;
        let (pivots, sweeps) = (report.exchanges, report.sweeps);
        let now = controller.visited();
        let visited = [std::mem::replace(&mut before, now), now];
        prices.push(price(&Done { pivots, sweeps, visited }));
        let settled = is_settled(report.ended);
        Some(TickWork { pivots, sweeps, settled, ..TickWork::default() })
    });
    let trial = summary(ticks);
    let mut prices: Vec<f64> = prices.into_iter().skip(1).flatten().collect();
    prices.sort_by(f64::total_cmp);
    (trial, [prices.get(prices.len() / 2).copied(), prices.last().copied()])
}

/// The trial of a full model under the limits that its module has.
pub fn of_full<R: Bakes>(baked: &full::Baked<R>, spaces: &[InputSpace]) -> Trial {
    let mut controller = full::Controller::new(baked);
    let (mut ticks, mut updates) = (Vec::new(), 0.0);
    for inputs in drawn::<R>(spaces, TICKS) {
        if ticks.len() > FULL_TICKS && updates > UPDATES {
            break;
        }
        let Ok((_, report)) = controller.tick(&inputs) else { continue };
        let (pivots, rounds) =
            controller.solved().map_or((0, 0), |solved| (solved.pivots, solved.rounds));
        let (sweeps, settled) = (report.sweeps, is_settled(report.ended));
        let looks = [controller.certificates(), measurements(sweeps, report.figures.omega.wide())];
        updates += f64::from(sweeps + rounds) * baked.unknowns() as f64;
        ticks.push(TickWork { pivots, sweeps, rounds, looks, settled });
    }
    summary(ticks.into_iter())
}

/// Measurements of the residual in so many sweeps: one a block, whose length follows ω, and the report's.
fn measurements(sweeps: u32, omega: f64) -> u32 {
    let block = (3.0 / (2.0 - omega)).clamp(4.0, 1e6) as u32;
    1 + sweeps / block.next_power_of_two()
}

/// Whether a tick came to its end.
fn is_settled(ended: Ended) -> bool {
    matches!(ended, Ended::Exact | Ended::Accurate | Ended::Settled)
}

/// The work of the first tick, which begins cold, is left out.
fn summary(ticks: impl Iterator<Item = TickWork<u32>>) -> Trial {
    let ticks: Vec<_> = ticks.collect();
    let both = |count: fn(&TickWork<u32>) -> u32| {
        let mut counts: Vec<u32> = ticks.iter().skip(1).map(count).collect();
        counts.sort_unstable();
        let median = counts.get(counts.len() / 2).copied().unwrap_or(0);
        [median, counts.last().copied().unwrap_or(0)]
    };
    Trial {
        pivots: both(|tick| tick.pivots),
        sweeps: both(|tick| tick.sweeps),
        rounds: both(|tick| tick.rounds),
        looks: [both(|tick| tick.looks[0]), both(|tick| tick.looks[1])],
        settled: !ticks.is_empty() && ticks.iter().all(|tick| tick.settled),
    }
}
