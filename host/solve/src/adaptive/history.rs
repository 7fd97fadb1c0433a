//! Whether refinement still pays: how fast the bound falls with the number of unknowns.
//!
//! With first-order elements the bound falls like N^(−½) where cells follow the solution. A slope half as steep over a doubling of N
//! is slow: cuts between fine and coarse cells take what marking brings, or data that marked cells do not resolve. A slope flatter
//! than −1/12 over two doublings is a stall: data that no mesh of this size resolves, rounding, or a solver that stopped.

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
