//! Element matrices.

use criterion::Bencher;
use signorini_kernel::Tensor;
use signorini_kernel::mesh::Mesh;
use signorini_kernel::stiffness::{self, Coefficient};
use signorini_problem::quadrature::DATA_POINTS;
use signorini_problem::scalar::Scalar;

use crate::mesh;
use crate::strip::Strip;

/// One matrix for each cell; quads by 8 × 8 points.
pub fn matrices<R: Scalar>(bencher: &mut Bencher, strip: &Strip) {
    let (vertices, mesh) = (mesh::vertices::<R>(strip), &strip.problem().mesh);
    let mesh = Mesh::new(&vertices, &mesh.triangles, &mesh.quads).expect("the cells are convex");
    let mut triangles = vec![[R::ZERO; 3]; mesh.triangles().len()];
    let mut quads = vec![[R::ZERO; 6]; mesh.quads().len()];
    let uniform = Coefficient::Uniform(Tensor::scalar(R::ONE));
    bencher.iter(|| stiffness::fill(&mesh, uniform, DATA_POINTS, &mut triangles, &mut quads));
}
