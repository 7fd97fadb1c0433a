//! Storage of cells in a step of time: a diagonal mass, for the implicit Euler method.
//!
//! ```text
//!   c ∂u/∂t ≈ k (u − u_old),   k = c/dt,   m_T = k |T|/m   in a cell T with m sides
//!   K_EE += Σ_T m_T,   b_E += Σ_T m_T u_old,E,   F_E += m_T (u_E − u_old,E)   for side E of T
//! ```
//! Means over edges carry the mass. That is exact for Crouzeix–Raviart triangles, whose products the midpoints of the sides
//! integrate, and keeps the rate on quads. The fluxes out of a cell then add up to k|T| (ū − ū_old) − ∫f for any u, where ū
//! is the mean over its sides.

#[cfg(not(feature = "storage"))]
use core::marker::PhantomData;

use crate::Real;
use crate::error::{Array, Error, all_finite, same_length};
use crate::index::{Index, read};
use crate::mesh::edges::Edges;

/// Storage that a step in time has beside a steady problem, or nothing (borrowed). Of no size where the build has no steps.
#[derive(Debug)]
pub struct IfStoring<'a, T> {
    #[cfg(feature = "storage")]
    of: Option<&'a T>,
    #[cfg(not(feature = "storage"))]
    of: PhantomData<&'a T>,
}

impl<T> Clone for IfStoring<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for IfStoring<'_, T> {}

impl<T> Default for IfStoring<'_, T> {
    fn default() -> Self {
        Self::NOTHING
    }
}

#[cfg(feature = "storage")]
impl<'a, T> IfStoring<'a, T> {
    /// Nothing: a steady problem.
    pub const NOTHING: Self = Self { of: None };

    /// What a step has; nothing in a build without steps.
    pub const fn of(of: &'a T) -> Self {
        Self { of: Some(of) }
    }

    /// What a step has.
    pub const fn get(self) -> Option<&'a T> {
        self.of
    }
}

#[cfg(not(feature = "storage"))]
impl<'a, T> IfStoring<'a, T> {
    /// Nothing: a steady problem.
    pub const NOTHING: Self = Self { of: PhantomData };

    /// What a step has; nothing in a build without steps.
    pub const fn of(_: &'a T) -> Self {
        Self::NOTHING
    }

    /// What a step has.
    pub const fn get(self) -> Option<&'a T> {
        None
    }
}

/// Masses of all cells, and u at the end of the step before (borrowed, validated).
#[derive(Debug, Clone, Copy)]
pub struct Storage<'a, R> {
    triangles: &'a [R],
    quads: &'a [R],
    old: &'a [R],
}

impl<'a, R: Real> Storage<'a, R> {
    /// `triangles` and `quads` hold m_T ≥ 0 of every cell, in the unit of K; `old` has one mean per edge.
    ///
    /// # Errors
    /// Slices of the wrong length, numbers that are not finite, a negative mass.
    pub fn new<I: Index>(
        edges: &Edges<I>,
        [triangles, quads]: [&'a [R]; 2],
        old: &'a [R],
    ) -> Result<Self, Error> {
        same_length(Array::Storage, triangles.len(), edges.of_triangles().len())?;
        same_length(Array::Storage, quads.len(), edges.of_quads().len())?;
        same_length(Array::Unknowns, old.len(), edges.counts().edges())?;
        all_finite(Array::Storage, triangles)?;
        all_finite(Array::Storage, quads)?;
        all_finite(Array::Unknowns, old)?;
        match triangles.iter().chain(quads).position(|&mass| mass < R::ZERO) {
            Some(at) => Err(Error::OutOfRange { of: Array::Storage, at }),
            None => Ok(Self { triangles, quads, old }),
        }
    }

    /// Takes what the host has checked, for a step of a baked scene.
    pub const fn baked([triangles, quads]: [&'a [R]; 2], old: &'a [R]) -> Self {
        Self { triangles, quads, old }
    }

    /// Means of u where the step begins, one per edge.
    pub const fn old(self) -> &'a [R] {
        self.old
    }

    /// Adds Σ_T m_T to each of the first edges, as many as `diagonal` has entries.
    pub fn add_to_diagonal<I: Index>(self, edges: &Edges<I>, diagonal: &mut [R]) {
        self.spread(edges, diagonal, |mass, _| mass);
    }

    /// Adds Σ_T m_T u_old to each of the first edges, as many as `load` has entries.
    pub fn add_to_load<I: Index>(self, edges: &Edges<I>, load: &mut [R]) {
        self.spread(edges, load, |mass, old| mass * old);
    }

    fn spread<I: Index>(self, edges: &Edges<I>, sums: &mut [R], term: impl Fn(R, R) -> R) {
        let mut add = |edge: I, mass: R| {
            if let Some(sum) = sums.get_mut(edge.at()) {
                *sum += term(mass, read(self.old, edge.at()));
            }
        };
        for (sides, &mass) in edges.of_triangles().iter().zip(self.triangles) {
            sides.iter().for_each(|&edge| add(edge, mass));
        }
        for (sides, &mass) in edges.of_quads().iter().zip(self.quads) {
            sides.iter().for_each(|&edge| add(edge, mass));
        }
    }

    /// m_T (u − u_old) on the sides of a triangle, of the means u there.
    #[inline(always)]
    pub fn in_triangle<I: Index>(self, at: usize, sides: &[I; 3], u: [R; 3]) -> [R; 3] {
        self.taken(read(self.triangles, at), sides, u)
    }

    /// m_T (u − u_old) on the sides of a quad, of the means u there.
    #[inline(always)]
    pub fn in_quad<I: Index>(self, at: usize, sides: &[I; 4], u: [R; 4]) -> [R; 4] {
        self.taken(read(self.quads, at), sides, u)
    }

    #[inline(always)]
    fn taken<I: Index, const N: usize>(self, mass: R, sides: &[I; N], mut u: [R; N]) -> [R; N] {
        u.iter_mut().zip(sides).for_each(|(u, edge)| *u = mass * (*u - read(self.old, edge.at())));
        u
    }
}
