//! The truth by one source against the truth by another.

use signorini_tolerances::Tolerance;
use signorini_tolerances::lab::{
    CATALOGUE, FORCE, FORCE_ERROR, ITSELF, LENGTH, LENGTH_ERROR, REFERENCE, REFERENCE_L2,
    REFERENCE_L2_QUADS, SAME_NORMS,
};
use std::f64::consts::PI;

use super::finer_solve::Reference;
use super::recovery::Inside;
use super::{ReferenceSolution, Source};
use crate::mesh_solution::solve_directly;
use crate::trade::record::PointError;
use crate::trade::tests::scene as read;
use signorini_certify::conductivity::product;
use signorini_certify::weighed::minus;
use signorini_problem::Problem;
use signorini_problem::fixtures::{SMOOTH, on_grid, with_four_sides};
use signorini_problem::pointwise::exact_at;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::{Mesh, Scene, mesh};
use signorini_solve::Solution;
use signorini_solve::norms::of_solution;

fn solved(scene: &Scene, mesh: Mesh) -> (Problem, Solution) {
    let problem = Problem::new(scene, mesh).unwrap();
    let solution = solve_directly(&problem).unwrap();
    (problem, solution)
}

/// By the scene's exact solution, known on `mesh`.
fn exact(scene: &Scene, mesh: &Mesh) -> ReferenceSolution {
    ReferenceSolution::new(scene, mesh, 0).unwrap()
}

/// By a solution on `mesh`, as if the scene had no exact one.
fn reference(scene: &Scene, mesh: &Mesh) -> ReferenceSolution {
    let scene = Scene { exact: None, ..scene.clone() };
    let (reference, facts) = Reference::new(&scene, mesh.clone()).unwrap();
    ReferenceSolution { source: Source::Reference(reference), facts }
}

#[test]
fn the_catalogue_has_its_forces_and_lengths() {
    let cases = [
        ("a-tri", 0.25, 1.0),
        ("b-tri", 1.0, 1.0),
        ("h-quad", PI * 0.3025, 1.1),
        ("hg-tri", PI * 0.3025, 1.1),
        ("moving-tri", PI * 0.3025, 1.1),
        ("j001-tri", 0.1, 1.0),
        ("t-h-tri", PI * 0.3025, 1.1),
        ("patch-mixed", 4.0, 2.0),
    ];
    for (name, force, length) in cases {
        let scene = read(&format!("catalogue/{name}"));
        let truth = exact(&scene, &grid(16, Cells::Quads));
        assert_eq!(truth.facts.words, "the exact solution");
        FORCE.check_relative(name, truth.facts.force, force);
        LENGTH.check_relative(name, truth.facts.length, length);
    }
}

#[test]
fn the_exact_solution_gives_the_norms_of_the_catalogue() {
    let scene = read("catalogue/h-tri");
    let mesh = grid(16, Cells::Triangles);
    let truth = exact(&scene, &mesh);
    let (problem, solution) = solved(&scene, mesh);
    let found = truth.errors(&problem, &solution).unwrap();
    CATALOGUE.check_relative("energy", found.energy, 9.74473e-2);
    CATALOGUE.check_relative("flux", found.flux, 9.74473e-2);
    CATALOGUE.check_relative("L2", found.l2, 1.97915e-3);
    FORCE_ERROR.check_relative("force", found.force, 0.952483 - PI * 0.3025);
    LENGTH_ERROR.check_relative("length", found.length, 18.0 / 16.0 - 1.1);
    let errors = of_solution(&problem, &solution).unwrap().unwrap();
    assert_eq!(found.combined, errors.combined);
    // ‖∇u‖² = ‖∇_h u_h‖² + ‖∇u − ∇_h u_h‖² up to what is of higher order.
    let energy = solution.energy(&problem).hypot(errors.energy);
    FORCE_ERROR.check_relative("energy of the solution", truth.facts.energy, energy);
}

#[test]
fn answers_on_other_meshes_in_between_change_nothing() {
    let scene = read("catalogue/ag-mixed");
    let meshes = [grid(16, Cells::Triangles), grid(9, Cells::Quads), grid(7, Cells::Mixed)];
    let truth = exact(&scene, &meshes[0]);
    let solved = meshes.map(|mesh| solved(&scene, mesh));
    for at in [0, 1, 2, 2, 0, 1] {
        let (problem, solution) = &solved[at];
        let found = truth.errors(problem, solution).unwrap();
        let expected = of_solution(problem, solution).unwrap().unwrap();
        SAME_NORMS.check_relative("energy", found.energy, expected.energy);
        SAME_NORMS.check_relative("L2", found.l2, expected.l2);
        SAME_NORMS.check_relative("flux", found.flux, expected.flux);
        SAME_NORMS.check_relative("combined", found.combined.unwrap(), expected.combined.unwrap());
    }
}

/// Errors of the answer on `coarse` by the exact solution and by the reference on `fine`; `in_l2` tells how
/// far apart they may be in L2.
fn compare(scene: &Scene, coarse: Mesh, fine: &Mesh, in_l2: Tolerance) {
    let (exact, reference) = (exact(scene, &coarse), reference(scene, fine));
    REFERENCE.check_relative("energy of the solution", reference.facts.energy, exact.facts.energy);
    let (problem, solution) = solved(scene, coarse);
    let expected = exact.errors(&problem, &solution).unwrap();
    let found = reference.errors(&problem, &solution).unwrap();
    println!("{}\n  exact     {expected:?}\n  reference {found:?}", scene.title);
    for (found, expected, allowed, what) in [
        (found.energy, expected.energy, REFERENCE, "energy"),
        (found.flux, expected.flux, REFERENCE, "flux"),
        (found.l2, expected.l2, in_l2, "L2"),
        (found.combined.unwrap(), expected.combined.unwrap(), REFERENCE, "combined"),
    ] {
        allowed.check_relative(format_args!("{}: {what}", scene.title), found, expected);
    }
    REFERENCE.check_relative("force", reference.facts.force, exact.facts.force);
    assert!((reference.facts.length - exact.facts.length).abs() < 2.5 / 32.0);
}

/// The answer may have other cells than the reference.
#[test]
fn a_reference_measures_what_the_exact_solution_does() {
    use Cells::{Mixed, Quads, Triangles};
    for (name, n, cells, of_reference, in_l2) in [
        ("h-tri", 8, Triangles, Triangles, REFERENCE_L2),
        ("j001-tri", 8, Triangles, Triangles, REFERENCE_L2),
        ("hg-tri", 8, Triangles, Triangles, REFERENCE_L2),
        ("ag-mixed", 8, Triangles, Triangles, REFERENCE_L2),
        ("h-tri", 8, Quads, Triangles, REFERENCE_L2_QUADS),
        ("h-tri", 8, Triangles, Quads, REFERENCE_L2),
        ("h-tri", 7, Mixed, Mixed, REFERENCE_L2),
    ] {
        let scene = read(&format!("catalogue/{name}"));
        compare(&scene, grid(n, cells), &grid(32, of_reference), in_l2);
    }
}

#[test]
fn transfer_counts_on_the_robin_boundary() {
    let (scene, problem) = on_grid(SMOOTH, grid(4, Cells::Mixed)).unwrap();
    compare(
        &scene,
        Mesh::clone(&problem.mesh),
        &with_four_sides(grid(32, Cells::Triangles)),
        REFERENCE_L2,
    );
}

#[test]
fn the_recovered_gradient_is_much_nearer_than_the_broken_one() {
    let cases = [
        ("h-tri", Cells::Triangles, 0.15),
        ("a-tri", Cells::Triangles, 0.15),
        ("j001-tri", Cells::Triangles, 0.1),
        ("h-tri", Cells::Quads, 0.4),
    ];
    for (name, cells, part) in cases {
        let scene = read(&format!("catalogue/{name}"));
        let exact = scene.exact.as_ref().unwrap();
        let mesh = grid(16, cells);
        let (reference, _) = Reference::new(&scene, mesh.clone()).unwrap();
        let square = |at: &Inside| {
            let (_, gradient) = exact_at(&scene, exact, at.x, 0.0).unwrap();
            let error = minus(at.gradient, gradient);
            at.weight * product(&at.conductivity, error, error)
        };
        let recovered = reference.points.iter().map(square).sum::<f64>().sqrt();
        let (problem, solution) = solved(&scene, mesh);
        let errors = of_solution(&problem, &solution).unwrap().unwrap();
        let total = solution.bound.unwrap().total;
        println!("{name}: recovered {recovered:.3e}, mean <= {:.3e}, {errors:?}", total / 2.0);
        assert!(recovered < part * errors.energy, "{name}");
    }
}

#[test]
fn a_worse_answer_is_farther_away() {
    let scene = read("catalogue/h-tri");
    let truth = reference(&scene, &grid(16, Cells::Triangles));
    let (problem, mut solution) = solved(&scene, grid(4, Cells::Quads));
    let before = truth.errors(&problem, &solution).unwrap();
    for (at, u) in solution.u.iter_mut().enumerate() {
        *u += 0.02 * (at as f64).sin();
    }
    solution.flux.iter_mut().for_each(|flux| *flux *= 1.05);
    solution.certified.vertices.iter_mut().for_each(|s| *s *= 1.05);
    solution.contact_force += 0.1;
    solution.contact_length += 0.5;
    let after = truth.errors(&problem, &solution).unwrap();
    let numbers = |error: PointError| {
        [error.energy, error.l2, error.flux, error.combined.unwrap(), error.force, error.length]
    };
    let pairs = numbers(before).into_iter().zip(numbers(after));
    assert!(pairs.clone().all(|(before, after)| after > before), "{:?}", pairs.collect::<Vec<_>>());
    solution.bound = None;
    assert_eq!(truth.errors(&problem, &solution).unwrap().combined, None);
}

#[test]
fn every_scene_can_be_its_own_reference() {
    for name in ["benbelgacem", "levee", "membrane", "pit", "slab", "strip"] {
        let scene = read(&format!("scenes/{name}"));
        let mesh = mesh::read(&scene.mesh.value).unwrap();
        let truth = reference(&scene, &mesh);
        let (problem, solution) = solved(&scene, mesh);
        let found = truth.errors(&problem, &solution).unwrap();
        println!("{name}: {}\n  {found:?}", truth.facts.words);
        let largest = solution.u.iter().fold(0.0f64, |most, u| most.max(u.abs()));
        assert!(found.l2 <= 1e-2 * largest, "{name}: {found:?}");
        ITSELF.check_over(name, found.force, truth.facts.force);
        assert_eq!(found.length, 0.0, "{name}");
        // ∇s and A⁻¹τ are equally far from their mean, and the recovered gradient is not far from it.
        let total = 2.0 * solution.bound.unwrap().total;
        assert!(found.combined.unwrap() <= total && found.energy <= total, "{name}: {found:?}");
        assert!(found.energy > 0.0 && truth.facts.energy > found.energy, "{name}: {found:?}");
    }
}
