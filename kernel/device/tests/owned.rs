//! Owned memory of what bounds and ticks borrow.

use signorini_bound::cells::{CellBuffers, Cells, Quad, Triangle, pack};
use signorini_bound::certificate::{Discretization, Metric, POINTS, Stability, stability};
use signorini_bound::forest::{Forest, ForestBuffers, grow};
use signorini_device::full::{self, DataMemory, HandedOn, Past};
use signorini_device::tick::{Memory, Progress};
use signorini_kernel::mesh::Mesh;
use signorini_kernel::mesh::boundary::Boundary;
use signorini_kernel::mesh::edges::Edges;
use signorini_kernel::rows::{QUADS, Row, Rows};
use signorini_kernel::stiffness::Stiffness;
use signorini_kernel::{Error, Real, Tensor};

/// Ways out of the cells, and the cells packed along them.
#[derive(Clone)]
pub struct Packed<R> {
    /// Order, parents, places.
    pub ways: [Vec<u16>; 3],
    pub triangles: Vec<Triangle<R, u16>>,
    pub quads: Vec<Quad<R, u16>>,
    /// Of vertices and of edges.
    pub weights: [Vec<R>; 2],
}

impl<R: Real> Packed<R> {
    /// With ½ tr A of the cells or nothing, and 1/(4 det A) of the triangles; the way through a cell has a cost.
    pub fn new(
        (mesh, edges): (&Mesh<R, u16>, &Edges<u16>),
        stiffness: Stiffness<R>,
        [alpha, compliance]: [&[R]; 2],
        cost: impl Fn(usize) -> R,
        is_root: impl Fn(usize) -> bool,
    ) -> Result<Self, Error> {
        let mut ways = [(); 3].map(|()| vec![u16::MAX; edges.cells()]);
        let [order, parent, place] = &mut ways;
        let mut distance = vec![R::ZERO; edges.cells()];
        let buffers = ForestBuffers { order, parent, place, distance: &mut distance };
        let forest = grow(edges, cost, is_root, buffers)?;
        let mut triangles = vec![Triangle::EMPTY; mesh.triangles().len()];
        let mut quads = vec![Quad::EMPTY; mesh.quads().len()];
        let mut weights =
            [mesh.vertices().len(), edges.counts().edges()].map(|length| vec![R::ONE; length]);
        let [of_vertices, of_edges] = &mut weights;
        let buffers =
            CellBuffers { triangles: &mut triangles, quads: &mut quads, of_vertices, of_edges };
        pack(mesh, edges, stiffness, alpha, compliance, &forest, buffers)?;
        Ok(Self { ways, triangles, quads, weights })
    }

    fn forest(&self, edges: &Edges<u16>) -> Result<Forest<'_, u16>, Error> {
        let [order, parent, place] = &self.ways;
        Forest::new(edges, order, parent, place)
    }

    pub fn cells(&self, edges: &Edges<u16>) -> Result<Cells<'_, R, u16>, Error> {
        let [of_vertices, of_edges] = &self.weights;
        let forest = self.forest(edges)?;
        Cells::new(&self.triangles, &self.quads, of_vertices, of_edges, &forest)
    }

    pub fn stability(
        &self,
        edges: &Edges<u16>,
        metric: Metric<R>,
        boundary: &Boundary<R, u16>,
    ) -> Result<Stability<R>, Error> {
        let way = &mut vec![R::ZERO; edges.cells()];
        stability(edges, &self.cells(edges)?, metric, boundary, &self.forest(edges)?, way)
    }
}

/// A at points of cells, and which of these a cell has.
pub type Points<R> = (Vec<[Tensor<R>; POINTS * POINTS]>, Vec<u32>);

/// All that a certificate stands on besides the matrix: packed cells, A at points, the cost of surplus.
#[derive(Clone)]
pub struct Ground<R> {
    pub packed: Packed<R>,
    points: Points<R>,
    pub stability: Stability<R>,
}

impl<R: Real> Ground<R> {
    pub fn new(
        packed: Packed<R>,
        points: Points<R>,
        edges: &Edges<u16>,
        boundary: &Boundary<R, u16>,
    ) -> Result<Self, Error> {
        let metric = Metric { at_points: &points.0, place: &points.1, ..Metric::default() };
        let stability = packed.stability(edges, metric, boundary)?;
        Ok(Self { packed, points, stability })
    }

    /// The view that the kernel takes.
    pub fn discretization<'a>(
        &'a self,
        mesh: Mesh<'a, R, u16>,
        edges: Edges<'a, u16>,
        stiffness: Stiffness<'a, R>,
    ) -> Result<Discretization<'a, R, u16>, Error> {
        let Self { packed, points: (at_points, place), stability } = self;
        let metric = Metric { at_points, place, ..Metric::default() };
        let cells = packed.cells(&edges)?;
        Ok(Discretization { mesh, edges, stiffness, cells, metric, stability: *stability })
    }
}

/// Arrays of a tick: nothing is in contact, and all is 0.
pub struct TickArrays<R> {
    rows: Vec<Row<R, u16, QUADS>>,
    pub active: Vec<bool>,
    /// load, s, bubbles, τ, u
    pub numbers: [Vec<R>; 5],
}

impl<R: Real> TickArrays<R> {
    pub fn new(edges: &Edges<u16>, vertices: usize) -> Self {
        let (unknowns, all) = (edges.counts().unknowns(), edges.counts().edges());
        Self {
            rows: vec![Row::EMPTY; unknowns],
            active: vec![false; edges.counts().contact],
            numbers: [unknowns, vertices, all, all, all].map(|length| vec![R::ZERO; length]),
        }
    }

    pub fn memory(&mut self, edges: &Edges<u16>) -> Result<Memory<'_, R, u16, QUADS>, Error> {
        let [load, vertices, bubbles, tau, u] = &mut self.numbers;
        let rows = Rows::new(edges, &mut self.rows)?;
        Ok(Memory { rows, load, active: &mut self.active, vertices, bubbles, tau, u })
    }
}

/// Memory of a full model that stores nothing.
pub fn of_full<'a, R: Real>(
    tick: Memory<'a, R, u16, QUADS>,
    data: DataMemory<'a, R, u16>,
    progress: &'a mut Progress<R>,
) -> full::Memory<'a, R, u16, QUADS> {
    let (past, handed_on) = (Past::default(), HandedOn::default());
    full::Memory { tick, data, past, handed_on, progress }
}
