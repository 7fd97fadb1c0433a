//! The discrete contact problem (14) and how far an iterate is from solving it.
//!
//! Minimise ½ uᵀKu − bᵀu over edge means with u_E ≥ ψ_E on contact edges. With r = b − Ku, u solves
//! it exactly when
//! ```text
//!   r_i = 0                            on free edges
//!   min(u_i − ψ_i, −r_i / K_ii) = 0    on contact edges: feasible, λ ≥ 0, and one of both is 0.
//! ```
//! The residual that stops the solver is the largest of |r_i|/K_ii and |min(…)|: a length in u,
//! the same whatever the units of K, divided by the size of u (see [`Residual::scaled`]).

use crate::csr::Csr;
use crate::error::{Array, Error, all_finite, same_length};
use crate::index::{Index, read};
use crate::law::{EdgeLaw, Law, Move};
use crate::mesh::diagonal::DiagonalTerms;
use crate::mesh::edges::EdgeCounts;
use crate::{Real, features};

/// Which part each unknown belongs to, and what holds the parts (borrowed).
#[derive(Debug, Clone, Copy)]
pub struct Shifts<'a, R, I> {
    /// The part of each unknown, from 0; empty where there is only one part.
    pub part: &'a [I],
    /// How many parts there are.
    pub parts: usize,
    /// Terms on the diagonal of K beyond the element matrices.
    pub diagonal: DiagonalTerms<'a, R, I>,
}

/// Matrix, load and bounds of one contact problem (borrowed, validated).
#[derive(Debug, Clone, Copy)]
pub struct System<'a, R, I> {
    matrix: Csr<'a, R, I>,
    load: &'a [R],
    law: Law<'a, R>,
    counts: EdgeCounts,
    shifts: Option<Shifts<'a, R, I>>,
}

impl<'a, R: Real, I: Index> System<'a, R, I> {
    /// `load` holds b, one entry an unknown.
    ///
    /// # Errors
    /// Lengths that do not match the counts, numbers that are not finite.
    pub fn new(
        matrix: Csr<'a, R, I>,
        load: &'a [R],
        law: Law<'a, R>,
        counts: EdgeCounts,
    ) -> Result<Self, Error> {
        same_length(Array::RowPointers, matrix.rows(), counts.unknowns())?;
        same_length(Array::Load, load.len(), counts.unknowns())?;
        law.check_length(counts)?;
        all_finite(Array::Load, load)?;
        law.check_finite()?;
        Ok(Self { matrix, load, law, counts, shifts: None })
    }

    /// This problem with the solver allowed to shift whole parts ([`crate::shift`]).
    ///
    /// # Errors
    /// Parts of another length than the unknowns (or empty).
    pub fn with_shifts(self, shifts: Shifts<'a, R, I>) -> Result<Self, Error> {
        if !shifts.part.is_empty() {
            same_length(Array::Scratch, shifts.part.len(), self.counts.unknowns())?;
        }
        Ok(Self { shifts: Some(shifts), ..self })
    }

    /// This matrix and its shifts with another load and another gap.
    ///
    /// # Errors
    /// As for [`System::new`].
    pub fn with_data<'b>(&self, load: &'b [R], law: Law<'b, R>) -> Result<System<'b, R, I>, Error>
    where
        'a: 'b,
    {
        let system = System::new(self.matrix, load, law, self.counts)?;
        Ok(System { shifts: self.shifts, ..system })
    }

    pub(crate) fn shifts(&self) -> Option<Shifts<'a, R, I>> {
        self.shifts
    }

    /// K, one row an unknown and one column an edge.
    pub fn matrix(&self) -> &Csr<'a, R, I> {
        &self.matrix
    }

    /// b
    pub fn load(&self) -> &'a [R] {
        self.load
    }

    /// The law on the contact edges.
    pub fn law(&self) -> Law<'a, R> {
        self.law
    }

    /// The law on unknown i, where it belongs to a contact edge.
    #[inline(always)]
    pub(crate) fn law_on(&self, i: usize) -> Option<EdgeLaw<R>> {
        let contact = i.checked_sub(self.counts.free)?;
        Some(self.law.on(contact))
    }

    /// Sizes of the blocks of u.
    pub fn counts(&self) -> EdgeCounts {
        self.counts
    }

    /// Puts u onto the gap wherever it may not be where it is (or is not a number): any iterate becomes feasible.
    pub fn make_feasible(&self, u: &mut [R]) {
        let on_contact = u.get_mut(self.counts.free..).unwrap_or_default();
        self.law.snap_to_gap(on_contact, &mut []);
    }

    /// Measures the iterate `u` (one entry an edge, Dirichlet values included).
    pub fn residual(&self, u: &[R]) -> Residual<R> {
        let mut measure = Residual::default();
        let (mut lowest, mut highest) = (R::ZERO, R::ZERO);
        if let Some(&first) = u.first() {
            (lowest, highest) = (first, first);
        }
        for &value in u.iter().chain(self.law.lower()) {
            lowest = lowest.or_smaller(value);
            highest = highest.or_larger(value);
        }
        measure.range = highest - lowest;
        let (law, free) = (self.law, self.counts.free);
        for (i, (row, &load)) in self.matrix.iter().zip(self.load).enumerate() {
            let (mut r, mut size) = (load, load.magnitude());
            for (column, value) in row.entries() {
                let product = value * read(u, column);
                r -= product;
                size += product.magnitude();
            }
            let per_diagonal = R::ONE / row.diagonal();
            let mut step = r * per_diagonal;
            let mut terms = size * per_diagonal;
            if i >= free {
                let (law, own) = (law.on(i - free), read(u, i));
                measure.active += u32::from(law.touches(own));
                match law.movement(law.opening(own), step, per_diagonal) {
                    Move::Row(moved) if features::LIMITED => {
                        terms += (moved - step).magnitude();
                        step = moved;
                    }
                    Move::Row(_) => {}
                    Move::Gap(opening) => {
                        step = opening;
                        terms = own.magnitude() + law.gap().magnitude();
                    }
                }
            }
            measure.include(step.magnitude(), load.magnitude() * per_diagonal, terms);
        }
        measure
    }
}

/// How far an iterate is from complementarity.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Residual<R> {
    /// max |r_i|/K_ii, on contact edges |min(u_i − ψ_i, −r_i/K_ii)|. NaN where anything is.
    pub largest: R,
    /// The sum of the same over all unknowns.
    pub sum: R,
    /// max − min over u, u_D and ψ.
    pub range: R,
    /// max |b_i|/K_ii
    pub load: R,
    /// Residual that rounding alone can make of `largest`: ε max (|b_i| + Σ|K_ij u_j|)/K_ii, on contact edges
    /// ε (|u_i| + |ψ_i|) where the opening decides.
    pub rounding: R,
    /// Number of active contact edges, u_E = ψ_E.
    pub active: u32,
}

impl<R: Real> Residual<R> {
    /// `terms` is the size of what `step` was summed from.
    fn include(&mut self, step: R, load: R, terms: R) {
        // Written so that a NaN is taken over and then stays.
        let is_nan = !(self.largest >= R::ZERO);
        if !(step <= self.largest || is_nan) {
            self.largest = step;
        }
        self.sum += step;
        self.load = self.load.or_larger(load);
        self.rounding = self.rounding.or_larger(terms * R::EPSILON);
    }

    /// `largest` divided by max(`range`, `load`, the smallest normal number).
    pub fn scaled(&self) -> R {
        self.largest / self.scale()
    }

    /// The size that `scaled` refers to.
    pub fn scale(&self) -> R {
        self.range.or_larger(self.load).or_larger(R::TINY)
    }
}
