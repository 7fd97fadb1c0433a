//! The plate with full data: what a certificate and a tick stand on.

use signorini_bound::certificate::{self, Discretization, LoadCase, Metric};
use signorini_bound::conforming::VertexData;
use signorini_bound::equilibrium::is_root;
use signorini_device::full::{Base, Full, Functional};
use signorini_device::tick::{Data, IfStoring};
use signorini_kernel::assembly::CellLoads;
use signorini_kernel::element::rannacher_turek;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::boundary::{Boundary, Neumann, Robin};
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::stiffness::{self, Coefficient, Stiffness};
use signorini_kernel::{Error, Real, Tensor};

use super::Plate;
use crate::numbering::{NONE, Side};
use crate::owned::Packed;

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
    points: Vec<[Tensor<f64>; 64]>,
    place: Vec<u32>,
    packed: Packed<f64>,
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
        let (neumann, robin): (Vec<_>, Vec<_>) =
            (neumann.collect(), on(Side::Transfer)?.into_iter().map(law).collect());
        let mut k = (vec![[0.0; 3]; plate.triangles.len()], vec![[0.0; 6]; plate.quads.len()]);
        stiffness::fill(&plate.mesh()?, Coefficient::Uniform(A), 2, &mut k.0, &mut k.1)?;
        let flux = vec![-0.2; counts.contact];
        let packed = packed(&plate, (&neumann, &robin, &flux), &k)?;
        Ok(Self {
            neumann,
            robin,
            flux,
            points: if at_points { metric(&plate) } else { Vec::new() },
            place: (0..(k.0.len() + k.1.len()) as u32).collect(),
            packed,
            loads: (vec![LOAD / 2.0; k.0.len()], vec![LOAD; k.1.len()]),
            gap: vec![[GAP; 2]; counts.contact],
            given: vec![[GIVEN; 2]; counts.dirichlet],
            lower: vec![GAP; counts.contact],
            dirichlet: vec![GIVEN; counts.dirichlet],
            stiffness: k,
            plate,
        })
    }

    pub fn boundary(&self) -> Result<Boundary<'_, f64, u16>, Error> {
        Boundary::new(&self.plate.edges()?, &self.neumann, &self.robin, &self.flux)
    }

    pub fn stiffness(&self) -> Stiffness<'_, f64> {
        Stiffness { triangles: &self.stiffness.0, quads: &self.stiffness.1 }
    }

    fn metric(&self) -> Metric<'_, f64> {
        Metric { at_points: &self.points, place: &self.place, ..Metric::default() }
    }

    pub fn discretization(&self) -> Result<Discretization<'_, f64, u16>, Error> {
        let edges = self.plate.edges()?;
        Ok(Discretization {
            mesh: self.plate.mesh()?,
            edges,
            stiffness: self.stiffness(),
            cells: self.packed.cells(&edges)?,
            metric: self.metric(),
            stability: self.packed.stability(&edges, self.metric(), &self.boundary()?)?,
        })
    }

    pub fn given(&self) -> Result<LoadCase<'_, f64, u16>, Error> {
        Ok(LoadCase {
            loads: CellLoads { triangles: &self.loads.0, quads: &self.loads.1 },
            boundary: self.boundary()?,
            ends: VertexData { gap: &self.gap, given: &self.given },
            ..LoadCase::default()
        })
    }

    /// Data of a tick.
    pub fn data(&self) -> Result<Data<'_, f64, u16>, Error> {
        let law = Law::above(&self.lower);
        Ok(Data { given: self.given()?, law, dirichlet: &self.dirichlet, step: IfStoring::NOTHING })
    }

    /// The full model, without inputs.
    pub fn full<'a>(
        &'a self,
        outputs: &'a [Functional<'a, f64, u16>],
        has_bound: bool,
    ) -> Result<Full<'a, f64, u16>, Error> {
        let LoadCase { loads, ends, .. } = self.given()?;
        Ok(Full {
            discretization: self.discretization()?,
            base: Base {
                loads,
                neumann: &self.neumann,
                robin: &self.robin,
                contact_flux: &self.flux,
                gap: &self.lower,
                dirichlet: &self.dirichlet,
                ends,
                ..Base::default()
            },
            patterns: &[],
            oscillation: &[],
            outputs,
            has_bound,
            corners: &[],
            start: 0.0,
            relaxation: Relaxation::Adaptive(1.0),
            storing: IfStoring::NOTHING,
        })
    }
}

type Records<'a> = (&'a [Neumann<f64, u16>], &'a [Robin<f64, u16>], &'a [f64]);

fn packed(
    plate: &Plate,
    (neumann, robin, flux): Records,
    k: &(Vec<[f64; 3]>, Vec<[f64; 6]>),
) -> Result<Packed<f64>, Error> {
    let (mesh, edges) = (plate.mesh()?, plate.edges()?);
    let boundary = Boundary::new(&edges, neumann, robin, flux)?;
    let compliance = vec![0.25 / (A.xx * A.yy - A.xy * A.xy); k.0.len()];
    let stiffness = Stiffness { triangles: &k.0, quads: &k.1 };
    let is_root = |edge| is_root(&edges, &boundary, edge);
    Packed::new((&mesh, &edges), stiffness, [&[], &compliance], |_| 1.0, is_root)
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
