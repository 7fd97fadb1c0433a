//! A scene as the arrays that the kernel borrows.

use std::ops::Deref;

use signorini_bound::conforming::VertexData;
use signorini_kernel::assembly::{self, CellLoads};
use signorini_kernel::csr::Csr;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::boundary::{Boundary, Neumann, Robin};
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::stiffness::{self, Coefficient, Stiffness};
use signorini_kernel::system::{Shifts, System};
use signorini_kernel::{Error, Tensor};

use super::scene::{Draw, Scalar, Scene};
use crate::numbering::{NONE, NumberedMesh, Side};

#[derive(Clone)]
pub struct Arrays<R> {
    mesh: NumberedMesh<R>,
    /// Of the cells.
    pub tensors: Vec<Tensor<R>>,
    pub k: (Vec<[R; 3]>, Vec<[R; 6]>),
    pub loads: (Vec<R>, Vec<R>),
    pub neumann: Vec<Neumann<R, u16>>,
    pub robin: Vec<Robin<R, u16>>,
    /// ∫q
    pub flux: Vec<R>,
    pub gap: Vec<[R; 2]>,
    pub given: Vec<[R; 2]>,
    /// Means of ψ.
    pub lower: Vec<R>,
    /// The part of each unknown.
    pub part: Vec<u16>,
    row_ptr: Vec<u32>,
    col_idx: Vec<u16>,
    values: Vec<R>,
    pub load: Vec<R>,
    /// A random start on the gap or above it, with u_D.
    pub start: Vec<R>,
}

/// A scene is its mesh, with data.
impl<R> Deref for Arrays<R> {
    type Target = NumberedMesh<R>;

    fn deref(&self) -> &NumberedMesh<R> {
        &self.mesh
    }
}

impl<R: Scalar> Arrays<R> {
    pub fn new(scene: &Scene) -> Result<Self, Error> {
        let (vertices, cells) = scene.mesh();
        let vertices = vertices.iter().map(|v| v.map(R::of)).collect();
        let mesh = NumberedMesh::new(vertices, cells, |ends| scene.side(ends).block())?;
        let (triangles, quads, counts) = (mesh.triangles.len(), mesh.quads.len(), mesh.counts);
        let mut arrays = Self {
            tensors: vec![Tensor::scalar(R::ONE); triangles + quads],
            k: (vec![[R::ZERO; 3]; triangles], vec![[R::ZERO; 6]; quads]),
            loads: (vec![R::ZERO; triangles], vec![R::ZERO; quads]),
            neumann: Vec::new(),
            robin: Vec::new(),
            flux: Vec::new(),
            gap: Vec::new(),
            given: Vec::new(),
            lower: Vec::new(),
            part: vec![0; counts.unknowns()],
            row_ptr: vec![0; counts.unknowns() + 1],
            col_idx: Vec::new(),
            values: Vec::new(),
            load: vec![R::ZERO; counts.unknowns()],
            start: Vec::new(),
            mesh,
        };
        arrays.draw(scene)?;
        arrays.assemble()?;
        Ok(arrays)
    }

    fn draw(&mut self, scene: &Scene) -> Result<(), Error> {
        let mut draw = Draw(scene.seed + 100);
        for (at, tensor) in self.tensors.iter_mut().enumerate() {
            let size = if at % 3 == 1 { scene.jump } else { 1.0 };
            let [xx, xy, yy] = [1.0 + draw.next(), 0.5 * draw.signed(), 1.0 + draw.next()];
            *tensor = Tensor { xx: R::of(size * xx), xy: R::of(size * xy), yy: R::of(size * yy) };
        }
        let mut load = || R::of(scene.source * (0.5 + draw.next()) / 16.0);
        self.loads.0.iter_mut().for_each(|f| *f = load() * R::HALF);
        self.loads.1.iter_mut().for_each(|f| *f = load());
        for edge in 0..self.counts.edges() {
            if self.edges()?.half_edges()[edge][1] != NONE {
                continue;
            }
            let ends = self.edges()?.endpoints(&self.mesh()?, edge);
            let (a, b) = (R::of(0.5 * draw.signed()), R::of(0.5 * draw.signed()));
            let edge = edge as u16;
            match scene.side(ends) {
                Side::Insulated => self.neumann.push(Neumann { edge, flux: a * R::QUARTER }),
                Side::Transfer => {
                    let coefficient = R::of(scene.transfer * (0.5 + draw.next()));
                    self.robin.push(Robin { edge, coefficient, ambient: coefficient * a });
                }
                Side::Contact => {
                    self.gap.push([a * R::QUARTER - R::HALF, b * R::QUARTER - R::HALF]);
                    self.flux.push(R::of(-0.05 * draw.next()));
                }
                Side::Given => self.given.push([a + R::ONE, b + R::ONE]),
            }
        }
        self.lower = self.gap.iter().map(|[a, b]| (*a + *b) * R::HALF).collect();
        let contact = self.counts.free..self.counts.unknowns();
        for i in 0..self.counts.unknowns() {
            let random = R::of(draw.signed());
            self.start.push(match contact.contains(&i).then(|| self.lower[i - contact.start]) {
                Some(lower) if random < lower || i % 2 == 0 => lower,
                _ => random,
            });
            let [a, b] = self.edges()?.endpoints(&self.mesh()?, i);
            let middle = |end: u16| usize::from(end) % (scene.columns + 1);
            let right = scene.missing.is_some_and(|missing| middle(a).min(middle(b)) > missing);
            self.part[i] = u16::from(right);
        }
        self.start.extend(self.given.iter().map(|[a, b]| (*a + *b) * R::HALF));
        Ok(())
    }

    fn assemble(&mut self) -> Result<(), Error> {
        let (mut triangles, mut quads) = self.k.clone();
        let coefficient = Coefficient::PerCell(&self.tensors);
        stiffness::fill(&self.mesh()?, coefficient, 3, &mut triangles, &mut quads)?;
        self.k = (triangles, quads);
        let nonzeros = self.edges()?.nonzeros();
        let (mut row_ptr, mut col_idx) = (self.row_ptr.clone(), vec![NONE; nonzeros]);
        let (mut values, mut load) = (vec![R::ZERO; nonzeros], self.load.clone());
        let (edges, boundary) = (self.edges()?, self.boundary()?);
        assembly::pattern(&edges, &mut row_ptr, &mut col_idx)?;
        assembly::values(&edges, self.stiffness(), self.diagonal()?, &row_ptr, &mut values)?;
        assembly::load(&edges, self.cell_loads(), &boundary, &mut load)?;
        (self.row_ptr, self.col_idx, self.values, self.load) = (row_ptr, col_idx, values, load);
        Ok(())
    }

    pub fn boundary(&self) -> Result<Boundary<'_, R, u16>, Error> {
        Boundary::new(&self.edges()?, &self.neumann, &self.robin, &self.flux)
    }

    pub fn diagonal(&self) -> Result<DiagonalTerms<'_, R, u16>, Error> {
        Ok(DiagonalTerms::new(&self.boundary()?))
    }

    pub fn stiffness(&self) -> Stiffness<'_, R> {
        Stiffness { triangles: &self.k.0, quads: &self.k.1 }
    }

    pub fn cell_loads(&self) -> CellLoads<'_, R> {
        CellLoads { triangles: &self.loads.0, quads: &self.loads.1 }
    }

    pub fn ends(&self) -> VertexData<'_, R> {
        VertexData { gap: &self.gap, given: &self.given }
    }

    pub fn matrix(&self) -> Result<Csr<'_, R, u16>, Error> {
        Csr::new(&self.row_ptr, &self.col_idx, &self.values, self.counts.edges())
    }

    /// The problem; with shifts, of its parts.
    pub fn system(&self, shifts: bool) -> Result<System<'_, R, u16>, Error> {
        let system = System::new(self.matrix()?, &self.load, Law::above(&self.lower), self.counts)?;
        let parts = usize::from(self.part.iter().max().copied().unwrap_or(0)) + 1;
        let part = if parts > 1 { &self.part[..] } else { &[] };
        if shifts {
            system.with_shifts(Shifts { part, parts, diagonal: self.diagonal()? })
        } else {
            Ok(system)
        }
    }
}
