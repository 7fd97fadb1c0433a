//! `signorini.solve`.

use std::path::PathBuf;
use std::sync::atomic::Ordering;

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use signorini_files::answer::Answer;
use signorini_files::contact::{opening, state, written};
use signorini_files::fields::Drawn;
use signorini_intervals::Coverage;
use signorini_problem::{EdgeKind, Problem};
use signorini_scene::error::{Error, Result};
use signorini_scene::scene::term::at_rest_warning;
use signorini_session::request::SolveRequest;
use signorini_solve::Solution;
use signorini_solve::adaptive::{MOST_UNKNOWNS, Wanted, refined_until};
use signorini_solve::energy_norm;

use crate::arrays::Filled;
use crate::error::raised;
use crate::posed::{GivenScene, PosedScene};
use crate::words;
use crate::work::{GivenUp, work};

/// How to solve.
#[derive(FromPyObject)]
pub struct How {
    scalar: Option<String>,
    solver: Option<String>,
    tolerance: Option<f64>,
    max_sweeps: Option<u32>,
    max_error: Option<String>,
    max_unknowns: Option<usize>,
    intervals: Option<bool>,
}

/// Solves a scene; writes its files where a folder is given. What is found, by name.
#[pyfunction]
pub fn solve<'py>(
    py: Python<'py>,
    scene: GivenScene,
    how: How,
    out: Option<PathBuf>,
) -> PyResult<Bound<'py, PyDict>> {
    let asked = how.asked()?;
    let goal = how
        .max_error
        .as_deref()
        .map(str::parse)
        .transpose()
        .map_err(|why| PyValueError::new_err(format!("max_error: {why}")))?;
    let most_unknowns = how.max_unknowns.unwrap_or(MOST_UNKNOWNS);
    let intervals = how.intervals();
    let is_file = scene.is_file();
    let found = work(py, move |given_up| {
        let posed = scene.read()?;
        let answer = match goal {
            None => on_its_mesh(&posed, &asked, intervals),
            Some(goal) => {
                let options = asked.options(posed.scene.setting.and_then(|setting| setting.scalar));
                let wanted = Wanted { goal, most_unknowns, options };
                refined(&posed, &wanted, (&asked, intervals), given_up)
            }
        }?;
        out.map(|out| answer.write(&out)).transpose()?;
        let told = Told::new(&answer)?;
        Ok((answer, told, posed.origins))
    })?;
    let (answer, told, origins) = found.map_err(|error: Error| raised(py, error, is_file))?;
    dictionary(py, answer, told, origins)
}

impl How {
    fn asked(&self) -> PyResult<SolveRequest> {
        let scalar = words::scalar(self.scalar.as_deref())?;
        let solver = words::solver(self.solver.as_deref())?;
        let refined = self.max_error.is_some();
        Ok(SolveRequest {
            scalar,
            solver,
            tolerance: self.tolerance,
            max_sweeps: self.max_sweeps,
            refined,
        })
    }

    fn intervals(&self) -> Coverage {
        match self.intervals {
            None => Coverage::Usual,
            Some(true) => Coverage::All,
            Some(false) => Coverage::None,
        }
    }
}

fn on_its_mesh(posed: &PosedScene, asked: &SolveRequest, intervals: Coverage) -> Result<Answer> {
    let mut problem = posed.problem()?;
    problem.warnings.extend(at_rest_warning(&posed.scene));
    let solution = asked.solve(&problem)?;
    let energy_norm = energy_norm::of_solution(&problem, &solution)?;
    Answer::new(problem, solution, energy_norm, asked.solver.unwrap_or_default(), intervals, None)
}

fn refined(
    posed: &PosedScene,
    wanted: &Wanted,
    (asked, intervals): (&SolveRequest, Coverage),
    given_up: &GivenUp,
) -> Result<Answer> {
    let go_on = |_: &_| Ok(!given_up.load(Ordering::Relaxed));
    let setting = posed.scene.setting.unwrap_or_default();
    let mesh =
        signorini_scene::mesh::adapted::adapted(posed.own_mesh()?, setting.cells, setting.refine)?;
    let (level, stop) = refined_until(&posed.scene, mesh, wanted, go_on)?;
    let mut problem = level.problem;
    problem.warnings.extend(at_rest_warning(&posed.scene));
    let why = stop.why(&level.solution);
    let solver = asked.solver.unwrap_or_default();
    Answer::new(problem, level.solution, level.energy_norm, solver, intervals, why)
}

/// What takes long to work out, and no interpreter.
struct Told {
    summary: String,
    cell_u: Vec<f64>,
    cell_flux: Vec<[f64; 2]>,
    indicators: Vec<f64>,
}

impl Told {
    fn new(answer: &Answer) -> Result<Self> {
        let Answer { problem, solution, .. } = answer;
        let drawn = Drawn::of(problem, solution)?;
        let (cell_u, cell_flux) = drawn.in_cells(problem);
        let indicators = drawn.indicators().to_vec();
        Ok(Self { summary: answer.summary().json(), cell_u, cell_flux, indicators })
    }
}

fn dictionary<'py>(
    py: Python<'py>,
    answer: Answer,
    told: Told,
    origins: Vec<u32>,
) -> PyResult<Bound<'py, PyDict>> {
    let Answer { problem, solution, energy_norm, .. } = answer;
    let all = Filled::new(py);
    let edges = Filled::new(py);
    let names: Vec<_> = problem.scene.boundaries.iter().map(|of| of.name.value.clone()).collect();
    let materials: Vec<_> =
        problem.scene.materials.iter().map(|of| of.name.value.clone()).collect();
    edge_columns(&edges, &problem)?;
    all.set("contact", contact_columns(py, &problem, &solution)?.0)?;
    all.set("edges", edges.0)?;
    all.set("boundaries", names)?;
    all.set("materials", materials)?;
    all.set("bound", solution.bound.map(|bound| bound.total))?;
    all.set("relative_bound", solution.relative_bound(energy_norm))?;
    all.set("converged", solution.converged())?;
    all.set("summary", told.summary)?;
    let flux =
        solution.flux.iter().zip(problem.lengths.iter()).map(|(flux, length)| flux / length + 0.0);
    all.numbers("flux", flux.collect())?;
    all.numbers("u", solution.u)?;
    all.numbers("vertex_u", solution.certified.vertices)?;
    all.numbers("cell_u", told.cell_u)?;
    all.rows("cell_flux", told.cell_flux)?;
    all.numbers("indicators", told.indicators)?;
    all.numbers("origins", origins)?;
    all.numbers("materials_of_cells", problem.binding.materials.to_vec())?;
    // The mesh is the problem's alone by now, unless something else still reads it.
    let mesh = std::sync::Arc::unwrap_or_clone(problem.mesh);
    all.rows("points", mesh.vertices)?;
    all.rows("triangles", mesh.triangles)?;
    all.rows("quads", mesh.quads)?;
    Ok(all.0)
}

/// Ends, kind, boundary and cells of each edge, in the order of `edges.csv`.
fn edge_columns(edges: &Filled, problem: &Problem) -> PyResult<()> {
    let count = problem.ends.len();
    let ends =
        (0..count).map(|edge| problem.segment(edge).as_flattened().try_into().unwrap_or([0.0; 4]));
    edges.rows::<f64, 4>("ends", ends.collect())?;
    edges.rows::<u32, 2>("vertices", problem.ends.to_vec())?;
    let kinds: Vec<&str> = problem.kinds.iter().map(|kind| kind.name()).collect();
    edges.set("kind", kinds)?;
    let boundary = (0..count).map(|edge| match problem.kinds[edge] {
        EdgeKind::Interior => -1,
        _ => problem.binding.boundary(problem.ends[edge]).map_or(-1, |at| at as i64),
    });
    edges.numbers("boundary", boundary.collect())?;
    let number = |cell: Option<usize>| cell.map_or(-1, |at| at as i64);
    let cells = (0..count).map(|edge| problem.topology.cells_of(edge).map(number));
    edges.rows("cells", cells.collect())
}

/// λ, gap, state and the ends of the flux on contact edges.
fn contact_columns<'py>(
    py: Python<'py>,
    problem: &Problem,
    solution: &Solution,
) -> PyResult<Filled<'py>> {
    let columns = Filled::new(py);
    let counts = problem.topology.counts;
    let edges = counts.free..counts.free + counts.contact;
    let all = || 0..counts.contact;
    let length = |at: usize| problem.lengths[counts.free + at];
    let gap = |at: usize| opening(problem, solution, at);
    let state = |at: usize| written(state(problem, solution, at)).1;
    let end = |at: usize, which: usize| problem.loads.flux_range(at).ends()[which] / length(at);
    columns.numbers("edge", edges.map(|edge| edge as i64).collect())?;
    columns.numbers("lambda", all().map(|at| solution.multiplier(problem, at) + 0.0).collect())?;
    columns.numbers("gap", all().map(gap).collect())?;
    columns.numbers("psi", all().map(|at| solution.gap(problem, at)).collect())?;
    columns.numbers("q", all().map(|at| end(at, 0)).collect())?;
    columns.numbers("limit", all().map(|at| end(at, 1)).collect())?;
    columns.numbers("state", all().map(state).collect())?;
    Ok(columns)
}
