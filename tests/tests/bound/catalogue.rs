//! How sharp the bound is on the catalogue: at convergence, and while the solver is under way; and the bound for u_h, which
//! is another function than the s of the bound's total.

use signorini_certify::sampled::{Solution as Known, Table};
use signorini_scene::mesh::structured::Cells;
use signorini_solve::norms::of_fields;
use signorini_solve::{ScalarKind, Solution, solve};
use signorini_tests::written::{Side, TwoMaterials, Units, Written};
use signorini_tolerances::some;
use signorini_tolerances::twins::{ALGEBRAIC, EDGE_MEAN, SHARPNESS};

use super::run::{Run, options, posed, run};
use crate::mesh::regular;

type Named = (String, Written);

/// The catalogue's cases with conditions of A up to 10, and jumps.
fn cases() -> Vec<Named> {
    let plain =
        [TwoMaterials::a(), TwoMaterials::b(), TwoMaterials::h(0.55), TwoMaterials::h_gap(0.55)];
    let jumps = [1e-4, 1e-2, 1e2, 1e4].map(TwoMaterials::jump);
    let named = |case: &TwoMaterials| (case.name.clone(), case.written());
    let mut cases: Vec<_> = plain.iter().chain(&jumps).map(named).collect();
    cases.push(("T(0.5, 1) of A".to_owned(), TwoMaterials::a().transformed(0.5, 1.0)));
    cases.push(("T(0, 3) of B".to_owned(), TwoMaterials::b().transformed(0.0, 3.0)));
    cases
}

/// Scenes that are farthest off when cut off.
const SLOW: [&str; 5] = ["B", "H_g(0.55)", "J(1.0e-4)", "J(1.0e4)", "T(0.5, 1) of A"];

/// Bound over energy error of u_h at convergence: √2 where s and σ_h err alike, and some more for
/// s at free points.
const CONVERGED: f64 = 2.0;
/// Bounds of cut-off solves over errors; 7.5 at worst, H_g after one sweep from a start far below the solution.
const CUT_OFF: f64 = 8.0;

#[test]
fn at_convergence_the_bound_is_close_to_the_error() {
    for (name, written) in cases() {
        let text = written.scene([Side::Dirichlet; 3], Units::ONE);
        for cells in [Cells::Triangles, Cells::Quads] {
            let what = format!("{name} on {cells:?}");
            let run = run(&text, regular(16, cells), &options(ScalarKind::F64, None));
            let found = run.certified().expect("held by Dirichlet edges");
            let gap = found.bound.duality_gap;
            SHARPNESS.check(&what, gap / found.combined - 1.0);
            assert!(gap <= CONVERGED * found.energy, "{what}: {found:?}");
            ALGEBRAIC.check_over(&what, found.bound.algebraic, gap);
        }
    }
}

#[test]
fn cut_off_the_bound_is_not_far_from_the_error() {
    let slow = cases().into_iter().filter(|(name, _)| SLOW.contains(&name.as_str()));
    assert_eq!(slow.clone().count(), SLOW.len());
    for (name, written) in some(2, slow) {
        let text = written.scene([Side::Dirichlet; 3], Units::ONE);
        for cells in [Cells::Triangles, Cells::Quads] {
            let problem = posed(&text, regular(16, cells));
            let exact = problem.scene.exact.as_ref().expect("an exact solution");
            // Evaluated once for all stops.
            let exact = Table::of(&Known { exact, problem: &problem }, &problem).expect("finite");
            for sweeps in [1, 5, 20, 80, 320] {
                let found = solve(&problem, &options(ScalarKind::F64, Some(sweeps)));
                let Solution { bound, u, flux, .. } = found.expect("an iterate");
                let bound = bound.expect("held by Dirichlet edges");
                let energy = of_fields(&problem, &exact, &u, &flux).expect("finite").energy;
                let what = format!("{name} on {cells:?} after {sweeps} sweeps");
                assert!(bound.duality_gap <= CUT_OFF * energy, "{what}: {bound:?}, {energy:e}");
            }
        }
    }
}

/// The bound cannot tell: it is right for any iterate.
#[test]
fn a_curved_gap_is_met_in_its_mean_over_an_edge() {
    let text = TwoMaterials::h_gap(0.55).written().scene([Side::Dirichlet; 3], Units::ONE);
    let Run { problem, solution, .. } =
        run(&text, regular(8, Cells::Mixed), &options(ScalarKind::F64, None));
    let edges = problem.topology.counts.free..problem.topology.counts.unknowns();
    let gap = |edge: usize| {
        let [[a, _], [b, _]] = problem.segment(edge);
        -(a * a + a * b + b * b) / 3.0
    };
    let openings: Vec<_> = edges.map(|edge| solution.u[edge] - gap(edge)).collect();
    let closed = openings.iter().filter(|opening| opening.abs() <= EDGE_MEAN.value);
    assert_eq!(closed.count(), solution.contact_active);
    EDGE_MEAN.check("u below ψ", openings.into_iter().fold(0.0, f64::min));
}

/// At most 1.0 after one sweep; with the plain mean of the two fluxes of an edge it is 4.3.
#[test]
fn at_a_jump_the_flux_of_the_soft_side_decides() {
    for k in [1e-4, 1e4] {
        let text = TwoMaterials::jump(k).written().scene([Side::Dirichlet; 3], Units::ONE);
        let run = run(&text, regular(8, Cells::Triangles), &options(ScalarKind::F64, Some(1)));
        let (bound, energy) = (run.solution.bound.expect("held"), run.energy());
        assert!(bound.duality_gap <= CONVERGED * energy, "J({k:e}): {bound:?}, {energy:e}");
    }
}

/// u = x² + y² is an s on quads: the total sees none of what is wrong with u_h.
const PARABOLOID: &str = "
title = \"a paraboloid\"
mesh = \"none.msh\"
material.default.conductivity = \"1\"
source.f = \"-4\"
boundary.default = { kind = \"dirichlet\", value = \"x^2 + y^2\" }
boundary.contact = { kind = \"contact\", gap = \"x^2 - 1\", flux = \"0\" }
exact = { u = \"x^2 + y^2\", gradient = [\"2*x\", \"2*y\"] }
";

#[test]
fn u_h_may_be_further_off_than_s() {
    for n in [1, 2, 8] {
        let run = run(PARABOLOID, regular(n, Cells::Quads), &options(ScalarKind::F64, None));
        let found = run.certified().expect("held by Dirichlet edges");
        assert!(found.energy > found.bound.total, "n = {n}: {found:?}");
        assert!(found.energy <= found.bound.of_u, "n = {n}: {found:?}");
    }
}
