//! New loads, gaps and boundary values for a workspace: the numeric passes, without the pattern.

use heapless::Vec;

use super::{Workspace, bound, fit};
use crate::condition::{BoundaryEdge, Condition};
use signorini_kernel::assembly::{self, CellLoads};
use signorini_kernel::error::{Array, Error, all_finite, known, same_length};
use signorini_kernel::index::{Index, read};
use signorini_kernel::mesh::boundary::{Boundary, Neumann, Robin};
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::mesh::edges::Edges;
use signorini_kernel::mesh::numbering::{NumberingBuffers, number};
use signorini_kernel::{Libm, Mesh, Real, features};

impl<
    R: Real,
    I: Index,
    const V: usize,
    const T: usize,
    const Q: usize,
    const B: usize,
    const C: usize,
    const E: usize,
    const N: usize,
    const W: usize,
> Workspace<R, I, V, T, Q, B, C, E, N, W>
{
    /// Sets all boundary data anew; the iterate stays. An edge keeps its block: contact edges stay
    /// contact and Dirichlet edges stay Dirichlet.
    ///
    /// `condition` is asked twice for every boundary edge, once before anything changes, and should say the same. The work
    /// is that of the boundary edges; where a transfer coefficient changes, matrix and ways out are worked out anew.
    ///
    /// # Errors
    /// An edge without a condition or with one of another block, numbers that are not admissible: the data stay as
    /// they were. Where only the second asking is refused, the workspace has to be built anew ([`Error::NotBuilt`]).
    pub fn set_conditions(
        &mut self,
        mesh: &Mesh<R, I>,
        mut condition: impl FnMut(&BoundaryEdge<R, I>) -> Option<Condition<R>>,
    ) -> Result<(), Error> {
        if !self.built {
            return Err(Error::NotBuilt);
        }
        if mesh.vertices().len() != self.at_vertex.len() || mesh.cells() != self.cells() {
            return Err(Error::OtherMesh);
        }
        let edges = self.numbered();
        for (edge, length) in self.boundary.iter().zip(&self.lengths) {
            Asked::new(&edges, mesh, edge.at(), *length, &mut condition)?;
        }
        self.replace_conditions(mesh, condition)
    }

    /// Asks for the condition of every edge again and stores the answers: the first round only checked them.
    pub(super) fn replace_conditions(
        &mut self,
        mesh: &Mesh<R, I>,
        mut condition: impl FnMut(&BoundaryEdge<R, I>) -> Option<Condition<R>>,
    ) -> Result<(), Error> {
        let had_matrix = core::mem::replace(&mut self.built, false);
        let before = self.robin.len();
        self.neumann.clear();
        self.contact_flux.clear();
        self.gap.clear();
        self.gap_ends.clear();
        self.dirichlet.clear();
        self.dirichlet_ends.clear();
        let (mut laws, mut same) = (0, had_matrix);
        for at in 0..self.boundary.len() {
            let (edge, length) = (read(&self.boundary, at), read(&self.lengths, at));
            let asked = Asked::new(&self.numbered(), mesh, edge.at(), length, &mut condition)?;
            match asked.law(edge) {
                Some(law) => {
                    same &= self.set_law(laws, law)?;
                    laws += 1;
                }
                None => self.set_condition(edge, &asked)?,
            }
        }
        self.robin.truncate(laws);
        if !(same && laws == before) {
            self.fill_matrix(mesh)?;
        }
        self.load_boundary()?;
        let Self { of_triangles, of_quads, half_edges, counts, at_vertex, .. } = self;
        let edges = Edges::baked(of_triangles, of_quads, half_edges, *counts);
        let ends = super::ends(&self.gap_ends, &self.dirichlet_ends);
        self.support = bound::support(mesh, &edges, ends, at_vertex);
        self.built = true;
        Ok(())
    }

    /// Puts a transfer law at its place; whether it has the edge and the coefficient of the one that was there.
    fn set_law(&mut self, at: usize, law: Robin<R, I>) -> Result<bool, Error> {
        match self.robin.get_mut(at) {
            Some(old) => {
                let same = old.edge == law.edge && old.coefficient == law.coefficient;
                *old = law;
                Ok(same)
            }
            None => push(&mut self.robin, law, Array::Robin).map(|()| false),
        }
    }

    fn set_condition(&mut self, edge: I, asked: &Asked<R>) -> Result<(), Error> {
        let length = asked.length;
        match asked.condition {
            Condition::Neumann { flux } => {
                push(&mut self.neumann, Neumann { edge, flux: flux * length }, Array::Neumann)
            }
            // A law without transfer insulates.
            Condition::Robin { .. } => Ok(()),
            Condition::Contact { flux, .. } | Condition::ContactBetween { flux, .. } => {
                push(&mut self.contact_flux, flux * length, Array::Contact)?;
                push(&mut self.gap, asked.mean(), Array::Contact)?;
                push(&mut self.gap_ends, asked.ends(), Array::Contact)
            }
            Condition::Dirichlet { .. } | Condition::DirichletBetween { .. } => {
                push(&mut self.dirichlet, asked.mean(), Array::Dirichlet)?;
                push(&mut self.dirichlet_ends, asked.ends(), Array::Dirichlet)
            }
        }
    }

    /// Numbers the edges as the conditions say, and lists those of the boundary with their lengths.
    pub(super) fn number_edges(
        &mut self,
        mesh: &Mesh<R, I>,
        condition: &mut impl FnMut(&BoundaryEdge<R, I>) -> Option<Condition<R>>,
    ) -> Result<(), Error> {
        fit(&mut self.at_vertex, mesh.vertices().len(), Array::Vertices)?;
        fit(&mut self.of_triangles, mesh.triangles().len(), Array::Triangles)?;
        fit(&mut self.of_quads, mesh.quads().len(), Array::Quads)?;
        let most = E.min(mesh.half_edges());
        fit(&mut self.half_edges, most, Array::Edges)?;
        let mut next = Vec::<I, E>::new();
        fit(&mut next, most, Array::Edges)?;
        let buffers = NumberingBuffers {
            of_triangles: &mut self.of_triangles,
            of_quads: &mut self.of_quads,
            half_edges: &mut self.half_edges,
            at_vertex: &mut self.at_vertex,
            next: &mut next,
        };
        let block = |ends| condition(&BoundaryEdge::new(mesh, ends)).map(|found| found.block());
        self.counts = number(mesh, buffers, block)?.counts();
        self.half_edges.truncate(self.counts.edges());
        self.list_boundary(mesh)
    }

    fn list_boundary(&mut self, mesh: &Mesh<R, I>) -> Result<(), Error> {
        let Self { of_triangles, of_quads, half_edges, boundary, lengths, .. } = self;
        let edges = Edges::baked(of_triangles, of_quads, half_edges, self.counts);
        let is_outer = |at: &usize| read(edges.half_edges(), *at)[1] == I::NONE;
        let needed = (0..self.counts.edges()).filter(is_outer).count();
        fit(boundary, needed, Array::Boundary)?;
        fit(lengths, needed, Array::Boundary)?;
        let places = boundary.iter_mut().zip(lengths.iter_mut());
        for (at, (edge, length)) in (0..self.counts.edges()).filter(is_outer).zip(places) {
            *edge = I::new(at).unwrap_or(I::NONE);
            *length = edges.length::<R, Libm>(mesh, at);
        }
        Ok(())
    }

    /// The matrix and the ways out, which follow the transfer laws.
    fn fill_matrix(&mut self, mesh: &Mesh<R, I>) -> Result<(), Error> {
        let Self { of_triangles, of_quads, half_edges, counts, equilibration, values, .. } = self;
        let edges = Edges::baked(of_triangles, of_quads, half_edges, *counts);
        let boundary = Boundary::new(&edges, &self.neumann, &self.robin, &self.contact_flux)?;
        let stiffness = super::stiffness_of(&self.triangles, &self.quads);
        if N > 0 {
            let diagonal = DiagonalTerms::new(&boundary);
            assembly::values(&edges, stiffness, diagonal, &self.row_ptr, values)?;
        }
        equilibration.find_ways(mesh, &edges, stiffness, &boundary)
    }

    /// b on the boundary edges anew: the share of the one cell, and what the conditions add.
    fn load_boundary(&mut self) -> Result<(), Error> {
        let Self { of_triangles, of_quads, half_edges, load, .. } = self;
        let edges = Edges::baked(of_triangles, of_quads, half_edges, self.counts);
        let boundary = Boundary::new(&edges, &self.neumann, &self.robin, &self.contact_flux)?;
        let cells = CellLoads { triangles: &self.source_triangles, quads: &self.source_quads };
        for edge in &self.boundary {
            if let Some(entry) = load.get_mut(edge.at()) {
                *entry = assembly::share_of_cell(&edges, cells, edge.at());
            }
        }
        boundary.add_to_load(&edges, load);
        Ok(())
    }

    /// Sets ∫_T f of every cell; the iterate stays.
    ///
    /// # Errors
    /// Slices of the wrong length, numbers that are not finite: nothing is changed then.
    pub fn set_source(&mut self, triangles: &[R], quads: &[R]) -> Result<(), Error> {
        if !self.built {
            return Err(Error::NotBuilt);
        }
        same_length(Array::CellLoads, triangles.len(), self.source_triangles.len())?;
        same_length(Array::CellLoads, quads.len(), self.source_quads.len())?;
        all_finite(Array::CellLoads, triangles)?;
        all_finite(Array::CellLoads, quads)?;
        self.source_triangles.copy_from_slice(triangles);
        self.source_quads.copy_from_slice(quads);
        let Self { of_triangles, of_quads, half_edges, load, .. } = self;
        let edges = Edges::baked(of_triangles, of_quads, half_edges, self.counts);
        let boundary = Boundary::new(&edges, &self.neumann, &self.robin, &self.contact_flux)?;
        let cells = CellLoads { triangles: &self.source_triangles, quads: &self.source_quads };
        assembly::load(&edges, cells, &boundary, load)
    }
}

/// What was said of a boundary edge.
struct Asked<R> {
    length: R,
    condition: Condition<R>,
}

impl<R: Real> Asked<R> {
    fn new<I: Index>(
        edges: &Edges<I>,
        mesh: &Mesh<R, I>,
        at: usize,
        length: R,
        condition: &mut impl FnMut(&BoundaryEdge<R, I>) -> Option<Condition<R>>,
    ) -> Result<Self, Error> {
        let ends = edges.endpoints(mesh, at);
        let named = ends.map(|vertex| vertex.at() as u32);
        let found = condition(&BoundaryEdge::new(mesh, ends)).ok_or(Error::NoCondition(named))?;
        if edges.counts().block(at) != found.block() {
            return Err(Error::ConditionChanged(named));
        }
        let asked = Self { length, condition: found };
        asked.check(at)?;
        Ok(asked)
    }

    /// Whether its integrals are admissible.
    fn check(&self, at: usize) -> Result<(), Error> {
        let (length, [a, b]) = (self.length, self.ends());
        let (of, numbers) = match self.condition {
            Condition::Neumann { flux } => (Array::Neumann, [flux * length; 3]),
            Condition::Robin { coefficient, .. } if coefficient < R::ZERO => {
                return Err(Error::NegativeRobin { edge: at });
            }
            Condition::Robin { coefficient, ambient } => {
                known(Array::Robin, features::ROBIN, 1)?;
                let coefficient = coefficient * length;
                (Array::Robin, [coefficient, coefficient * ambient, ambient])
            }
            Condition::Contact { flux, .. } | Condition::ContactBetween { flux, .. } => {
                (Array::Contact, [a, b, flux * length])
            }
            Condition::Dirichlet { .. } | Condition::DirichletBetween { .. } => {
                (Array::Dirichlet, [a, b, b])
            }
        };
        match numbers.iter().all(|number| number.finite()) && self.mean().finite() {
            true => Ok(()),
            false => Err(Error::NotFinite { of, at }),
        }
    }

    /// The record of a transfer law, where there is transfer.
    fn law<I: Index>(&self, edge: I) -> Option<Robin<R, I>> {
        let Condition::Robin { coefficient, ambient } = self.condition else { return None };
        let coefficient = coefficient * self.length;
        let record = Robin { edge, coefficient, ambient: coefficient * ambient };
        (coefficient > R::ZERO).then_some(record)
    }

    fn ends(&self) -> [R; 2] {
        self.condition.ends().unwrap_or_default()
    }

    /// The mean of u_D or ψ; that of equal values is the value.
    fn mean(&self) -> R {
        let [a, b] = self.ends();
        if a == b { a } else { R::HALF * a + R::HALF * b }
    }
}

fn push<T, const N: usize>(storage: &mut Vec<T, N>, entry: T, of: Array) -> Result<(), Error> {
    storage.push(entry).map_err(|_| Error::Capacity { of, needed: N + 1, limit: N })
}
