//! A solved problem and what is read off it.

use std::collections::HashMap;
use std::sync::Arc;

use serde::Serialize;
use signorini_kernel::Real;
use signorini_kernel::mesh::components::{PartCounts, Support};
use signorini_kernel::mesh::geometry::{quad_area, triangle_area};

use super::{Ending, Multigrid, Ran, ScalarKind};
use signorini_certify::{CertifiedFields, ErrorBound, NoBound};
use signorini_problem::field::CellField;
use signorini_problem::{Parts, Problem, State};
use signorini_scene::scene::units::Units;

/// Work of the factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Factored {
    /// Entries of L.
    pub entries: usize,
    /// Contact edges that changed sides; of the direct solver, active-set steps.
    pub exchanges: u32,
    /// Substitutions, corrections among them; of the direct solver, passes of refinement.
    pub rounds: u32,
}

/// The answer of a solve or of a tick; numbers of an f32 one are held exactly in f64.
#[derive(Debug, Clone, Default)]
pub struct Solution {
    /// Its scalar type.
    pub scalar: ScalarKind,
    /// How it ended.
    pub status: Ending,
    /// Sweeps; those before a factor took over are not in the answer.
    pub sweeps: u32,
    /// Iterations of conjugate gradients among them.
    pub conjugate: u32,
    /// The solver that ended it.
    pub ran: Ran,
    /// The factor, where one solved it.
    pub factored: Option<Factored>,
    /// The work of multigrid, where that solved it.
    pub multigrid: Option<Multigrid>,
    /// Why the solver that was asked for gave up, where another one took over: a sentence.
    pub given_up: Option<String>,
    /// The units in which it was solved; all numbers here are in the scene's.
    pub units: Units,
    /// Problem and solution in these units, where they are not the scene's.
    pub own: Option<Arc<(Arc<Problem>, Solution)>>,
    /// The scaled complementarity residual.
    pub algebraic_residual: f64,
    /// The last relaxation factor; 0 for the direct solver.
    pub omega: f64,
    /// Mean of u_h over each edge.
    pub u: Vec<f64>,
    /// ∫_E σ·n for each edge along its direction's normal: (15), the mean of both sides.
    pub flux: Vec<f64>,
    /// Largest disagreement of the two sides, relative to the largest flux.
    pub mismatch: f64,
    /// ∫_C (τ·n − q) ≥ 0: τ is [`Solution::flux`] within the law of contact, so that it is q where u > ψ and not
    /// below q where u = ψ, wherever the solve was stopped.
    pub contact_force: f64,
    /// Σ|E| over active contact edges.
    pub contact_length: f64,
    /// Active contact edges, u_E = ψ_E.
    pub contact_active: usize,
    /// Connected parts of the domain.
    pub parts: PartCounts,
    /// How wrong it can be; `None` where there is no bound.
    pub bound: Option<ErrorBound>,
    /// Why there is no bound.
    pub no_bound: Option<NoBound>,
    /// The continuous function and the flux that the bound is about.
    pub certified: CertifiedFields,
    /// The outputs of a controller, in the order of the scene, with its bits; empty where no controller answered.
    pub outputs: Vec<f64>,
    /// Wall-clock seconds.
    pub seconds: Seconds,
}

/// Where the time went.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub struct Seconds {
    /// Element matrices, pattern, values, load.
    pub assembly: f64,
    /// Sweeps, or factorisation and active set.
    pub solve: f64,
    /// Flux recovery.
    pub flux: f64,
    /// The error bound, with the integrals of data that it needs.
    pub certificate: f64,
}

impl Solution {
    /// The solve reached its tolerance, or all that rounding allows.
    pub fn converged(&self) -> bool {
        self.status.is_success()
    }

    /// This solution with its problem, both in the units of the solve; nothing where these are the scene's. Squares of the
    /// scene's numbers may overflow or vanish; those of the solve's do not.
    pub fn in_its_units(&self) -> Option<(&Problem, &Self)> {
        let (problem, solution) = self.own.as_deref()?;
        Some((problem, solution))
    }

    /// The state that a step in time hands on to the next one.
    pub fn state(&self) -> State {
        let CertifiedFields { vertices, bubbles, openings, lifts, .. } = &self.certified;
        State {
            u: self.u.clone(),
            vertices: vertices.clone(),
            bubbles: bubbles.clone(),
            openings: openings.clone(),
            traces: lifts.traces.clone(),
            lifted: lifts.energy,
        }
    }

    /// With these contact edges active, one flag each.
    #[must_use]
    pub fn with_active(mut self, problem: &Problem, active: impl Iterator<Item = bool>) -> Self {
        let lengths = problem.lengths.iter().skip(problem.topology.counts.free);
        (self.contact_active, self.contact_length) = (0, 0.0);
        for (_, length) in active.zip(lengths).filter(|(active, _)| *active) {
            self.contact_active += 1;
            self.contact_length += length;
        }
        self
    }

    /// max |∫_E σ·n|, at least the smallest normal number.
    pub fn largest_flux(&self) -> f64 {
        self.flux.iter().fold(f64::TINY, |most, flux| most.max(flux.abs()))
    }

    /// max over the cells of |Σ_E ∫σ·n + ∫f − what is stored|, relative to the largest edge flux.
    pub fn conservation_defect(&self, problem: &Problem) -> f64 {
        let defect = (0..problem.cells()).map(|cell| {
            let field = CellField::new(problem, cell, &self.u, &self.flux);
            field.surplus(problem.loads.of_cell(cell), &problem.stored(cell, &self.u)).abs()
        });
        defect.fold(0.0, f64::max) / self.largest_flux()
    }

    /// The bound as a part of the energy norm of what it is the bound of; `None` where either is missing, or where the solution
    /// is constant up to rounding.
    pub fn relative_bound(&self, energy_norm: Option<f64>) -> Option<f64> {
        if self.is_constant(energy_norm) {
            return None;
        }
        let relative = self.bound?.total / energy_norm?;
        relative.is_finite().then_some(relative)
    }

    /// Whether rounding may be all of the energy norm.
    pub fn is_constant(&self, energy_norm: Option<f64>) -> bool {
        let rounding = self.bound.map(|bound| bound.rounding);
        matches!((energy_norm, rounding), (Some(norm), Some(rounding)) if norm <= rounding)
    }

    /// ‖A^½∇_h u_h‖, where the solve has converged: see [`CellField::energy`].
    pub fn energy(&self, problem: &Problem) -> f64 {
        let squares = (0..problem.cells()).map(|cell| {
            let field = CellField::new(problem, cell, &self.u, &self.flux);
            field.energy(problem.loads.of_cell(cell), &problem.stored(cell, &self.u))
        });
        squares.sum::<f64>().max(0.0).sqrt()
    }

    /// Mean of ψ over contact edge `at` in the scalar of u, so that u_E = ψ_E can be asked.
    pub fn gap(&self, problem: &Problem, at: usize) -> f64 {
        if let Some((problem, own)) = self.in_its_units() {
            return self.units.value(own.gap(problem, at));
        }
        self.ran.scalar_of_u(self.scalar).round(problem.loads.gap[at])
    }

    /// λ = σ·n − q, the mean over contact edge `at` (counted from the first one).
    pub fn multiplier(&self, problem: &Problem, at: usize) -> f64 {
        let edge = problem.topology.counts.free + at;
        problem.loads.flux_range(at).multiplier(self.flux[edge]) / problem.lengths[edge]
    }
}

/// A part held by nothing is determined up to a constant: the one with ∫u = 0 is given.
pub fn centre_floating(problem: &Problem, parts: &Parts, u: &mut [f64], vertices: &mut [f64]) {
    let Ok(edges) = problem.topology.edges() else { return };
    let mesh = &problem.mesh;
    let corner = |vertex: u32| mesh.vertices[vertex as usize];
    let triangles = mesh.triangles.iter();
    let areas = triangles
        .map(|cell| triangle_area(cell.map(corner)))
        .chain(mesh.quads.iter().map(|cell| quad_area(cell.map(corner))));
    let mut means = HashMap::<usize, (f64, f64)>::new();
    let no_flux = vec![0.0; u.len()];
    for (cell, area) in areas.enumerate() {
        let mean = CellField::new(problem, cell, u, &no_flux).mean();
        let sums = means.entry(parts.of_cell(cell)).or_default();
        *sums = (sums.0 + area * mean, sums.1 + area);
    }
    let shift = |part: usize| match parts.support(part) {
        Support::None => means[&part].0 / means[&part].1,
        Support::Contact | Support::Held => 0.0,
    };
    for (edge, u) in u.iter_mut().enumerate() {
        *u -= shift(parts.of_edge(&edges, edge));
    }
    let corners = |cell| problem.vertices_of(cell).iter().map(move |&vertex| (vertex, cell));
    let of_vertex: HashMap<u32, usize> = (0..problem.cells()).flat_map(corners).collect();
    for (&vertex, &cell) in &of_vertex {
        if let Some(value) = vertices.get_mut(vertex as usize) {
            *value -= shift(parts.of_cell(cell));
        }
    }
}
