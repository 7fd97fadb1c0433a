//! What the error bound of a workspace needs beside the answer: ways out of the cells, packed cells, and what the data
//! allow for.
//!
//! The bound is that of the problem as its conditions state it: f constant in each cell, g, q, h and u_ext along each
//! edge, ψ and u_D affine along each edge, one A per cell. It covers triangles and parallelograms.

use heapless::Vec;

use super::fit;
use signorini_bound::cells::{CellBuffers, Cells, Quad, Triangle};
use signorini_bound::certificate::{Discretization, Metric, Stability, of_quad};
use signorini_bound::conforming::VertexData;
use signorini_bound::equilibrium::is_root;
use signorini_bound::forest::ForestBuffers;
use signorini_bound::prepare::{Conductivities, is_parallelogram, is_told, prepare};
use signorini_kernel::element::rannacher_turek::place;
use signorini_kernel::error::{Array, CellId, Error};
use signorini_kernel::index::{Index, read, write};
use signorini_kernel::mesh::boundary::Boundary;
use signorini_kernel::mesh::edges::Edges;
use signorini_kernel::stiffness::{Coefficient, Stiffness};
use signorini_kernel::{Mesh, Real, Tensor};

/// Ways out of the cells and cells packed along them.
#[derive(Debug, Default)]
pub(super) struct Equilibration<
    R,
    I,
    const VERTICES: usize,
    const TRIANGLES: usize,
    const QUADS: usize,
    const CELLS: usize,
    const EDGES: usize,
> {
    order: Vec<I, CELLS>,
    parent: Vec<I, CELLS>,
    place: Vec<I, CELLS>,
    /// Scratch.
    way: Vec<R, CELLS>,
    /// ½ tr A of every cell.
    alpha: Vec<R, CELLS>,
    /// 1/(4 det A) of every triangle.
    compliance: Vec<R, TRIANGLES>,
    triangles: Vec<Triangle<R, I>, TRIANGLES>,
    quads: Vec<Quad<R, I>, QUADS>,
    of_vertices: Vec<R, VERTICES>,
    of_edges: Vec<R, EDGES>,
    stability: Stability<R>,
    /// Whether all quads are parallelograms whose element matrices tell A.
    affine: bool,
    /// What of A and of A in the directions of the sides cancels in rounded sums: [`cancelled`] of any cell.
    cancelled: R,
    /// Behind the cell that has no way out, where there is one; 0 elsewhere, so that an empty workspace is all zeros.
    cut_off: usize,
}

impl<
    R: Real,
    I: Index,
    const V: usize,
    const T: usize,
    const Q: usize,
    const C: usize,
    const E: usize,
> Equilibration<R, I, V, T, Q, C, E>
{
    pub(super) const fn new() -> Self {
        Self {
            order: Vec::new(),
            parent: Vec::new(),
            place: Vec::new(),
            way: Vec::new(),
            alpha: Vec::new(),
            compliance: Vec::new(),
            triangles: Vec::new(),
            quads: Vec::new(),
            of_vertices: Vec::new(),
            of_edges: Vec::new(),
            stability: Stability { largest: R::ZERO, weighed: R::ZERO, oblique: R::ZERO },
            affine: false,
            cancelled: R::ZERO,
            cut_off: 0,
        }
    }

    /// Takes the sizes of a mesh and its A; `points` a direction are those of its quads.
    pub(super) fn build(
        &mut self,
        mesh: &Mesh<R, I>,
        coefficient: Coefficient<R>,
        points: usize,
        edges: usize,
    ) -> Result<(), Error> {
        let (t, q) = (mesh.triangles().len(), mesh.quads().len());
        for array in [&mut self.order, &mut self.parent, &mut self.place] {
            fit(array, t + q, Array::Scratch)?;
        }
        fit(&mut self.way, t + q, Array::Scratch)?;
        fit(&mut self.alpha, t + q, Array::Scratch)?;
        fit(&mut self.compliance, t, Array::Triangles)?;
        fit(&mut self.of_vertices, mesh.vertices().len(), Array::Vertices)?;
        fit(&mut self.of_edges, edges, Array::Edges)?;
        self.triangles.clear();
        self.quads.clear();
        let full = |of, needed, limit| Error::Capacity { of, needed, limit };
        let room = self.triangles.resize(t, Triangle::EMPTY);
        room.map_err(|_| full(Array::Triangles, t, T))?;
        self.quads.resize(q, Quad::EMPTY).map_err(|_| full(Array::Quads, q, Q))?;
        for (at, alpha) in self.alpha.iter_mut().enumerate() {
            let a = coefficient.of_cell(at, t, points);
            *alpha = R::HALF * (a.xx + a.yy);
        }
        for (at, compliance) in self.compliance.iter_mut().enumerate() {
            let a = coefficient.of_cell(at, t, points);
            *compliance = R::QUARTER / (a.xx * a.yy - a.xy * a.xy);
        }
        let constant = q == 0 || !matches!(coefficient, Coefficient::PerPoint(_));
        let is_told = |(at, quad): (usize, &[I; 4])| {
            let corners = mesh.quad(quad);
            let a = coefficient.of_cell(t + at, t, points);
            is_parallelogram(corners)
                && is_told(of_quad(&place(corners, [R::HALF; 2]), a), R::EPSILON)
        };
        self.affine = constant && mesh.quads().iter().enumerate().all(is_told);
        self.cancelled = R::ONE;
        for (at, cell) in mesh.triangles().iter().enumerate() {
            let a = coefficient.of_cell(at, t, points);
            self.bear(cancelled(a, mesh.triangle(cell)), CellId::Triangle(at))?;
        }
        for (at, cell) in mesh.quads().iter().enumerate() {
            let a = coefficient.of_cell(t + at, t, points);
            self.bear(cancelled(a, mesh.quad(cell)), CellId::Quad(at))?;
        }
        Ok(())
    }

    /// Records how much cancels in a cell's element matrix; an error where that is too much.
    fn bear(&mut self, cancelled: R, cell: CellId) -> Result<(), Error> {
        self.cancelled = self.cancelled.or_larger(cancelled);
        let told = R::from_count(32) * R::EPSILON * cancelled < R::ONE;
        told.then_some(()).ok_or(Error::Oblique(cell))
    }

    /// Finds the ways out through D and R, and packs the cells along them. Where a part has no way out, there is none.
    pub(super) fn find_ways(
        &mut self,
        mesh: &Mesh<R, I>,
        edges: &Edges<I>,
        stiffness: Stiffness<R>,
        boundary: &Boundary<R, I>,
    ) -> Result<(), Error> {
        let Self { order, parent, place, way, alpha, triangles, quads, .. } = self;
        let forest = ForestBuffers { order, parent, place, distance: way };
        let (of_vertices, of_edges) = (&mut *self.of_vertices, &mut *self.of_edges);
        let cells = CellBuffers { triangles, quads, of_vertices, of_edges };
        let (compliance, metric) = (&*self.compliance, Metric::default());
        let a = Conductivities { alpha, compliance, metric };
        let is_root = |edge| is_root(edges, boundary, edge);
        self.cut_off = 0;
        match prepare(mesh, (edges, stiffness), boundary, a, is_root, forest, cells) {
            Err(Error::NoWayOut { cell }) => {
                self.cut_off = cell + 1;
                return Ok(());
            }
            found => self.stability = found?,
        }
        self.stability.oblique *= self.cancelled;
        Ok(())
    }

    /// What stays from tick to tick.
    ///
    /// # Errors
    /// [`Error::NoWayOut`] where contact alone holds a part.
    pub(super) fn discretization<'a>(
        &'a self,
        mesh: Mesh<'a, R, I>,
        edges: Edges<'a, I>,
        stiffness: Stiffness<'a, R>,
    ) -> Result<Discretization<'a, R, I>, Error> {
        if let Some(cell) = self.cut_off.checked_sub(1) {
            return Err(Error::NoWayOut { cell });
        }
        let Self { triangles, quads, of_vertices, of_edges, order, .. } = self;
        let cells = Cells::baked(triangles, quads, of_vertices, of_edges, order);
        Ok(Discretization {
            mesh,
            edges,
            stiffness,
            cells,
            metric: Metric::default(),
            stability: self.stability,
        })
    }

    /// Whether A is constant and the map affine on every cell.
    pub(super) fn is_affine(&self) -> bool {
        self.affine
    }
}

/// How much larger the terms of det A, and of N·AN for the normals N of the sides, are than what they cancel to: a host
/// rounds such sums once, in f64, and a workspace rounds every term in its own scalar.
fn cancelled<R: Real, const N: usize>(a: Tensor<R>, corners: [[R; 2]; N]) -> R {
    let scale = a.xx.or_larger(a.yy);
    let [xx, xy, yy] = [a.xx / scale, a.xy / scale, a.yy / scale];
    let worse = |most: R, terms: R, sum: R| {
        let here = if sum > R::ZERO { terms / sum } else { R::ONE / R::ZERO };
        most.or_larger(here)
    };
    let ends = corners.iter().zip(corners.iter().cycle().skip(1));
    let sides = ends.fold(R::ONE, |most, (p, q)| {
        let [m, n] = [q[1] - p[1], p[0] - q[0]];
        let size = m.magnitude().or_larger(n.magnitude());
        let [m, n] = [m / size, n / size];
        let (straight, oblique) = (xx * m * m + yy * n * n, R::TWO * xy * m * n);
        worse(most, straight + oblique.magnitude(), straight + oblique)
    });
    worse(sides, xx * yy + xy * xy, xx * yy - xy * xy)
}

/// What boundary data allow for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum BoundSupport {
    /// A bound.
    #[default]
    Bound,
    /// None, since u_D jumps.
    NotForJumps,
    /// None, since u_D lies below ψ where they meet.
    NotBelowGap,
}

/// What the boundary data allow for; jumps of rounding count as none. `last` is scratch with an entry a vertex.
pub(super) fn support<R: Real, I: Index>(
    mesh: &Mesh<R, I>,
    edges: &Edges<I>,
    ends: VertexData<R>,
    last: &mut [[I; 2]],
) -> BoundSupport {
    let counts = edges.counts();
    for edge in counts.free..counts.edges() {
        edges.endpoints(mesh, edge).iter().for_each(|end| write(last, end.at(), [I::NONE; 2]));
    }
    let known = |[at, end]: [I; 2]| read(&read(ends.given, at.at()), end.at());
    for (at, values) in ends.given.iter().enumerate() {
        let corners = edges.endpoints(mesh, counts.unknowns() + at);
        for (end, (vertex, &value)) in corners.iter().zip(values).enumerate() {
            let before = read(last, vertex.at());
            if before[0] != I::NONE {
                let (other, size) = (known(before), value.magnitude());
                if (other - value).magnitude() > R::EPSILON * size.or_larger(other.magnitude()) {
                    return BoundSupport::NotForJumps;
                }
            }
            let own = [at, end].map(|number| I::new(number).unwrap_or(I::NONE));
            write(last, vertex.at(), own);
        }
    }
    let slack = ends.slack();
    for (at, gap) in ends.gap.iter().enumerate() {
        let corners = edges.endpoints(mesh, counts.free + at);
        for (vertex, &psi) in corners.iter().zip(gap) {
            let met = read(last, vertex.at());
            if met[0] != I::NONE && psi - known(met) > slack {
                return BoundSupport::NotBelowGap;
            }
        }
    }
    BoundSupport::Bound
}
