//! `signorini solve`: one scene, its files.

use std::path::Path;

use clap::Args;

use super::place::Place;
use crate::engine;
use crate::error::{Error, Result};
use crate::field::CellField;
use crate::mesh::adapted;
use crate::norms::{Errors, of_solution};
use crate::output::atomic::write_atomically;
use crate::output::edges::edges_csv;
use crate::output::summary::Summary;
use crate::output::vtu::{Field, vtu};
use crate::outputs::outputs;
use crate::problem::Problem;
use crate::progress::{say, waiting};
use crate::scene::Scene;
use crate::setting::{Precision, Setting};
use crate::solve::{Options, ScalarKind, Solution, SolverKind, solve, status_name};

const EXAMPLES: &str = "\
Examples:
  signorini solve meshes/scenes/levee.toml
  signorini solve levee.toml --mesh finer.msh --solver direct --out /tmp/levee
  signorini solve levee.toml --scalar f32 --input rain=2e-8

The [setting] of a scene is followed unless --solver, --tolerance or --max-sweeps is given; of it cells, refine and
scalar hold in any case. A fixed number of warm sweeps is solved as the tick of a controller that has run.";

/// Arguments of `solve`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    place: Place,
    /// Scalar type of the kernel [default: that of the scene's setting, else f64]
    #[arg(long, value_enum)]
    scalar: Option<ScalarKind>,
    /// The kernel's projected SOR, or the host's active set on a sparse factorisation [default: kernel]
    #[arg(long, value_enum)]
    solver: Option<SolverKind>,
    /// Bound on the scaled complementarity residual [default: 1e-13 in f64, the rounding limit in f32]
    #[arg(long, value_name = "T", value_parser = tolerance, allow_negative_numbers = true)]
    tolerance: Option<f64>,
    /// Most sweeps allowed [default: 1 000 000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    max_sweeps: Option<u32>,
}

pub(super) fn tolerance(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(tolerance) if tolerance.is_finite() && tolerance >= 0.0 => Ok(tolerance),
        _ => Err("expected a finite number ≥ 0, such as 1e-9".to_owned()),
    }
}

impl Arguments {
    pub(super) fn run(self) -> Result<u8> {
        let scene = self.place.scene()?;
        let out = self.place.out()?;
        let problem = Problem::new(&scene, adapted::of_scene(&scene)?)?;
        let unknowns = problem.topology.counts.unknowns();
        let solution =
            waiting(&format!("solving {unknowns} unknowns"), || self.solved(&scene, &problem))?;
        let errors = of_solution(&scene, &problem, &solution)?;
        let declared = outputs(&scene, &problem, &solution)?;
        let summary = Summary::new(&scene, &problem, self.solver(), &solution, errors, declared);
        let files = [
            (
                "edges.csv",
                edges_csv(&problem, &solution).map_err(|error| Error::Check(error.to_string()))?,
            ),
            ("solution.vtu", picture(&problem, &solution).into_bytes()),
            ("summary.json", summary.json().into_bytes()),
        ];
        for (name, bytes) in files {
            write_atomically(&out.join(name), &bytes)?;
        }
        report(&scene, &problem, &solution, errors, &out);
        // Sweeps that a setting asks for are what was to be done.
        let asked = self.follows_setting() && scene.setting.is_some_and(|set| set.sweeps.is_some());
        Ok(if solution.converged() || asked { 0 } else { 3 })
    }

    fn solver(&self) -> SolverKind {
        self.solver.unwrap_or(SolverKind::Kernel)
    }

    /// Whether the command line leaves how to solve to the scene.
    fn follows_setting(&self) -> bool {
        self.solver.is_none() && self.tolerance.is_none() && self.max_sweeps.is_none()
    }

    /// As the scene's setting says, where it has one and nothing else was asked for.
    fn solved(&self, scene: &Scene, problem: &Problem) -> Result<Solution> {
        let own = scene.setting.and_then(|setting| setting.scalar);
        if let (Some(setting), true) = (scene.setting, self.follows_setting()) {
            let scalar = self.scalar.map(|scalar| match scalar {
                ScalarKind::F32 => Precision::F32,
                ScalarKind::F64 => Precision::F64,
            });
            let setting = Setting { scalar: scalar.or(own), ..setting };
            return engine::solve(&Scene { setting: Some(setting), ..scene.clone() }, problem);
        }
        let single = own == Some(Precision::F32) && self.solver() == SolverKind::Kernel;
        let scalar = self.scalar.unwrap_or(if single { ScalarKind::F32 } else { ScalarKind::F64 });
        let options = Options {
            scalar,
            solver: self.solver(),
            tolerance: self.tolerance,
            to_the_floor: false,
            max_sweeps: self.max_sweeps.unwrap_or(1_000_000),
        };
        solve(scene, problem, &options)
    }
}

fn picture(problem: &Problem, solution: &Solution) -> String {
    let mesh = &problem.mesh;
    let cells = 0..mesh.triangles.len() + mesh.quads.len();
    let fields: Vec<_> =
        cells.map(|cell| CellField::new(problem, cell, &solution.u, &solution.flux)).collect();
    vtu(&Field {
        vertices: &mesh.vertices,
        triangles: &mesh.triangles,
        quads: &mesh.quads,
        cell_u: &fields.iter().map(CellField::mean).collect::<Vec<_>>(),
        cell_flux: &fields.iter().map(CellField::middle_flux).collect::<Vec<_>>(),
        region: &problem.binding.materials,
        vertex_u: &solution.certified.vertices,
    })
}

fn report(
    scene: &Scene,
    problem: &Problem,
    solution: &Solution,
    errors: Option<Errors>,
    out: &Path,
) {
    let counts = problem.topology.counts;
    say(format_args!("{}", scene.title));
    say(format_args!(
        "  {} unknowns, {} of {} contact edges active",
        counts.unknowns(),
        solution.contact_active,
        counts.contact
    ));
    say(format_args!(
        "  {} after {} sweeps, scaled residual {:.1e}",
        status_name(solution.status),
        solution.sweeps,
        solution.algebraic_residual
    ));
    say(format_args!(
        "  contact force {}, contact length {}",
        solution.contact_force, solution.contact_length
    ));
    match solution.bound {
        Some(bound) => say(format_args!(
            "  error at most {:.4e} in the energy norm, {:.1e} of it by unfinished sweeps",
            bound.total, bound.algebraic
        )),
        None => say(format_args!("  no error bound: see `error_bound` in the README")),
    }
    if let Some(errors) = errors {
        say(format_args!(
            "  errors: |u − u_h|₁ {:.5e}, ‖u − u_h‖ {:.5e}, ‖σ − σ_h‖ {:.5e}",
            errors.h1, errors.l2, errors.flux
        ));
    }
    say(format_args!("  written to {}", out.display()));
}
