//! The foundation of a certificate, for any sound numbering: owned arrays, filled from bytes.

use signorini_bound::certificate::{
    Buffers, Certificate, Curved, Discretization, LoadCase, Verdict, certify,
};
use signorini_bound::conforming::VertexData;
use signorini_bound::equilibrium::{Iterate, is_root};
use signorini_device::tick::{Data, IfStoring};
use signorini_kernel::assembly::CellLoads;
use signorini_kernel::flux_range::Spans;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::Mesh;
use signorini_kernel::mesh::boundary::{Boundary, Neumann, Robin};
use signorini_kernel::mesh::edges::{Block, Edges};
use signorini_kernel::stiffness::Stiffness;
use signorini_kernel::{Error, Tensor};

use super::bytes::{Bits, Bytes};
use super::numbering::NONE;
use super::owned::{Ground, Packed};

/// Conditions on the boundary.
pub struct Conditions<R> {
    pub neumann: Vec<Neumann<R, u16>>,
    pub robin: Vec<Robin<R, u16>>,
    pub flux: Vec<R>,
}

impl<R: Bits> Conditions<R> {
    /// Each free boundary edge has a given flux, a transfer law, or neither. `wild`: any numbers.
    pub fn new(bytes: &mut Bytes, edges: &Edges<u16>, wild: bool) -> Self {
        let counts = edges.counts();
        let (mut neumann, mut robin) = (Vec::new(), Vec::new());
        for (edge, pair) in (0..).zip(edges.half_edges()).take(counts.free.min(255)) {
            match if pair[1] == NONE { bytes.below(3) } else { 0 } {
                0 => {}
                1 => neumann.push(Neumann { edge, flux: bytes.given(1, wild)[0] }),
                _ => {
                    let [h, ambient] = [(); 2].map(|()| bytes.given::<R>(1, wild)[0]);
                    let coefficient = if wild { h } else { h.magnitude() };
                    robin.push(Robin { edge, coefficient, ambient });
                }
            }
        }
        let flux = if bytes.flag() { bytes.given(counts.contact, wild) } else { Vec::new() };
        Self { neumann, robin, flux }
    }

    pub fn boundary(&self, edges: &Edges<u16>) -> Result<Boundary<'_, R, u16>, Error> {
        Boundary::new(edges, &self.neumann, &self.robin, &self.flux)
    }
}

/// Ways out and packed cells.
pub struct Foundation<R> {
    pub stiffness: (Vec<[R; 3]>, Vec<[R; 6]>),
    ground: Ground<R>,
}

impl<R: Bits> Foundation<R> {
    /// For these element matrices; costs, α and compliances are `wild` or all 1.
    pub fn new(
        bytes: &mut Bytes,
        mesh: &Mesh<R, u16>,
        edges: &Edges<u16>,
        boundary: &Boundary<R, u16>,
        stiffness: (Vec<[R; 3]>, Vec<[R; 6]>),
        wild: bool,
    ) -> Result<Self, Error> {
        let (t, q) = (stiffness.0.len(), stiffness.1.len());
        let cells = edges.cells();
        let mut some = |count| if wild { bytes.reals(count) } else { vec![R::ONE; count] };
        let (cost, alpha, compliance) = (some(cells), some(t + q), some(t));
        let (mut points, mut place) = (Vec::new(), Vec::new());
        if wild && bytes.flag() {
            let point = |bytes: &mut Bytes| {
                let [xx, xy, yy] = [(); 3].map(|()| bytes.real());
                [Tensor { xx, xy, yy }; 64]
            };
            points = (0..cells).map(|_| point(bytes)).collect();
            place = (0..cells).map(|_| u32::from(bytes.byte()) % 9).collect();
        }
        let root = |edge| is_root(edges, boundary, edge);
        let k = Stiffness { triangles: &stiffness.0, quads: &stiffness.1 };
        let a = [&alpha[..], &compliance];
        let packed = Packed::new((mesh, edges), k, a, |cell| cost[cell], root)?;
        let ground = Ground::new(packed, (points, place), edges, boundary)?;
        Ok(Self { stiffness, ground })
    }

    /// The view that the kernel takes.
    pub fn discretization<'a>(
        &'a self,
        mesh: Mesh<'a, R, u16>,
        edges: Edges<'a, u16>,
    ) -> Result<Discretization<'a, R, u16>, Error> {
        let (triangles, quads) = &self.stiffness;
        self.ground.discretization(mesh, edges, Stiffness { triangles, quads })
    }
}

/// Loads and boundary values of any bits.
pub struct Loads<R> {
    pub conditions: Conditions<R>,
    cells: (Vec<R>, Vec<R>),
    ends: [Vec<[R; 2]>; 2],
    curved: Vec<Curved<R, u16>>,
    transfer: Vec<[[R; 2]; 8]>,
    oscillation: R,
    lower: Vec<R>,
    spans: Vec<R>,
    pub dirichlet: Vec<R>,
}

impl<R: Bits> Loads<R> {
    pub fn new(bytes: &mut Bytes, edges: &Edges<u16>, conditions: Conditions<R>) -> Self {
        let counts = edges.counts();
        let laws = if bytes.flag() { conditions.robin.len() } else { 0 };
        let curved = |bytes: &mut Bytes| Curved {
            edge: bytes.byte().into(),
            mean: bytes.real(),
            peak: bytes.real(),
            energy: bytes.real(),
            coupling: [(); 8].map(|()| bytes.real()),
        };
        let (lower, dirichlet) = (bytes.reals(counts.contact), bytes.reals(counts.dirichlet));
        Self {
            cells: (bytes.reals(edges.of_triangles().len()), bytes.reals(edges.of_quads().len())),
            ends: [bytes.groups(counts.contact), bytes.groups(counts.dirichlet)],
            curved: (0..bytes.below(4)).map(|_| curved(bytes)).collect(),
            transfer: (0..laws).map(|_| [(); 8].map(|()| [bytes.real(), bytes.real()])).collect(),
            oscillation: bytes.real::<R>().magnitude(),
            conditions,
            lower,
            dirichlet,
            spans: bytes.spans(counts.contact),
        }
    }

    /// The view that a certificate takes.
    pub fn given(&self, edges: &Edges<u16>) -> Result<LoadCase<'_, R, u16>, Error> {
        let [gap, given] = &self.ends;
        Ok(LoadCase {
            loads: CellLoads { triangles: &self.cells.0, quads: &self.cells.1 },
            boundary: self.conditions.boundary(edges)?.with_spans(edges, self.spans()?)?,
            ends: VertexData { gap, given },
            curved: &self.curved,
            transfer: &self.transfer,
            forms: &[],
            oscillation: self.oscillation,
        })
    }

    /// The view that a tick takes.
    pub fn data(&self, edges: &Edges<u16>) -> Result<Data<'_, R, u16>, Error> {
        Ok(Data {
            given: self.given(edges)?,
            law: self.law()?,
            dirichlet: &self.dirichlet,
            step: IfStoring::NOTHING,
        })
    }

    fn spans(&self) -> Result<Spans<'_, R>, Error> {
        Spans::new(&self.spans)
    }

    /// The law on C.
    pub fn law(&self) -> Result<Law<'_, R>, Error> {
        Ok(Law::above(&self.lower).with_spans(self.spans()?))
    }
}

/// Certifies any iterate.
pub fn judged<R: Bits>(
    bytes: &mut Bytes,
    discretization: &Discretization<R, u16>,
    loads: &Loads<R>,
) -> Result<(), Error> {
    let edges = discretization.edges.counts().edges();
    let (u, cells) = (bytes.reals(edges), discretization.edges.cells());
    let buffers = Buffers {
        vertices: &mut vec![R::ZERO; discretization.mesh.vertices().len()],
        bubbles: &mut vec![R::ZERO; edges],
        tau: &mut vec![R::ZERO; edges],
        indicators: &mut vec![R::ZERO; if bytes.flag() { cells } else { 0 }],
    };
    let iterate = Iterate { u: &u, law: loads.law()? };
    match certify(discretization, &loads.given(&discretization.edges)?, iterate, buffers)? {
        Verdict::Certified(found) => is_bound(&found),
        Verdict::Pulled { edge } => {
            assert_eq!(discretization.edges.counts().block(edge), Block::Contact);
        }
        _ => {}
    }
    Ok(())
}

/// All finite, and none negative.
pub fn is_bound<R: Bits>(found: &Certificate<R>) {
    let Certificate { duality_gap: gap, algebraic, oscillation, rounding, total, of_u, distance } =
        *found;
    let parts = [gap, algebraic, oscillation, rounding, total, of_u, distance];
    assert!(parts.iter().all(|part| part.finite()), "{found:?}");
    assert!(parts.iter().all(|part| *part >= R::ZERO), "{found:?}");
    assert!(gap <= total && total <= of_u && distance <= gap, "{found:?}");
}
