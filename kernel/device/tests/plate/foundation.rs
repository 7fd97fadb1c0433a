//! The plate with full data: what a certificate and a tick stand on.

use signorini_bound::certificate::{self, Discretization, LoadCase};
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

use super::{Plate, free_edges, plate};
use crate::numbering::Side;
use crate::owned::{Ground, Packed, Points};

pub const A: Tensor<f64> = Tensor { xx: 3.0, xy: -1.2, yy: 1.5 };
pub const LOAD: f64 = -0.8;
pub const GAP: f64 = -0.5;
/// ∫h of an edge, and u_ext.
pub const LAW: [f64; 2] = [0.7, 0.4];
pub const GIVEN: f64 = 0.9;

/// Owned arrays.
#[derive(Clone)]
pub struct Foundation {
    pub plate: Plate,
    neumann: Vec<Neumann<f64, u16>>,
    robin: Vec<Robin<f64, u16>>,
    flux: Vec<f64>,
    stiffness: (Vec<[f64; 3]>, Vec<[f64; 6]>),
    ground: Ground<f64>,
    pub loads: (Vec<f64>, Vec<f64>),
    pub gap: Vec<[f64; 2]>,
    given: Vec<[f64; 2]>,
    pub lower: Vec<f64>,
    pub dirichlet: Vec<f64>,
    pub oscillation: f64,
}

impl Foundation {
    pub fn new(sides: [Side; 4], at_points: bool) -> Result<Self, Error> {
        let plate = plate(sides)?;
        let counts = plate.counts;
        let law = |edge| Robin { edge, coefficient: LAW[0], ambient: LAW[0] * LAW[1] };
        let on = |side| free_edges(&plate, sides, side);
        let neumann = on(Side::Insulated)?.into_iter().map(|edge| Neumann { edge, flux: 0.3 });
        let (neumann, robin): (Vec<_>, Vec<_>) =
            (neumann.collect(), on(Side::Transfer)?.into_iter().map(law).collect());
        let mut k = (vec![[0.0; 3]; plate.triangles.len()], vec![[0.0; 6]; plate.quads.len()]);
        stiffness::fill(&plate.mesh()?, Coefficient::Uniform(A), 2, &mut k.0, &mut k.1)?;
        let flux = vec![-0.2; counts.contact];
        let points = if at_points { metric(&plate) } else { Vec::new() };
        let places = (0..(k.0.len() + k.1.len()) as u32).collect();
        let ground = ground(&plate, (&neumann, &robin, &flux), &k, (points, places))?;
        Ok(Self {
            neumann,
            robin,
            flux,
            ground,
            loads: (vec![LOAD / 2.0; k.0.len()], vec![LOAD; k.1.len()]),
            gap: vec![[GAP; 2]; counts.contact],
            given: vec![[GIVEN; 2]; counts.dirichlet],
            lower: vec![GAP; counts.contact],
            dirichlet: vec![GIVEN; counts.dirichlet],
            oscillation: 0.0,
            stiffness: k,
            plate,
        })
    }

    /// A copy whose source is multiplied, with other means of ψ.
    pub fn with(&self, source: f64, psi: impl Fn(usize, f64) -> f64) -> Self {
        let mut other = self.clone();
        let loads = other.loads.0.iter_mut().chain(&mut other.loads.1);
        loads.for_each(|load| *load *= source);
        other.lower.iter_mut().enumerate().for_each(|(at, lower)| *lower = psi(at, *lower));
        other
    }

    pub fn boundary(&self) -> Result<Boundary<'_, f64, u16>, Error> {
        Boundary::new(&self.plate.edges()?, &self.neumann, &self.robin, &self.flux)
    }

    pub fn stiffness(&self) -> Stiffness<'_, f64> {
        Stiffness { triangles: &self.stiffness.0, quads: &self.stiffness.1 }
    }

    pub fn discretization(&self) -> Result<Discretization<'_, f64, u16>, Error> {
        self.ground.discretization(self.plate.mesh()?, self.plate.edges()?, self.stiffness())
    }

    pub fn given(&self) -> Result<LoadCase<'_, f64, u16>, Error> {
        Ok(LoadCase {
            loads: CellLoads { triangles: &self.loads.0, quads: &self.loads.1 },
            boundary: self.boundary()?,
            ends: VertexData { gap: &self.gap, given: &self.given },
            oscillation: self.oscillation,
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

fn ground(
    plate: &Plate,
    (neumann, robin, flux): Records,
    k: &(Vec<[f64; 3]>, Vec<[f64; 6]>),
    points: Points<f64>,
) -> Result<Ground<f64>, Error> {
    let (mesh, edges) = (plate.mesh()?, plate.edges()?);
    let boundary = Boundary::new(&edges, neumann, robin, flux)?;
    let compliance = vec![0.25 / (A.xx * A.yy - A.xy * A.xy); k.0.len()];
    let stiffness = Stiffness { triangles: &k.0, quads: &k.1 };
    let is_root = |edge| is_root(&edges, &boundary, edge);
    let packed = Packed::new((&mesh, &edges), stiffness, [&[], &compliance], |_| 1.0, is_root)?;
    Ground::new(packed, points, &edges, &boundary)
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
