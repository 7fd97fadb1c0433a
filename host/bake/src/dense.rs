//! Instructions of a condensed tick from what it did: each part by what it looks at, with the coefficients of the record.
//!
//! ```text
//!   exact method: a (blocks before + blocks after) + b n + c       exchanges in pairs, an odd one half as much again
//!   a norm of the bound: a entries + b order + c           one for s, one more for u_h on quads
//! ```
//! And of the worst tick, with whatever load and from whatever state, of a method that comes to its end in so many exchanges:
//! ```text
//!   2 S₀ + (exchanges + 1) E + all entries of the bound        S₀ = all edges open before and after; twice, for a correction
//!                                                              E  = (all edges come in − ½ S₀) / n, going back to nothing
//!                                                                   open and an exchange alone included
//! ```

use super::condensed::Visited;
use super::costs::{Costs, ORDERS, around};
use signorini_problem::scalar::Scalar;

/// A column entry of a load or an output: two loads, a multiply-add, half of a loop.
pub(super) const AN_ENTRY: f64 = 4.0;
/// What the bound does with an edge beside the norm (its part of z, of the largest opening, of what is mended) and with a
/// contact vertex (two openings, what is beside them, its correction), what a tick does once and with an edge: no stage of
/// the record has them alone. They were chosen so that slab, levee, strip and a levee of 64 edges are met within 8 %.
const IN_THE_BOUND: [f64; 2] = [8.0, 20.0];
const A_TICK: f64 = 700.0;
const AN_EDGE: f64 = 4.0;
/// Instructions around each term that a step in time hands on. A tick looks at it, compares it with the one before and copies it twice; a
/// column of the load or a row of the states begins and ends there. No stage of the record has that alone: of starts that a board
/// has drawn (`xtask firmware --worst`) none took more than 0.6 of the worst case.
const A_TERM: f64 = 60.0;

/// What an odd exchange costs, which corrects the tableau alone, of one in a pair.
const ALONE: f64 = 1.5;

/// What the worst case is multiplied by: compilers make more or less of the same stage in another image (the record's stages
/// differ by up to 5 % from those of images), and what is fitted by up to 7 %.
const MARGIN: f64 = 1.12;

/// The work of a tick.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Done {
    /// Exchanges.
    pub pivots: u32,
    /// Sweeps.
    pub sweeps: u32,
    /// What the tick before left to look at, and what it looked at itself.
    pub visited: [Visited; 2],
}

/// The sizes of a condensed model.
#[derive(Debug, Default)]
pub struct Price {
    /// n, padded.
    pub order: usize,
    /// Entries of loads and outputs.
    pub entries: usize,
    /// Contact vertices.
    pub vertices: usize,
    /// Columns of the bound's factor.
    pub columns: usize,
    /// Whether the exact method is there.
    pub exact: bool,
    /// Whether a flux has a limit.
    pub is_limited: bool,
    /// Forms of the error bound: none, that of s, that of u_h where it is another, and that of laws that change.
    pub forms: usize,
    /// Columns of the two forms of what a step changes; 0 without a bound of the evolution.
    pub changes: usize,
    /// Modes of a transfer coefficient that changes.
    pub modes: usize,
    /// Terms that a step in time hands on to the next.
    pub handed_on: usize,
}

impl Price {
    /// Instructions of a tick.
    pub fn of<R: Scalar>(&self, costs: &Costs, done: &Done) -> Option<f64> {
        let n = self.order as f64;
        let [before, after] = done.visited.map(|visited| visited.blocks as f64);
        let given = self.given();
        let solve = match (self.order, self.exact) {
            (0, _) => 0.0,
            (_, true) => {
                let rest = line::<R>(costs, self.order as f64, "exact, no edge changes", |n| {
                    [n * n / 64.0, n]
                })?;
                at(rest, [before + after, n]) + self.exchanges::<R>(costs, done.pivots)?
            }
            (_, false) => at(
                line::<R>(costs, self.order as f64, PRODUCT, |n| [n * n / 128.0, n])?,
                [after, n],
            ),
        };
        let sweeps = f64::from(done.sweeps) * costs.of_dense::<R>("sweep", self.order)?;
        let follows = if done.visited[1].follows { self.follows::<R>(costs)? } else { 0.0 };
        Some(given + solve + sweeps + follows + self.bound::<R>(costs, &done.visited[1])?)
    }

    /// Instructions that no tick exceeds which needs so many exchanges at most: an upper bound as far as the record's counts
    /// are those of the image. Nothing where they depend on the operands, as those of f64 without a unit for it do.
    pub fn worst<R: Scalar>(&self, costs: &Costs, exchanges: u32) -> Option<f64> {
        let [smallest, ..] = ORDERS;
        costs.counted::<R>(STAY[0], smallest)?;
        let solve = match self.order {
            0 => 0.0,
            _ => {
                2.0 * self.stage::<R>(costs, STAY)?
                    + f64::from(exchanges + 1) * self.each::<R>(costs)?
                    + self.ways::<R>(costs, exchanges)?
            }
        };
        let columns = self.columns;
        let entries = columns * (columns + 1) / 2;
        let all = Visited { entries, order: columns, ..Visited::default() };
        let follows = self.follows::<R>(costs)?;
        Some(MARGIN * (self.given() + solve + follows + self.bound::<R>(costs, &all)?))
    }

    /// What limits add to so many exchanges in the worst case, or take off. Two an edge belong to the third phase, the others only
    /// come in. An edge that leaves its limit may end open: a way without an exchange.
    fn ways<R: Scalar>(&self, costs: &Costs, exchanges: u32) -> Option<f64> {
        if !self.is_limited {
            return Some(0.0);
        }
        let (each, comes) = (self.each::<R>(costs)?, self.per_edge::<R>(costs, COME)?);
        let way = each - costs.of_dense::<R>("exchange", self.order)?;
        // The order counts padding: no fewer in the third phase than there are.
        let before = exchanges.saturating_sub(2 * self.order as u32);
        Some(self.order as f64 * way - f64::from(before) * (each - comes))
    }

    /// The matrix for another value of the coefficient.
    pub fn follows<R: Scalar>(&self, costs: &Costs) -> Option<f64> {
        if self.modes == 0 || self.order == 0 {
            return Some(0.0);
        }
        let [none, eight] = MATRIX.map(|stage| costs.of_dense::<R>(stage, self.order));
        match none.zip(eight) {
            Some((none, eight)) => Some(none + self.modes as f64 / 8.0 * (eight - none)),
            // A mode takes half a pass, as an exchange does with what comes on top.
            None => Some((self.modes + 2) as f64 * costs.of_dense::<R>("exchange", self.order)?),
        }
    }

    /// Instructions of load, outputs and report.
    fn given(&self) -> f64 {
        let of_step = A_TERM * self.handed_on as f64;
        A_TICK + AN_EDGE * self.order as f64 + AN_ENTRY * self.entries as f64 + of_step
    }

    /// An exchange and the choice of it. Two are made in one pass over the tableau.
    fn exchanges<R: Scalar>(&self, costs: &Costs, pivots: u32) -> Option<f64> {
        let exchange = costs.of_dense::<R>("exchange", self.order)?;
        let each = self.each::<R>(costs).unwrap_or(exchange);
        let odd = f64::from(pivots % 2) * (ALONE - 1.0);
        Some(f64::from(pivots) * each + odd * exchange)
    }

    /// An exchange on the way from nothing open to all, where that was counted; to all at their limits, if that takes more.
    fn each<R: Scalar>(&self, costs: &Costs) -> Option<f64> {
        let [smallest, ..] = ORDERS;
        costs.counted::<R>(COME[0], smallest)?;
        Some(self.per_edge::<R>(costs, COME)?.max(self.per_edge::<R>(costs, FALL)?))
    }

    /// What an edge takes of a stage in which all of them change.
    fn per_edge<R: Scalar>(&self, costs: &Costs, stage: [&str; 2]) -> Option<f64> {
        let all = self.stage::<R>(costs, stage)? - 0.5 * self.stage::<R>(costs, STAY)?;
        Some(all / self.order as f64)
    }

    /// Instructions of a stage that was counted without limits and with them.
    fn stage<R: Scalar>(&self, costs: &Costs, [plain, limited]: [&str; 2]) -> Option<f64> {
        costs.of_dense::<R>(if self.is_limited { limited } else { plain }, self.order)
    }

    fn bound<R: Scalar>(&self, costs: &Costs, visited: &Visited) -> Option<f64> {
        if self.forms == 0 {
            return Some(0.0);
        }
        // Counted with the first n/2 + 3 of n + 3 columns.
        let counted = |n: f64| [(n / 2.0 + 3.0) * (n / 2.0 + 4.0) / 2.0, n + 3.0];
        let norm =
            line::<R>(costs, self.order as f64, "norm of the bound, half of x zero", counted)?;
        let [edge, vertex] = IN_THE_BOUND;
        let rest = edge * self.order as f64 + vertex * self.vertices as f64;
        let each = at(norm, [visited.entries as f64, visited.order as f64]);
        let changes = self.changes as f64;
        let of_changes = match self.changes {
            0 => 0.0,
            _ => at(norm, [0.5 * changes * (changes + 1.0), changes]),
        };
        Some(rest + self.forms as f64 * each + 2.0 * of_changes)
    }
}

const PRODUCT: &str = "product, half of x zero";
const STAY: [&str; 2] = ["two phases, all edges stay open", "three phases, all stay there"];
const COME: [&str; 2] = ["two phases, all edges come in", "three phases, all edges come in"];
const MATRIX: [&str; 2] = ["modes, a matrix of none", "modes, a matrix of eight"];
const FALL: [&str; 2] = ["two phases, all edges come in", "three phases, all to their limits"];

/// The coefficients of two measures of work and 1 that give the counts of a stage, whose work at the three sizes
/// counted around `order` is `work`; of the first alone where one size was counted, the largest.
fn line<R: Scalar>(
    costs: &Costs,
    order: f64,
    stage: &str,
    work: impl Fn(f64) -> [f64; 2],
) -> Option<[f64; 3]> {
    let row = |n| costs.counted::<R>(stage, n).map(|count| (work(n), count));
    let [Some(a), Some(b), Some(c)] = around(order).map(row) else {
        let [.., largest] = ORDERS;
        let ([blocks, _], count) = row(largest)?;
        return Some([count / blocks, 0.0, 0.0]);
    };
    let less = |(w, count): ([f64; 2], f64)| (w[0] - a.0[0], w[1] - a.0[1], count - a.1);
    let ((p, q, y), (r, s, z)) = (less(b), less(c));
    let determinant = p * s - q * r;
    let first = (y * s - z * q) / determinant;
    let second = (p * z - r * y) / determinant;
    Some([first, second, a.1 - first * a.0[0] - second * a.0[1]])
}

fn at([first, second, rest]: [f64; 3], work: [f64; 2]) -> f64 {
    (first * work[0] + second * work[1] + rest).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_tolerances::bake::COSTS;

    #[test]
    fn counted_stages_are_met() {
        let costs = Costs::measured();
        for n in ORDERS {
            let work = |n: f64| [n * n / 128.0, n];
            let line = line::<f32>(&costs, n, PRODUCT, work).unwrap();
            let counted = costs.counted::<f32>(PRODUCT, n).unwrap();
            COSTS.check_relative(format_args!("order {n}"), at(line, work(n)), counted);
        }
        // A block of 64 multiply-adds, in at least one instruction and a load each.
        let of_block = |n: f64| [n * n / 128.0, n];
        let [block, edge, _] = line::<f32>(&costs, 64.0, PRODUCT, of_block).unwrap();
        assert!((128.0..200.0).contains(&block) && (5.0..60.0).contains(&edge), "{block} {edge}");
        assert!(line::<f64>(&costs, 64.0, PRODUCT, of_block).is_some());
    }

    #[test]
    fn the_worst_tick_grows_with_its_exchanges() {
        let costs = Costs::measured();
        for order in [8, 32, 64] {
            let sizes = Price { order, vertices: order, columns: 2 * order, ..Price::default() };
            let price = Price { exact: true, forms: 1, ..sizes };
            let worst = |exchanges| price.worst::<f32>(&costs, exchanges).unwrap();
            let [none, all] = [worst(0), worst(order as u32)];
            // What was counted from nothing open to all, and the rest of a tick.
            let counted = costs.counted::<f32>(COME[0], order as f64).unwrap();
            assert!(all > counted && all - none < 1.3 * counted, "{order}");
        }
        let price = Price { entries: 9, columns: 2, forms: 1, ..Price::default() };
        assert!(price.worst::<f32>(&costs, 0).unwrap() > A_TICK);
        assert_eq!(price.worst::<f64>(&costs, 0), None);
    }

    #[test]
    fn an_exchange_alone_costs_less_than_two() {
        let costs = Costs::measured();
        let price = Price { order: 64, exact: true, ..Price::default() };
        let of = |pivots| price.of::<f32>(&costs, &Done { pivots, ..Done::default() }).unwrap();
        assert!(of(1) > of(0) && of(2) > of(1) && of(2) - of(1) < of(1) - of(0));
    }
}
