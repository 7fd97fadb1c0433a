//! The plate with full data: what a certificate and a tick stand on.

use signorini_bound::cells::{CellBuffers, Cells, Quad, Triangle, pack};
use signorini_bound::certificate::{self, Discretization, LoadCase, Metric};
use signorini_bound::conforming::VertexData;
use signorini_bound::equilibrium::is_root;
use signorini_bound::forest::{Forest, ForestBuffers, grow};
use signorini_kernel::assembly::CellLoads;
use signorini_kernel::element::rannacher_turek;
use signorini_kernel::mesh::boundary::{Boundary, Neumann, Robin};
use signorini_kernel::stiffness::{self, Coefficient, Stiffness};
use signorini_kernel::{Error, Real, Tensor};

use super::{NONE, Plate, Side};

pub const A: Tensor<f64> = Tensor { xx: 3.0, xy: -1.2, yy: 1.5 };
pub const LOAD: f64 = -0.8;
pub const GAP: f64 = -0.5;
/// ∫h of an edge, and u_ext.
pub const LAW: [f64; 2] = [0.7, 0.4];
pub const GIVEN: f64 = 0.9;

/// Owned arrays.
pub struct Foundation {
    pub plate: Plate,
    neumann: Vec<Neumann<f64, u16>>,
    robin: Vec<Robin<f64, u16>>,
    flux: Vec<f64>,
    stiffness: (Vec<[f64; 3]>, Vec<[f64; 6]>),
    compliance: Vec<f64>,
    points: Vec<[Tensor<f64>; 64]>,
    place: Vec<u32>,
    ways: [Vec<u16>; 3],
    triangles: Vec<Triangle<f64, u16>>,
    quads: Vec<Quad<f64, u16>>,
    weights: [Vec<f64>; 2],
    stability: certificate::Stability<f64>,
    pub loads: (Vec<f64>, Vec<f64>),
    gap: Vec<[f64; 2]>,
    given: Vec<[f64; 2]>,
    pub lower: Vec<f64>,
    pub dirichlet: Vec<f64>,
}

impl Foundation {
    pub fn new(sides: [Side; 4], at_points: bool) -> Result<Self, Error> {
        let plate = Plate::new(sides)?;
        let counts = plate.edges()?.counts();
        let law = |edge| Robin { edge, coefficient: LAW[0], ambient: LAW[0] * LAW[1] };
        let on = |side| free_edges(&plate, side);
        let neumann = on(Side::Insulated)?.into_iter().map(|edge| Neumann { edge, flux: 0.3 });
        let (neumann, robin) =
            (neumann.collect(), on(Side::Transfer)?.into_iter().map(law).collect());
        let mut k = (vec![[0.0; 3]; plate.triangles.len()], vec![[0.0; 6]; plate.quads.len()]);
        stiffness::fill(&plate.mesh()?, Coefficient::Uniform(A), 2, &mut k.0, &mut k.1)?;
        let cells = k.0.len() + k.1.len();
        let mut foundation = Self {
            neumann,
            robin,
            flux: vec![-0.2; counts.contact],
            compliance: vec![0.25 / (A.xx * A.yy - A.xy * A.xy); k.0.len()],
            points: if at_points { metric(&plate) } else { Vec::new() },
            place: (0..cells as u32).collect(),
            ways: [(); 3].map(|()| vec![NONE; cells]),
            triangles: vec![Triangle::EMPTY; k.0.len()],
            quads: vec![Quad::EMPTY; k.1.len()],
            weights: [vec![0.0; plate.vertices.len()], vec![0.0; counts.edges()]],
            stability: certificate::Stability::default(),
            loads: (vec![LOAD / 2.0; k.0.len()], vec![LOAD; k.1.len()]),
            gap: vec![[GAP; 2]; counts.contact],
            given: vec![[GIVEN; 2]; counts.dirichlet],
            lower: vec![GAP; counts.contact],
            dirichlet: vec![GIVEN; counts.dirichlet],
            stiffness: k,
            plate,
        };
        foundation.find_ways()?;
        Ok(foundation)
    }

    fn find_ways(&mut self) -> Result<(), Error> {
        let Self { plate, neumann, robin, flux, stiffness, compliance, points, place, .. } = self;
        let (mesh, edges) = (plate.mesh()?, plate.edges()?);
        let boundary = Boundary::new(&edges, neumann, robin, flux)?;
        let mut distance = vec![0.0; edges.cells()];
        let [order, parent, places] = &mut self.ways;
        let buffers = ForestBuffers { order, parent, place: places, distance: &mut distance };
        let forest = grow(&edges, |_| 1.0, |edge| is_root(&edges, &boundary, edge), buffers)?;
        let stiffness = Stiffness { triangles: &stiffness.0, quads: &stiffness.1 };
        let [of_vertices, of_edges] = &mut self.weights;
        let (triangles, quads) = (&mut self.triangles, &mut self.quads);
        let buffers = CellBuffers { triangles, quads, of_vertices, of_edges };
        let cells = pack(&mesh, &edges, stiffness, &[], compliance, &forest, buffers)?;
        let metric = Metric { at_points: points, place, distortions: &[] };
        let mut way = vec![0.0; edges.cells()];
        self.stability =
            certificate::stability(&edges, &cells, metric, &boundary, &forest, &mut way)?;
        Ok(())
    }

    pub fn boundary(&self) -> Result<Boundary<'_, f64, u16>, Error> {
        Boundary::new(&self.plate.edges()?, &self.neumann, &self.robin, &self.flux)
    }

    pub fn stiffness(&self) -> Stiffness<'_, f64> {
        Stiffness { triangles: &self.stiffness.0, quads: &self.stiffness.1 }
    }

    fn metric(&self) -> Metric<'_, f64> {
        Metric { at_points: &self.points, place: &self.place, distortions: &[] }
    }

    pub fn discretization(&self) -> Result<Discretization<'_, f64, u16>, Error> {
        let edges = self.plate.edges()?;
        let [order, parent, place] = &self.ways;
        let forest = Forest::new(&edges, order, parent, place)?;
        let [of_vertices, of_edges] = &self.weights;
        Ok(Discretization {
            mesh: self.plate.mesh()?,
            edges,
            stiffness: self.stiffness(),
            cells: Cells::new(&self.triangles, &self.quads, of_vertices, of_edges, &forest)?,
            metric: self.metric(),
            stability: self.stability,
        })
    }

    pub fn given(&self) -> Result<LoadCase<'_, f64, u16>, Error> {
        Ok(LoadCase {
            loads: CellLoads { triangles: &self.loads.0, quads: &self.loads.1 },
            boundary: self.boundary()?,
            ends: VertexData { gap: &self.gap, given: &self.given },
            curved: &[],
            transfer: &[],
            oscillation: 0.0,
        })
    }
}

fn free_edges(plate: &Plate, side: Side) -> Result<Vec<u16>, Error> {
    let (mesh, edges) = (plate.mesh()?, plate.edges()?);
    let outer = (0..edges.counts().free).filter(|&edge| edges.half_edges()[edge][1] == NONE);
    let on = outer.filter(|&edge| plate.side(edges.endpoints(&mesh, edge)) == side);
    Ok(on.map(|edge| edge as u16).collect())
}

/// A in reference coordinates at the points of every cell, though it is constant.
fn metric(plate: &Plate) -> Vec<[Tensor<f64>; 64]> {
    let corner = |vertex: u16| plate.vertices[usize::from(vertex)];
    let triangles = plate.triangles.iter().map(|cell| cell.map(corner));
    let triangles = triangles.map(|corners| [certificate::of_triangle(corners, A); 64]);
    let quads = plate.quads.iter().map(|cell| {
        let corners = cell.map(corner);
        let at = |k: usize| f64::GAUSS[7][k][0];
        std::array::from_fn(|p| {
            certificate::of_quad(&rannacher_turek::place(corners, [at(p % 8), at(p / 8)]), A)
        })
    });
    triangles.chain(quads).collect()
}
