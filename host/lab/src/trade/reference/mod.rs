//! The truth that the errors of a trade study are measured against.
//!
//! ```text
//!   [exact] ─────────────────► exact ─► tables ────┐
//!   scene on a finer mesh ─► finer_solve ─► points ──┴─► ‖·‖ of the difference ─► PointError
//!                 cells of an answer ─► places ─┘
//! ```
//! Everything at t = 0 and with the inputs at their defaults.

mod distance;
mod exact;
mod finer_solve;
mod places;
mod recovery;
mod tables;
#[cfg(test)]
mod tests;

use self::finer_solve::Reference;
use self::tables::{KEPT, Kept, Tables};
use crate::trade::record::PointError;
use serde::{Deserialize, Serialize};
use signorini_certify::admissible::Admissible;
use signorini_certify::curved::followed;
use signorini_certify::deviation::Deviations;
use signorini_certify::exact::Integrands;
use signorini_problem::Problem;
use signorini_scene::mesh::adapted::adapted;
use signorini_scene::scene::Exact;
use signorini_scene::{Mesh, Result, Scene};
use signorini_solve::{Solution, norms};

/// How many refinements the reference is finer than the finest mesh that is measured.
const FINER: u32 = 2;
/// The words of a record whose scene has an exact solution.
pub const EXACT: &str = "the exact solution";

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Facts {
    /// How it was found, in words.
    pub words: String,
    /// ‖A^½∇u‖
    pub energy: f64,
    /// ∫_C (σ·n − q)
    pub force: f64,
    /// Length of the part of C where u = ψ.
    pub length: f64,
}

/// The solution of a scene as well as it is known.
#[derive(Debug)]
pub struct ReferenceSolution {
    source: Source,
    /// The facts that a record states of it.
    pub facts: Facts,
}

#[derive(Debug)]
enum Source {
    Exact(Box<Exact>, Kept<Tables>),
    Reference(Reference),
}

impl ReferenceSolution {
    /// Takes the exact solution of `scene`, or solves it on `mesh`, refined some times more than `finest`, the number
    /// of refinements of the finest mesh that is measured.
    pub fn new(scene: &Scene, mesh: &Mesh, finest: u32) -> Result<Self> {
        let Some(exact) = &scene.exact else {
            let fine = adapted(mesh.clone(), None, finest + FINER)?;
            let (reference, facts) = Reference::new(scene, fine)?;
            return Ok(Self { source: Source::Reference(reference), facts });
        };
        let problem = Problem::new(scene, mesh.clone())?;
        let recent = Kept::new(KEPT);
        let deviations = Deviations::of(&problem)?;
        let tables = recent.on(&problem.mesh, || Tables::new(exact, &problem, &deviations))?;
        let facts = exact::facts(exact, &tables.u, &problem)?;
        Ok(Self { source: Source::Exact(Box::new(exact.clone()), recent), facts })
    }

    /// How far `answer`, found for `problem`, is from it. `problem` belongs to the scene that
    /// this was made for, in any setting, on any mesh, with the loads of t = 0.
    pub fn errors(&self, problem: &Problem, answer: &Solution) -> Result<PointError> {
        let inside = match &self.source {
            Source::Exact(exact, recent) => exactly(exact, recent, problem, answer)?,
            Source::Reference(reference) => reference.errors(problem, answer)?,
        };
        Ok(PointError {
            force: (self.facts.force - answer.contact_force).abs(),
            length: (self.facts.length - answer.contact_length).abs(),
            ..inside
        })
    }
}

/// s and τ of the certificate, if there is one.
fn certified(answer: &Solution) -> Option<Admissible<'_>> {
    answer.bound.map(|_| answer.certified.admissible())
}

/// The norms over the domain, against an exact solution.
fn exactly(
    exact: &Exact,
    recent: &Kept<Tables>,
    problem: &Problem,
    answer: &Solution,
) -> Result<PointError> {
    let deviations = &Deviations::of(problem)?;
    let tables = recent.on(&problem.mesh, || Tables::new(exact, problem, deviations))?;
    let (u, lift) = (&tables.u, &tables.lift);
    let errors = norms::of_fields(problem, u, &answer.u, &answer.flux)?;
    let combined = |admissible| {
        let deviations = &followed(problem, admissible)?;
        Integrands { exact, problem, admissible, deviations, u, lift, panels: 1, fewer: 1 }
            .combined()
    };
    Ok(PointError {
        energy: errors.energy,
        combined: certified(answer).as_ref().map(combined).transpose()?,
        l2: errors.l2,
        flux: errors.flux,
        ..PointError::default()
    })
}
