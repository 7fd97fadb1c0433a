//! Multigrid against the direct solver, on every kind of problem; its iterations.

use std::path::Path;

use signorini_tolerances::solve::{MULTIGRID, MULTIGRID_NARROW};
use signorini_tolerances::some;

use super::{LOOSE, Options, SolverKind, distance, meshes, read, solve, standard_scenes};
use crate::{Ran, ScalarKind, Solution};
use signorini_problem::Problem;
use signorini_problem::fixtures::{SMOOTH, changed, on_grid, scene};
use signorini_scene::error::Result;
use signorini_scene::mesh::Mesh;
use signorini_scene::mesh::adaptive::refined;
use signorini_scene::mesh::structured::{Cells, grid};

/// The answer, which is the direct solver's; by itself where that is `expected`.
fn agrees(what: &str, problem: &Problem, expected: bool) -> Result<Solution> {
    let reference = solve(problem, &Options::by(SolverKind::Direct))?;
    let found = solve(problem, &Options::by(SolverKind::Multigrid))?;
    let given_up = found.given_up.as_deref().unwrap_or_default();
    assert!(found.converged(), "{what}: {}", found.ending());
    MULTIGRID.check(what, distance(&found.u, &reference.u));
    assert_eq!(found.contact_active, reference.contact_active, "{what}");
    let ran = if given_up.is_empty() { Ran::Multigrid } else { Ran::Direct };
    assert_eq!(found.ran, ran, "{what}");
    assert!(!expected || given_up.is_empty(), "{what}: {given_up}");
    Ok(found)
}

fn finer(problem: &Problem) -> Result<Problem> {
    Problem::new(&problem.scene, refined(&problem.mesh)?)
}

#[test]
fn every_standard_scene_at_two_refinements() -> Result<()> {
    let limits = ["l-quad", "l-tri"].map(|name| meshes("limits").join(name).with_extension("toml"));
    for path in some(3, standard_scenes().chain(limits)) {
        let name = path.file_stem().unwrap().to_string_lossy();
        let (_, problem) = read(&path)?;
        agrees(&name, &problem, true)?;
        agrees(&name, &finer(&problem)?, true)?;
    }
    Ok(())
}

/// Jumps, anisotropy and thin cells: multigrid or, with its reason, the direct solver.
#[test]
fn hard_problems_have_an_answer() -> Result<()> {
    let plain = "conductivity = [\"2\", \"0.5\", \"1\"]";
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        for tensor in [
            "conductivity = \"1 + 0.5e8*(1 + sign(x))\"",
            "conductivity = \"1 + 0.5e8*(1 + sign(x*(y - 0.5)))\"",
            "conductivity = [\"1000\", \"0\", \"1\"]",
            "conductivity = [\"1\", \"0\", \"1000\"]",
            "conductivity = [\"501\", \"499\", \"501\"]",
        ] {
            let (_, problem) = on_grid(&changed(SMOOTH, &[(plain, tensor)]), grid(16, cells))?;
            agrees(tensor, &problem, false)?;
        }
        let mut thin = grid(16, cells);
        thin.vertices.iter_mut().for_each(|[_, y]| *y *= 1e-3);
        agrees("slivers", &on_grid(SMOOTH, thin)?.1, false)?;
    }
    Ok(())
}

/// In f32 the matrix is that of the kernel, and u has a low part: the answer is that of the kernel's factor.
#[test]
fn single_precision_has_the_digits_of_the_factor() -> Result<()> {
    for name in
        ["catalogue/h-tri.toml", "catalogue/a-quad.toml", "scenes/levee.toml", "limits/l-tri.toml"]
    {
        let (_, problem) = read(&meshes(name))?;
        let single = |solver| Options { scalar: ScalarKind::F32, ..Options::by(solver) };
        let factor = solve(&problem, &single(SolverKind::Factor))?;
        let found = solve(&problem, &single(SolverKind::Multigrid))?;
        assert!(found.converged() && found.ran == Ran::Multigrid, "{name}: {}", found.ending());
        assert_eq!(found.contact_active, factor.contact_active, "{name}");
        MULTIGRID_NARROW.check(name, distance(&found.u, &factor.u));
        MULTIGRID_NARROW.check(name, distance(&found.flux, &factor.flux));
    }
    Ok(())
}

/// Nothing holds the domain: it has a solution up to a constant.
#[test]
fn a_loose_domain_is_centred_as_ever() -> Result<()> {
    agrees("loose", &on_grid(LOOSE, grid(12, Cells::Triangles))?.1, true)?;
    Ok(())
}

/// For one active set, as many as the issue of linear cost allows for.
#[test]
fn iterations_stay_where_they_are() -> Result<()> {
    let firmware = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/firmware/scenes");
    for (path, most) in [
        (meshes("catalogue/h-tri.toml"), 20),
        (meshes("catalogue/h-quad.toml"), 20),
        (meshes("scenes/levee.toml"), 25),
        (meshes("scenes/slab.toml"), 20),
        (firmware.join("dam.toml"), 45),
    ] {
        let (_, mut problem) = read(&path)?;
        for _ in 0..2 {
            problem = finer(&problem)?;
            let found = solve(&problem, &Options::by(SolverKind::Multigrid))?;
            let work = found.multigrid.expect("multigrid");
            assert!(work.longest <= most, "{}: {work:?}", path.display());
            assert!(found.ending().contains("by multigrid, "), "{}", found.ending());
        }
    }
    Ok(())
}

/// On the mesh itself, which is a refined one, and with a vertex moved by so little that it is none.
#[test]
fn a_coarser_mesh_has_found_most_of_the_active_set() -> Result<()> {
    for path in [meshes("scenes/levee.toml"), meshes("scenes/slab.toml")] {
        let (_, problem) = read(&path)?;
        let nested = finer(&finer(&problem)?)?;
        let mut mesh = Mesh::clone(&nested.mesh);
        mesh.vertices.last_mut().expect("a vertex")[0] += 1e-12;
        let cold = Problem::new(&nested.scene, mesh)?;
        let sets = |problem| -> Result<usize> {
            Ok(agrees("nested", problem, true)?.multigrid.expect("multigrid").sets)
        };
        let [nested, cold] = [sets(&nested)?, sets(&cold)?];
        assert!(2 * nested <= cold, "{}: {nested} sets, {cold} without", path.display());
    }
    Ok(())
}

/// On one triangle that contact alone holds: the lower side is at its limit, the left one at its least flux, the third one on its gap. Every guess of
/// sides has a solution at once, and the next one is another guess.
#[test]
fn where_sides_go_round_in_circles_the_kernel_answers() -> Result<()> {
    let text = "
mesh = \"grid\"
material.default.conductivity = \"1\"
boundary.default = { kind = \"contact\", gap = \"5*x - 7*y\", flux = \"-1\", limit = \"1\" }
";
    let mesh = Mesh {
        vertices: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
        triangles: vec![[0, 1, 2]],
        ..Mesh::default()
    };
    let problem = Problem::new(&scene(text)?, mesh)?;
    let known = solve(&problem, &Options::by(SolverKind::Kernel))?;
    for solver in [SolverKind::Direct, SolverKind::Multigrid] {
        let found = solve(&problem, &Options::by(solver))?;
        assert!(found.converged(), "{solver:?}: {}", found.ending());
        let given_up = found.given_up.as_deref().unwrap_or_default();
        assert!(given_up.contains("the kernel took over"), "{solver:?}: {given_up}");
        MULTIGRID.check(format_args!("{solver:?}"), distance(&found.u, &known.u));
    }
    Ok(())
}
