//! Stages that a mesh takes before anything is assembled on it.

use criterion::{BatchSize, Bencher};
use signorini_kernel::Tensor;
use signorini_kernel::mesh::Mesh;
use signorini_kernel::mesh::edges::Block;
use signorini_kernel::mesh::numbering::{NumberingBuffers, number};
use signorini_kernel::stiffness::{self, Coefficient};
use signorini_problem::quadrature::DATA_POINTS;
use signorini_problem::scalar::Scalar;

use crate::strip::Strip;

pub fn vertices<R: Scalar>(strip: &Strip) -> Vec<[R; 2]> {
    strip.problem().mesh.vertices.iter().map(|vertex| vertex.map(R::narrow)).collect()
}

/// Indices, orientation, convexity.
pub fn check<R: Scalar>(bencher: &mut Bencher, strip: &Strip) {
    let (vertices, mesh) = (vertices::<R>(strip), &strip.problem().mesh);
    bencher.iter(|| Mesh::new(&vertices, &mesh.triangles, &mesh.quads).is_ok());
}

/// Edges from cells.
pub fn numbering<R: Scalar>(bencher: &mut Bencher, strip: &Strip) {
    let (vertices, mesh) = (vertices::<R>(strip), &strip.problem().mesh);
    let mesh = Mesh::new(&vertices, &mesh.triangles, &mesh.quads).expect("the cells are convex");
    let sides = mesh.half_edges();
    let memory = || Memory {
        of_triangles: vec![[0; 3]; mesh.triangles().len()],
        of_quads: vec![[0; 4]; mesh.quads().len()],
        half_edges: vec![[0; 2]; sides],
        at_vertex: vec![[0; 2]; vertices.len()],
        next: vec![0; sides],
    };
    let run = |memory: &mut Memory| {
        let buffers = NumberingBuffers {
            of_triangles: &mut memory.of_triangles,
            of_quads: &mut memory.of_quads,
            half_edges: &mut memory.half_edges,
            at_vertex: &mut memory.at_vertex,
            next: &mut memory.next,
        };
        number(&mesh, buffers, |_| Some(Block::Free)).map(|edges| edges.counts().edges())
    };
    assert_eq!(run(&mut memory()), Ok(strip.problem().topology.counts.edges()));
    bencher.iter_batched_ref(memory, run, BatchSize::LargeInput);
}

struct Memory {
    of_triangles: Vec<[u32; 3]>,
    of_quads: Vec<[u32; 4]>,
    half_edges: Vec<[u32; 2]>,
    at_vertex: Vec<[u32; 2]>,
    next: Vec<u32>,
}

/// One matrix for each cell; quads by 8 × 8 points.
pub fn matrices<R: Scalar>(bencher: &mut Bencher, strip: &Strip) {
    let (vertices, mesh) = (vertices::<R>(strip), &strip.problem().mesh);
    let mesh = Mesh::new(&vertices, &mesh.triangles, &mesh.quads).expect("the cells are convex");
    let mut triangles = vec![[R::ZERO; 3]; mesh.triangles().len()];
    let mut quads = vec![[R::ZERO; 6]; mesh.quads().len()];
    let uniform = Coefficient::Uniform(Tensor::scalar(R::ONE));
    bencher.iter(|| stiffness::fill(&mesh, uniform, DATA_POINTS, &mut triangles, &mut quads));
}
