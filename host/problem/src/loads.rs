//! Loads, gaps and boundary values as integrals over cells and edges, at one time.

use signorini_kernel::Error as KernelError;
use signorini_kernel::assembly::{self, CellLoads};
use signorini_kernel::flux_range::{FluxRange, Span, Spans};
use signorini_kernel::law::Law;
use signorini_kernel::mesh::boundary::{Boundary, Neumann, Robin};
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::mesh::edges::Edges;

use super::{EdgeKind, Problem, Step, Sum, limits, widths};
use crate::cell::Cell;
use crate::quadrature::enclosed::Integral;
use crate::quadrature::mean_on_edge;
use crate::scalar::Scalar;
use signorini_scene::error::Result;
use signorini_scene::faults::Faults;
use signorini_scene::scene::{Condition, Field};

/// Everything on the right-hand side, integrated in f64; the kernel's records of it in the scalar `R`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Loads<R = f64> {
    /// ∫_T f of each triangle.
    pub triangles: Vec<R>,
    /// ∫_T f of each quad.
    pub quads: Vec<R>,
    /// Edges with a flux other than 0.
    pub neumann: Vec<Neumann<R, u32>>,
    /// Edges with a transfer law.
    pub robin: Vec<Robin<R, u32>>,
    /// The base of the flux's range on each contact edge: ∫_E q, say.
    pub contact_flux: Vec<R>,
    /// The spans of these ranges; none where all are ∞.
    pub spans: Vec<R>,
    /// By how much |E| (hi − lo) may exceed its span; 0 where it is constant along every edge.
    pub span_excess: R,
    /// By how much ends of fluxes were moved at most, since rounding had put the upper one below the lower one.
    pub moved: R,
    /// Mean of ψ on each contact edge.
    pub gap: Vec<R>,
    /// Mean of u_D on each Dirichlet edge.
    pub dirichlet: Vec<R>,
    /// The storage of the cells, where the problem is a step in time.
    pub step: Option<Step<R>>,
    /// The most that is missed of ∫f, ∫g, ∫q and their limits in all: out of balance, and seen by no mean.
    pub missed: f64,
}

impl<R: Scalar> Loads<R> {
    /// Range of ∫_E A∇u·n on a contact edge, counted from the first one.
    pub fn flux_range(&self, contact: usize) -> FluxRange<R> {
        let span = self.spans.get(contact).map_or(Span::UNLIMITED, |&span| Span::new(span));
        FluxRange::new(self.contact_flux[contact], span)
    }

    /// The law on the contact edges.
    pub fn law(&self) -> Law<'_, R> {
        // Those of a scene that is refused, or of a part of the loads, are none.
        let spans = Spans::new(&self.spans).unwrap_or(Spans::UNLIMITED);
        Law::above(&self.gap).with_spans(spans.varying(self.span_excess))
    }

    /// ∫f over the cells.
    pub fn cells(&self) -> CellLoads<'_, R> {
        CellLoads { triangles: &self.triangles, quads: &self.quads }
    }

    /// The load b of the unknowns.
    ///
    /// # Errors
    /// Records and masses that are not admissible in this scalar; `load` of another length.
    pub fn fill(&self, edges: &Edges<u32>, load: &mut [R]) -> std::result::Result<(), KernelError> {
        assembly::load(edges, self.cells(), &self.boundary(edges)?, load)?;
        if let Some(step) = &self.step {
            step.storage(edges)?.add_to_load(edges, load);
        }
        Ok(())
    }

    /// Terms on the diagonal of K beyond the element matrices.
    ///
    /// # Errors
    /// As for [`Loads::boundary`].
    pub fn diagonal(
        &self,
        edges: &Edges<u32>,
    ) -> std::result::Result<DiagonalTerms<'_, R, u32>, KernelError> {
        match &self.step {
            Some(step) => Ok(DiagonalTerms::in_step(&step.diagonal)),
            None => Ok(DiagonalTerms::new(&self.boundary(edges)?)),
        }
    }

    /// Boundary records.
    ///
    /// # Errors
    /// Records that are not admissible in this scalar.
    pub fn boundary<'a>(
        &'a self,
        edges: &Edges<u32>,
    ) -> std::result::Result<Boundary<'a, R, u32>, KernelError> {
        Boundary::new(edges, &self.neumann, &self.robin, &self.contact_flux)?
            .with_spans(edges, Spans::new(&self.spans)?.varying(self.span_excess))
    }
}

impl Loads {
    /// Integrates all data of `problem` at its time.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn of(problem: &Problem) -> Result<Self> {
        let (source, faults) = (Sum::source(&problem.scene, problem.time), Faults::default());
        let mut loads = Self::default();
        if !source.is_zero() {
            let triangles = problem.mesh.triangles.len();
            let cells: Vec<_> = (0..problem.cells()).map(|at| Cell::of(problem, at)).collect();
            if let Some(all) = faults.keep(source.over(&cells)) {
                let values = |of: &[Integral]| of.iter().map(|integral| integral.value).collect();
                loads.triangles = values(&all[..triangles]);
                loads.quads = values(&all[triangles..]);
                loads.missed = all.iter().map(|integral| integral.missed).sum();
            }
        }
        faults.keep(loads.add_edges(problem));
        faults.into_result()?;
        if loads.spans.iter().all(|&span| span == f64::INFINITY) {
            loads.spans.clear();
        }
        let contact = 0..loads.spans.len();
        let free = problem.topology.counts.free;
        let excess = contact.filter_map(|at| widths::excess(problem, free + at));
        loads.span_excess = excess.fold(0.0, f64::max);
        Ok(loads)
    }

    /// These loads in another scalar.
    pub fn narrowed<R: Scalar>(&self) -> Loads<R> {
        let all = |numbers: &[f64]| numbers.iter().map(|&x| R::narrow(x)).collect();
        let neumann = self.neumann.iter();
        let robin = self.robin.iter().map(|r| Robin {
            edge: r.edge,
            coefficient: R::narrow(r.coefficient),
            ambient: R::narrow(r.ambient),
        });
        Loads {
            triangles: all(&self.triangles),
            quads: all(&self.quads),
            neumann: neumann.map(|n| Neumann { edge: n.edge, flux: R::narrow(n.flux) }).collect(),
            robin: robin.collect(),
            contact_flux: all(&self.contact_flux),
            spans: all(&self.spans),
            span_excess: R::narrow(self.span_excess),
            moved: R::narrow(self.moved),
            gap: all(&self.gap),
            dirichlet: all(&self.dirichlet),
            step: self.step.as_ref().map(Step::narrowed),
            missed: self.missed,
        }
    }

    /// ∫_T f of a cell, triangles first.
    pub fn of_cell(&self, cell: usize) -> f64 {
        let all = self.triangles.iter().chain(&self.quads);
        all.copied().nth(cell).unwrap_or(0.0)
    }

    /// The data of all boundary edges; of each boundary the first fault is told.
    fn add_edges(&mut self, problem: &Problem) -> Result<()> {
        let (faults, mut told) = (Faults::default(), Vec::new());
        for edge in 0..problem.ends.len() {
            if problem.kinds[edge] == EdgeKind::Interior {
                continue;
            }
            if let Err(error) = self.add_edge(problem, edge) {
                let boundary = problem.binding.boundary(problem.ends[edge]);
                if !told.contains(&boundary) {
                    told.push(boundary);
                    faults.add(error);
                }
            }
        }
        faults.into_result()
    }

    /// Edges come in the order of the blocks, so contact and Dirichlet data line up by themselves.
    fn add_edge(&mut self, problem: &Problem, edge: usize) -> Result<()> {
        let Some(boundary) = problem.boundary_of(edge) else { return Ok(()) };
        let (segment, length) = (problem.segment(edge), problem.lengths[edge]);
        let name = &boundary.name.value;
        let sum = |field, base| Sum::new(&problem.scene, name, field, base, problem.time);
        let index = edge as u32;
        match &boundary.condition {
            Condition::Dirichlet { value } => {
                self.dirichlet.push(sum(Field::Value, value).mean(segment)?);
            }
            Condition::Neumann { flux } => {
                let flux = sum(Field::Flux, flux).mean_and_missed(segment)?;
                self.missed += length * flux.missed;
                let flux = length * flux.value;
                if flux != 0.0 {
                    self.neumann.push(Neumann { edge: index, flux });
                }
            }
            Condition::Robin { coefficient, ambient } => {
                let (h, outside) =
                    (sum(Field::Coefficient, coefficient), sum(Field::Ambient, ambient));
                let both = mean_on_edge(segment, |x, y| h.at(x, y) * outside.at(x, y));
                let robin = Robin {
                    edge: index,
                    coefficient: length * h.mean(segment)?,
                    ambient: length * outside.finite(both, segment[0])?,
                };
                self.robin.push(robin);
            }
            Condition::Contact { gap, .. } => {
                self.gap.push(sum(Field::Gap, gap).mean(segment)?);
                let (ends, missed) = limits::ends(problem, edge)?;
                let [base, span, moved] = limits::base_and_span(ends, length);
                self.missed += length * missed;
                self.moved = self.moved.max(moved);
                self.contact_flux.push(base);
                self.spans.push(span);
            }
        }
        Ok(())
    }
}
