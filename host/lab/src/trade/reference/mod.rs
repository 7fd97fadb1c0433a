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
mod kept;
mod places;
mod points;
mod recovery;
mod tables;
#[cfg(test)]
mod tests;

use self::exact::Contact;
use self::finer_solve::Reference;
use self::kept::Kept;
use self::tables::{KEPT, Tables};
use crate::baseline::record::PointError;
use signorini_certify::admissible::Admissible;
use signorini_certify::curved::followed;
use signorini_certify::deviation::Deviations;
use signorini_certify::exact::Integrands;
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_scene::mesh::Mesh;
use signorini_scene::scene::{Exact, Scene};
use signorini_solve::Solution;
use signorini_solve::norms;

/// How many refinements the reference is finer than the finest mesh that is measured.
pub const FINER: u32 = 2;
/// The words of a record whose scene has an exact solution.
pub const EXACT: &str = "the exact solution";

/// The solution of a scene as well as it is known.
#[derive(Debug)]
pub struct ReferenceSolution {
    source: Source,
    energy: f64,
    contact: Contact,
}

#[derive(Debug)]
enum Source {
    Exact(Box<Exact>, Kept<Tables>),
    Reference(Reference),
}

/// An answer for a scene, on a mesh of its own.
#[derive(Debug, Clone, Copy)]
pub struct Approximation<'a> {
    /// Mean of u_h over each edge.
    pub u: &'a [f64],
    /// ∫_E σ·n of each edge, along its direction's normal.
    pub flux: &'a [f64],
    /// ∫_C (σ·n − q)
    pub force: f64,
    /// Σ|E| over active contact edges.
    pub length: f64,
    /// s and τ of the certificate, if there is one.
    pub certified: Option<Admissible<'a>>,
}

impl<'a> From<&'a Solution> for Approximation<'a> {
    fn from(solution: &'a Solution) -> Self {
        Self {
            u: &solution.u,
            flux: &solution.flux,
            force: solution.contact_force,
            length: solution.contact_length,
            certified: solution.bound.map(|_| solution.certified.admissible()),
        }
    }
}

impl ReferenceSolution {
    /// Takes the exact solution of `scene`, or solves it on `refined(mesh, times)`, [`FINER`] times
    /// finer than `finest`, the number of refinements of the finest mesh that is measured.
    ///
    /// # Errors
    /// A scene that cannot be solved, an exact solution that is not finite somewhere.
    pub fn new(
        scene: &Scene,
        mesh: &Mesh,
        finest: u32,
        refined: impl FnOnce(&Mesh, u32) -> Result<Mesh>,
    ) -> Result<Self> {
        let Some(exact) = &scene.exact else {
            return Self::by_reference(scene, refined(mesh, finest + FINER)?);
        };
        let problem = Problem::new(scene, mesh.clone())?;
        let recent = Kept::new(KEPT);
        let deviations = Deviations::at_time(&problem, problem.time)?;
        let tables = recent.on(&problem.mesh, || Tables::new(exact, &problem, &deviations))?;
        Ok(Self {
            source: Source::Exact(Box::new(exact.clone()), recent),
            energy: exact::energy(&tables.u, &problem)?,
            contact: exact::contact(exact, &problem)?,
        })
    }

    /// Solves the scene on `mesh`.
    fn by_reference(scene: &Scene, mesh: Mesh) -> Result<Self> {
        let reference = Reference::new(scene, mesh)?;
        Ok(Self {
            energy: reference.energy(),
            contact: reference.contact,
            source: Source::Reference(reference),
        })
    }

    /// Says in words how it was found.
    pub fn words(&self) -> String {
        match &self.source {
            Source::Exact(..) => EXACT.to_owned(),
            Source::Reference(reference) => reference.words(),
        }
    }

    /// ‖A^½∇u‖
    pub fn energy(&self) -> f64 {
        self.energy
    }

    /// ∫_C (σ·n − q)
    pub fn force(&self) -> f64 {
        self.contact.force
    }

    /// Length of the part of C where u = ψ.
    pub fn length(&self) -> f64 {
        self.contact.length
    }

    /// How far `answer`, found for `problem`, is from it. `problem` belongs to the scene that
    /// this was made for, in any setting, with the loads of t = 0.
    ///
    /// # Errors
    /// Data that are not finite at a quadrature point.
    pub fn errors(&self, problem: &Problem, answer: &Approximation) -> Result<PointError> {
        let inside = match &self.source {
            Source::Exact(exact, recent) => exactly(exact, recent, problem, answer)?,
            Source::Reference(reference) => reference.errors(problem, answer)?,
        };
        Ok(PointError {
            force: (self.contact.force - answer.force).abs(),
            length: (self.contact.length - answer.length).abs(),
            ..inside
        })
    }
}

/// The norms over the domain, against an exact solution.
fn exactly(
    exact: &Exact,
    recent: &Kept<Tables>,
    problem: &Problem,
    answer: &Approximation,
) -> Result<PointError> {
    let deviations = &Deviations::at_time(problem, problem.time)?;
    let tables = recent.on(&problem.mesh, || Tables::new(exact, problem, deviations))?;
    let (u, lift) = (&tables.u, &tables.lift);
    let errors = norms::of_fields(problem, u, answer.u, answer.flux)?;
    let combined = |admissible| {
        let deviations = &followed(problem, admissible)?;
        Integrands { exact, problem, admissible, deviations, u, lift, panels: 1 }.combined()
    };
    Ok(PointError {
        energy: errors.energy,
        combined: answer.certified.as_ref().map(combined).transpose()?,
        l2: errors.l2,
        flux: errors.flux,
        ..PointError::default()
    })
}
