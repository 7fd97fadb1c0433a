//! A gradient that is affine in each cell and nearer to ∇u, from one that jumps between cells.
//!
//! Around a vertex v the cells of one material form a patch. What p lacks of ∇u nearly cancels in its
//! mean over a patch (Zienkiewicz and Zhu), which is the value at the patch's centroid c_v: v itself
//! inside a regular mesh, a point farther in on a boundary.
//! ```text
//!   c_v = Σ_T ∫_T x / Σ_T |T|,   g_v = Σ_T ∫_T p / Σ_T |T|,
//!   G on a cell: the affine function nearest to the g_v at the c_v of its corners v.
//! ```
//! The reference is then near enough to measure quads, several times nearer to the solution than
//! triangles, on a mesh of triangles. Across materials ∇u itself jumps.

use std::collections::HashMap;

use signorini_certify::cell::Cell;
use signorini_certify::conductivity::{dot, product};
use signorini_certify::weighed::minus;
use signorini_kernel::Tensor;
use signorini_problem::Problem;
use signorini_problem::quadrature::{Point, gauss};

/// Points a direction: exact to degree 2 on triangles and 5 along both sides of quads, enough for the
/// squares of differences of linear fields where A is constant and the meshes are nested.
const ON_TRIANGLES: usize = 2;
const ON_QUADS: usize = 3;

#[derive(Debug, Clone, Copy)]
pub(super) struct Inside {
    pub(super) x: [f64; 2],
    /// An element of area.
    pub(super) weight: f64,
    pub(super) u: f64,
    pub(super) gradient: [f64; 2],
    pub(super) conductivity: Tensor<f64>,
}

pub(super) fn points(cell: &Cell) -> Vec<Point> {
    cell.points(&gauss(match cell {
        Cell::Triangle(_) => ON_TRIANGLES,
        Cell::Quad(_) => ON_QUADS,
    }))
}

/// The centroids of a thin part's patches lie on a line and fix no slope: below this part of the
/// corners' own spread the vertices take their place.
const SPREAD: f64 = 0.05;

/// |T|, ∫x and ∫p over the cells of one material at a vertex.
#[derive(Default)]
struct Patch {
    area: f64,
    place: [f64; 2],
    gradient: [f64; 2],
}

type Patches = HashMap<(u32, u32), Patch>;

/// Replaces the gradients p at the points of all cells by G; ‖A^½(p − G)‖.
pub(super) fn smooth(problem: &Problem, inside: &mut [Inside]) -> f64 {
    let patches = collect(problem, inside);
    let (mut rest, mut square) = (inside, 0.0);
    for at in 0..problem.cells() {
        let cell = Cell::of(problem, at);
        let (here, others) = rest.split_at_mut(points(&cell).len());
        rest = others;
        let material = problem.binding.materials[at];
        let corners =
            problem.mesh.corners_of(at).iter().map(|&vertex| &patches[&(vertex, material)]);
        let affine = Affine::nearest(cell.corners(), &corners.collect::<Vec<_>>());
        for known in here {
            let gradient = affine.at(known.x);
            let change = minus(known.gradient, gradient);
            square += known.weight * product(&known.conductivity, change, change);
            known.gradient = gradient;
        }
    }
    square.sqrt()
}

fn collect(problem: &Problem, inside: &[Inside]) -> Patches {
    let (mut patches, mut rest) = (Patches::new(), inside);
    for at in 0..problem.cells() {
        let (here, others) = rest.split_at(points(&Cell::of(problem, at)).len());
        rest = others;
        for vertex in problem.mesh.corners_of(at) {
            let patch = patches.entry((*vertex, problem.binding.materials[at])).or_default();
            for known in here {
                patch.add(known);
            }
        }
    }
    patches
}

impl Patch {
    fn add(&mut self, known: &Inside) {
        self.area += known.weight;
        self.place = [0, 1].map(|k| self.place[k] + known.weight * known.x[k]);
        self.gradient = [0, 1].map(|k| self.gradient[k] + known.weight * known.gradient[k]);
    }
}

/// value + slope (x − centre)
struct Affine {
    centre: [f64; 2],
    value: [f64; 2],
    slope: [[f64; 2]; 2],
}

impl Affine {
    /// By least squares through the means of the patches of a cell's corners.
    fn nearest(corners: &[[f64; 2]], patches: &[&Patch]) -> Self {
        let places: Vec<_> =
            patches.iter().map(|patch| patch.place.map(|x| x / patch.area)).collect();
        let values: Vec<_> =
            patches.iter().map(|patch| patch.gradient.map(|p| p / patch.area)).collect();
        let is_thin = determinant(spread(&places)) < SPREAD * determinant(spread(corners));
        Self::through(if is_thin { corners } else { &places }, &values)
    }

    /// slope = (Σ δg δxᵀ)(Σ δx δxᵀ)⁻¹ with the distances δ from the means.
    fn through(places: &[[f64; 2]], values: &[[f64; 2]]) -> Self {
        let (centre, value) = (mean(places), mean(values));
        let [xx, xy, yy] = spread(places);
        let determinant = determinant([xx, xy, yy]);
        let slope = [0, 1].map(|k| {
            let mut moment = [0.0; 2];
            for (place, g) in places.iter().zip(values) {
                let (away, change) = (minus(*place, centre), g[k] - value[k]);
                moment = [moment[0] + change * away[0], moment[1] + change * away[1]];
            }
            let [x, y] = moment;
            [(x * yy - y * xy) / determinant, (y * xx - x * xy) / determinant]
        });
        Self { centre, value, slope }
    }

    fn at(&self, x: [f64; 2]) -> [f64; 2] {
        let away = minus(x, self.centre);
        [0, 1].map(|k| self.value[k] + dot(self.slope[k], away))
    }
}

/// Σ δx δxᵀ: xx, xy, yy
fn spread(places: &[[f64; 2]]) -> [f64; 3] {
    let centre = mean(places);
    places.iter().fold([0.0; 3], |[xx, xy, yy], place| {
        let [x, y] = minus(*place, centre);
        [xx + x * x, xy + x * y, yy + y * y]
    })
}

fn determinant([xx, xy, yy]: [f64; 3]) -> f64 {
    xx * yy - xy * xy
}

fn mean(points: &[[f64; 2]]) -> [f64; 2] {
    let sum = points.iter().fold([0.0; 2], |sum, point| [sum[0] + point[0], sum[1] + point[1]]);
    sum.map(|x| x / points.len() as f64)
}
