//! The exact solution at the quadrature points of the meshes of a study, and what is kept of the meshes used last.
//!
//! Its expressions cost microseconds a point, with 256 points a cell and up to 60 answers on a mesh.

use std::sync::{Arc, Mutex, PoisonError};

use crate::trade::journal::digest;
use signorini_certify::deviation::Deviations;
use signorini_certify::sampled::{Lifted, Solution, Table};
use signorini_problem::Problem;
use signorini_scene::scene::Exact;
use signorini_scene::{Mesh, Result};

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
    pub(super) fn new(exact: &Exact, problem: &Problem, deviations: &Deviations) -> Result<Self> {
        let solution = Solution { exact, problem };
        Ok(Self {
            u: Table::of(&solution, problem)?,
            lift: Table::of(&Lifted { problem, deviations }, problem)?,
        })
    }
}

/// Something for each of the last `most` meshes, the newest first.
#[derive(Debug)]
pub(super) struct Kept<T> {
    most: usize,
    recent: Mutex<Vec<(u64, Arc<T>)>>,
}

impl<T> Kept<T> {
    pub(super) fn new(most: usize) -> Self {
        Self { most, recent: Mutex::default() }
    }

    /// Gives what is known on a mesh, or `make`s it.
    pub(super) fn on(&self, mesh: &Mesh, make: impl FnOnce() -> Result<T>) -> Result<Arc<T>> {
        let mut recent = self.recent.lock().unwrap_or_else(PoisonError::into_inner);
        let places: Vec<u64> = mesh.vertices.as_flattened().iter().map(|x| x.to_bits()).collect();
        let key = digest(&(places, &mesh.triangles, &mesh.quads));
        let known = match recent.iter().position(|(other, _)| *other == key) {
            Some(at) => recent.remove(at).1,
            None => {
                // First, so that there is never one more than is kept.
                recent.truncate(self.most - 1);
                Arc::new(make()?)
            }
        };
        recent.insert(0, (key, known.clone()));
        Ok(known)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_problem::fixtures::{SMOOTH, on_grid};
    use signorini_scene::mesh::structured::{Cells, grid};

    #[test]
    fn tables_of_the_last_two_meshes_are_kept() {
        let recent = Kept::new(KEPT);
        let on = |n| {
            let (scene, problem) = on_grid(SMOOTH, grid(n, Cells::Quads)).unwrap();
            let deviations = Deviations::of(&problem).unwrap();
            let exact = scene.exact.as_ref().unwrap();
            recent.on(&problem.mesh, || Tables::new(exact, &problem, &deviations)).unwrap()
        };
        let [two, three] = [2, 3].map(on);
        assert!(Arc::ptr_eq(&two, &on(2)) && Arc::ptr_eq(&three, &on(3)));
        on(2);
        on(4);
        assert!(Arc::ptr_eq(&two, &on(2)) && !Arc::ptr_eq(&three, &on(3)));
    }
}
