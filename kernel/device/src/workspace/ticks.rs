//! A control loop on a workspace: sweeps until the answer is good enough or time is up, with its error bound.

use super::bound::BoundSupport;
use super::{Workspace, ends, stiffness_of};
use crate::tick::{
    CertifiedSweeps, Data, Deadline, Limits, Memory, Progress, Report, Tick, UncertifiedSweeps,
};
use signorini_bound::certificate::{LoadCase, Verdict};
use signorini_kernel::Libm;
use signorini_kernel::Real;
use signorini_kernel::assembly::CellLoads;
use signorini_kernel::error::Error;
use signorini_kernel::index::Index;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::Mesh;
use signorini_kernel::mesh::boundary::Boundary;
use signorini_kernel::mesh::edges::Edges;
use signorini_kernel::relaxation::Relaxation;

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
                curved: &[],
                transfer: &[],
                oscillation: R::ZERO,
            },
            law: Law::above(&self.gap),
            dirichlet: &self.dirichlet,
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
