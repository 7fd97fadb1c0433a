//! The kernel's stages on the exported scenes, in the order of use; each prints what it computed.

mod matrix;
mod solve;

use signorini_device::model::Model;
use signorini_kernel::mesh::numbering::{NumberingBuffers, number};
use signorini_kernel::stiffness::{self, Coefficient};
use signorini_kernel::{Error, Libm, Micromath};

use crate::journal::{Bits, Journal};
use crate::scenes;

/// Room for the largest scene.
pub(crate) const VERTICES: usize = 900;
pub(crate) const CELLS: usize = 1600;
pub(crate) const EDGES: usize = 2500;
pub(crate) const ENTRIES: usize = 5 * EDGES;
pub(crate) const CONTACT: usize = 100;

/// What a stage does with a scene.
type Work<R> = fn(&Model<R, u16>, &mut Journal) -> Result<(), Error>;

/// One stage on every scene, in `f32` and in `f64`.
fn every(narrow: Work<f32>, wide: Work<f64>, journal: &mut Journal) {
    for model in [
        &scenes::levee_f32::MODEL,
        &scenes::slab_f32::MODEL,
        &scenes::strip_f32::MODEL,
        &scenes::membrane_f32::MODEL,
    ] {
        one(narrow, model, "f32", journal);
    }
    for model in [
        &scenes::levee_f64::MODEL,
        &scenes::slab_f64::MODEL,
        &scenes::strip_f64::MODEL,
        &scenes::membrane_f64::MODEL,
    ] {
        one(wide, model, "f64", journal);
    }
}

fn one<R: Bits>(work: Work<R>, model: &Model<R, u16>, scalar: &str, journal: &mut Journal) {
    journal.title(model.title, scalar);
    if work(model, journal).is_err() {
        journal.text("refused");
    }
}

/// Edge numbering and element matrices, computed anew from the mesh.
pub fn elements(journal: &mut Journal) {
    every(of_cells, of_cells, journal);
}

/// CSR, load and packed rows.
pub fn assembly(journal: &mut Journal) {
    every(matrix::assembly, matrix::assembly, journal);
}

/// A few sweeps and the residual after them.
pub fn sweeps(journal: &mut Journal) {
    every(matrix::sweeps, matrix::sweeps, journal);
}

/// The flux of an unfinished iterate, cell by cell and over the edges.
pub fn flux(journal: &mut Journal) {
    every(matrix::flux, matrix::flux, journal);
}

/// Whole solves, as `signorini solve` does them, with both square roots.
pub fn scenes(journal: &mut Journal) {
    every(
        |model, journal| {
            solve::scene::<f32, Libm>(model, journal)?;
            journal.text("with micromath");
            solve::scene::<f32, Micromath>(model, journal)
        },
        solve::scene::<f64, Libm>,
        journal,
    );
}

#[inline(never)]
fn of_cells<R: Bits>(model: &Model<R, u16>, journal: &mut Journal) -> Result<(), Error> {
    let mesh = model.mesh()?;
    let mut of_triangles = [[0; 3]; CELLS];
    let mut of_quads = [[0; 4]; CELLS];
    let (mut half_edges, mut at_vertex) = ([[0; 2]; 3 * CELLS], [[0; 2]; VERTICES]);
    let buffers = NumberingBuffers {
        of_triangles: cut(&mut of_triangles, model.triangles.len())?,
        of_quads: cut(&mut of_quads, model.quads.len())?,
        half_edges: &mut half_edges,
        at_vertex: cut(&mut at_vertex, model.vertices.len())?,
        next: &mut [0; 3 * CELLS],
    };
    let given = model.edges()?;
    let block = |ends: [u16; 2]| {
        let found = (0..model.counts.edges()).find(|&at| given.endpoints(&mesh, at) == ends);
        found.map(|at| model.counts.block(at))
    };
    let edges = number(&mesh, buffers, block)?;
    let same = edges.counts() == model.counts && edges.half_edges() == model.half_edges;
    journal.text(if same { "numbered as given" } else { "numbered otherwise" });

    let (mut triangles, mut quads) = ([[R::ZERO; 3]; CELLS], [[R::ZERO; 6]; CELLS]);
    let triangles = cut(&mut triangles, model.triangles.len())?;
    let quads = cut(&mut quads, model.quads.len())?;
    stiffness::fill(&mesh, Coefficient::PerCell(model.tensors), 8, triangles, quads)?;
    let bits = |k: &R| k.bits();
    let of_triangles = triangles.as_flattened().iter().map(bits);
    let of_quads = quads.as_flattened().iter().map(bits);
    let same = of_triangles.eq(model.stiffness.triangles.as_flattened().iter().map(bits))
        && of_quads.eq(model.stiffness.quads.as_flattened().iter().map(bits));
    journal.text(if same { "element matrices as given" } else { "element matrices differ" });
    let all = triangles.as_flattened().iter().chain(quads.as_flattened());
    journal.digest("element matrices", all.copied());
    Ok(())
}

/// The first entries of a buffer.
///
/// # Errors
/// A buffer that is too short.
pub fn cut<T>(buffer: &mut [T], length: usize) -> Result<&mut [T], Error> {
    let limit = buffer.len();
    let of = signorini_kernel::error::Array::Scratch;
    buffer.get_mut(..length).ok_or(Error::Capacity { of, needed: length, limit })
}
