//! The nonparametric element on quads of any shape: exact where u is linear, the method's identities, the
//! guarantee, and the rates that the parametric element loses.

use signorini_problem::EdgeKind;
use signorini_scene::mesh::Mesh;
use signorini_scene::mesh::structured::{Cells, Trapezoids, grid, trapezoids};
use signorini_solve::{Options, ScalarKind, SolverKind};
use signorini_tests::random::Random;
use signorini_tests::written::{Side, Smooth, TwoMaterials, Units};
use signorini_tolerances::cases;
use signorini_tolerances::twins::{
    BOUNDARY_FLUX, CONTACT_SIGN, FLUX_CONTINUITY, PATCH, SAME_ON_SQUARES, SHARPNESS, TRAPEZOID_RATE,
};

use super::property::{check, trial};
use super::run::{Run, options, run};
use crate::mesh::{four_sides, scattered};

/// A scene with this element on quads.
fn with(element: &str, text: &str) -> String {
    format!("{text}\n[setting]\nelement = \"{element}\"\n")
}

fn direct(text: &str, mesh: Mesh) -> Run {
    let options = Options { solver: SolverKind::Direct, ..Options::default() };
    run(&with("nonparametric", text), mesh, &options)
}

/// A linear u that touches, held by every kind of condition, under an oblique tensor.
const LINEAR: &str = r#"
mesh = "none.msh"
material.default.conductivity = ["2", "0.5", "1"]
source.f = "0"
boundary.contact = { kind = "contact", gap = "1 + 0.5*x", flux = "0.25" }
boundary.left = { kind = "robin", coefficient = "3", ambient = "1 + 0.5*x - 2*y" }
boundary.right = { kind = "neumann", flux = "0" }
boundary.top = { kind = "dirichlet", value = "1 + 0.5*x - 2*y" }
exact = { u = "1 + 0.5*x - 2*y", gradient = ["0.5", "-2"] }
"#;

#[test]
fn linear_functions_are_exact_on_scattered_quads() {
    for cells in [Cells::Quads, Cells::Mixed] {
        let run = direct(LINEAR, scattered(&mut Random::new(7), 5, cells));
        let found = run.certified().expect("held");
        PATCH.check("energy", found.energy / run.solution.energy(&run.problem));
        PATCH.check("bound", found.bound.duality_gap / run.solution.energy(&run.problem));
        assert_eq!(run.solution.contact_active, 10);
    }
}

/// From both sides of an edge, on N, and on C, for sources and tensors that vary.
#[test]
fn identities() {
    for seed in 0..20 {
        let random = &mut Random::new(seed);
        let text = Smooth::random(random).written();
        let text = text.scene([Side::Robin, Side::Neumann, Side::Dirichlet], Units::ONE);
        let Run { problem, solution, .. } = direct(&text, scattered(random, 4, Cells::Quads));
        let (what, free) = (format!("seed {seed}"), problem.topology.counts.free);
        let range = solution.u.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
        let terms = problem.stiffest() * range;
        let flux = solution.largest_flux() / terms;
        FLUX_CONTINUITY.check(&what, solution.mismatch * flux);
        // Of fluxes that are means of both sides.
        FLUX_CONTINUITY.check(&what, solution.conservation_defect(&problem) * flux);
        for record in &problem.loads.neumann {
            assert_eq!(problem.kinds[record.edge as usize], EdgeKind::Neumann);
            BOUNDARY_FLUX.check(&what, (solution.flux[record.edge as usize] - record.flux) / terms);
        }
        for (at, gap) in problem.loads.gap.iter().enumerate() {
            let opening = (solution.u[free + at] - gap) / range;
            let force = (solution.flux[free + at] - problem.loads.contact_flux[at]) / terms;
            CONTACT_SIGN.check(&what, opening.min(force));
        }
    }
}

#[test]
fn the_bound_holds_on_random_scenes() {
    for seed in 0..cases(40) {
        check(&trial(seed, |text| with("nonparametric", &text)));
    }
}

/// Orders of h1, l2, flux and the bound, with the average, between n = 16 and 32 on quads that stay trapezoids.
fn rates(element: &str, place: Trapezoids) -> [f64; 4] {
    let text = TwoMaterials::b().written().scene([Side::Dirichlet; 3], Units::ONE);
    let [coarse, fine] = [16, 32].map(|n| {
        let mesh = four_sides(trapezoids(n, place));
        let options = Options { averages: true, ..options(ScalarKind::F64, None) };
        let run = run(&with(element, &text), mesh, &options);
        let (errors, bound) = (run.errors(), run.solution.bound.expect("held"));
        [errors.h1, errors.l2, errors.flux, bound.duality_gap]
    });
    std::array::from_fn(|k| (coarse[k] / fine[k]).log2())
}

#[test]
fn trapezoids_keep_all_rates() {
    for place in [Trapezoids::InTwoRows, Trapezoids::Everywhere] {
        for (rate, limit) in rates("nonparametric", place).into_iter().zip([1.0, 2.0, 1.0, 1.0]) {
            TRAPEZOID_RATE.check(format_args!("{place:?}"), rate - limit);
        }
    }
}

/// Its span lacks a linear function in every cell: u_h tends to another function, and the bound stays up.
#[test]
fn on_trapezoids_alone_the_parametric_element_does_not_converge() {
    let [h1, _, _, bound] = rates("parametric", Trapezoids::Everywhere);
    TRAPEZOID_RATE.check("parametric, h1", h1);
    TRAPEZOID_RATE.check("parametric, bound", bound);
}

#[test]
fn on_trapezoids_the_bound_is_sharp() {
    let text = TwoMaterials::h(0.55).written().scene([Side::Dirichlet; 3], Units::ONE);
    let mesh = four_sides(trapezoids(16, Trapezoids::Everywhere));
    let run = run(&with("nonparametric", &text), mesh, &options(ScalarKind::F64, None));
    let found = run.certified().expect("held");
    SHARPNESS.check("H on trapezoids", found.bound.duality_gap / found.combined - 1.0);
    assert!(found.bound.duality_gap <= 2.0 * found.energy, "{found:?}");
}

/// On squares both elements are the same, and so is what they find.
#[test]
fn squares_know_no_difference() {
    let text = TwoMaterials::h_gap(0.55).written().scene([Side::Dirichlet; 3], Units::ONE);
    let [one, other] = ["parametric", "nonparametric"].map(|element| {
        let mesh = four_sides(grid(8, Cells::Quads));
        run(&with(element, &text), mesh, &options(ScalarKind::F64, None)).solution
    });
    SAME_ON_SQUARES.check_each("u", &one.u, &other.u);
}
