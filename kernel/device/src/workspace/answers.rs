//! Answers of a workspace: a solve to its end; and ticks of a control loop, which sweep until the answer is good enough or time
//! is up, with its error bound.

use super::bound::BoundSupport;
use super::{Workspace, ends, stiffness_of};
use crate::tick::{
    CertifiedSweeps, Data, Deadline, IfStoring, Limits, Memory, Progress, Report, Tick,
    UncertifiedSweeps,
};
use signorini_bound::certificate::{LoadCase, Verdict};
use signorini_kernel::assembly::CellLoads;
use signorini_kernel::csr::Csr;
use signorini_kernel::error::{Array, Error, all_moderate};
use signorini_kernel::law::Law;
use signorini_kernel::mesh::boundary::Boundary;
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::mesh::edges::Edges;
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::solver::{Outcome, Settings, Solver};
use signorini_kernel::system::{Shifts, System};
use signorini_kernel::{Index, Libm, Mesh, Real, contact, flux};

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
    /// Solves from the present iterate and recovers the flux. Look at the outcome's status: the
    /// iterate is feasible and usable also where sweeps ran out.
    ///
    /// # Errors
    /// Data that are not finite or within 1/ε² of the largest number, where the answer may overflow (ψ, u_D, b and
    /// b_i/K_ii); a relaxation factor outside (0, 2); a workspace for ticks only. The last answer stays then, bit for bit.
    pub fn solve(&mut self, settings: Settings<R>) -> Result<Outcome<R>, Error> {
        if !self.built {
            return Err(Error::NotBuilt);
        }
        if N == 0 {
            let needed = self.numbered().nonzeros();
            return Err(Error::Capacity { of: Array::MatrixValues, needed, limit: 0 });
        }
        // Borrowed apart, since moving an array out of the workspace would pass through the stack.
        let Self { of_triangles, of_quads, half_edges, counts, u, flux, .. } = self;
        let edges = Edges::baked(of_triangles, of_quads, half_edges, *counts);
        let matrix = Csr::new(&self.row_ptr, &self.col_idx, &self.values, counts.edges())?;
        let boundary = Boundary::new(&edges, &self.neumann, &self.robin, &self.contact_flux)?;
        let shifts = Shifts { part: &[], parts: 1, diagonal: DiagonalTerms::new(&boundary) };
        let system =
            System::new(matrix, &self.load, Law::above(&self.gap), *counts)?.with_shifts(shifts)?;
        let (unknowns, given) = u.split_at_mut_checked(counts.unknowns()).unwrap_or_default();
        all_moderate(Array::Load, self.load.iter().copied())?;
        let steps = matrix.iter().zip(&self.load).map(|(row, &load)| load / row.diagonal());
        all_moderate(Array::Load, steps)?;
        all_moderate(Array::LowerBounds, self.gap.iter().copied())?;
        all_moderate(Array::Dirichlet, self.dirichlet.iter().copied())?;
        let mut solver = Solver::<R>::new(settings)?;
        given.iter_mut().zip(&self.dirichlet).for_each(|(u, &value)| *u = value);
        if unknowns.iter().any(|u| !u.finite()) {
            // An overflow of the last solve: start anew.
            unknowns.fill(R::ZERO);
        }
        let mut rows = self.rows.within(&edges)?;
        let outcome = solver.run(&system, &mut rows, u)?;
        let stiffness = stiffness_of(&self.triangles, &self.quads);
        let cells = CellLoads { triangles: &self.source_triangles, quads: &self.source_quads };
        flux::recover(&edges, stiffness, cells, u, &[], flux)?;
        for (at, active) in self.active.iter_mut().enumerate() {
            *active = contact::is_active(*counts, Law::above(&self.gap), u, at);
        }
        self.force = contact::force(*counts, &boundary, Law::above(&self.gap), u, flux);
        Ok(outcome)
    }

    /// How ω is chosen from the next tick on: adaptive from the best ω of a square with as many unknowns, unless this
    /// says otherwise.
    ///
    /// # Errors
    /// An ω outside (0, 2).
    pub fn set_relaxation(&mut self, relaxation: Relaxation<R>) -> Result<(), Error> {
        self.progress = Progress::new(relaxation)?;
        Ok(())
    }

    /// Goes on from the last answer until a limit or the deadline ends it, and says how wrong the answer can be: the
    /// error bound of the problem as its conditions state it ([`Report::verdict`]), f constant in each cell, g, q, h and
    /// u_ext along each edge. Whatever ends it, the iterate is feasible and has that bound.
    ///
    /// There is no bound where u_D jumps from one edge to the next or where a quad is no parallelogram or too thin for the
    /// scalar ([`Verdict::Unavailable`]), and where u_D lies below ψ ([`Verdict::BelowGap`]).
    ///
    /// # Errors
    /// [`Error::NoWayOut`] where contact alone holds a part: [`Workspace::solve`] solves it. Numbers that are not finite or
    /// within 1/ε² of the largest number, where the answer may overflow. Another mesh than the one that was built, by its
    /// cells. The last answer stays then, bit for bit.
    pub fn tick<F: FnMut() -> u32>(
        &mut self,
        mesh: &Mesh<R, I>,
        limits: Limits<R>,
        deadline: &mut Deadline<F>,
    ) -> Result<Report<R>, Error> {
        if !self.built {
            return Err(Error::NotBuilt);
        }
        if super::fingerprint(mesh) != self.fingerprint
            || mesh.vertices().len() != self.vertices.len()
        {
            return Err(Error::OtherMesh);
        }
        let Self { of_triangles, of_quads, half_edges, counts, rows, load, u, flux, .. } = self;
        let edges = Edges::baked(of_triangles, of_quads, half_edges, *counts);
        let stiffness = stiffness_of(&self.triangles, &self.quads);
        let discretization = self.equilibration.discretization(*mesh, edges, stiffness)?;
        let data = Data {
            given: LoadCase {
                loads: CellLoads { triangles: &self.source_triangles, quads: &self.source_quads },
                boundary: Boundary::new(&edges, &self.neumann, &self.robin, &self.contact_flux)?,
                ends: ends(&self.gap_ends, &self.dirichlet_ends),
                ..LoadCase::default()
            },
            law: Law::above(&self.gap),
            dirichlet: &self.dirichlet,
            step: IfStoring::NOTHING,
        };
        if !self.progress.has_begun() {
            self.progress = Progress::new(Relaxation::for_unknowns(counts.unknowns()))?;
        }
        let refused = match self.support {
            BoundSupport::NotBelowGap => Some(Verdict::BelowGap),
            BoundSupport::Bound if self.equilibration.is_affine() => None,
            BoundSupport::Bound | BoundSupport::NotForJumps => Some(Verdict::Unavailable),
        };
        let (vertices, bubbles) = (&mut *self.vertices, &mut *self.bubbles);
        let (rows, active) = (rows.within(&edges)?, &mut *self.active);
        let memory = Memory { rows, load, active, vertices, bubbles, tau: flux, u };
        let mut tick = Tick::resume(discretization, memory, self.progress)?;
        let mut running = tick.begin(data)?;
        let report = match refused {
            None => running.advance(CertifiedSweeps(Libm), limits, deadline)?,
            Some(verdict) => {
                let report = running.advance(UncertifiedSweeps(Libm), limits, deadline)?;
                Report { verdict, ..report }
            }
        };
        self.progress = tick.progress();
        self.force = report.figures.force;
        Ok(report)
    }

    /// s at the vertices, the function that the bound of the last tick is about.
    pub fn vertices(&self) -> &[R] {
        &self.vertices
    }
}
