//! A scene on a mesh, and the discrete problem (14) that it leads to.
//!
//! ```text
//! −∇·(A∇u) = f,   u = u_D on D,   A∇u·n = g on N,   A∇u·n = h (u_ext − u) on R,
//! u ≥ ψ,  A∇u·n ≥ q,  (u − ψ)(A∇u·n − q) = 0 on C.
//! ```
//! In edge means: minimise ½ uᵀKu − bᵀu with u_E given on D and u_E ≥ mean of ψ on C, where
//! b_E = ∫ f̄ φ_E + ∫_E g (on N) + ∫_E q (on C) + ∫_E h u_ext (on R), and R adds ∫_E h to K_EE.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::cell::Cell;
use crate::element::Element;
use crate::exact::Exact;
use crate::field::{Point, Scalar, apply, constant, dot};
use crate::grid::{Edge, Grid};
use crate::quadrature::edge_mean;

/// f as a function of the cell's number and the point, so that it can jump between cells.
pub type CellScalar = Arc<dyn Fn(usize, Point) -> f64 + Send + Sync>;
/// A = [a_xx, a_xy, a_yy] likewise.
pub type CellTensor = Arc<dyn Fn(usize, Point) -> [f64; 3] + Send + Sync>;

/// The condition on a boundary edge; n is outward.
#[derive(Clone)]
pub enum Boundary {
    /// u = value.
    Dirichlet {
        /// u_D.
        value: Scalar,
    },
    /// A∇u·n = flux.
    Neumann {
        /// g.
        flux: Scalar,
    },
    /// u ≥ gap, A∇u·n ≥ flux, one of them with equality.
    Contact {
        /// ψ.
        gap: Scalar,
        /// q.
        flux: Scalar,
    },
    /// A∇u·n = coefficient (ambient − u).
    Robin {
        /// h ≥ 0.
        coefficient: Scalar,
        /// u_ext.
        ambient: Scalar,
    },
}

/// Which condition an exact solution is given on a boundary edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Its values.
    Dirichlet,
    /// Its flux.
    Neumann,
    /// Its gap; only where it solves a contact problem, on y = 0.
    Contact,
    /// Its flux, with this coefficient.
    Robin(f64),
}

/// A scene.
#[derive(Clone)]
pub struct Problem {
    /// The mesh.
    pub grid: Grid,
    /// A.
    pub tensor: CellTensor,
    /// f.
    pub source: CellScalar,
    /// The condition on every edge of the boundary.
    pub boundary: BTreeMap<Edge, Boundary>,
    /// Gauss points a direction in cells and along edges.
    pub order: usize,
}

/// The discrete problem (14).
#[derive(Clone, Debug, Default)]
pub struct System {
    /// K, with R; entries that are not listed are zero.
    pub stiffness: BTreeMap<(Edge, Edge), f64>,
    /// b, on every edge.
    pub load: BTreeMap<Edge, f64>,
    /// The means of u_D on the edges of D.
    pub fixed: BTreeMap<Edge, f64>,
    /// The means of ψ on the edges of C.
    pub gap: BTreeMap<Edge, f64>,
}

impl Problem {
    /// The scene that `exact` solves, with the condition that `kind` chooses for the midpoint of
    /// each boundary edge.
    pub fn of_exact(exact: &Exact, grid: Grid, kind: impl Fn(Point) -> Kind) -> Self {
        let mut boundary = BTreeMap::new();
        for (e, cells) in grid.edges().into_iter().filter(|(_, cells)| cells.len() == 1) {
            let local = grid.cell_edges(cells[0]).iter().position(|&other| other == e);
            let normal = Cell::of(&grid, cells[0]).scaled_normal(local.unwrap_or(0));
            let [a, b] = grid.ends(e);
            let midpoint = [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0];
            boundary.insert(e, condition(exact, kind(midpoint), normal));
        }
        let (tensor, source) = (exact.tensor.clone(), exact.source.clone());
        Self {
            grid,
            tensor: Arc::new(move |_, p| tensor(p)),
            source: Arc::new(move |_, p| source(p)),
            boundary,
            order: 8,
        }
    }

    /// The scene of the catalogue: contact on y = 0, Dirichlet elsewhere.
    pub fn catalogue(exact: &Exact, grid: Grid) -> Self {
        let kind = |[_, y]: Point| if y == 0.0 { Kind::Contact } else { Kind::Dirichlet };
        Self::of_exact(exact, grid, kind)
    }

    /// The element of a cell.
    pub fn element(&self, cell: usize) -> Element {
        Element::new(Cell::of(&self.grid, cell))
    }

    /// K_T of a cell, in the order of its edges.
    pub fn cell_stiffness(&self, cell: usize) -> Vec<Vec<f64>> {
        self.element(cell).stiffness(|p| (self.tensor)(cell, p), self.order)
    }

    /// ∫_T f̄ φ_E of a cell, in the order of its edges.
    pub fn cell_load(&self, cell: usize) -> Vec<f64> {
        self.element(cell).load(|p| (self.source)(cell, p), self.order)
    }

    /// Cell by cell, then edge by edge of the boundary.
    pub fn system(&self) -> System {
        let mut system = System::default();
        for cell in 0..self.grid.cell_count() {
            let edges = self.grid.cell_edges(cell);
            let (matrix, load) = (self.cell_stiffness(cell), self.cell_load(cell));
            for (i, &row) in edges.iter().enumerate() {
                *system.load.entry(row).or_default() += load[i];
                for (j, &column) in edges.iter().enumerate() {
                    *system.stiffness.entry((row, column)).or_default() += matrix[i][j];
                }
            }
        }
        for (&e, condition) in &self.boundary {
            self.impose(&mut system, e, condition);
        }
        system
    }

    fn impose(&self, system: &mut System, e: Edge, condition: &Boundary) {
        let ends @ [a, b] = self.grid.ends(e);
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let mean = |f: &Scalar| edge_mean(f, ends, self.order);
        let load = system.load.entry(e).or_default();
        match condition {
            Boundary::Dirichlet { value } => {
                system.fixed.insert(e, mean(value));
            }
            Boundary::Neumann { flux } => *load += length * mean(flux),
            Boundary::Contact { gap, flux } => {
                *load += length * mean(flux);
                system.gap.insert(e, mean(gap));
            }
            Boundary::Robin { coefficient, ambient } => {
                let (h, u_ext) = (coefficient.clone(), ambient.clone());
                let product: Scalar = Arc::new(move |p| h(p) * u_ext(p));
                *load += length * mean(&product);
                *system.stiffness.entry((e, e)).or_default() += length * mean(coefficient);
            }
        }
    }
}

/// `normal` may have any length.
fn condition(exact: &Exact, kind: Kind, normal: [f64; 2]) -> Boundary {
    let (u, gradient, tensor) = (exact.u.clone(), exact.gradient.clone(), exact.tensor.clone());
    let length = normal[0].hypot(normal[1]);
    let flux = move |p| dot(apply(tensor(p), gradient(p)), normal) / length;
    match kind {
        Kind::Dirichlet => Boundary::Dirichlet { value: u },
        Kind::Neumann => Boundary::Neumann { flux: Arc::new(flux) },
        Kind::Contact => Boundary::Contact { gap: exact.gap.clone(), flux: constant(0.0) },
        Kind::Robin(h) => Boundary::Robin {
            coefficient: constant(h),
            ambient: Arc::new(move |p| u(p) + flux(p) / h),
        },
    }
}
