//! The cost of surplus, by element matrices of which the scalar has lost something: a loss is never told as a small number.

use crate::owned::Packed;
use signorini_bound::certificate::{Metric, Stability};
use signorini_bound::equilibrium::is_root;
use signorini_device::condition::Condition;
use signorini_device::workspace;
use signorini_kernel::mesh::boundary::{Boundary, Robin};
use signorini_kernel::stiffness::{Coefficient, Stiffness};
use signorini_kernel::{Error, Mesh, Tensor};

type Small = workspace!(f64, u16: vertices 3, triangles 1, quads 0, boundary 3);

/// One triangle with this element matrix and 1/(4 det A), given on one side, or with ∫h there.
fn of_triangle(
    k: [f64; 3],
    compliance: f64,
    transfer: Option<f64>,
) -> Result<Stability<f64>, Error> {
    let vertices = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let mesh = Mesh::new(&vertices, &[[0, 1, 2]], &[])?;
    let mut small = Small::new();
    // Only its numbers of edges are used.
    small.build(&mesh, Coefficient::Uniform(Tensor::scalar(1.0)), |edge| {
        Some(match edge.vertices == [0, 1] && transfer.is_none() {
            true => Condition::Dirichlet { value: 0.0 },
            false => Condition::Neumann { flux: 0.0 },
        })
    })?;
    let edges = small.edges()?;
    let law = |coefficient| Robin { edge: 0, coefficient, ambient: 0.0 };
    let robin: Vec<_> = transfer.into_iter().map(law).collect();
    let boundary = Boundary::new(&edges, &[], &robin, &[])?;
    let (stiffness, a) = (Stiffness { triangles: &[k], quads: &[] }, [&[][..], &[compliance]]);
    let is_root = |edge| is_root(&edges, &boundary, edge);
    let packed = Packed::new((&mesh, &edges), stiffness, a, |_| 1.0, is_root)?;
    packed.stability(&edges, Metric::default(), &boundary)
}

/// The equilateral one, K₀₁ = K₁₂ = K₂₀ = −1 and 4 det A = 3: 1 out of a side costs −(K₁₂ + K₂₀ + 3K₀₁)/6 of 1/(4 det A),
/// 5/18, and κ is 1.
#[test]
fn a_sound_cell_is_told() -> Result<(), Error> {
    let found = of_triangle([-1.0; 3], 1.0 / 3.0, None)?;
    // A handful of roundings each.
    assert!((found.largest.powi(2) * 18.0 / 5.0 - 1.0).abs() < 1e-14, "{found:?}");
    assert!((found.weighed.powi(2) * 18.0 / 5.0 - 1.0).abs() < 1e-14, "{found:?}");
    assert_eq!(found.oblique, 64.0 * f64::EPSILON);
    // Behind a side with ∫h = 4 it costs ¼ more.
    let found = of_triangle([-1.0; 3], 1.0 / 3.0, Some(4.0))?;
    assert!((found.largest.powi(2) * 36.0 / 19.0 - 1.0).abs() < 1e-14, "{found:?}");
    Ok(())
}

#[test]
fn what_the_scalar_has_lost_is_unknown() -> Result<(), Error> {
    // 1/(4 det A) is the smallest number: times Σ|K| = 1.2 it is still one, times the ⅓ of the cost it is 0.
    let found = of_triangle([-0.4; 3], f64::from_bits(1), None)?;
    assert_eq!(found.largest, f64::INFINITY);
    // 1/(4 det A) has underflown, and the way through the transfer edge is known: the cell on it is not.
    let found = of_triangle([-1.0; 3], 0.0, Some(1.0))?;
    assert_eq!((found.largest, found.weighed), (f64::INFINITY, f64::INFINITY));
    // Rounded so that K₀₁K₁₂ + K₁₂K₂₀ + K₂₀K₀₁ = 4 det A is negative.
    let found = of_triangle([-1.0, -1.0, 0.6], 1.0, None)?;
    assert_eq!(found.oblique, f64::INFINITY);
    Ok(())
}
