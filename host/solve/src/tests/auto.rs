//! The choices of `auto`, and that its answers are the kernel's.

use super::{distance, read, standard_scenes};
use crate::auto::by_factor;
use crate::{Options, Ran, ScalarKind, Solution, SolverKind, solve};
use signorini_problem::Parts;
use signorini_problem::fixtures::{SMOOTH, on_grid};
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tolerances::Tolerance;
use signorini_tolerances::solve::{
    AGREEMENT, BOUND_OF_FACTOR, BOUND_OF_FACTOR_NARROW, FACTOR_NARROW,
};

const AUTO: Options = Options {
    scalar: ScalarKind::F64,
    solver: SolverKind::Auto,
    tolerance: None,
    to_the_floor: false,
    max_sweeps: 1_000_000,
    averages: false,
};

/// A domain that nothing holds, in balance.
const LOOSE: &str = r#"
mesh = "grid"
material.default.conductivity = "1"
source.f = "x"
boundary.default = { kind = "neumann", flux = "0" }
"#;

/// Asserts one answer: converged, equal active edges, u and bound.
fn same(name: &str, found: &Solution, kernel: &Solution, allowed: [Tolerance; 2]) {
    assert!(found.converged() && kernel.converged(), "{name}: {:?}", found.status);
    assert_eq!(found.contact_active, kernel.contact_active, "{name}");
    let far = distance(&found.u, &kernel.u);
    allowed[0].check(name, far);
    assert_eq!(found.bound.is_some(), kernel.bound.is_some(), "{name}");
    if let Some((bound, of_kernel)) = found.bound.zip(kernel.bound) {
        let more = (bound.total - of_kernel.total).max(0.0);
        let size =
            of_kernel.total.max(1e-12 * kernel.u.iter().fold(1.0, |a: f64, u| a.max(u.abs())));
        allowed[1].check_over(name, more, size);
    }
}

#[test]
fn the_factor_alone_answers_like_the_kernel_on_every_standard_scene() -> Result<()> {
    for path in standard_scenes() {
        let (_, problem) = read(&path)?;
        let name = path.file_stem().unwrap().to_string_lossy();
        let parts = Parts::examine(&problem)?;
        let kernel = solve(&problem, &Options::default())?;
        let found = by_factor::<f64>(&problem, &parts, &AUTO, &[], None)?.expect("a factor");
        same(&name, &found, &kernel, [AGREEMENT, BOUND_OF_FACTOR]);
        let single = Options { scalar: ScalarKind::F32, ..AUTO };
        let found = by_factor::<f32>(&problem, &parts, &single, &[], None)?.expect("a factor");
        assert!(found.converged() && found.ran == Ran::Factor, "{name}");
        let far = distance(&found.u, &kernel.u);
        FACTOR_NARROW.check(&name, far);
        let chosen = solve(&problem, &AUTO)?;
        same(&name, &chosen, &kernel, [AGREEMENT, BOUND_OF_FACTOR]);
    }
    Ok(())
}

#[test]
fn small_meshes_are_swept_and_large_ones_factored() -> Result<()> {
    for (cells, scalar) in [
        (Cells::Triangles, ScalarKind::F64),
        (Cells::Quads, ScalarKind::F64),
        (Cells::Mixed, ScalarKind::F32),
    ] {
        let auto = Options { scalar, ..AUTO };
        let (_, problem) = on_grid(SMOOTH, grid(8, cells))?;
        let small = solve(&problem, &auto)?;
        assert_eq!((small.ran, small.factored), (Ran::Sweeps, None));
        let (_, problem) = on_grid(SMOOTH, grid(40, cells))?;
        let large = solve(&problem, &auto)?;
        let factored = large.factored.expect("a factor");
        assert_eq!((large.ran, large.sweeps), (Ran::Factor, 0), "{cells:?}");
        assert!(factored.entries > problem.topology.counts.unknowns());
        assert!(large.ending().contains("by elimination"), "{}", large.ending());
        assert!(!large.ending().contains("sweeps"), "{}", large.ending());
        let kernel = solve(&problem, &Options { scalar, ..Options::default() })?;
        let of_u = if scalar == ScalarKind::F64 { AGREEMENT } else { FACTOR_NARROW };
        same("large", &large, &kernel, [of_u, BOUND_OF_FACTOR_NARROW]);
    }
    Ok(())
}

#[test]
fn what_nothing_holds_goes_to_the_direct_solver() -> Result<()> {
    let (_, problem) = on_grid(LOOSE, grid(40, Cells::Triangles))?;
    let found = solve(&problem, &AUTO)?;
    assert_eq!((found.ran, found.sweeps), (Ran::Direct, 0));
    let direct = solve(&problem, &Options { solver: SolverKind::Direct, ..AUTO })?;
    assert_eq!(distance(&found.u, &direct.u), 0.0);
    let single = solve(&problem, &Options { scalar: ScalarKind::F32, ..AUTO })?;
    assert!(single.converged() && single.ran == Ran::Sweeps, "{}", single.ending());
    Ok(())
}

#[test]
fn the_direct_solver_has_steps_and_tells_a_tolerance_that_it_misses() -> Result<()> {
    let (_, problem) = on_grid(SMOOTH, grid(8, Cells::Triangles))?;
    let with = |tolerance| Options { solver: SolverKind::Direct, tolerance, ..AUTO };
    let found = solve(&problem, &with(None))?;
    assert_eq!((found.ran, found.sweeps), (Ran::Direct, 0));
    assert!(found.ending().contains("active-set steps") && !found.ending().contains("sweeps"));
    assert!(found.factored.expect("a factor").exchanges > 0);
    let met = solve(&problem, &with(Some(1e-9)))?;
    assert!(met.ending().starts_with("converged"), "{}", met.ending());
    let missed = solve(&problem, &with(Some(1e-30)))?;
    assert!(missed.ending().starts_with("rounding-limit"), "{}", missed.ending());
    Ok(())
}
