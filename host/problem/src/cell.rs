//! Functions on one cell that carry boundary values inside: vertex functions and extensions.
//!
//! Each side E = ab of a cell has coordinates of its own, t ∈ \[0, 1\] from a to b and η ∈ \[0, 1\]
//! away from it. On a triangle with apex c they collapse there, on a quad they are x̂ and ŷ, turned:
//! ```text
//!         c  η = 1                 d ───────── c  η = 1
//!        / \                       │           │
//!       / | \    t = λ_b/(1−λ_c)   │     │     │
//!      /  |  \   η = λ_c           │     │     │
//!     a ──┴── b                    a ────┴──── b
//!       t ─►                         t ─►
//! ```
//! A function w(t) that is 0 at both ends becomes v = (1 − η) w(t): w on E, 0 on the other sides, and
//! ```text
//!   ∇v = w′(t) (1−η)∇t − w(t) ∇η,     on triangles (1−η)∇t = ∇λ_b + t ∇λ_c, ∇η = ∇λ_c.
//! ```

use signorini_kernel::element::rannacher_turek;
use signorini_kernel::mesh::geometry::{doubled_area, scaled_normal};

use crate::Problem;
use crate::bilinear::inverse_bilinear;
use crate::quadrature::{Point, on_quad, on_triangle};
use signorini_scene::mesh::Mesh;
use signorini_scene::mesh::shape::edge_length;

/// A value and its gradient at a point.
#[derive(Debug, Clone, Copy, Default)]
pub struct Jet {
    /// The value.
    pub value: f64,
    /// The gradient.
    pub gradient: [f64; 2],
}

impl Jet {
    /// Adds `factor` times another function.
    pub fn add(&mut self, factor: f64, other: Jet) {
        self.value += factor * other.value;
        self.gradient[0] += factor * other.gradient[0];
        self.gradient[1] += factor * other.gradient[1];
    }
}

/// The corners of a cell, counterclockwise.
#[derive(Debug, Clone, Copy)]
pub enum Cell {
    /// Of a triangle.
    Triangle([[f64; 2]; 3]),
    /// Of a quad.
    Quad([[f64; 2]; 4]),
}

/// The coordinates of one side at a point of its cell.
#[derive(Debug, Clone, Copy, Default)]
pub struct SideCoordinates {
    /// From 0 to 1 along the side.
    pub t: f64,
    /// 1 − η
    pub height: f64,
    /// (1 − η)∇t
    along: [f64; 2],
    /// ∇η
    away: [f64; 2],
}

/// All local functions at one point; a triangle's fourth entries stay 0.
#[derive(Debug, Clone, Copy, Default)]
pub struct Local {
    /// The P1 or Q1 functions of the vertices.
    pub vertices: [Jet; 4],
    /// Side k runs from vertex k to k + 1.
    pub sides: [SideCoordinates; 4],
    /// The area element of the reference coordinates: 2|T| or det DF.
    pub determinant: f64,
    /// Physical coordinates.
    pub x: [f64; 2],
}

impl SideCoordinates {
    /// (1 − η) w(t), from w and w′ at t.
    pub fn extension(&self, w: f64, slope: f64) -> Jet {
        let gradient = [0, 1].map(|k| slope * self.along[k] - w * self.away[k]);
        Jet { value: self.height * w, gradient }
    }

    /// The side's bubble 4t(1 − t)(1 − η).
    pub fn bubble(&self) -> Jet {
        self.extension(4.0 * self.t * (1.0 - self.t), 4.0 - 8.0 * self.t)
    }
}

impl Cell {
    /// Cell `cell` of the mesh, triangles first.
    pub fn of(problem: &Problem, cell: usize) -> Self {
        Self::in_mesh(&problem.mesh, cell)
    }

    /// Cell `cell` of a mesh, triangles first.
    pub fn in_mesh(mesh: &Mesh, cell: usize) -> Self {
        let corner = |vertex: u32| mesh.vertices[vertex as usize];
        match mesh.triangles.get(cell) {
            Some(vertices) => Self::Triangle(vertices.map(corner)),
            None => Self::Quad(mesh.quads[cell - mesh.triangles.len()].map(corner)),
        }
    }

    /// The corners, three or four.
    pub fn corners(&self) -> &[[f64; 2]] {
        match self {
            Self::Triangle(corners) => corners,
            Self::Quad(corners) => corners,
        }
    }

    /// This cell with so many times its lengths, a power of 2.
    #[must_use]
    pub fn scaled(self, by: f64) -> Self {
        match self {
            Self::Triangle(corners) => Self::Triangle(corners.map(|corner| corner.map(|x| by * x))),
            Self::Quad(corners) => Self::Quad(corners.map(|corner| corner.map(|x| by * x))),
        }
    }

    /// The mean of its corners.
    pub fn middle(&self) -> [f64; 2] {
        let corners = self.corners();
        let sum = |k: usize| corners.iter().map(|corner| corner[k]).sum::<f64>();
        [0, 1].map(|k| sum(k) / corners.len() as f64)
    }

    /// |T|
    pub fn area(&self) -> f64 {
        // That of the parallelogram of the diagonals of a quad, halved.
        let [[ax, ay], [bx, by]] = match *self {
            Self::Triangle([a, b, c]) => [[b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]],
            Self::Quad([a, b, c, d]) => [[c[0] - a[0], c[1] - a[1]], [d[0] - b[0], d[1] - b[1]]],
        };
        0.5 * (ax * by - ay * bx)
    }

    /// The largest distance between two of its points.
    pub fn diameter(&self) -> f64 {
        let pairs =
            self.corners().iter().flat_map(|&a| self.corners().iter().map(move |&b| [a, b]));
        pairs.map(edge_length).fold(0.0, f64::max)
    }

    /// f̄ at a point with area element `determinant`, for a load with the integral `load` over the
    /// cell: load/|T| on triangles, load/det DF on quads.
    pub fn spread(&self, load: f64, determinant: f64) -> f64 {
        match self {
            Self::Triangle(_) => 2.0 * load / determinant,
            Self::Quad(_) => load / determinant,
        }
    }

    /// Whether the area element is the same all over it, up to rounding.
    pub fn is_affine(&self) -> bool {
        const ROUNDING: f64 = 1e-14;
        self.distortion() <= ROUNDING * self.diameter()
    }

    /// By how much the fourth corner of a quad is off the parallelogram of the others.
    pub fn distortion(&self) -> f64 {
        let Self::Quad([a, b, c, d]) = self else { return 0.0 };
        let distortion = [0, 1].map(|k| (a[k] - b[k]) + (c[k] - d[k]));
        distortion[0].hypot(distortion[1])
    }

    /// Reference coordinates of a point.
    pub fn reference(&self, x: [f64; 2]) -> [f64; 3] {
        match *self {
            Self::Triangle([a, b, c]) => {
                let whole = doubled_area(a, b, c);
                let parts = [doubled_area(x, b, c), doubled_area(a, x, c), doubled_area(a, b, x)];
                parts.map(|part| part / whole)
            }
            Self::Quad(corners) => {
                let [x, y] = inverse_bilinear(corners, x);
                [x, y, 0.0]
            }
        }
    }

    /// The points of a one-dimensional rule's square on it.
    pub fn points(&self, rule: &[[f64; 2]]) -> Vec<Point> {
        match *self {
            Self::Triangle(corners) => on_triangle(corners, rule).collect(),
            Self::Quad(corners) => on_quad(corners, rule).collect(),
        }
    }

    /// Reference coordinates of the point (t, η) of side `side`.
    pub fn side_point(&self, side: usize, t: f64, eta: f64) -> [f64; 3] {
        match (self, side) {
            (Self::Triangle(_), _) => {
                let mut lambda = [0.0; 3];
                lambda[side] = (1.0 - t) * (1.0 - eta);
                lambda[(side + 1) % 3] = t * (1.0 - eta);
                lambda[(side + 2) % 3] = eta;
                lambda
            }
            (_, 0) => [t, eta, 0.0],
            (_, 1) => [1.0 - eta, t, 0.0],
            (_, 2) => [1.0 - t, 1.0 - eta, 0.0],
            _ => [eta, 1.0 - t, 0.0],
        }
    }

    /// dx dy per dt dη at a point of a side's coordinates.
    pub fn area_element(&self, local: &Local, eta: f64) -> f64 {
        match self {
            Self::Triangle(_) => local.determinant * (1.0 - eta),
            Self::Quad(_) => local.determinant,
        }
    }

    /// The area element of the reference coordinates there: 2|T| or det DF.
    pub fn determinant(&self, reference: [f64; 3]) -> f64 {
        match *self {
            Self::Triangle([a, b, c]) => doubled_area(a, b, c),
            Self::Quad(corners) => {
                rannacher_turek::place(corners, [reference[0], reference[1]]).determinant
            }
        }
    }

    /// All local functions at a point given by its reference coordinates.
    pub fn local(&self, reference: [f64; 3]) -> Local {
        match *self {
            Self::Triangle(corners) => triangle(corners, reference),
            Self::Quad(corners) => quad(corners, [reference[0], reference[1]]),
        }
    }
}

fn triangle(corners: [[f64; 2]; 3], lambda: [f64; 3]) -> Local {
    let [a, b, c] = corners;
    let doubled = doubled_area(a, b, c);
    let mut local = Local { determinant: doubled, ..Local::default() };
    for (k, &value) in lambda.iter().enumerate() {
        let opposite = scaled_normal(corners[(k + 1) % 3], corners[(k + 2) % 3]);
        let gradient = [-opposite.x / doubled, -opposite.y / doubled];
        local.vertices[k] = Jet { value, gradient };
        local.x = [0, 1].map(|axis| local.x[axis] + value * corners[k][axis]);
    }
    for (k, &start) in lambda.iter().enumerate() {
        let [end, apex] = [1, 2].map(|next| local.vertices[(k + next) % 3]);
        // 1 − λ_c as a sum, which does not cancel near the apex.
        let height = start + end.value;
        let t = end.value / height;
        let along = [0, 1].map(|axis| end.gradient[axis] + t * apex.gradient[axis]);
        local.sides[k] = SideCoordinates { t, height, along, away: apex.gradient };
    }
    local
}

fn quad(corners: [[f64; 2]; 4], [x, y]: [f64; 2]) -> Local {
    let place = rannacher_turek::place(corners, [x, y]);
    // x̂ and ŷ belong to the element's space: their gradients follow from their means over the sides.
    let by_x: [f64; 2] = place.gradient([0.5, 1.0, 0.5, 0.0]).into();
    let by_y: [f64; 2] = place.gradient([0.0, 0.5, 1.0, 0.5]).into();
    let minus = |v: [f64; 2]| [-v[0], -v[1]];
    let side = |t: f64, height: f64, towards: [f64; 2], away: [f64; 2]| SideCoordinates {
        t,
        height,
        along: [height * towards[0], height * towards[1]],
        away,
    };
    let product = |p: f64, dp: [f64; 2], q: f64, dq: [f64; 2]| Jet {
        value: p * q,
        gradient: [dp[0] * q + p * dq[0], dp[1] * q + p * dq[1]],
    };
    let (left, below) = (1.0 - x, 1.0 - y);
    Local {
        vertices: [
            product(left, minus(by_x), below, minus(by_y)),
            product(x, by_x, below, minus(by_y)),
            product(x, by_x, y, by_y),
            product(left, minus(by_x), y, by_y),
        ],
        sides: [
            side(x, below, by_x, by_y),
            side(y, x, by_y, minus(by_x)),
            side(left, y, minus(by_x), minus(by_y)),
            side(below, left, minus(by_y), by_x),
        ],
        determinant: place.determinant,
        x: place.x,
    }
}
