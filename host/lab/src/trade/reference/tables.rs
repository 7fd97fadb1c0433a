//! The exact solution at the quadrature points of the meshes of a study.
//!
//! Its expressions cost microseconds a point, with 256 points a cell and up to 60 answers on a mesh.

use signorini_certify::deviation::Deviations;
use signorini_certify::sampled::{Lifted, Solution, Table};
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_scene::scene::Exact;

/// Meshes whose tables are kept, of some 60 MB each at 10 000 cells. A study finishes with a mesh before
/// the next, but for the scene's own.
pub(super) const KEPT: usize = 2;

/// The tables that no answer changes.
#[derive(Debug)]
pub(super) struct Tables {
    /// u
    pub(super) u: Table,
    /// The part of S that ψ and u_D add.
    pub(super) lift: Table,
}

impl Tables {
    /// Fills the tables on the mesh of `problem`.
    pub(super) fn new(exact: &Exact, problem: &Problem, deviations: &Deviations) -> Result<Self> {
        let solution = Solution { exact, problem };
        Ok(Self {
            u: Table::of(&solution, problem)?,
            lift: Table::of(&Lifted { problem, deviations }, problem)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::super::kept::Kept;
    use super::*;
    use signorini_problem::fixtures::{SMOOTH, on_grid};
    use signorini_scene::mesh::structured::{Cells, grid};

    #[test]
    fn tables_of_the_last_two_meshes_are_kept() {
        let recent = Kept::new(KEPT);
        let on = |n| {
            let (scene, problem) = on_grid(SMOOTH, grid(n, Cells::Quads)).unwrap();
            let deviations = Deviations::at_time(&problem, 0.0).unwrap();
            let exact = scene.exact.as_ref().unwrap();
            recent.on(&problem.mesh, || Tables::new(exact, &problem, &deviations)).unwrap()
        };
        let [two, three] = [2, 3].map(on);
        assert!(Arc::ptr_eq(&two, &on(2)) && Arc::ptr_eq(&three, &on(3)));
        on(2);
        on(4);
        assert!(Arc::ptr_eq(&two, &on(2)) && !Arc::ptr_eq(&three, &on(3)));
        assert_eq!(recent.count(), KEPT);
    }
}
