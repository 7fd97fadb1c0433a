//! The contact problem on a factor: exchanges find the edges that touch, corrections the last digits.
//!
//! ```text
//!   d = b − Ku in differences    y, b̃ = L⁻¹d        round 1, or where an edge is on the wrong side:
//!                                                      x ≥ 0, Sx − (Sx_old + b̃) ≥ 0, complementary
//!                                                      u_C = ψ + v
//!                                                   else: S_oo δ_o = b̃_o on the open edges
//!   u, low ← u + L⁻ᵀ(…)          until a correction is the last digit of u, or more than half the one before
//! ```
//! S is scaled to a diagonal of 1, x_i = v_i √S_ii, as in a condensed model, and solved by the same
//! [`signorini_contact::dense::pivoting`]: as many exchanges as edges change sides since the last solve. Where d comes
//! from is left to who asks: a matrix in CSR, on the desk, or element matrices ([`super::cells`]).

use super::factor::Factor;
use super::solved::{FAR, ROUNDS, Solved};
use super::storage::Memory;
use signorini_contact::dense::blocks::{Block, Blocks, multiply_add, padded};
use signorini_contact::dense::pivoting::{self, Found};
use signorini_contact::dense::ranges::Given;
use signorini_contact::dense::rule::Largest;
use signorini_contact::dense::tableau::{InitialTableau, Tableau};
use signorini_contact::dense::{Iterate, sizes};
use signorini_kernel::error::{Array, Error, same_length};
use signorini_kernel::index::{Index, read, write};
use signorini_kernel::law::Law;
use signorini_kernel::{Real, features};

/// Rounds within which that may be.
const AGAIN: u32 = 6;

/// A row may be off by this many ε of its terms in a solution.
pub const SLACK: u32 = 64;

/// Where defects come from.
pub trait Defect<R: Real, I: Index> {
    /// Writes d = b − Ku by places.
    fn measure(&self, factor: &Factor<R, I>, u: &[R], places: &mut [R]);
}

/// K by its factor, which does not change (borrowed): P is [`padded`] contact edges, B the number of blocks of S.
#[derive(Debug, Clone, Copy)]
pub struct Factored<'a, R, I> {
    /// L and D.
    pub factor: Factor<'a, R, I>,
    /// S scaled to a diagonal of 1, S_ij / √(S_ii S_jj): B blocks.
    pub schur: &'a [Block<R>],
    /// 1/√S_ii: P entries.
    pub scale: &'a [R],
    /// Where exchanges begin: B blocks, P entries.
    pub start: InitialTableau<'a, R>,
}

/// A factor with its contact problem, ready for any number of loads.
#[derive(Debug)]
pub struct Exact<'a, R, I> {
    factored: Factored<'a, R, I>,
    tableau: Tableau<'a, R>,
    load: &'a mut [R],
    iterate: Iterate<'a, R>,
    solved: Option<Solved<R>>,
}

impl<'a, R: Real, I: Index> Exact<'a, R, I> {
    /// Takes memory that a last solve has left, or that is about to be [`Exact::restart`]ed.
    ///
    /// # Errors
    /// Memory of the wrong length.
    pub fn new(factored: Factored<'a, R, I>, memory: Memory<'a, R>) -> Result<Self, Error> {
        let contact = factored.factor.counts().contact;
        let Memory { tableau, exchanged, columns, load, iterate } = memory;
        let length = padded(contact);
        let Iterate { x, residual, scratch, open } = &iterate;
        let numbers = [factored.scale.len(), load.len(), x.len(), residual.len(), scratch.len()];
        for found in numbers {
            same_length(Array::Scratch, found, length)?;
        }
        for found in [open.len(), exchanged.len()] {
            same_length(Array::Contact, found, length)?;
        }
        Blocks::new(factored.schur, contact)?;
        let tableau = Tableau::new(contact, tableau, exchanged, columns)?;
        Ok(Self { factored, tableau, load, iterate, solved: None })
    }

    /// Forgets all solves: everything touches, and exchanges begin where they began first.
    ///
    /// # Errors
    /// A start of the wrong length.
    pub fn restart(&mut self) -> Result<(), Error> {
        self.iterate.x.fill(R::ZERO);
        self.solved = None;
        self.tableau.reset(&self.factored.start)
    }

    /// Forgets the openings of the last solve where they are larger than `most`.
    pub(crate) fn forget_beyond(&mut self, most: R) {
        let mut openings = self.iterate.x.iter().zip(self.factored.scale);
        if openings.any(|(&x, &scale)| !((x * scale).magnitude() <= most)) {
            self.iterate.x.fill(R::ZERO);
        }
    }

    /// What the last solve did; `None` where it found nothing.
    pub fn solved(&self) -> Option<Solved<R>> {
        self.solved
    }

    /// Sizes of the blocks of u.
    pub(super) fn counts(&self) -> signorini_kernel::mesh::edges::EdgeCounts {
        self.factored.factor.counts()
    }

    /// Solves from any `u`, which becomes the answer, within `law` on C, together with its low part `low`
    /// (as long as u, or empty where nobody asks). `places` is scratch, one entry per unknown. `None` where there is no answer that this scalar can
    /// hold: no solution, or a matrix that is singular in it; u is of no use then.
    ///
    /// # Errors
    /// Arrays of the wrong length.
    pub fn solve(
        &mut self,
        defect: &impl Defect<R, I>,
        law: Law<R>,
        places: &mut [R],
        u: &mut [R],
        low: &mut [R],
    ) -> Result<Option<Solved<R>>, Error> {
        let Factored { factor, .. } = self.factored;
        let counts = factor.counts();
        same_length(Array::Unknowns, u.len(), counts.edges())?;
        same_length(Array::Scratch, places.len(), counts.unknowns())?;
        law.check_length(counts)?;
        self.solved = None;
        self.open(law, u);
        low.fill(R::ZERO);
        let (mut pivots, mut rounds, mut last) = (0, 0, None);
        let mut first = R::ZERO;
        // Where exchanges find nothing to exchange, what looks wrong is rounding.
        let mut settled = false;
        while rounds < ROUNDS {
            rounds += 1;
            defect.measure(&factor, u, places);
            self.reduce(places);
            if last.is_none() || !settled && self.is_wrong(law) {
                let Some(exchanges) = self.exchange(law, places, u)? else { return Ok(None) };
                settled = exchanges == 0 && last.is_some();
                pivots += exchanges;
                factor.substitute(places);
                let step = largest(places);
                self.add(places, counts.free, u, low);
                // The openings are in u already.
                low.iter_mut().skip(counts.free).for_each(|rest| *rest = R::ZERO);
                if last.is_none() {
                    first = step / largest(u);
                    if first > R::from_count(FAR) && rounds < AGAIN {
                        continue;
                    }
                }
                last = Some(R::ONE / R::ZERO);
                continue;
            }
            self.correct(law, places)?;
            factor.substitute(places);
            let change = largest(places) / largest(u);
            if last.is_some_and(|last| !(change < R::HALF * last)) {
                low.fill(R::ZERO);
                break;
            }
            self.add(places, counts.unknowns(), u, low);
            last = Some(change);
            if change <= R::EPSILON {
                break;
            }
        }
        // A correction may round to less than ψ. What sinks further was open by a factor that is not of this matrix.
        let (_, on_contact) = u.split_at_mut(counts.free.min(u.len()));
        let lifted = law.snap_to_gap(on_contact, low.get_mut(counts.free..).unwrap_or_default());
        if lifted > R::from_count(SLACK) * R::EPSILON * largest(u) {
            last = Some(R::ONE / R::ZERO);
        }
        self.solved = last.map(|change| Solved { pivots, rounds, change, first });
        Ok(self.solved)
    }

    /// Contact edges onto ψ + v, v as the last solve left it.
    fn open(&mut self, law: Law<R>, u: &mut [R]) {
        let contact = u.iter_mut().skip(self.counts().free).zip(law.edges());
        let openings = self.iterate.x.iter().zip(self.factored.scale);
        for ((u, law), (x, &scale)) in contact.zip(openings) {
            *u = law.opened(*x * scale);
        }
    }

    /// y and, scaled in `load`, b̃ for the defect that `places` holds.
    fn reduce(&mut self, places: &mut [R]) {
        let Factored { factor, scale, .. } = &self.factored;
        factor.eliminate(places);
        self.load.fill(R::ZERO);
        let reduced = places.iter().skip(factor.counts().free).zip(*scale);
        self.load.iter_mut().zip(reduced).for_each(|(load, (&b, &scale))| *load = b * scale);
    }

    /// Whether an edge that touches is pulled off the gap, by more than rounding.
    fn is_wrong(&self, law: Law<R>) -> bool {
        let size = sizes::norm(self.iterate.x);
        let noise = R::from_count(64) * R::EPSILON * size;
        let edges = self.load.iter().zip(self.iterate.x.iter());
        if law.is_limited() {
            let ranges = Given::between(self.load, law.spans(), self.factored.scale).ranges;
            let is_torn = |at: usize, b: R| ranges.outside(at, -b).magnitude() > noise;
            return edges.enumerate().any(|(at, (&b, &x))| x == R::ZERO && is_torn(at, b));
        }
        edges.into_iter().any(|(&b, &x)| x == R::ZERO && b > noise)
    }

    /// Finds which edges touch; u_C = ψ + v, and the change of v goes behind y. Returns the exchanges, or
    /// nothing where there is no solution.
    fn exchange(
        &mut self,
        law: Law<R>,
        places: &mut [R],
        u: &mut [R],
    ) -> Result<Option<u32>, Error> {
        if !features::CONTACT {
            return Ok(Some(0));
        }
        let Factored { factor, schur, scale, start } = self.factored;
        let counts = factor.counts();
        let matrix = Blocks::new(schur, counts.contact)?;
        for (open, &x) in self.iterate.open.iter_mut().zip(self.iterate.x.iter()) {
            *open = x != R::ZERO;
        }
        let Iterate { x, residual, scratch, open } = &mut self.iterate;
        multiply_add(&matrix, x, open, self.load)?;
        let cap = (4 * counts.contact + 16) as u32;
        let iterate = Iterate { x, residual, scratch, open };
        let search = pivoting::find(
            &matrix,
            Given::between(self.load, law.spans(), scale),
            &mut self.tableau,
            &start,
            &mut Largest,
            |at| at < cap,
            iterate,
        );
        let pivots = match search {
            Ok((Found::Exact, pivots)) => pivots,
            // What overflows has no answer either.
            Ok(_) | Err(Error::NotFinite { .. }) => return Ok(None),
            Err(error) => return Err(error),
        };
        let values = self.iterate.x.iter().zip(scale).zip(law.edges());
        let contact = u.iter_mut().skip(counts.free).zip(values);
        for ((u, ((&x, &scale), law)), place) in contact.zip(counts.free..) {
            let new = law.opened(x * scale);
            write(places, place, new - *u);
            *u = new;
        }
        Ok(Some(pivots))
    }

    /// The change of v with the edges that touch held, behind y.
    fn correct(&mut self, law: Law<R>, places: &mut [R]) -> Result<(), Error> {
        if !features::CONTACT {
            return Ok(());
        }
        let Factored { factor, scale, .. } = self.factored;
        if law.is_limited() {
            let ranges = Given::between(&[], law.spans(), scale).ranges;
            for (at, (load, &x)) in self.load.iter_mut().zip(self.iterate.x.iter()).enumerate() {
                *load += ranges.excess(at, x);
            }
        }
        let change = &mut *self.iterate.scratch;
        // What it says of edges that touch is not read.
        self.tableau.answer(self.load, change)?;
        let entries = places.iter_mut().skip(factor.counts().free).zip(change.iter().zip(scale));
        for ((place, (&z, &scale)), &x) in entries.zip(self.iterate.x.iter()) {
            *place = if x != R::ZERO { -z * scale } else { R::ZERO };
        }
        Ok(())
    }

    /// u + z of the first unknowns as the nearest number and the exact rest.
    fn add(&self, places: &[R], unknowns: usize, u: &mut [R], low: &mut [R]) {
        for (unknown, u) in u.iter_mut().enumerate().take(unknowns) {
            let z = read(places, self.factored.factor.place(unknown));
            let sum = *u + z;
            write(low, unknown, z + (*u - sum));
            *u = sum;
        }
    }
}

/// max |x|, at least the smallest normal number; NaN stays.
fn largest<R: Real>(x: &[R]) -> R {
    let larger = |most: R, x: &R| if x.magnitude() <= most { most } else { x.magnitude() };
    x.iter().fold(R::TINY, larger)
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_contact::dense::blocks::SIDE;
    use signorini_kernel::mesh::edges::EdgeCounts;

    /// An edge with an opening of 2 by x = 16 and 1/√S_ii = ⅛, and what is left of x.
    fn forgotten(most: f64) -> Result<f64, Error> {
        let counts = EdgeCounts { free: 0, contact: 1, dirichlet: 0 };
        let factor = Factor::<f64, u16>::baked(&[], &[0], &[], &[], &[], counts);
        let (schur, mut tableau) = ([[[0.0; SIDE]; SIDE]], [[[0.0; SIDE]; SIDE]]);
        let (mut scale, mut x) = ([0.0; SIDE], [0.0; SIDE]);
        (scale[0], x[0]) = (0.125, 16.0);
        let start = InitialTableau { blocks: &schur, exchanged: &[false; SIDE] };
        let iterate = Iterate {
            x: &mut x,
            residual: &mut [0.0; SIDE],
            scratch: &mut [0.0; SIDE],
            open: &mut [false; SIDE],
        };
        let memory = Memory {
            tableau: &mut tableau,
            exchanged: &mut [false; SIDE],
            columns: [&mut [0.0; SIDE], &mut [0.0; SIDE]],
            load: &mut [0.0; SIDE],
            iterate,
        };
        Exact::new(Factored { factor, schur: &schur, scale: &scale, start }, memory)?
            .forget_beyond(most);
        Ok(x[0])
    }

    #[test]
    fn openings_are_forgotten_beyond_what_is_worth_keeping() {
        assert_eq!([3.0, 2.0, 1.99, 0.0].map(forgotten), [Ok(16.0), Ok(16.0), Ok(0.0), Ok(0.0)]);
        assert_eq!(forgotten(f64::NAN), Ok(0.0));
    }
}
