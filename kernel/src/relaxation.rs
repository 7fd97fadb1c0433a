//! The relaxation factor ω: given, or found while the solver runs.
//!
//! A tuned ω is worth a factor 20 in sweeps. For a consistently ordered matrix Young's relation ties
//! the observed convergence factor R of a run with ω below the optimum to the spectral radius μ of
//! the Jacobi matrix, and μ to the best ω:
//! ```text
//!   (R + ω − 1)² = R ω² μ²,        ω_best = 2 / (1 + √(1 − μ²)).
//! ```
//! So the search *rises* from ω = 1 by this formula, after Hageman and Young, as long as R is worse
//! than (ω − 1)^¾, a factor that an ω near the optimum would not show. Matrices of distorted cells are
//! far from consistently ordered: there R gets worse again long before the formula is content. The
//! search then *falls* back from the best ω seen in steps that widen 2 − ω, as long as R improves,
//! and *settles*. It rises anew when R becomes much worse than where it settled, since a slow part of
//! the error has come to light.
//!
//! R is the geometric mean over two blocks of sweeps, after one block that the transient of a new ω
//! may have. Any ω in (0, 2) converges, and ω moves a bounded number of times, so convergence is
//! never at stake. The memory is a handful of scalars.

use crate::{Error, Math, Real};

/// How ω is chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Relaxation<R> {
    /// This value, inside (0, 2).
    Fixed(R),
    /// Found while the solver runs, starting from this value in \[1, 2).
    Adaptive(R),
}

impl<R: Real> Relaxation<R> {
    /// Adaptive from near the best ω of a square mesh with so many unknowns: n lines of cells make
    /// 6n² of them, and the best ω is about 2 − 2.4/n. For a control loop, whose first tick should not be
    /// spent on the search.
    pub fn for_unknowns(count: usize) -> Self {
        let root = R::from_count(count as u32).or_larger(R::ONE).rounded_sqrt();
        let omega = R::TWO - R::from_count(6) / root;
        Self::Adaptive(omega.or_larger(R::ONE))
    }
}

/// Phase of the search.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
enum Phase {
    #[default]
    Rising,
    Falling,
    Settled,
}

/// The state of the search.
#[derive(Debug, Clone, Copy, Default)]
pub struct Search<R> {
    /// ω of the next sweep.
    pub omega: R,
    phase: Phase,
    /// The best ω of this search and its factor.
    best: Option<(R, R)>,
    /// Size of the residual and number of active edges at the last look.
    previous: Option<(R, u32)>,
    /// The factor of the block before.
    factor: Option<R>,
    moves: u32,
}

/// What a search leaves to other data, as numbers that mean something whatever bits they have: who keeps it need not trust
/// its memory. All zeros before a search.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct KeptSearch<R> {
    /// ω of the next sweep.
    pub omega: R,
    /// The best ω of this search and its factor; an ω of 0 is none.
    pub best: [R; 2],
    /// How often ω has moved.
    pub moves: u32,
    /// The number of the phase.
    pub phase: u32,
}

impl<R: Real> KeptSearch<R> {
    /// Before a search.
    pub const NONE: Self = Self { omega: R::ZERO, best: [R::ZERO; 2], moves: 0, phase: 0 };

    /// The same as numbers, none of which is rounded: counts are small.
    pub fn numbers(&self) -> [R; 5] {
        let [best, factor] = self.best;
        let [moves, phase] = [self.moves, self.phase].map(|count| R::from_count(count.min(MOVES)));
        [self.omega, best, factor, moves, phase]
    }

    /// From such numbers.
    pub fn of_numbers([omega, best, factor, moves, phase]: [R; 5]) -> Self {
        let count = |x: R| (0..MOVES).find(|&count| R::from_count(count) >= x).unwrap_or(MOVES);
        Self { omega, best: [best, factor], moves: count(moves), phase: count(phase) }
    }

    /// The search that goes on from here; `None` before one, or where ω is none of a search.
    pub fn search(&self) -> Option<Search<R>> {
        let Self { omega, best: [best, factor], moves, phase } = *self;
        let phase = match phase {
            0 => Phase::Rising,
            1 => Phase::Falling,
            _ => Phase::Settled,
        };
        let best = (best != R::ZERO).then_some((best, factor));
        let is_known = omega > R::ZERO && omega < R::TWO;
        is_known.then_some(Search { omega, phase, best, previous: None, factor: None, moves })
    }
}

/// The longest block, for 2 − ω around 1e−5.
const LONGEST: u32 = 1 << 18;

/// ω moves at most this often.
const MOVES: u32 = 64;

impl<R: Real> Search<R> {
    /// A search; with a fixed ω, one that is over.
    fn new(relaxation: Relaxation<R>) -> Self {
        let (omega, moves) = match relaxation {
            Relaxation::Fixed(omega) => (omega, MOVES),
            Relaxation::Adaptive(start) => (start, 0),
        };
        Self { omega, phase: Phase::Rising, best: None, previous: None, factor: None, moves }
    }

    /// Sweeps until the next look: about four times 1/(2 − ω), in which the transient of a new ω
    /// passes; always a power of two.
    pub fn block(&self) -> u32 {
        let mut sweeps = 4;
        let mut time = R::TWO + R::TWO;
        while sweeps < LONGEST && time * (R::TWO - self.omega) < R::THREE {
            sweeps *= 2;
            time *= R::TWO;
        }
        sweeps
    }

    /// Checks that ω may start there: inside (0, 2), an adaptive one in [1, 2).
    pub fn checked(relaxation: Relaxation<R>) -> Result<Self, Error> {
        let valid = match relaxation {
            Relaxation::Fixed(omega) => omega > R::ZERO && omega < R::TWO,
            Relaxation::Adaptive(start) => start >= R::ONE && start < R::TWO,
        };
        if valid { Ok(Self::new(relaxation)) } else { Err(Error::Relaxation) }
    }

    /// Whether ω moves no more.
    pub fn is_over(&self) -> bool {
        self.moves >= MOVES
    }

    /// Other data: what was seen last says nothing of the next blocks.
    pub fn disturb(&mut self) {
        *self = Self { previous: None, factor: None, ..*self };
    }

    /// The state that is left once data change.
    pub fn kept(&self) -> KeptSearch<R> {
        let best = self.best.map_or([R::ZERO; 2], |(omega, factor)| [omega, factor]);
        KeptSearch { omega: self.omega, best, moves: self.moves, phase: self.phase as u32 }
    }

    /// Looks at the size of the residual after a block of `sweeps` (a power of two).
    pub fn look<M: Math<R>>(&mut self, size: R, active: u32, sweeps: u32) {
        let before = self.previous.replace((size, active));
        let Some((earlier, active_earlier)) = before.filter(|_| self.moves < MOVES) else { return };
        if active != active_earlier {
            self.factor = None;
            return;
        }
        let mut factor = size / earlier;
        for _ in 0..sweeps.trailing_zeros() {
            factor = M::sqrt(factor);
        }
        if let Some(last) = self.factor.replace(factor) {
            self.judge::<M>(M::sqrt(last * factor));
        }
    }

    /// Decides what follows from the factor R that ω has shown.
    fn judge<M: Math<R>>(&mut self, shown: R) {
        let improves = self.best.is_none_or(|(_, best)| shown < best);
        match self.phase {
            Phase::Rising if improves => {
                self.best = Some((self.omega, shown));
                match higher::<R, M>(self.omega, shown) {
                    Some(omega) => self.move_to(omega),
                    None => self.phase = Phase::Settled,
                }
            }
            Phase::Rising => self.fall_from_best(),
            Phase::Falling if improves => {
                self.best = Some((self.omega, shown));
                self.fall_from_best();
            }
            Phase::Falling => self.settle_at_best(),
            Phase::Settled => self.rise_again::<M>(shown),
        }
    }

    fn fall_from_best(&mut self) {
        let Some((omega, _)) = self.best else { return };
        self.phase = Phase::Falling;
        let wider = (R::ONE + R::HALF) * (R::TWO - omega);
        self.move_to((R::TWO - wider).or_larger(R::ONE));
    }

    fn settle_at_best(&mut self) {
        let Some((omega, _)) = self.best else { return };
        self.phase = Phase::Settled;
        self.move_to(omega);
    }

    fn rise_again<M: Math<R>>(&mut self, shown: R) {
        let much_worse = |(_, best): (R, R)| R::TWO * (R::ONE - shown) < R::ONE - best;
        let Some(omega) = higher::<R, M>(self.omega, shown) else { return };
        if self.best.is_some_and(much_worse) {
            self.phase = Phase::Rising;
            self.best = Some((self.omega, shown));
            self.move_to(omega);
        }
    }

    fn move_to(&mut self, omega: R) {
        *self = Self { omega, previous: None, factor: None, moves: self.moves + 1, ..*self };
    }
}

/// The ω that the observed convergence factor asks for, where that is a real step upwards.
fn higher<R: Real, M: Math<R>>(omega: R, factor: R) -> Option<R> {
    let over = omega - R::ONE;
    let root = M::sqrt(over);
    let expected = root * M::sqrt(root);
    if !(factor > expected && factor < R::ONE) {
        return None;
    }
    let sum = factor + over;
    let radius_squared = sum * sum / (factor * omega * omega);
    if !(radius_squared < R::ONE) {
        return None;
    }
    let best = R::TWO / (R::ONE + M::sqrt(R::ONE - radius_squared));
    let least = R::QUARTER * R::QUARTER * (R::TWO - omega);
    if best > omega + least { Some(best) } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Libm;

    #[test]
    fn young_s_relation_tells_the_best_omega() {
        // ω = 1 shows R = μ²: √(1 − ¾) = ½ and ω = 2 / 1½.
        assert_eq!(higher::<f64, Libm>(1.0, 0.75), Some(4.0 / 3.0));
        // Faster than any ω below the best one can be, though the relation would ask for more.
        assert_eq!(higher::<f64, Libm>(1.5, 0.27), None);
        for omega in [1.0, 1.25, 1.5, 1.875] {
            for ulps in 0..64 {
                let factor = 1.0 - f64::from(ulps) * 0.5 * f64::EPSILON;
                let asked = higher::<f64, Libm>(omega, factor);
                assert!(asked.is_none_or(|asked| asked < 2.0), "{omega}, {factor}: {asked:?}");
            }
        }
    }

    #[test]
    fn omega_moves_64_times_at_most() -> Result<(), Error> {
        let mut search = Search::<f64>::checked(Relaxation::Adaptive(1.0))?;
        let (mut size, mut moves, mut state) = (1.0, 0, 1_u32);
        for _ in 0..100_000 {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            size *= f64::from(state >> 8) / f64::from(1 << 24);
            size = if size < 1e-200 { 1.0 } else { size };
            let before = search.omega;
            search.look::<Libm>(size, 0, search.block());
            moves += u32::from(search.omega != before);
        }
        assert!(search.is_over() && (32..=MOVES).contains(&moves), "{moves} moves");
        Ok(())
    }

    /// A search goes on from what was kept; of any other bits it is a search too, or none.
    #[test]
    fn what_is_kept_is_a_search_whatever_its_bits() -> Result<(), Error> {
        let mut search = Search::<f64>::checked(Relaxation::Adaptive(1.0))?;
        let mut again = search;
        let mut size = 1.0;
        for tick in 0..20 {
            search.disturb();
            again = again.kept().search().ok_or(Error::Relaxation)?;
            for look in 0..5 {
                size *= match (tick + look) % 3 {
                    0 => 0.9,
                    1 => 0.5,
                    _ => 0.99,
                };
                search.look::<Libm>(size, 0, search.block());
                again.look::<Libm>(size, 0, again.block());
                assert_eq!((search.omega, search.is_over()), (again.omega, again.is_over()));
            }
        }
        assert!(KeptSearch::<f64>::NONE.search().is_none());
        let kept = search.kept();
        for omega in [0.0, -1.0, 2.0, 1e300, f64::NAN] {
            assert!(KeptSearch { omega, ..kept }.search().is_none());
        }
        for phase in [3, 1 << 31, u32::MAX] {
            let mut found =
                KeptSearch { phase, moves: u32::MAX, ..kept }.search().ok_or(Error::Relaxation)?;
            found.look::<Libm>(1.0, 0, 4);
            assert!(found.is_over());
        }
        Ok(())
    }
}
