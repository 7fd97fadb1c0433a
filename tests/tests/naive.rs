//! The naive twin reproduces the table of targets, which proves both.

use std::sync::Arc;

use signorini_tests::contact;
use signorini_tests::exact::Exact;
use signorini_tests::field::constant;
use signorini_tests::flux::contact_force;
use signorini_tests::grid::{Cells, Grid};
use signorini_tests::norms::{Errors, errors};
use signorini_tests::problem::{Boundary, Kind, Problem};
use signorini_tests::targets::{self, ACTIVE, Target};
use signorini_tolerances::twins::{CATALOGUE, TOTAL_FORCE, TRAPEZOID_RATE};

fn solve(problem: &Problem) -> contact::Solution {
    contact::solve(&problem.system()).expect("the scene has exactly one solution")
}

/// Errors, contact force and number of active edges.
fn measure(exact: &Exact, problem: &Problem) -> (Errors, f64, usize) {
    let solution = solve(problem);
    let force = contact_force(problem, &solution);
    (errors(problem, &solution, exact), force, solution.active.len())
}

fn check_target(target: &Target, level: usize) {
    let Target { cells, case, n, h1, l2, force } = *target;
    let what = format!("{case:?} on {cells:?}, n = {n}");
    let exact = case.exact();
    let problem = Problem::catalogue(&exact, Grid::catalogue(n, cells));
    let (e, measured, active) = measure(&exact, &problem);
    CATALOGUE.check_relative(format_args!("{what}, h1"), e.h1, h1);
    CATALOGUE.check_relative(format_args!("{what}, l2"), e.l2, l2);
    TOTAL_FORCE.check_relative(format_args!("{what}, force"), measured, force);
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
fn flux_error_with_a_source() {
    for (cells, expected) in targets::FLUX_OF_A {
        let problem = Problem::catalogue(&Exact::a(), Grid::catalogue(32, cells));
        let (e, ..) = measure(&Exact::a(), &problem);
        CATALOGUE.check_relative(format_args!("A on {cells:?}, flux"), e.flux, expected);
    }
}

#[test]
fn coefficient_jumps() {
    for (k, energy, force) in targets::JUMPS {
        let exact = Exact::jump(k);
        let problem = Problem::catalogue(&exact, Grid::catalogue(32, Cells::Triangles));
        let (e, measured, _) = measure(&exact, &problem);
        CATALOGUE.check_relative(format_args!("{}, energy", exact.name), e.energy, energy);
        CATALOGUE.check_relative(format_args!("{}, force", exact.name), measured, force);
    }
}

#[test]
fn oblique_tensors() {
    for (s, kappa, case, n, energy, force) in targets::TRANSFORMED {
        let exact = case.exact().transformed(s, kappa);
        let problem = Problem::catalogue(&exact, Grid::catalogue(n, Cells::Triangles));
        let (e, measured, _) = measure(&exact, &problem);
        CATALOGUE.check_relative(format_args!("{}, force", exact.name), measured, force);
        if let Some(energy) = energy {
            CATALOGUE.check_relative(format_args!("{}, energy", exact.name), e.energy, energy);
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
        CATALOGUE.check_relative(format_args!("moved {cells:?} {n}, h1"), e.h1, h1);
        CATALOGUE.check_relative(format_args!("moved {cells:?} {n}, l2"), e.l2, l2);
        CATALOGUE.check_relative(format_args!("moved {cells:?} {n}, flux"), e.flux, flux);
    }
}

/// Orders of the errors on quads that stay trapezoids: the parametric element loses half an order
/// in the gradient and one in u, the recovered flux loses nothing.
#[test]
fn trapezoids_cost_the_gradient_and_not_the_flux() {
    let [coarse, fine] = [16, 32].map(|n| {
        let grid = Grid::catalogue(n, Cells::Quads).moved_to_trapezoids(n);
        let exact = Exact::b_mirrored();
        measure(&exact, &Problem::catalogue(&exact, grid)).0
    });
    let order = |coarse: f64, fine: f64| (coarse / fine).log2();
    TRAPEZOID_RATE.check("gradient", order(coarse.h1, fine.h1) - 0.5);
    TRAPEZOID_RATE.check("u", order(coarse.l2, fine.l2) - 1.0);
    TRAPEZOID_RATE.check("flux", order(coarse.flux, fine.flux) - 1.0);
}

#[test]
fn moved_grid() {
    check_moved(0);
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
        TOTAL_FORCE.check_relative(format_args!("benchmark n = {n}"), force, expected);
    }
}

#[test]
fn ben_belgacem_renard() {
    check_benchmark(0..3);
}
