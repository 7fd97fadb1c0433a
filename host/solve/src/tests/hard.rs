//! Problems on which sweeps alone fail, or the scalar.

use super::{distance, meshes, read};
use crate::{Options, ScalarKind, SolverKind, solve};
use signorini_problem::Problem;
use signorini_scene::error::Result;
use signorini_scene::expression::{Expression, Variables};
use signorini_scene::scene::Scene;
use signorini_scene::scene::units::Units;
use signorini_tolerances::solve::{HARD, HARD_BOUND};

/// A catalogue scene with another A; its boundary data stay what they are.
fn with_tensor(name: &str, tensor: [f64; 3]) -> Result<(Scene, Problem)> {
    let (mut scene, problem) = read(&meshes("catalogue").join(name))?;
    for (entry, value) in scene.materials[0].conductivity.iter_mut().zip(tensor) {
        entry.value = Expression::parse(&format!("{value:e}"), Variables::Space).unwrap();
    }
    let problem = Problem::new(&scene, problem.mesh)?;
    Ok((scene, problem))
}

#[test]
fn the_factor_takes_over_where_sweeps_do_not_end() -> Result<()> {
    // Condition 10⁸; and one on which the edges that touch are not the ones that sweeps left.
    for tensor in [[1e4 + 1.0, 1e2, 1.0], [9000.001, 3000.0, 1000.0]] {
        let (_, problem) = with_tensor("t-h-tri.toml", tensor)?;
        let found = solve(&problem, &Options::default())?;
        let reference = solve(&problem, &Options::by(SolverKind::Direct))?;
        let what = format!("{tensor:?}: {:?}, {:?}", found.status, found.factored);
        assert!(found.converged() && found.sweeps == 10_000, "{what}");
        let factored = found.factored.expect("a factor");
        assert!(factored.entries > problem.topology.counts.unknowns() && factored.rounds >= 2);
        let far = distance(&found.u, &reference.u);
        HARD.check(format_args!("{tensor:?}"), far);
        assert_eq!(found.contact_active, reference.contact_active);
        let [bound, best] = [&found, &reference].map(|of| of.bound.expect("a bound").total);
        HARD_BOUND.check_relative(format_args!("{tensor:?}"), bound, best);
    }
    Ok(())
}

#[test]
fn where_sweeps_end_there_is_no_factor() -> Result<()> {
    let (_, problem) = read(&meshes("catalogue").join("t-h-tri.toml"))?;
    assert_eq!(solve(&problem, &Options::default())?.factored, None);
    let few = Options { max_sweeps: Some(20), ..Options::default() };
    let cut = solve(&problem, &few)?;
    assert!(!cut.converged() && cut.sweeps == 20 && cut.factored.is_none());
    Ok(())
}

#[test]
fn other_units_change_no_digit() -> Result<()> {
    for (name, scalar) in [
        ("ag-mixed", ScalarKind::F64),
        ("ag-mixed", ScalarKind::F32),
        ("j100-tri", ScalarKind::F32),
    ] {
        let (scene, problem) = read(&meshes("catalogue").join(name).with_extension("toml"))?;
        let options = Options { scalar, ..Options::default() };
        let plain = solve(&problem, &options)?;
        assert_eq!(plain.units, Units::default());
        // Loads of 1e−150 and a conductivity of 1e90: nothing that f32 could hold.
        let far = Units { u: 2f64.powi(-500), conductivity: 2f64.powi(300), zero: 0.0 };
        let scaled = far.inverse().scene(&scene);
        let found = solve(&Problem::new(&scaled, problem.mesh.clone())?, &options)?;
        let expected: Vec<f64> = plain.u.iter().map(|u| u * far.u).collect();
        assert_eq!(found.u, expected, "{name}");
        assert_eq!(found.contact_force, plain.contact_force * far.flux(), "{name}");
        let [bound, expected] = [&found, &plain].map(|of| of.bound.expect("a bound").total);
        assert_eq!(bound, expected * far.energy(), "{name}");
        assert!(found.units.u > 2f64.powi(-520) && found.units.u < 2f64.powi(-480));
    }
    Ok(())
}

#[test]
fn energies_beyond_f64_are_refused() -> Result<()> {
    let (scene, problem) = read(&meshes("catalogue").join("a-tri.toml"))?;
    let huge = Units { u: 2f64.powi(-600), conductivity: 1.0, zero: 0.0 }.scene(&scene);
    let problem = Problem::new(&huge, problem.mesh)?;
    let error = solve(&problem, &Options::default()).unwrap_err();
    assert!(error.to_string().contains("energy that f64 cannot hold"), "{error}");
    Ok(())
}

#[test]
fn f32_refuses_a_tensor_that_it_cannot_tell_from_a_singular_one() -> Result<()> {
    let f32 = Options { scalar: ScalarKind::F32, ..Options::default() };
    for name in ["t-h-tri.toml", "h-quad.toml"] {
        let (_, problem) = with_tensor(name, [9000.001, 3000.0, 1000.0])?;
        let error = solve(&problem, &f32).unwrap_err();
        assert!(error.to_string().contains("too oblique"), "{name}: {error}");
        assert!(solve(&problem, &Options::default()).is_ok(), "{name}");
        // Anisotropy along the cells' own axes is no obstacle.
        let (_, problem) = with_tensor(name, [1e6, 0.0, 1e-6])?;
        assert!(solve(&problem, &f32).is_ok(), "{name}");
    }
    Ok(())
}
