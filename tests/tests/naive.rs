//! The naive twin reproduces the table of targets, which proves both; and what it computes meets
//! the identities of the method, which proves it where no table reaches.

use std::collections::BTreeMap;
use std::sync::Arc;

use signorini_tests::contact::{self, Solution};
use signorini_tests::exact::Exact;
use signorini_tests::field::{Point, apply, constant, minus};
use signorini_tests::flux::{RaviartThomas, cell_flux, cell_means, contact_force, normal_flux};
use signorini_tests::grid::{Cells, Grid};
use signorini_tests::norms::{Errors, errors};
use signorini_tests::problem::{Boundary, Kind, Problem};
use signorini_tests::random::{self, Random};
use signorini_tests::targets::{self, ACTIVE, Case, Target};
use signorini_tests::tolerances::{
    BOUNDARY_FLUX, CATALOGUE, CLOSED_FORM, CONSERVATION, CONTACT_SIGN, FLUX_CONTINUITY, PATCH,
    TOTAL_FORCE,
};

fn solve(problem: &Problem) -> Solution {
    contact::solve(&problem.system()).expect("the scene has exactly one solution")
}

/// Errors, contact force and number of active edges.
fn measure(exact: &Exact, problem: &Problem) -> (Errors, f64, usize) {
    let solution = solve(problem);
    let force = contact_force(problem, &solution);
    (errors(problem, &solution, exact), force, solution.active.len())
}

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most: f64, value| most.max(value.abs()))
}

fn check_target(target: &Target, level: usize) {
    let Target { cells, case, n, h1, l2, force } = *target;
    let what = format!("{case:?} on {cells:?}, n = {n}");
    let exact = case.exact();
    let problem = Problem::catalogue(&exact, Grid::catalogue(n, cells));
    let (e, measured, active) = measure(&exact, &problem);
    CATALOGUE.check_relative(&format!("{what}, h1"), e.h1, h1);
    CATALOGUE.check_relative(&format!("{what}, l2"), e.l2, l2);
    TOTAL_FORCE.check_relative(&format!("{what}, force"), measured, force);
    let expected = ACTIVE.iter().find(|(listed, _)| *listed == case && cells == Cells::Triangles);
    if let Some((_, counts)) = expected {
        assert_eq!(active, counts[level], "{what}, active edges");
    }
}

#[test]
fn catalogue_on_coarse_meshes() {
    for (level, row) in (0..2).flat_map(|level| targets::CATALOGUE.map(|row| (level, row))) {
        check_target(&row[level], level);
    }
}

#[test]
#[ignore = "two minutes: dense local work on 16 384 cells, eight times"]
fn catalogue_on_fine_meshes() {
    for (level, row) in (2..4).flat_map(|level| targets::CATALOGUE.map(|row| (level, row))) {
        check_target(&row[level], level);
    }
}

#[test]
fn flux_error_with_a_source() {
    for (cells, expected) in targets::FLUX_OF_A {
        let problem = Problem::catalogue(&Exact::a(), Grid::catalogue(32, cells));
        let (e, ..) = measure(&Exact::a(), &problem);
        CATALOGUE.check_relative(&format!("A on {cells:?}, flux"), e.flux, expected);
    }
}

#[test]
fn coefficient_jumps() {
    for (k, energy, force) in targets::JUMPS {
        let exact = Exact::jump(k);
        let problem = Problem::catalogue(&exact, Grid::catalogue(32, Cells::Triangles));
        let (e, measured, _) = measure(&exact, &problem);
        CATALOGUE.check_relative(&format!("{}, energy", exact.name), e.energy, energy);
        CATALOGUE.check_relative(&format!("{}, force", exact.name), measured, force);
    }
}

#[test]
fn oblique_tensors() {
    for (s, kappa, case, n, energy, force) in targets::TRANSFORMED {
        let exact = case.exact().transformed(s, kappa);
        let problem = Problem::catalogue(&exact, Grid::catalogue(n, Cells::Triangles));
        let (e, measured, _) = measure(&exact, &problem);
        CATALOGUE.check_relative(&format!("{}, force", exact.name), measured, force);
        if let Some(energy) = energy {
            CATALOGUE.check_relative(&format!("{}, energy", exact.name), e.energy, energy);
        }
    }
}

fn check_moved(level: usize) {
    let exact = Exact::b_mirrored();
    for (cells, n, unknowns, [h1, l2, flux]) in targets::MOVED.into_iter().skip(level).step_by(2) {
        let grid = Grid::catalogue(n, cells).moved_smoothly();
        let problem = Problem::of_exact(&exact, grid, |[_, y]| match y {
            0.0 => Kind::Contact,
            1.0 => Kind::Dirichlet,
            _ => Kind::Neumann,
        });
        let dirichlet =
            problem.boundary.values().filter(|b| matches!(b, Boundary::Dirichlet { .. })).count();
        assert_eq!(problem.grid.edges().len() - dirichlet, unknowns);
        let (e, ..) = measure(&exact, &problem);
        CATALOGUE.check_relative(&format!("moved {cells:?} {n}, h1"), e.h1, h1);
        CATALOGUE.check_relative(&format!("moved {cells:?} {n}, l2"), e.l2, l2);
        CATALOGUE.check_relative(&format!("moved {cells:?} {n}, flux"), e.flux, flux);
    }
}

#[test]
fn moved_grid() {
    check_moved(0);
}

#[test]
#[ignore = "half a minute"]
fn moved_grid_refined() {
    check_moved(1);
}

fn check_benchmark(levels: std::ops::Range<usize>) {
    for &(n, expected) in &targets::BENCHMARK[levels] {
        let grid = Grid::rectangle([0.0, 0.0], [1.0, 1.0], n, n, Cells::Triangles);
        let condition = |y: f64| match y {
            0.0 => Boundary::Contact { gap: constant(0.0), flux: constant(0.0) },
            1.0 => Boundary::Dirichlet { value: constant(0.0) },
            _ => Boundary::Neumann { flux: constant(0.0) },
        };
        let height = |e| grid.ends(e).iter().map(|p| p[1]).sum::<f64>() / 2.0;
        let boundary = grid.boundary().into_iter().map(|e| (e, condition(height(e)))).collect();
        let tau = 2.0 * std::f64::consts::PI;
        let problem = Problem {
            boundary,
            grid,
            tensor: Arc::new(|_, _| [1.0, 0.0, 1.0]),
            source: Arc::new(move |_, [x, _]| tau * (tau * x).sin()),
            order: 8,
        };
        let force = contact_force(&problem, &solve(&problem));
        TOTAL_FORCE.check_relative(&format!("benchmark n = {n}"), force, expected);
    }
}

#[test]
fn ben_belgacem_renard() {
    check_benchmark(0..3);
}

#[test]
#[ignore = "half a minute"]
fn ben_belgacem_renard_refined() {
    check_benchmark(3..5);
}

/// Linear solutions lie in the space, also on mixed and moved cells, oblique tensors, and under
/// every kind of condition.
#[test]
fn patches_are_exact() {
    for exact in [Exact::patch_closed(1.0, 0.5, -2.0), Exact::patch_open(1.0, 0.5)] {
        let grid = Grid::catalogue(4, Cells::Mixed).moved_smoothly();
        let problem = Problem::of_exact(&exact, grid, |[x, y]| match (x, y) {
            (_, 0.0) => Kind::Contact,
            (-1.0, _) => Kind::Robin(3.0),
            (1.0, _) => Kind::Neumann,
            _ => Kind::Dirichlet,
        });
        let (e, force, active) = measure(&exact, &problem);
        PATCH.check(&exact.name, largest([e.h1, e.l2, e.flux, e.energy]));
        PATCH.check(&exact.name, force - exact.force);
        assert!(active == 0 || active == 8, "{active} active edges");
    }
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

/// The largest |flux| through an edge, to measure deviations by.
fn flux_scale(normal: &BTreeMap<(usize, (u32, u32)), f64>) -> f64 {
    largest(normal.values().copied())
}

/// Continuity, conservation and the conditions of N, R and C on scenes of every kind.
#[test]
fn identities_on_random_scenes() {
    for seed in 0..200 {
        let problem = random::problem(&mut Random::new(seed), 4);
        let what = format!("seed {seed}");
        let (solution, system) = (solve(&problem), problem.system());
        let normal = normal_flux(&problem, &solution);
        let scale = flux_scale(&normal);
        for (e, cells) in problem.grid.edges() {
            if let [first, second] = cells[..] {
                let jump = normal[&(first, e)] + normal[&(second, e)];
                FLUX_CONTINUITY.check(&what, jump / scale);
            }
        }
        for cell in 0..problem.grid.cell_count() {
            let flux = cell_flux(&problem, &solution, cell);
            let source = problem.element(cell).source_integral(|p| (problem.source)(cell, p), 8);
            let size = largest(problem.cell_stiffness(cell).concat())
                * largest(cell_means(&problem, &solution, cell));
            CONSERVATION.check(&what, (flux.iter().sum::<f64>() + source) / size);
        }
        let range = largest(solution.means.values().copied());
        for (&e, &gap) in &system.gap {
            let opening = solution.means[&e] - gap;
            let reaction = system.row(e, &solution.means) - system.load[&e];
            let reaction = reaction / system.stiffness[&(e, e)];
            CONTACT_SIGN.check(&what, opening.min(0.0) / range);
            CONTACT_SIGN.check(&what, opening.min(reaction) / range);
            assert_eq!(solution.active.contains(&e), opening == 0.0, "{what}");
        }
        check_boundary_flux(&what, &problem, &solution, scale);
    }
}

/// On N the mean flux is the mean of g, on R it is (∫ h u_ext − u_E ∫ h)/|E|.
fn check_boundary_flux(what: &str, problem: &Problem, solution: &Solution, scale: f64) {
    let normal = normal_flux(problem, solution);
    let cells = problem.grid.edges();
    for (&e, condition) in &problem.boundary {
        let mean = |f| signorini_tests::quadrature::edge_mean(f, problem.grid.ends(e), 8);
        let expected = match condition {
            Boundary::Neumann { flux } => mean(flux),
            Boundary::Robin { coefficient, ambient } => {
                let (h, u_ext) = (coefficient.clone(), ambient.clone());
                mean(&(Arc::new(move |p: Point| h(p) * u_ext(p)) as _))
                    - solution.means[&e] * mean(coefficient)
            }
            _ => continue,
        };
        BOUNDARY_FLUX.check(what, (normal[&(cells[&e][0], e)] - expected) / scale);
    }
}

/// Remark 3.5: on a triangle σ_h = Ā∇u_h − f̄/2 (x − x_T); on an h_x × h_y rectangle with scalar
/// constant A, σ_h = A∇u_h − f̄/(h_x + h_y) (h_y (x − x_T), h_x (y − y_T)).
#[test]
fn closed_forms_of_the_flux() {
    let oblique = Exact::a().transformed(0.5, 1.0);
    for (exact, cells) in [
        (oblique, Cells::Triangles),
        (Exact::jump(100.0), Cells::Triangles),
        (Exact::a(), Cells::Mixed),
        (Exact::jump(100.0), Cells::Quads),
    ] {
        let grid = Grid::rectangle([-1.0, 0.0], [1.0, 1.0], 4, 6, cells);
        let mut problem = Problem::catalogue(&exact, grid);
        problem.source = Arc::new(|cell, [x, y]| 1.0 + cell as f64 * x - y * y);
        let solution = solve(&problem);
        let scale = flux_scale(&normal_flux(&problem, &solution));
        for k in 0..problem.grid.cell_count() {
            let element = problem.element(k);
            let means = cell_means(&problem, &solution, k);
            let field = RaviartThomas::new(element.cell.clone(), cell_flux(&problem, &solution, k));
            let corners = &element.cell.corners;
            let mean = |i: usize| corners.iter().map(|c| c[i]).sum::<f64>() / corners.len() as f64;
            let total = element.source_integral(|p| (problem.source)(k, p), 8);
            // h_x = 1/2, h_y = 1/6; a triangle's factors are both 1/2.
            let factor = if corners.len() == 3 { [0.5, 0.5] } else { [0.25, 0.75] };
            for r in [[0.2, 0.3], [0.6, 0.1], [0.0, 1.0]] {
                let p = element.cell.map(r);
                let gradient =
                    apply((problem.tensor)(k, [mean(0), mean(1)]), element.gradient(&means, r));
                let f = element.averaged_source(total, r);
                let expected = [
                    gradient[0] - f * factor[0] * (p[0] - mean(0)),
                    gradient[1] - f * factor[1] * (p[1] - mean(1)),
                ];
                let deviation = minus(field.at(r), expected);
                CLOSED_FORM.check(&exact.name, largest(deviation) / scale);
            }
        }
    }
}
