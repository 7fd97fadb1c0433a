//! The exact solution at the quadrature points of the meshes of a study.
//!
//! Its expressions cost microseconds a point, with 256 points a cell and up to 60 answers on a mesh.

use std::sync::{Arc, Mutex, PoisonError};

use super::places::fingerprint;
use signorini_certify::deviation::Deviations;
use signorini_certify::sampled::{Lifted, Solution, Table};
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_scene::scene::Exact;

/// Meshes whose tables are kept, of some 60 MB each at 10 000 cells. A study finishes with a mesh before
/// the next, but for the scene's own.
const KEPT: usize = 2;

/// What does not depend on the answer.
#[derive(Debug)]
pub(super) struct Tables {
    /// u
    pub(super) u: Table,
    /// What ψ and u_D add to S.
    pub(super) lift: Table,
}

/// The tables of the meshes that were used last.
#[derive(Debug, Default)]
pub(super) struct Recent(Mutex<Vec<(u64, Arc<Tables>)>>);

impl Recent {
    /// Those on the mesh of `problem`.
    pub(super) fn of(
        &self,
        exact: &Exact,
        problem: &Problem,
        deviations: &Deviations,
    ) -> Result<Arc<Tables>> {
        let mut recent = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let key = fingerprint(&problem.mesh);
        let known = recent.iter().position(|(other, _)| *other == key);
        if known.is_none() {
            // First, so that there is never one more than is kept.
            recent.truncate(KEPT - 1);
        }
        let tables = match known {
            Some(at) => recent.remove(at).1,
            None => Arc::new(Tables::new(exact, problem, deviations)?),
        };
        recent.insert(0, (key, tables.clone()));
        Ok(tables)
    }
}

impl Tables {
    fn new(exact: &Exact, problem: &Problem, deviations: &Deviations) -> Result<Self> {
        let solution = Solution { exact, problem };
        Ok(Self {
            u: Table::of(&solution, problem)?,
            lift: Table::of(&Lifted { problem, deviations }, problem)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_problem::fixtures::{SMOOTH, on_grid};
    use signorini_scene::mesh::structured::{Cells, grid};

    #[test]
    fn tables_of_the_last_two_meshes_are_kept() {
        let recent = Recent::default();
        let on = |n| {
            let (scene, problem) = on_grid(SMOOTH, grid(n, Cells::Quads)).unwrap();
            let deviations = Deviations::at_time(&problem, 0.0).unwrap();
            let exact = scene.exact.as_ref().unwrap();
            recent.of(exact, &problem, &deviations).unwrap()
        };
        let [two, three] = [2, 3].map(on);
        assert!(Arc::ptr_eq(&two, &on(2)) && Arc::ptr_eq(&three, &on(3)));
        on(2);
        on(4);
        assert!(Arc::ptr_eq(&two, &on(2)) && !Arc::ptr_eq(&three, &on(3)));
        assert_eq!(recent.0.lock().unwrap().len(), KEPT);
    }
}
