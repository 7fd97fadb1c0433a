//! New loads, gaps and boundary values for a workspace: the numeric passes, without the pattern.

use heapless::Vec;

use super::Workspace;
use crate::assembly::{self, CellLoads};
use crate::boundary::{Boundary, Neumann, Robin};
use crate::condition::{BoundaryEdge, Condition};
use crate::edges::Edges;
use crate::error::{Array, Error, all_finite, same_length};
use crate::index::{Index, read};
use crate::math::Libm;
use crate::mesh::Mesh;
use crate::real::Real;
use crate::stiffness::Stiffness;

impl<
    R: Real,
    I: Index,
    const V: usize,
    const T: usize,
    const Q: usize,
    const B: usize,
    const E: usize,
    const N: usize,
    const W: usize,
> Workspace<R, I, V, T, Q, B, E, N, W>
{
    /// Sets all boundary data anew; the iterate stays. An edge keeps its block: contact edges stay
    /// contact and Dirichlet edges stay Dirichlet.
    ///
    /// `condition` is asked twice for every boundary edge, and must say the same: once before anything changes.
    ///
    /// # Errors
    /// An edge without a condition or with one of another block, numbers that are not admissible: the data stay as
    /// they were.
    pub fn set_conditions(
        &mut self,
        mesh: &Mesh<R, I>,
        mut condition: impl FnMut(&BoundaryEdge<R, I>) -> Option<Condition<R>>,
    ) -> Result<(), Error> {
        let mut records = [(Array::Neumann, 0), (Array::Robin, 0), (Array::Contact, 0)];
        for at in 0..self.counts.edges() {
            let kind = match self.asked(mesh, at, &mut condition)? {
                Some((_, Condition::Neumann { .. })) => 0,
                Some((_, Condition::Robin { .. })) => 1,
                Some((_, Condition::Contact { .. })) => 2,
                Some((_, Condition::Dirichlet { .. })) | None => continue,
            };
            if let Some((of, needed)) = records.get_mut(kind) {
                *needed += 1;
                if *needed > B {
                    return Err(Error::Capacity { of: *of, needed: *needed, limit: B });
                }
            }
        }
        self.neumann.clear();
        self.robin.clear();
        self.contact_flux.clear();
        self.gap.clear();
        for at in 0..self.counts.edges() {
            if let Some((length, found)) = self.asked(mesh, at, &mut condition)? {
                self.set_condition(at, length, found)?;
            }
        }
        let Self { of_triangles, of_quads, half_edges, values, .. } = self;
        let edges = Edges::new(of_triangles, of_quads, half_edges, self.counts)?;
        let boundary = Boundary::new(&edges, &self.neumann, &self.robin, &self.contact_flux)?;
        let stiffness = Stiffness { triangles: &self.triangles, quads: &self.quads };
        assembly::values(&edges, stiffness, &boundary, &self.row_ptr, values)?;
        self.fill_load()
    }

    /// Length and condition of an edge, where it is one of the boundary.
    fn asked(
        &self,
        mesh: &Mesh<R, I>,
        at: usize,
        condition: &mut impl FnMut(&BoundaryEdge<R, I>) -> Option<Condition<R>>,
    ) -> Result<Option<(R, Condition<R>)>, Error> {
        if read(&self.half_edges, at)[1] != I::NONE {
            return Ok(None);
        }
        let edges = self.edges()?;
        let ends = edges.endpoints(mesh, at);
        let length = edges.length::<R, Libm>(mesh, at);
        let named = ends.map(|vertex| vertex.at() as u32);
        let found = condition(&BoundaryEdge::new(mesh, ends)).ok_or(Error::NoCondition(named))?;
        if self.counts.block(at) != found.block() {
            return Err(Error::ConditionChanged(named));
        }
        let (of, numbers) = match found {
            Condition::Neumann { flux } => (Array::Neumann, [flux * length; 2]),
            Condition::Robin { coefficient, .. } if coefficient < R::ZERO => {
                return Err(Error::NegativeRobin { edge: at });
            }
            Condition::Robin { coefficient, ambient } => {
                (Array::Robin, [coefficient * length, coefficient * length * ambient])
            }
            Condition::Contact { gap, flux } => (Array::Contact, [gap, flux * length]),
            Condition::Dirichlet { value } => (Array::Dirichlet, [value; 2]),
        };
        match numbers.iter().all(|number| number.finite()) {
            true => Ok(Some((length, found))),
            false => Err(Error::NotFinite { of, at }),
        }
    }

    fn set_condition(&mut self, at: usize, length: R, found: Condition<R>) -> Result<(), Error> {
        let edge = I::new(at).unwrap_or(I::NONE);
        match found {
            Condition::Neumann { flux } => {
                push(&mut self.neumann, Neumann { edge, flux: flux * length }, Array::Neumann)
            }
            Condition::Robin { coefficient, ambient } => {
                let coefficient = coefficient * length;
                let record = Robin { edge, coefficient, ambient: coefficient * ambient };
                push(&mut self.robin, record, Array::Robin)
            }
            Condition::Contact { gap, flux } => {
                push(&mut self.contact_flux, flux * length, Array::Contact)?;
                push(&mut self.gap, gap, Array::Contact)
            }
            Condition::Dirichlet { value } => {
                if let Some(entry) = self.u.get_mut(at) {
                    *entry = value;
                }
                Ok(())
            }
        }
    }

    /// Sets ∫_T f of every cell; the iterate stays.
    ///
    /// # Errors
    /// Slices of the wrong length, numbers that are not finite: nothing is changed then.
    pub fn set_source(&mut self, triangles: &[R], quads: &[R]) -> Result<(), Error> {
        same_length(Array::CellLoads, triangles.len(), self.source_triangles.len())?;
        same_length(Array::CellLoads, quads.len(), self.source_quads.len())?;
        all_finite(Array::CellLoads, triangles)?;
        all_finite(Array::CellLoads, quads)?;
        self.source_triangles.copy_from_slice(triangles);
        self.source_quads.copy_from_slice(quads);
        self.fill_load()
    }

    fn fill_load(&mut self) -> Result<(), Error> {
        let Self { of_triangles, of_quads, half_edges, load, .. } = self;
        let edges = Edges::new(of_triangles, of_quads, half_edges, self.counts)?;
        let boundary = Boundary::new(&edges, &self.neumann, &self.robin, &self.contact_flux)?;
        let cells = CellLoads { triangles: &self.source_triangles, quads: &self.source_quads };
        assembly::load(&edges, cells, &boundary, load)
    }
}

fn push<T, const N: usize>(storage: &mut Vec<T, N>, entry: T, of: Array) -> Result<(), Error> {
    storage.push(entry).map_err(|_| Error::Capacity { of, needed: N + 1, limit: N })
}
