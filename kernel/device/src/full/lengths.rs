//! How long the memory of a baked scene is: the one list of its arrays.

use super::{Full, Pattern};
use crate::tick::Progress;
use signorini_bound::certificate::Curved;
use signorini_kernel::mesh::boundary::{Neumann, Robin};
use signorini_kernel::rows::Row;
use signorini_kernel::{Index, Real};

/// Every array of numbers, in their order in memory: `T` is its length, or the array.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Numbers<T> {
    /// The load.
    pub load: T,
    /// Means of u over the edges: where the next tick starts.
    pub u: T,
    /// The fluxes, of the error bound where there is one.
    pub tau: T,
    /// The continuous function of the error bound, at the vertices.
    pub vertices: T,
    /// The same on edges of quads.
    pub bubbles: T,
    /// ∫f of triangles, with what inputs add; so all below.
    pub triangles: T,
    /// ∫f of quads.
    pub quads: T,
    /// ∫q
    pub contact_flux: T,
    /// ψ
    pub gap: T,
    /// ψ at both ends of its edges.
    pub gap_ends: T,
    /// u_D
    pub dirichlet: T,
    /// u_D at both ends of its edges.
    pub dirichlet_ends: T,
    /// ∫h and u_ext at 8 points of each transfer edge.
    pub transfer: T,
    /// ∫(hi − lo) of contact edges.
    pub spans: T,
    /// Where a step in time begins: u, s at the vertices and its bubbles.
    pub begin: [T; 3],
    /// How far s was from ψ then, at contact edges.
    pub openings: T,
    /// What the bound of the evolution carries.
    pub carried: T,
    /// What K_ii has beyond the element matrices in a step whose transfer coefficients change.
    pub diagonal: T,
    /// The fluxes where cells hand on what they lack of balance, in a step with a bound.
    pub handed: T,
}

/// The lengths of all arrays that change; data that no input changes have none.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Lengths {
    /// Packed rows: the unknowns.
    pub rows: usize,
    /// Flags of contact edges, one each.
    pub active: usize,
    /// Numbers, by array.
    pub numbers: Numbers<usize>,
    /// Given fluxes.
    pub neumann: usize,
    /// Transfer laws.
    pub robin: usize,
    /// Curved edges.
    pub curved: usize,
}

impl<T> Numbers<T> {
    /// Applies `each` to every field; `None` if it returns `None` for any.
    pub fn map<U>(self, mut each: impl FnMut(T) -> Option<U>) -> Option<Numbers<U>> {
        Some(Numbers {
            load: each(self.load)?,
            u: each(self.u)?,
            tau: each(self.tau)?,
            vertices: each(self.vertices)?,
            bubbles: each(self.bubbles)?,
            triangles: each(self.triangles)?,
            quads: each(self.quads)?,
            contact_flux: each(self.contact_flux)?,
            gap: each(self.gap)?,
            gap_ends: each(self.gap_ends)?,
            dirichlet: each(self.dirichlet)?,
            dirichlet_ends: each(self.dirichlet_ends)?,
            transfer: each(self.transfer)?,
            spans: each(self.spans)?,
            begin: {
                let [u, vertices, bubbles] = self.begin;
                [each(u)?, each(vertices)?, each(bubbles)?]
            },
            openings: each(self.openings)?,
            carried: each(self.carried)?,
            diagonal: each(self.diagonal)?,
            handed: each(self.handed)?,
        })
    }
}

impl Numbers<usize> {
    /// Total number of entries.
    pub const fn sum(&self) -> usize {
        let of_tick = self.load + self.u + self.tau + self.vertices + self.bubbles;
        let of_cells = self.triangles + self.quads;
        let of_contact = self.contact_flux + self.gap + self.gap_ends + self.spans;
        let [u, vertices, bubbles] = self.begin;
        let of_bound = self.openings + self.carried + self.handed;
        let of_step = u + vertices + bubbles + of_bound + self.diagonal;
        let given = self.dirichlet + self.dirichlet_ends + self.transfer;
        of_tick + of_cells + of_contact + given + of_step
    }
}

impl Lengths {
    /// Those of `full`.
    pub const fn of<R: Real, I: Index>(full: &Full<R, I>) -> Self {
        let mut lengths = Self::without_inputs(full);
        lengths.curved = full.base.curved_sums.len();
        lengths.store(full);
        let mut left = full.patterns;
        while let Some((pattern, rest)) = left.split_first() {
            lengths.add(pattern, full);
            left = rest;
        }
        lengths
    }

    /// Memory for what a step hands on.
    const fn store<R: Real, I: Index>(&mut self, full: &Full<R, I>) {
        let numbers = &mut self.numbers;
        if let Some(storing) = full.storing.get() {
            numbers.begin = [numbers.u, numbers.vertices, numbers.bubbles];
            numbers.openings = 2 * self.active;
            numbers.carried = 2;
            numbers.handed = if storing.cells.is_empty() { 0 } else { numbers.tau };
        }
    }

    const fn without_inputs<R: Real, I: Index>(full: &Full<R, I>) -> Self {
        let (counts, mesh) = (full.discretization.edges.counts(), &full.discretization.mesh);
        let numbers = Numbers {
            load: counts.unknowns(),
            u: counts.edges(),
            tau: counts.edges(),
            vertices: mesh.vertices().len(),
            bubbles: if mesh.quads().is_empty() { 0 } else { counts.edges() },
            triangles: 0,
            quads: 0,
            contact_flux: 0,
            gap: 0,
            gap_ends: 0,
            dirichlet: 0,
            dirichlet_ends: 0,
            transfer: 0,
            spans: 0,
            begin: [0; 3],
            openings: 0,
            carried: 0,
            diagonal: 0,
            handed: 0,
        };
        let (rows, active) = (counts.unknowns(), counts.contact);
        Self { rows, active, numbers, neumann: 0, robin: 0, curved: 0 }
    }

    /// Memory for what `pattern` changes.
    const fn add<R: Real, I: Index>(&mut self, pattern: &Pattern<R, I>, full: &Full<R, I>) {
        let (base, numbers) = (&full.base, &mut self.numbers);
        match pattern {
            Pattern::Source { .. } => {
                numbers.triangles = base.loads.triangles.len();
                numbers.quads = base.loads.quads.len();
            }
            Pattern::Neumann(_) => self.neumann = base.neumann.len(),
            Pattern::ContactFlux(_) => numbers.contact_flux = base.contact_flux.len(),
            // Both ends go to their mean where they cross by rounding.
            Pattern::ContactRange { .. } => {
                numbers.contact_flux = base.contact_flux.len();
                numbers.spans = base.spans.count();
            }
            Pattern::Gap(_) => {
                numbers.gap = base.gap.len();
                numbers.gap_ends = base.ends.gap.as_flattened().len();
            }
            Pattern::Value(_) => {
                numbers.dirichlet = base.dirichlet.len();
                numbers.dirichlet_ends = base.ends.given.as_flattened().len();
            }
            Pattern::Ambient { .. } | Pattern::Coefficient(_) => {
                if full.storing.get().is_some() && matches!(pattern, Pattern::Coefficient(_)) {
                    numbers.diagonal = numbers.load;
                }
                self.robin = base.robin.len();
                numbers.transfer = base.transfer.points().as_flattened().as_flattened().len();
            }
        }
    }

    /// Bytes of a [`super::Storage`] on a machine of 32 bits, alignment aside.
    pub const fn bytes<R, I, const WIDTH: usize>(&self) -> usize {
        let Self { rows, active, numbers, neumann, robin, curved } = *self;
        let of_rows = rows * size_of::<Row<R, I, WIDTH>>() + 3 * size_of::<u32>();
        let of_neumann = neumann * size_of::<Neumann<R, I>>();
        let of_robin = robin * size_of::<Robin<R, I>>();
        let of_curved = curved * size_of::<Curved<R, I>>();
        let records = of_neumann + of_robin + of_curved;
        of_rows + numbers.sum() * size_of::<R>() + active + records + size_of::<Progress<R>>()
    }
}
