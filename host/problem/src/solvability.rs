//! Whether a problem has a solution, part by part, before any sweep is spent on it.

use signorini_kernel::mesh::components::{Part, PartCounts, Support, examine};
use signorini_kernel::mesh::edges::{Edges, Side};

use super::balance::Balance;
use super::{Loads, Problem};
use signorini_scene::error::{InputError, Result};

/// Loads whose sum is this small against their sizes are in balance: what quadrature leaves.
pub const BALANCE: f64 = 1e-9;

/// The connected parts of a problem that has a solution.
#[derive(Debug, Clone)]
pub struct Parts {
    /// How many there are of each kind.
    pub counts: PartCounts,
    cells: Vec<Part<f64, u32>>,
    triangles: usize,
}

impl Parts {
    /// Finds the connected parts of `problem`.
    ///
    /// # Errors
    /// A part without a solution, or with more than one where contact could decide, named by a
    /// point in it.
    pub fn examine(problem: &Problem) -> Result<Self> {
        let triangles = problem.mesh.triangles.len();
        let mut cells = vec![Part::default(); triangles + problem.mesh.quads.len()];
        let counts = Self::counts(problem, &mut cells);
        let counts = counts.map_err(|error| refused(problem, &cells, error))?;
        Ok(Self { counts, cells, triangles })
    }

    /// Parts where every transfer coefficient is the least that inputs make it, and loads are such that each part has a
    /// solution: what holds the parts whatever the inputs. Without such inputs, those of `problem` as it stands.
    ///
    /// # Errors
    /// As for [`Parts::examine`] without such inputs; data that are not finite.
    pub fn whatever_inputs(problem: &Problem) -> Result<Self> {
        if problem.scene.transfer_input().is_none() {
            return Self::examine(problem);
        }
        let mut least = problem.at_least_transfer()?;
        least.loads = Loads {
            neumann: Vec::new(),
            contact_flux: vec![-1.0; least.topology.counts.contact],
            spans: Vec::new(),
            triangles: Vec::new(),
            quads: Vec::new(),
            ..least.loads
        };
        least.loads.robin.iter_mut().for_each(|law| law.ambient = 0.0);
        Self::examine(&least)
    }

    fn counts(
        problem: &Problem,
        cells: &mut [Part<f64, u32>],
    ) -> std::result::Result<PartCounts, signorini_kernel::Error> {
        let (edges, loads) = (problem.topology.edges()?, &problem.loads);
        let mut load = vec![0.0; edges.counts().unknowns()];
        loads.fill(&edges, &mut load)?;
        let given = (&load[..], loads.law().spans());
        examine(&edges, loads.diagonal(&edges)?, given, BALANCE, cells)
    }

    /// The part that an edge belongs to, by the number of a cell in it.
    pub fn of_edge(&self, edges: &Edges<u32>, edge: usize) -> usize {
        let cell = match edges.first_side(edge) {
            Side::Triangle(at, _) => at,
            Side::Quad(at, _) => self.triangles + at,
        };
        self.of_cell(cell)
    }

    /// The part that a cell belongs to, by the number of a cell in it.
    pub fn of_cell(&self, cell: usize) -> usize {
        self.cells[cell].root as usize
    }

    /// One cell of each part, by which the part is numbered.
    pub fn roots(&self) -> impl Iterator<Item = usize> {
        (0..self.cells.len()).filter(|&cell| self.of_cell(cell) == cell)
    }

    /// Support of a part.
    pub fn support(&self, part: usize) -> Support {
        self.cells[part].support
    }
}

/// The sentence for parts that nothing holds, if there are any and their loads balance.
pub(super) fn floating(problem: &Problem) -> Option<String> {
    let parts = Parts::examine(problem).ok()?;
    let first =
        (0..problem.cells()).find(|&cell| parts.support(parts.of_cell(cell)) == Support::None)?;
    let more = match parts.counts.floating {
        0 | 1 => String::new(),
        count => format!(", nor {} more", count - 1),
    };
    Some(format!(
        "no Dirichlet, Robin or contact boundary holds {}{more}: u is determined up to a constant there",
        near(problem, first)
    ))
}

/// The part of a cell in words.
fn near(problem: &Problem, cell: usize) -> String {
    let [x, y] = problem.mesh.vertices[problem.vertices_of(cell)[0] as usize];
    format!("the connected part of the mesh around ({x}, {y})")
}

fn refused(
    problem: &Problem,
    cells: &[Part<f64, u32>],
    error: signorini_kernel::Error,
) -> InputError {
    use signorini_kernel::Error as E;
    let (message, hint) = match error {
        E::NoSolution { cell } => {
            let (near, balance) = (near(problem, cell), Balance::of(problem, cells, cell));
            let words = balance.words();
            let message = format!("no solution: nothing holds {near} against its loads. {words}");
            (message, balance.hint())
        }
        E::NotUnique { cell } => {
            let (near, balance) = (near(problem, cell), Balance::of(problem, cells, cell));
            let message = format!(
                "no unique solution: the loads on {near} balance by themselves (their sum is at most {BALANCE:e} of the \
                 sum of their sizes, edge by edge). {}",
                balance.words()
            );
            (message, balance.hint())
        }
        other => (other.to_string(), "see the numbers of the scene"),
    };
    let refused = InputError::new(format!("boundary: {message}")).file(&problem.scene.path);
    refused.hint(hint).because(error)
}
