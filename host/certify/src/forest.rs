//! The ways out: the forest over the cells and the cells packed in its order, owned.

use signorini_bound::cells::{CellBuffers, Cells, Quad, Triangle};
use signorini_bound::certificate::{Discretization, Stability};
use signorini_bound::equilibrium::is_root;
use signorini_bound::forest::{Forest, ForestBuffers};
use signorini_bound::prepare::{Conductivities, prepare};
use signorini_kernel::Error as KernelError;
use signorini_kernel::mesh::edges::Edges;

use super::metric::Metric;
use signorini_problem::scalar::Scalar;
use signorini_problem::{Assembled, Problem};

/// Forest, packed cells, weights of means.
#[derive(Debug)]
pub struct EquilibrationForest<R> {
    order: Vec<u32>,
    parent: Vec<u32>,
    place: Vec<u32>,
    triangles: Vec<Triangle<R, u32>>,
    quads: Vec<Quad<R, u32>>,
    of_vertices: Vec<R>,
    of_edges: Vec<R>,
    stability: Stability<R>,
}

impl<R: Scalar> EquilibrationForest<R> {
    /// Memory for `problem`.
    pub fn new(problem: &Problem) -> Self {
        let (mesh, cells) = (&problem.mesh, problem.cells());
        Self {
            order: vec![0; cells],
            parent: vec![0; cells],
            place: vec![0; cells],
            triangles: vec![Triangle::EMPTY; mesh.triangles.len()],
            quads: vec![Quad::EMPTY; mesh.quads.len()],
            of_vertices: vec![R::ZERO; mesh.vertices.len()],
            of_edges: vec![R::ZERO; problem.topology.counts.edges()],
            stability: Stability::default(),
        }
    }

    /// Grows the forest from D and R and from the edges that are `also` roots, and packs the cells.
    ///
    /// # Errors
    /// A part of the domain without a root.
    pub fn find(
        &mut self,
        assembled: &Assembled<R>,
        metric: &Metric<R>,
        also: impl Fn(usize) -> bool,
    ) -> Result<(), KernelError> {
        let (edges, boundary) = (assembled.edges(), assembled.boundary()?);
        let mut numbers = vec![R::ZERO; edges.cells()];
        let buffers = ForestBuffers {
            order: &mut self.order,
            parent: &mut self.parent,
            place: &mut self.place,
            distance: &mut numbers,
        };
        let root = |edge: usize| {
            let outer = edges.half_edges()[edge][1] == u32::MAX;
            outer && (is_root(edges, &boundary, edge) || also(edge))
        };
        let cells = CellBuffers {
            triangles: &mut self.triangles,
            quads: &mut self.quads,
            of_vertices: &mut self.of_vertices,
            of_edges: &mut self.of_edges,
        };
        let (alpha, compliance) = (metric.alpha(), metric.compliance());
        let a = Conductivities { alpha, compliance, metric: metric.view() };
        let (mesh, of_edges) = (assembled.mesh()?, (edges, assembled.stiffness()));
        self.stability = prepare(&mesh, of_edges, &boundary, a, root, buffers, cells)?;
        Ok(())
    }

    /// The part of what each cell lacks of balance in a step of time that is cheaper to keep than to hand on: k|T|/(k|T| + g_T), where
    /// g_T is what the way out conducts, with all that its cells store:
    /// ```text
    ///   g_T = α_T where the way ends,   1/g_T = 1/α_T + 1/(k_P|P| + g_P) where P is the next cell on it
    /// ```
    pub fn kept(&self, edges: &Edges<u32>, metric: &Metric<R>, contents: &[f64]) -> Vec<f64> {
        let alpha: Vec<f64> = metric.alpha().iter().map(|alpha| alpha.wide()).collect();
        let mut conducted = alpha.clone();
        // Roots first.
        for cell in self.order.iter().map(|&cell| cell as usize) {
            if let Some((_, next)) = edges.beyond(self.parent[cell] as usize) {
                let beyond = contents[next] + conducted[next];
                conducted[cell] = 1.0 / (1.0 / alpha[cell] + 1.0 / beyond);
            }
        }
        let kept = contents.iter().zip(conducted);
        kept.map(|(content, conducted)| content / (content + conducted)).collect()
    }

    /// Energy that it takes to bring 1 from the farthest cell to its root.
    pub fn stability(&self) -> R {
        self.stability.largest
    }

    /// The kernel's view of it.
    ///
    /// # Errors
    /// Before [`EquilibrationForest::find`].
    pub fn discretization<'a>(
        &'a self,
        assembled: &'a Assembled<R>,
        metric: &'a Metric<R>,
    ) -> Result<Discretization<'a, R, u32>, KernelError> {
        let edges = *assembled.edges();
        let forest = Forest::new(&edges, &self.order, &self.parent, &self.place)?;
        let (triangles, quads) = (&self.triangles, &self.quads);
        Ok(Discretization {
            mesh: assembled.mesh()?,
            edges,
            stiffness: assembled.stiffness(),
            cells: Cells::new(triangles, quads, &self.of_vertices, &self.of_edges, &forest)?,
            metric: metric.view(),
            stability: self.stability,
        })
    }
}
