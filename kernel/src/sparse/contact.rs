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
//! [`crate::condensed::pivoting`]: as many exchanges as edges change sides since the last solve.

use super::factor::Factor;
use crate::boundary::Boundary;
use crate::condensed::Iterate;
use crate::condensed::blocks::{Block, Blocks, SIDE, padded};
use crate::condensed::pivoting::{self, Found};
use crate::condensed::tableau::{Start, Tableau};
use crate::error::{Array, Error, same_length};
use crate::index::{Index, read, write};
use crate::real::Real;
use crate::refinement::{defects, renormalise};
use crate::signorini::{Residual, System};
use crate::solver::{Settings, Status};

/// Rounds at most, exchanges and corrections together.
const ROUNDS: u32 = 16;

/// What a solve did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress<R> {
    /// How it ended: `Converged`, `RoundingLimit` where corrections are down to rounding, or `Stalled` where they
    /// stopped to shrink before that.
    pub status: Status,
    /// The residual of u.
    pub residual: Residual<R>,
    /// Exchanges.
    pub pivots: u32,
    /// Substitutions with the factor.
    pub rounds: u32,
}

/// Memory of a contact problem: P is [`padded`] contact edges, B the number of blocks of S.
#[derive(Debug)]
pub struct Memory<'a, R> {
    /// S as the factor left it: B blocks. Becomes scaled.
    pub schur: &'a mut [Block<R>],
    /// Scratch for exchanges: B blocks.
    pub tableau: &'a mut [Block<R>],
    /// Which edges are exchanged: P entries.
    pub exchanged: &'a mut [bool],
    /// Zeros, P of them: where exchanges begin.
    pub none: &'a mut [bool],
    /// Scratch, P entries each.
    pub columns: [&'a mut [R]; 2],
    /// Becomes 1/√S_ii: P entries.
    pub scale: &'a mut [R],
    /// Scratch, P entries.
    pub load: &'a mut [R],
    /// x = v √S_ii, kept from solve to solve; scratch beside it. P entries each.
    pub iterate: Iterate<'a, R>,
    /// Scratch, one entry an unknown.
    pub places: &'a mut [R],
}

/// A factor with its contact problem, ready for any number of loads.
#[derive(Debug)]
pub struct Direct<'a, R, I> {
    factor: Factor<'a, R, I>,
    schur: &'a [Block<R>],
    tableau: Tableau<'a, R>,
    none: &'a [bool],
    scale: &'a [R],
    load: &'a mut [R],
    iterate: Iterate<'a, R>,
    places: &'a mut [R],
}

impl<'a, R: Real, I: Index> Direct<'a, R, I> {
    /// Takes a factor and the S that it left in `memory.schur`. `None` where S has no positive diagonal.
    ///
    /// # Errors
    /// Memory of the wrong length.
    pub fn new(factor: Factor<'a, R, I>, memory: Memory<'a, R>) -> Result<Option<Self>, Error> {
        let counts = factor.pattern().counts();
        let Memory { schur, tableau, exchanged, none, columns, scale, load, iterate, places } =
            memory;
        let length = padded(counts.contact);
        let Iterate { x, residual, scratch, open } = &iterate;
        for found in [scale.len(), load.len(), x.len(), residual.len(), scratch.len()] {
            same_length(Array::Scratch, found, length)?;
        }
        for found in [open.len(), exchanged.len(), none.len()] {
            same_length(Array::Contact, found, length)?;
        }
        same_length(Array::Scratch, places.len(), counts.unknowns())?;
        Blocks::new(schur, counts.contact)?;
        if !normalise(schur, scale, counts.contact) {
            return Ok(None);
        }
        none.fill(false);
        iterate.x.fill(R::ZERO);
        let mut tableau = Tableau::new(counts.contact, tableau, exchanged, columns)?;
        tableau.reset(&Start { blocks: schur, exchanged: none })?;
        Ok(Some(Self { factor, schur, tableau, none, scale, load, iterate, places }))
    }

    /// Solves `system`, from any `u`, which becomes the answer together with its low part `low`; the
    /// tolerances of `settings` tell whether it is good enough. `None` where there is no answer that this
    /// scalar can hold: no solution, or a matrix that is singular in it; u is of no use then.
    ///
    /// # Errors
    /// Arrays of the wrong length, a system with other edges than the factor's.
    pub fn solve(
        &mut self,
        system: &System<R, I>,
        boundary: &Boundary<R, I>,
        settings: &Settings<R>,
        u: &mut [R],
        low: &mut [R],
    ) -> Result<Option<Progress<R>>, Error> {
        let counts = self.factor.pattern().counts();
        same_length(Array::Unknowns, u.len(), counts.edges())?;
        same_length(Array::Scratch, low.len(), u.len())?;
        same_length(Array::Contact, system.lower().len(), counts.contact)?;
        self.restart(system, u);
        low.fill(R::ZERO);
        let (mut pivots, mut rounds, mut last) = (0, 0, None);
        // Where exchanges find nothing to exchange, what looks wrong is rounding.
        let mut settled = false;
        while rounds < ROUNDS {
            rounds += 1;
            self.reduce(system, boundary, u);
            if last.is_none() || !settled && self.is_wrong() {
                let Some(exchanges) = self.exchange(system.lower(), u)? else { return Ok(None) };
                settled = exchanges == 0 && last.is_some();
                pivots += exchanges;
                self.substitute(low);
                // The openings are in u already.
                let contact = low.iter_mut().skip(counts.free).take(counts.contact);
                contact.for_each(|change| *change = R::ZERO);
                renormalise(u, low);
                last = Some(R::ONE / R::ZERO);
                continue;
            }
            self.correct()?;
            let change = self.substitute(low) / size(u);
            if last.is_some_and(|last| !(change < R::HALF * last)) {
                low.fill(R::ZERO);
                break;
            }
            renormalise(u, low);
            last = Some(change);
            if change <= R::EPSILON {
                break;
            }
        }
        let residual = system.residual(u);
        if !(residual.largest.finite() && residual.range.finite()) {
            return Ok(None);
        }
        // The last correction that was made, relative to u, tells how many digits rounding leaves: three at least.
        let digits = last.is_some_and(|last| R::from_count(1024) * last <= R::ONE);
        let status = match settings.is_met(&residual, R::ONE) {
            true => Status::Converged,
            false if digits => Status::RoundingLimit,
            false => Status::Stalled,
        };
        Ok(Some(Progress { status, residual, pivots, rounds }))
    }

    /// Contact edges onto ψ + v, v as the last solve left it.
    fn restart(&mut self, system: &System<R, I>, u: &mut [R]) {
        let contact = u.iter_mut().skip(system.counts().free).zip(system.lower());
        for ((u, &lower), (x, &scale)) in contact.zip(self.iterate.x.iter().zip(self.scale)) {
            *u = lower + *x * scale;
        }
    }

    /// y and, scaled in `load`, b̃ for the defect of u.
    fn reduce(&mut self, system: &System<R, I>, boundary: &Boundary<R, I>, u: &[R]) {
        let pattern = self.factor.pattern();
        let free = pattern.counts().free;
        for (unknown, defect) in defects(system, u).enumerate() {
            write(self.places, pattern.place(unknown), defect);
        }
        boundary.add_to_diagonal(|edge, coefficient| {
            if let Some(defect) = self.places.get_mut(pattern.place(edge)) {
                *defect -= coefficient * read(u, edge);
            }
        });
        self.factor.eliminate(self.places);
        self.load.fill(R::ZERO);
        let reduced = self.places.iter().skip(free).zip(self.scale);
        self.load.iter_mut().zip(reduced).for_each(|(load, (&b, &scale))| *load = b * scale);
    }

    /// Whether an edge that touches is pulled off the gap, by more than rounding.
    fn is_wrong(&self) -> bool {
        let size = pivoting::square(self.iterate.x).rounded_sqrt();
        let noise = R::from_count(64) * R::EPSILON * size;
        let edges = self.load.iter().zip(self.iterate.x.iter());
        edges.into_iter().any(|(&b, &x)| x == R::ZERO && b > noise)
    }

    /// Finds which edges touch; u_C = ψ + v, and the change of v goes behind y. Returns the exchanges, or
    /// nothing where there is no solution.
    fn exchange(&mut self, lower: &[R], u: &mut [R]) -> Result<Option<u32>, Error> {
        let counts = self.factor.pattern().counts();
        let matrix = Blocks::new(self.schur, counts.contact)?;
        let start = Start { blocks: self.schur, exchanged: self.none };
        for (open, &x) in self.iterate.open.iter_mut().zip(self.iterate.x.iter()) {
            *open = x > R::ZERO;
        }
        let Iterate { x, residual, scratch, open } = &mut self.iterate;
        crate::condensed::blocks::multiply_add(&matrix, x, open, self.load)?;
        let cap = (4 * counts.contact + 16) as u32;
        let iterate = Iterate { x, residual, scratch, open };
        let (found, pivots) =
            pivoting::find(&matrix, self.load, &mut self.tableau, &start, cap, iterate)?;
        if found != Found::Exact {
            return Ok(None);
        }
        let values = self.iterate.x.iter().zip(self.scale).zip(lower);
        let contact = u.iter_mut().skip(counts.free).zip(values);
        for ((u, ((&x, &scale), &lower)), place) in contact.zip(counts.free..) {
            let new = lower + x * scale;
            write(self.places, place, new - *u);
            *u = new;
        }
        Ok(Some(pivots))
    }

    /// The change of v with the edges that touch held, behind y.
    fn correct(&mut self) -> Result<(), Error> {
        let free = self.factor.pattern().counts().free;
        let change = &mut *self.iterate.scratch;
        self.tableau.respond(self.load, change)?;
        let entries = self.places.iter_mut().skip(free).zip(change.iter().zip(self.scale));
        for ((place, (&z, &scale)), &x) in entries.zip(self.iterate.x.iter()) {
            *place = if x > R::ZERO { -z * scale } else { R::ZERO };
        }
        Ok(())
    }

    /// `low` = L⁻ᵀ(…) by unknowns; returns its largest entry.
    fn substitute(&mut self, low: &mut [R]) -> R {
        self.factor.substitute(self.places);
        let pattern = self.factor.pattern();
        let mut most = R::ZERO;
        for (place, &z) in self.places.iter().enumerate() {
            write(low, pattern.unknown(place), z);
            if !(z.magnitude() <= most) {
                most = z.magnitude();
            }
        }
        most
    }
}

/// max |u|, at least the smallest normal number.
fn size<R: Real>(u: &[R]) -> R {
    u.iter().fold(R::TINY, |most, u| most.or_larger(u.magnitude()))
}

/// S to a diagonal of 1, `scale` to 1/√S_ii; false where an entry on the diagonal is not positive.
fn normalise<R: Real>(schur: &mut [Block<R>], scale: &mut [R], order: usize) -> bool {
    let mut positive = true;
    scale.fill(R::ZERO);
    for (row, scale) in scale.iter_mut().enumerate().take(order) {
        let position = crate::condensed::blocks::count(row / SIDE * SIDE) + row / SIDE;
        let line = schur.get(position).and_then(|block| block.get(row % SIDE));
        let diagonal = line.map_or(R::ZERO, |line| read(line, row % SIDE));
        *scale = R::ONE / diagonal.rounded_sqrt();
        positive &= diagonal > R::ZERO && scale.finite();
    }
    let mut blocks = schur.iter_mut();
    for row in 0..order.div_ceil(SIDE) {
        for (column, block) in blocks.by_ref().take(row + 1).enumerate() {
            for (r, line) in block.iter_mut().enumerate() {
                for (c, entry) in line.iter_mut().enumerate() {
                    *entry *= read(scale, row * SIDE + r) * read(scale, column * SIDE + c);
                }
            }
        }
    }
    positive
}
