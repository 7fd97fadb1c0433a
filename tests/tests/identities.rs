//! The naive twin's answers meet the identities of the method, which proves it where no table
//! of targets reaches: patches, conservation, complementarity, closed forms.

use std::sync::Arc;

use signorini_tests::contact::{self, Solution};
use signorini_tests::exact::Exact;
use signorini_tests::field::{Point, Scalar, apply, minus};
use signorini_tests::flux::{RaviartThomas, cell_flux, cell_means, contact_force, normal_flux};
use signorini_tests::grid::{Cells, Grid};
use signorini_tests::norms::errors;
use signorini_tests::problem::{Boundary, Kind, Problem, System};
use signorini_tests::quadrature::edge_mean;
use signorini_tests::random::{self, Random};
use signorini_tolerances::twins::{
    BOUNDARY_FLUX, CLOSED_FORM, CONSERVATION, CONTACT_SIGN, FLUX_CONTINUITY, PATCH,
};

fn solve(problem: &Problem) -> Solution {
    contact::solve(&problem.system()).expect("the scene has exactly one solution")
}

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// Linear functions lie in the space on triangles of any shape and on parallelograms, not on
/// other quads; here they meet every kind of condition, and an oblique tensor.
#[test]
fn patches_are_exact() {
    for exact in [Exact::patch_closed(1.0, 0.5, -2.0), Exact::patch_open(1.0, 0.5)] {
        check_patch(&exact, Grid::catalogue(4, Cells::Mixed));
        check_patch(&exact, Grid::catalogue(4, Cells::Triangles).moved_smoothly());
        let sheared = exact.transformed(0.7, 3.0);
        check_patch(&sheared, Grid::rectangle([-1.0, 0.0], [1.0, 1.0], 8, 3, Cells::Mixed));
    }
}

fn check_patch(exact: &Exact, grid: Grid) {
    let problem = Problem::of_exact(exact, grid, |[x, y]| match (x, y) {
        (_, 0.0) => Kind::Contact,
        (-1.0, _) => Kind::Robin(3.0),
        (1.0, _) => Kind::Neumann,
        _ => Kind::Dirichlet,
    });
    let solution = solve(&problem);
    let e = errors(&problem, &solution, exact);
    PATCH.check(&exact.name, largest([e.h1, e.l2, e.flux, e.energy]));
    PATCH.check(&exact.name, contact_force(&problem, &solution) - exact.force);
    let active = solution.active.len();
    assert_eq!(active, if exact.force > 0.0 { 8 } else { 0 }, "{}", exact.name);
}

/// At y = −0.0 the angle of a negative x is −π in floating point; λ must not notice.
#[test]
fn minus_zero_is_zero() {
    let cases =
        [Exact::b(), Exact::h(0.55), Exact::jump(100.0), Exact::h(0.55).transformed(3.0, 2.0)];
    for (exact, x) in cases.iter().flat_map(|case| [-0.5, -0.9].map(|x| (case, x))) {
        assert_eq!((exact.multiplier)([x, -0.0]), (exact.multiplier)([x, 0.0]), "{}", exact.name);
        assert!((exact.multiplier)([x, -0.0]) >= 0.0, "{}", exact.name);
    }
}

/// The size of the terms that add up to a flux: the rounding of the solve is relative to it.
fn term_size(system: &System, solution: &Solution) -> f64 {
    largest(system.stiffness.values().copied()) * largest(solution.means.values().copied())
}

fn length([a, b]: [Point; 2]) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

/// Continuity, conservation and the conditions of N, R and C on scenes of every kind.
#[test]
fn identities_on_random_scenes() {
    for seed in 0..200 {
        let problem = random::problem(&mut Random::new(seed), 4);
        let (solution, system) = (solve(&problem), problem.system());
        let (what, size) = (format!("seed {seed}"), term_size(&system, &solution));
        let normal = normal_flux(&problem, &solution);
        for (e, cells) in problem.grid.edges() {
            if let [first, second] = cells[..] {
                let jump = normal[&(first, e)] + normal[&(second, e)];
                FLUX_CONTINUITY.check(&what, jump * length(problem.grid.ends(e)) / size);
            }
        }
        check_conservation(&what, &problem, &solution);
        check_contact(&what, &system, &solution);
        check_boundary_flux(&what, &problem, &solution, size);
    }
}

/// Σ_E |E| σ_h·n_T = −∫_T f.
fn check_conservation(what: &str, problem: &Problem, solution: &Solution) {
    for cell in 0..problem.grid.cell_count() {
        let outflow: f64 = cell_flux(problem, solution, cell).iter().sum();
        let source = problem.element(cell).source_integral(|p| (problem.source)(cell, p), 8);
        let size = largest(problem.cell_stiffness(cell).concat())
            * largest(cell_means(problem, solution, cell));
        CONSERVATION.check(what, (outflow + source) / size.max(source.abs()));
    }
}

/// u ≥ ψ, σ·n ≥ q and one of them with equality, in means.
fn check_contact(what: &str, system: &System, solution: &Solution) {
    let range = largest(solution.means.values().copied());
    for (&e, &gap) in &system.gap {
        let opening = solution.means[&e] - gap;
        let reaction = system.row(e, &solution.means) - system.load[&e];
        let reaction = reaction / system.stiffness[&(e, e)];
        CONTACT_SIGN.check(what, opening.min(reaction) / range);
        assert_eq!(solution.active.contains(&e), opening == 0.0, "{what}");
    }
}

/// On N the mean flux is the mean of g, on R it is (∫ h u_ext − u_E ∫ h)/|E|.
fn check_boundary_flux(what: &str, problem: &Problem, solution: &Solution, size: f64) {
    let (normal, cells) = (normal_flux(problem, solution), problem.grid.edges());
    for (&e, condition) in &problem.boundary {
        let ends = problem.grid.ends(e);
        let mean = |f| edge_mean(f, ends, 8);
        let expected = match condition {
            Boundary::Neumann { flux } => mean(flux),
            Boundary::Robin { coefficient, ambient } => {
                let (h, u_ext) = (coefficient.clone(), ambient.clone());
                let product: Scalar = Arc::new(move |p| h(p) * u_ext(p));
                mean(&product) - solution.means[&e] * mean(coefficient)
            }
            _ => continue,
        };
        let deviation = normal[&(cells[&e][0], e)] - expected;
        BOUNDARY_FLUX.check(what, deviation * length(ends) / size);
    }
}

/// Remark 3.5 on triangles (Marini's formula) and squares: σ_h = Ā∇u_h − f̄/2 (x − x_T).
///
/// On rectangles with h_x ≠ h_y the remark's factors f̄ h_y/(h_x + h_y), f̄ h_x/(h_x + h_y) do not
/// follow from (10): x̂² − ŷ² is not harmonic there. Testing (10) with it makes both factors
/// equal, and conservation makes them (f̄ + ∇·A∇u_h)/2, which on squares is the remark again.
#[test]
fn closed_forms_of_the_flux() {
    let oblique = Exact::a().transformed(0.5, 1.0);
    for (exact, rows, cells) in [
        (&oblique, 6, Cells::Triangles),
        (&Exact::jump(100.0), 2, Cells::Triangles),
        (&Exact::a(), 2, Cells::Mixed),
        (&Exact::jump(100.0), 2, Cells::Quads),
        (&Exact::jump(100.0), 6, Cells::Mixed),
    ] {
        let grid = Grid::rectangle([-1.0, 0.0], [1.0, 1.0], 4, rows, cells);
        let mut problem = Problem::catalogue(exact, grid);
        problem.source = Arc::new(|cell, [x, y]| 1.0 + cell as f64 * x - y * y);
        let solution = solve(&problem);
        let size = term_size(&problem.system(), &solution);
        for cell in 0..problem.grid.cell_count() {
            let deviation = closed_form_deviation(&problem, &solution, cell, rows == 2);
            CLOSED_FORM.check(&exact.name, deviation / size);
        }
    }
}

/// `square`: quads are squares, on which ∇·A∇u_h = 0 is taken for granted, as the paper does.
fn closed_form_deviation(p: &Problem, solution: &Solution, cell: usize, square: bool) -> f64 {
    let (element, means) = (p.element(cell), cell_means(p, solution, cell));
    let corners = &element.cell.corners;
    let mean = |i: usize| corners.iter().map(|c| c[i]).sum::<f64>() / corners.len() as f64;
    let centre = [mean(0), mean(1)];
    let sigma = |r| apply((p.tensor)(cell, centre), element.gradient(&means, r));
    let divergence = if square || corners.len() == 3 {
        0.0
    } else {
        let [width, height] = minus(corners[2], corners[0]);
        let origin = sigma([0.0, 0.0]);
        (sigma([1.0, 0.0])[0] - origin[0]) / width + (sigma([0.0, 1.0])[1] - origin[1]) / height
    };
    let total = element.source_integral(|x| (p.source)(cell, x), 8);
    let field = RaviartThomas::new(element.cell.clone(), cell_flux(p, solution, cell));
    largest([[0.2, 0.3], [0.6, 0.1], [0.0, 1.0]].into_iter().flat_map(|r| {
        let factor = (element.averaged_source(total, r) + divergence) / 2.0;
        let arm = minus(element.cell.map(r), centre);
        let expected = minus(sigma(r), [factor * arm[0], factor * arm[1]]);
        minus(field.at(r), expected)
    }))
}
