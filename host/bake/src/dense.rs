//! Instructions of a condensed tick from what it did: each part by what it looks at, with the coefficients of the record.
//!
//! ```text
//!   exact method: a (blocks before + blocks after) + b n + c       exchanges in pairs, an odd one half as much again
//!   a norm of the bound: a entries + b order + c           one for s, one more for u_h on quads
//! ```

use super::condensed::Visited;
use super::costs::{Costs, ORDERS};
use signorini_solve::scalar::Scalar;

/// A column entry of a load or an output: two loads, a multiply-add, half of a loop.
const AN_ENTRY: f64 = 4.0;
/// What the bound does with an edge beside the norm (its part of z, of the largest opening, of what is mended) and with a
/// contact vertex (two openings, what is beside them, its correction), what a tick does once and with an edge: no stage of
/// the record has them alone. They were chosen so that slab, levee, strip and a levee of 64 edges are met within 7 %.
const IN_THE_BOUND: [f64; 2] = [8.0, 20.0];
const A_TICK: f64 = 300.0;
const AN_EDGE: f64 = 4.0;

/// What an odd exchange costs, which corrects the tableau alone, of one in a pair.
const ALONE: f64 = 1.5;

/// What a tick did.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Done {
    /// Exchanges.
    pub pivots: u32,
    /// Sweeps.
    pub sweeps: u32,
    /// What the tick before left to look at, and what it looked at itself.
    pub visited: [Visited; 2],
}

/// The sizes of a condensed model, and the record's coefficients for it.
#[derive(Debug)]
pub struct Price {
    /// n, padded.
    pub order: usize,
    /// Entries of loads and outputs.
    pub entries: usize,
    /// Contact vertices.
    pub vertices: usize,
    /// Whether the exact method is there.
    pub exact: bool,
    /// Forms of the error bound: none, that of s, and that of u_h where it is another.
    pub forms: usize,
}

impl Price {
    /// Instructions of a tick.
    pub fn of<R: Scalar>(&self, costs: &Costs, done: &Done) -> Option<f64> {
        let n = self.order as f64;
        let [before, after] = done.visited.map(|visited| visited.blocks as f64);
        let given = A_TICK + AN_EDGE * n + AN_ENTRY * self.entries as f64;
        let solve = match (self.order, self.exact) {
            (0, _) => 0.0,
            (_, true) => {
                let rest = line::<R>(costs, "exact, no edge changes", |n| [n * n / 64.0, n])?;
                at(rest, [before + after, n]) + self.exchanges::<R>(costs, done.pivots)?
            }
            (_, false) => at(line::<R>(costs, PRODUCT, |n| [n * n / 128.0, n])?, [after, n]),
        };
        let sweeps = f64::from(done.sweeps) * costs.of_dense::<R>("sweep", self.order)?;
        Some(given + solve + sweeps + self.bound::<R>(costs, &done.visited[1])?)
    }

    /// Two are made in one pass over the tableau.
    fn exchanges<R: Scalar>(&self, costs: &Costs, pivots: u32) -> Option<f64> {
        let odd = f64::from(pivots % 2);
        Some(
            costs.of_dense::<R>("exchange", self.order)?
                * (f64::from(pivots) + odd * (ALONE - 1.0)),
        )
    }

    fn bound<R: Scalar>(&self, costs: &Costs, visited: &Visited) -> Option<f64> {
        if self.forms == 0 {
            return Some(0.0);
        }
        // Counted with the first n/2 + 3 of n + 3 columns.
        let counted = |n: f64| [(n / 2.0 + 3.0) * (n / 2.0 + 4.0) / 2.0, n + 3.0];
        let norm = line::<R>(costs, "norm of the bound, half of x zero", counted)?;
        let [edge, vertex] = IN_THE_BOUND;
        let rest = edge * self.order as f64 + vertex * self.vertices as f64;
        let each = at(norm, [visited.entries as f64, visited.order as f64]);
        Some(rest + self.forms as f64 * each)
    }
}

const PRODUCT: &str = "product, half of x zero";

/// The coefficients of two measures of work and 1 that give the counts of a stage, whose work at the sizes counted is
/// `work`; of the first alone where one size was counted, the largest.
fn line<R: Scalar>(costs: &Costs, stage: &str, work: impl Fn(f64) -> [f64; 2]) -> Option<[f64; 3]> {
    let rows = ORDERS.map(|n| costs.counted::<R>(stage, n).map(|count| (work(n), count)));
    let [Some(a), Some(b), Some(c)] = rows else {
        let ([blocks, _], count) = rows[2]?;
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
            let line = line::<f32>(&costs, PRODUCT, work).unwrap();
            let counted = costs.counted::<f32>(PRODUCT, n).unwrap();
            COSTS.check_relative(format_args!("order {n}"), at(line, work(n)), counted);
        }
        // A block of 64 multiply-adds, in at least one instruction and a load each.
        let [block, edge, _] = line::<f32>(&costs, PRODUCT, |n| [n * n / 128.0, n]).unwrap();
        assert!((128.0..200.0).contains(&block) && (5.0..60.0).contains(&edge), "{block} {edge}");
        assert!(line::<f64>(&costs, PRODUCT, |n| [n * n / 128.0, n]).is_some());
    }

    #[test]
    fn an_exchange_alone_costs_less_than_two() {
        let costs = Costs::measured();
        let price = Price { order: 64, entries: 0, vertices: 0, exact: true, forms: 0 };
        let of = |pivots| price.of::<f32>(&costs, &Done { pivots, ..Done::default() }).unwrap();
        assert!(of(1) > of(0) && of(2) > of(1) && of(2) - of(1) < of(1) - of(0));
    }
}
