//! Which cells are refined: the fewest that hold a share of the whole (Dörfler's marking), as long as refinement pays.
//!
//! ```text
//!   Σ_{T marked} η_T² ≥ θ² Σ_T η_T²,    the largest η_T first
//! ```
//! θ² is ½, so that levels grow by a factor near 2 where cells have nearly equal shares. A refined cell of a smooth part keeps a
//! quarter of its η_T². Where less is asked for than a whole level brings, less is marked:
//! ```text
//!   Σ η_T² − ¾ Σ_{T marked} η_T² ≤ ROOM · goal²
//! ```
//!
//! With first-order elements the bound falls like N^(−½) where cells follow the solution. A slope half as steep over a doubling of N
//! is slow: cuts between fine and coarse cells take what marking brings, or data that marked cells do not resolve. A slope flatter
//! than −1/12 over two doublings is a stall: data that no mesh of this size resolves, rounding, or a solver that stopped.

/// θ²
const SHARE: f64 = 0.5;
/// Where more of the cells than this have that share, as many are refined as the goal takes, or all: the bound is spread evenly then, and cuts between fine and
/// coarse cells cost more than they save.
const EVEN: f64 = 0.2;
/// Part of the square of a smooth cell's indicator that refinement removes.
const TAKEN: f64 = 0.75;
/// The least part of the cells that a level marks, so that few levels are solved: all together cost little more than the last.
const FEWEST: f64 = 0.03;
/// Least part of the cells that a last level marks.
const FEWEST_AT_LAST: f64 = 0.02;
/// The goal is aimed at from below, since not all cells are smooth.
const ROOM: f64 = 0.85;

/// Whether each cell is marked; `goal` is what the root of the sum of the squares is to become.
pub(super) fn marked(squares: &[f64], goal: f64) -> Vec<bool> {
    let total: f64 = squares.iter().sum();
    let mut order: Vec<usize> = (0..squares.len()).collect();
    order.sort_by(|&a, &b| squares[b].total_cmp(&squares[a]).then(a.cmp(&b)));
    let last = (total - ROOM * goal * goal) / TAKEN;
    let fewest = |part: f64| (part * squares.len() as f64).ceil() as usize;
    let count = match last < SHARE * total {
        true => holding(&order, squares, last).max(fewest(FEWEST_AT_LAST)),
        false => {
            let half = holding(&order, squares, SHARE * total).max(fewest(FEWEST));
            if half > fewest(EVEN) { holding(&order, squares, last.min(total)) } else { half }
        }
    };
    let mut marked = vec![false; squares.len()];
    order.iter().take(count.max(1)).for_each(|&cell| marked[cell] = true);
    marked
}

/// How many of the largest hold `sum` together.
fn holding(order: &[usize], squares: &[f64], sum: f64) -> usize {
    let mut held = 0.0;
    let is_short = |&&cell: &&usize| {
        let is_short = held < sum;
        held += squares[cell];
        is_short
    };
    order.iter().take_while(is_short).count()
}

/// The flattest slope with which cells are marked, and the growth of N over which it is measured.
const SLOW: [f64; 2] = [1.0 / 4.0, 2.0];
/// The flattest slope of the bound that goes on, and its growth.
const STALLED: [f64; 2] = [1.0 / 12.0, 4.0];

/// N and bound of all levels so far.
#[derive(Debug, Default)]
pub(super) struct History(Vec<[f64; 2]>);

impl History {
    /// Adds a level: its unknowns, and its bound in any unit that stays.
    pub fn push(&mut self, unknowns: usize, bound: f64) {
        self.0.push([unknowns as f64, bound]);
    }

    /// Whether marked cells bring little.
    pub fn is_slow(&self) -> bool {
        self.is_flatter_than(SLOW)
    }

    /// Whether it is no use to go on.
    pub fn is_stalled(&self) -> bool {
        self.is_flatter_than(STALLED)
    }

    fn is_flatter_than(&self, [slope, growth]: [f64; 2]) -> bool {
        let Some(now) = self.0.last() else { return false };
        let before = self.0.iter().rev().find(|before| now[0] >= growth * before[0]);
        before.is_some_and(|before| {
            let fall = (before[1] / now[1]).ln() / (now[0] / before[0]).ln();
            fall < slope
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_hold_half() {
        let mut squares = vec![1.0; 20];
        (squares[3], squares[7], squares[11]) = (9.0, 4.0, 4.0);
        let found = marked(&squares, 0.0);
        assert_eq!((0..20).filter(|&cell| found[cell]).collect::<Vec<_>>(), [3, 7, 11]);
    }

    #[test]
    fn less_is_marked_near_the_goal_and_all_where_it_is_even() {
        let squares = vec![1.0; 100];
        let count = |goal| marked(&squares, goal).iter().filter(|&&is| is).count();
        assert_eq!(count(0.0), 100);
        // 100 − ¾ n ≤ 0.85 · 100
        assert_eq!(count(10.0), 20);
        assert_eq!(count(1e3), 2);
        assert_eq!(marked(&[0.0, 0.0], 0.0), [true, false]);
    }

    #[test]
    fn slopes_are_those_of_the_last_doublings() {
        let slope = |exponent: f64| {
            let level = |at: i32| {
                let n = 100.0 * 1.5_f64.powi(at);
                [n, n.powf(-exponent)]
            };
            let history = History((0..6).map(level).collect());
            [history.is_slow(), history.is_stalled()]
        };
        assert_eq!([0.5, 0.26].map(slope), [[false; 2]; 2]);
        assert_eq!([0.2, 0.1].map(slope), [[true, false]; 2]);
        assert_eq!([0.08, 0.0, -0.3].map(slope), [[true; 2]; 3]);
        assert!(!History(vec![[100.0, 1.0], [199.0, 1.0]]).is_slow());
    }
}
