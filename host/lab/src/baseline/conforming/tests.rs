//! Conforming P1 against the catalogue's figures.

use super::Conforming;
use crate::baseline::tests::catalogue;
use signorini_problem::Problem;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tolerances::lab::{CONFORMING, SAME_TRIANGLES};

/// Errors of u in energy and L2 at n = 32, to the three digits given.
#[test]
fn errors_of_the_catalogue() {
    for (name, energy, l2) in
        [("a-tri", 3.90e-2, 3.10e-4), ("b-tri", 2.19e-2, 1.17e-4), ("h-tri", 3.76e-2, 1.74e-4)]
    {
        let scene = catalogue(name);
        let problem = Problem::new(&scene, grid(32, Cells::Triangles)).unwrap();
        let conforming = Conforming::new(&problem).unwrap();
        let error = conforming.errors().unwrap().unwrap();
        CONFORMING.check_relative(name, error.energy, energy);
        CONFORMING.check_relative(name, error.l2, l2);
        assert!(error.force < 0.03 && error.length < 0.1, "{name}: {error:?}");
        assert!(3 * conforming.unknowns() < problem.topology.counts.unknowns() + 400);
    }
}

/// Quads are cut: the same grid as triangles gives the same discretisation.
#[test]
fn quads_are_cut_into_the_same_triangles() {
    let scene = catalogue("h-tri");
    let of = |cells| {
        let problem = Problem::new(&scene, grid(8, cells)).unwrap();
        let conforming = Conforming::new(&problem).unwrap();
        (conforming.unknowns(), conforming.force)
    };
    let ((n, force), (quads, of_quads)) = (of(Cells::Triangles), of(Cells::Quads));
    assert_eq!(n, quads);
    SAME_TRIANGLES.check_over("force", force - of_quads, force);
}
