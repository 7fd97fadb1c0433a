//! All solvers over the size of the problem: the punch whose contact moves, on grids of 2n × n squares
//! of triangles, at equal error.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::benchmark::Benchmark;
use super::series::Baseline;
use super::{discretisation_error, osqp};
use crate::checkout::root;
use crate::cycles::{NARROW, REGISTERS};
use signorini_problem::{Loads, Problem};
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::{Result, Scene};

/// Squares over the height of the domain: 48 to 18 800 unknowns.
const GRIDS: [u32; 6] = [3, 4, 8, 16, 32, 56];
/// The coarsest grid of a start from coarse to fine.
const COARSEST: u32 = 2;
/// From tick to tick; the free points move by up to 0.0063.
const STEP: f64 = 0.01;
const TICKS: usize = 10;

/// The whole study.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sizes {
    pub title: String,
    /// The registers that this program was built for.
    pub registers: String,
    pub rows: Vec<Size>,
    /// Solvers that could not run and why; how long condensing takes.
    pub notes: Vec<String>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Size {
    /// Squares over the height of the domain.
    pub n: u32,
    /// Edges not on D.
    pub unknowns: usize,
    pub contact: usize,
    /// ‖A^½∇_h(u − u_h)‖ of the discrete solution in the first tick.
    pub discretisation_error: f64,
    /// The part that a solver may leave of ‖A^½∇_h(u_h − u*_h)‖, in every tick.
    pub target: f64,
    pub baselines: Vec<Baseline>,
}

/// Measures all solvers on every grid; tells `progress` in words what comes next.
pub fn sizes(mut progress: impl FnMut(&str)) -> Result<Sizes> {
    let scene = Scene::read(&root()?.join("meshes/catalogue/moving-tri.toml"))?;
    progress("building OSQP");
    let program = osqp::program();
    let mut notes: Vec<String> = program.err().map(str::to_owned).into_iter().collect();
    let mut rows = Vec::new();
    for n in GRIDS {
        progress(&format!("all solvers on {} unknowns", 6 * n * n));
        rows.push(size(&scene, n, TICKS, program.ok(), &mut notes)?);
    }
    notes.extend(NARROW.map(str::to_owned));
    Ok(Sizes { title: scene.title, registers: REGISTERS.to_owned(), rows, notes })
}

/// One grid with so many warm ticks.
pub(super) fn size(
    scene: &Scene,
    n: u32,
    ticks: usize,
    program: Option<&Path>,
    notes: &mut Vec<String>,
) -> Result<Size> {
    let problem = Problem::new(scene, grid(n, Cells::Triangles))?;
    let coarser = nested(n).into_iter().map(|n| Problem::new(scene, grid(n, Cells::Triangles)));
    let coarser: Vec<_> = coarser.collect::<Result<_>>()?;
    let at = |tick: usize| {
        let time = STEP * tick as f64;
        Loads::of(&Problem { time, ..problem.clone() })
    };
    let moments: Vec<_> = (0..=ticks).map(at).collect::<Result<_>>()?;
    let mut remarks = Vec::new();
    let discretisation_error = discretisation_error(&problem, &mut remarks)?;
    let own = Benchmark::new(&problem, &moments, discretisation_error);
    let ring = Benchmark { osqp: program, coarser: &coarser, ..own };
    let baselines = ring.hold(&mut remarks)?;
    notes.extend(remarks.into_iter().map(|remark| format!("n = {n}: {remark}")));
    let counts = problem.topology.counts;
    let (unknowns, contact) = (counts.unknowns(), counts.contact);
    let target = ring.target;
    Ok(Size { n, unknowns, contact, discretisation_error, target, baselines })
}

/// Grids that this one refines, the coarsest first.
fn nested(n: u32) -> Vec<u32> {
    let mut coarser: Vec<u32> =
        std::iter::successors(Some(n), |&n| (n % 2 == 0 && n / 2 >= COARSEST).then_some(n / 2))
            .skip(1)
            .collect();
    coarser.reverse();
    coarser
}
