//! Workspaces on a small square, and what is said of it.

mod data;
mod exact;
mod hostile;
mod layers;

use signorini_device::condition::{BoundaryEdge, Condition};
use signorini_device::tick::Limits;
use signorini_device::workspace;
use signorini_kernel::stiffness::Coefficient;
use signorini_kernel::{Error, Mesh, Real, Tensor};

pub type Plate<R = f64> = workspace!(R, u16: vertices 16, triangles 16, quads 4, boundary 16);
pub type Edge = BoundaryEdge<f64, u16>;

pub const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
/// Cut along its diagonal.
pub const TWO: [[u16; 3]; 2] = [[0, 1, 2], [0, 2, 3]];
pub const ONE: Tensor<f64> = Tensor { xx: 1.0, xy: 0.0, yy: 1.0 };
pub const UNIT: Coefficient<'static, f64> = Coefficient::Uniform(ONE);
/// Nothing passes.
pub const OPEN: Condition<f64> = Condition::Neumann { flux: 0.0 };
pub const ZERO: Condition<f64> = Condition::Dirichlet { value: 0.0 };

/// A workspace with this A and these conditions.
pub fn built(
    mesh: &Mesh<f64, u16>,
    a: Coefficient<f64>,
    condition: impl FnMut(&Edge) -> Option<Condition<f64>>,
) -> Result<Plate, Error> {
    let mut plate = Plate::new();
    plate.build(mesh, a, condition)?;
    Ok(plate)
}

/// Conditions where x = 0, where x is this, and on the rest.
pub fn sides<R: Real>(
    length: R,
    [left, right, rest]: [Condition<R>; 3],
) -> impl Fn(&BoundaryEdge<R, u16>) -> Option<Condition<R>> {
    move |edge| {
        let [x, _] = edge.middle();
        Some(if x == R::ZERO {
            left
        } else if x == length {
            right
        } else {
            rest
        })
    }
}

/// One condition from vertex 0 to 1 and one from there to vertex 2; nothing passes the rest.
fn beside(
    first: Condition<f64>,
    second: Condition<f64>,
) -> impl Fn(&Edge) -> Option<Condition<f64>> {
    move |edge| {
        Some(match edge.vertices {
            [0, 1] => first,
            [1, 2] => second,
            _ => OPEN,
        })
    }
}

/// So many sweeps at most, to the last digits.
fn sweeps<R: Real>(sweeps: u32) -> Limits<R> {
    Limits { error: R::ZERO, share: R::EPSILON, sweeps }
}
