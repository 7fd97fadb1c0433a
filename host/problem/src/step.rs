//! A step in time: what the cells store in it, and the u that it begins from.
//!
//! ```text
//!   c ∂u/∂t − ∇·(A∇u) = f   ─►   (K + M) u = b + M u_old,     M_E = Σ_T m_T,  m_T = (∫_T c)/(m dt)
//! ```
//! c is the mean of the capacity over each cell, and m its number of sides: the implicit Euler method with the diagonal mass of
//! [`signorini_kernel::storage`]. A problem without a step is the steady one, whatever its materials store.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use signorini_kernel::Error as KernelError;
use signorini_kernel::mesh::edges::Edges;
use signorini_kernel::storage::Storage;

use crate::cell::Cell;
use crate::quadrature::{DATA_POINTS, gauss};
use crate::scalar::Scalar;
use crate::{Binding, Loads, Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::mesh::Mesh;
use signorini_scene::scene::Scene;
use signorini_scene::scene::units::Units;

impl Loads {
    /// What a cell stores in a step for each unit of u, k|T|; 0 where the problem is no step.
    pub fn content(&self, cell: usize) -> f64 {
        self.step.as_ref().map_or(0.0, |step| step.content(cell))
    }
}

/// The state that one step hands on to the next, in the scalar `R`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct State<R = f64> {
    /// Mean of u over each edge.
    pub u: Vec<R>,
    /// s at the vertices.
    pub vertices: Vec<R>,
    /// The bubbles of s, one per edge.
    pub bubbles: Vec<R>,
    /// The means of (s − ψ)⁺ and (ψ − s)⁺ along each contact edge.
    pub openings: Vec<[R; 2]>,
    /// The curved data that s followed and that may move.
    pub traces: Vec<Trace>,
    /// ‖A^½∇·‖ of all that s followed of curved data.
    pub lifted: f64,
}

/// By how much a gap or a value was off its chord along an edge.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Trace {
    /// The edge.
    pub edge: u32,
    /// Place along the edge, weight, and w there.
    pub samples: Vec<[f64; 3]>,
    /// ∫₀¹ w² of what these points miss of it.
    pub missed: f64,
}

impl Trace {
    /// (∫₀¹ w²)^½ at most.
    pub fn size(&self) -> f64 {
        let square: f64 = self.samples.iter().map(|[_, weight, w]| weight * w * w).sum();
        square.sqrt() + self.missed.sqrt()
    }

    /// With `unit` for 1.
    #[must_use]
    pub fn in_unit(self, unit: f64) -> Self {
        let samples = self.samples.into_iter().map(|[t, weight, w]| [t, weight, w / unit]);
        Self { samples: samples.collect(), missed: self.missed / unit / unit, ..self }
    }
}

impl State {
    /// 0 everywhere on the mesh of `problem`.
    pub fn zero(problem: &Problem) -> Self {
        let edges = vec![0.0; problem.ends.len()];
        let vertices = vec![0.0; problem.mesh.vertices.len()];
        let openings = vec![[0.0; 2]; problem.topology.counts.contact];
        Self { u: edges.clone(), vertices, bubbles: edges, openings, ..Self::default() }
    }

    fn in_units(self, units: &Units) -> Self {
        let of_u = |all: Vec<f64>| all.into_iter().map(|u| (u - units.zero) / units.u).collect();
        Self {
            u: of_u(self.u),
            vertices: of_u(self.vertices),
            bubbles: self.bubbles.into_iter().map(|x| x / units.u).collect(),
            openings: self.openings.into_iter().map(|pair| pair.map(|x| x / units.u)).collect(),
            traces: self.traces.into_iter().map(|trace| trace.in_unit(units.u)).collect(),
            lifted: self.lifted / units.energy(),
        }
    }

    fn narrowed<R: Scalar>(&self) -> State<R> {
        let all = |numbers: &[f64]| numbers.iter().map(|&x| R::narrow(x)).collect();
        State {
            u: all(&self.u),
            vertices: all(&self.vertices),
            bubbles: all(&self.bubbles),
            openings: self.openings.iter().map(|pair| pair.map(R::narrow)).collect(),
            traces: self.traces.clone(),
            lifted: self.lifted,
        }
    }
}

/// Masses of a step and the state that it begins from, in the scalar `R`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Step<R = f64> {
    /// m_T of the triangles, and of the quads.
    masses: [Vec<R>; 2],
    /// dt
    pub length: f64,
    /// The state that the step before has left.
    pub begin: State<R>,
    /// The part of K_ii beyond the element matrices, one per unknown: M_E, and ∫h of a transfer law.
    pub(super) diagonal: Vec<R>,
}

impl<R: Scalar> Step<R> {
    /// k|T| of each cell, triangles first.
    pub fn contents(&self) -> impl Iterator<Item = R> {
        let [triangles, quads] = &self.masses;
        let of = |sides: u32| move |&mass: &R| R::from_count(sides) * mass;
        triangles.iter().map(of(3)).chain(quads.iter().map(of(4)))
    }

    /// k|T| of one of them.
    pub fn content(&self, cell: usize) -> R {
        let [triangles, quads] = &self.masses;
        match cell.checked_sub(triangles.len()) {
            None => R::from_count(3) * triangles[cell],
            Some(quad) => R::from_count(4) * quads[quad],
        }
    }

    /// m_T of the triangles, and of the quads.
    pub fn masses(&self) -> [&[R]; 2] {
        self.masses.each_ref().map(Vec::as_slice)
    }

    /// The step in the kernel's form.
    ///
    /// # Errors
    /// Numbers that are not admissible in this scalar.
    pub fn storage<'a>(
        &'a self,
        edges: &Edges<u32>,
    ) -> std::result::Result<Storage<'a, R>, KernelError> {
        let [triangles, quads] = &self.masses;
        Storage::new(edges, [triangles, quads], &self.begin.u)
    }
}

impl Step {
    /// In `units`.
    pub(super) fn in_units(self, units: &Units) -> Self {
        let divided = |all: Vec<f64>| all.into_iter().map(|x| x / units.conductivity).collect();
        Self { masses: self.masses.map(divided), begin: self.begin.in_units(units), ..self }
    }

    /// This step in another scalar.
    pub(super) fn narrowed<R: Scalar>(&self) -> Step<R> {
        let all = |numbers: &[f64]| numbers.iter().map(|&x| R::narrow(x)).collect();
        Step {
            masses: self.masses.each_ref().map(|masses| all(masses)),
            length: self.length,
            begin: self.begin.narrowed(),
            diagonal: all(&self.diagonal),
        }
    }

    /// See [`Problem::stored`].
    fn stored(&self, problem: &Problem, cell: usize, u: &[f64]) -> Vec<f64> {
        let [triangles, quads] = &self.masses;
        let mass = triangles.iter().chain(quads).nth(cell).copied().unwrap_or(0.0);
        let sides = problem.topology.edges_of(cell).iter().map(|&edge| edge as usize);
        sides.map(|edge| mass * (u[edge] - self.begin.u[edge])).collect()
    }
}

impl Loads {
    /// These loads in a step of time; the step's diagonal is filled in.
    pub(super) fn in_step(self, problem: &Problem, step: Option<Step>) -> Result<Self> {
        let Some(mut step) = step else { return Ok(self) };
        let refused = |error: KernelError| problem.scene.error(&problem.scene.mesh, error);
        let edges = problem.topology.edges().map_err(refused)?;
        let mut diagonal = vec![0.0; edges.counts().unknowns()];
        step.storage(&edges).map_err(refused)?.add_to_diagonal(&edges, &mut diagonal);
        for law in &self.robin {
            diagonal[law.edge as usize] += law.coefficient;
        }
        step.diagonal = diagonal;
        Ok(Self { step: Some(step), ..self })
    }
}

impl Problem {
    /// This problem as a step of length `dt`.
    ///
    /// # Errors
    /// Masses that are not finite.
    pub fn stepping(&self, dt: f64, begin: State) -> Result<Self> {
        let mut problem = self.clone();
        let masses: Vec<f64> = self.capacities.iter().map(|share| share / dt).collect();
        let (triangles, quads) = masses.split_at(self.mesh.triangles.len().min(masses.len()));
        let masses = [triangles.to_vec(), quads.to_vec()];
        let step = Step { masses, length: dt, begin, diagonal: Vec::new() };
        problem.loads = std::mem::take(&mut problem.loads).in_step(self, Some(step))?;
        Ok(problem)
    }

    /// What a cell stores by each of its sides, for these means over all edges: m_T (u_E − u_old,E). Nothing where the problem
    /// is no step in time.
    pub fn stored(&self, cell: usize, u: &[f64]) -> Vec<f64> {
        self.loads.step.as_ref().map_or_else(Vec::new, |step| step.stored(self, cell, u))
    }

    /// The next step begins from `state`.
    pub fn advance(&mut self, state: State) {
        if let Some(step) = &mut self.loads.step {
            step.begin = state;
        }
    }
}

/// (∫_T c)/m of each cell, where c is not negative; nothing where no material stores anything.
///
/// # Errors
/// A capacity that is negative or not finite somewhere, with the point.
pub(super) fn capacities(scene: &Scene, mesh: &Mesh, binding: &Binding) -> Result<Arc<[f64]>> {
    if !scene.stores() {
        return Ok(Arc::new([]));
    }
    let mut shares = vec![0.0; binding.materials.len()];
    for (number, material) in scene.materials.iter().enumerate().filter(|(_, of)| of.stores()) {
        let own: Vec<usize> =
            (0..shares.len()).filter(|&at| binding.materials[at] as usize == number).collect();
        let cells: Vec<Cell> = own.iter().map(|&at| Cell::in_mesh(mesh, at)).collect();
        let capacity = Sum::alone(scene, &material.capacity, 0.0);
        if capacity.constant().is_none() {
            cells.iter().try_for_each(|cell| not_negative(scene, &capacity, cell))?;
        }
        for ((&at, cell), integral) in own.iter().zip(&cells).zip(capacity.over(&cells)?) {
            shares[at] = integral.value.max(0.0) / cell.corners().len() as f64;
        }
    }
    Ok(shares.into())
}

/// Refuses a capacity that is negative at a point of the rule.
fn not_negative(scene: &Scene, capacity: &Sum, cell: &Cell) -> Result<()> {
    let wrong = cell.points(&gauss(DATA_POINTS)).into_iter().find(|point| {
        let [x, y] = point.x;
        capacity.at(x, y) < 0.0
    });
    let Some(point) = wrong else { return Ok(()) };
    let [x, y] = point.x;
    let message = format!("{} at ({x}, {y}), expected a capacity of at least 0", capacity.at(x, y));
    Err(scene
        .error(capacity.key(), message)
        .hint("state one that is 0 or positive everywhere")
        .into())
}
