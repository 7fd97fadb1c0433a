//! The kernel's stages one after the other, on any numbering: matrix, solver, rows, flux, certificate.

use signorini_kernel::assembly::{self, CellLoads};
use signorini_kernel::csr::Csr;
use signorini_kernel::flux_range::Spans;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::Mesh;
use signorini_kernel::mesh::components::{Part, examine};
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::mesh::edges::{EdgeCounts, Edges};
use signorini_kernel::refinement;
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::{QUADS, Row, Rows};
use signorini_kernel::solver::{Outcome, Settings, Status};
use signorini_kernel::stiffness::{self, Coefficient, Stiffness};
use signorini_kernel::system::{Shifts, System};
use signorini_kernel::{Error, Libm, Tensor, flux, psor};

use super::bytes::{Bits, Bytes};
use super::certified::{Conditions, Foundation, Loads, judged};

/// Element matrices: of a mesh with any tensors, or any numbers.
pub type Matrices<R> = (Vec<[R; 3]>, Vec<[R; 6]>);

/// Runs all of them until one refuses.
pub fn all<R: Bits>(
    bytes: &mut Bytes,
    mesh: &Mesh<R, u16>,
    edges: &Edges<u16>,
    matrices: Matrices<R>,
) -> Result<(), Error> {
    let wild = bytes.flag();
    let conditions = Conditions::<R>::new(bytes, edges, wild);
    let boundary = conditions.boundary(edges)?;
    let k = Stiffness { triangles: &matrices.0, quads: &matrices.1 };
    // Which of them refuses says nothing of the others.
    let _ = solved(bytes, edges, k, &conditions);
    let _ = swept(bytes, edges, k, &conditions);
    let foundation = Foundation::new(bytes, mesh, edges, &boundary, matrices, wild)?;
    let loads = Loads::new(bytes, edges, conditions);
    judged(bytes, &foundation.discretization(*mesh, *edges)?, &loads)
}

/// Element matrices of `mesh` by any coefficients and any rule.
pub fn filled<R: Bits>(bytes: &mut Bytes, mesh: &Mesh<R, u16>) -> Result<Matrices<R>, Error> {
    let (t, q) = (mesh.triangles().len(), mesh.quads().len());
    let mut matrices = (vec![[R::ZERO; 3]; t], vec![[R::ZERO; 6]; q]);
    let points = bytes.below(10);
    let tensor = |bytes: &mut Bytes| {
        let [xx, xy, yy] = [(); 3].map(|()| bytes.real());
        Tensor { xx, xy, yy }
    };
    let kind = bytes.below(4);
    let count = if kind == 1 { t + q } else { t + q * points * points };
    let tensors: Vec<_> = match kind {
        1 => (0..count).map(|_| tensor(bytes)).collect(),
        // All points but the first alike, which spares bytes.
        2 => {
            let (first, rest) = (tensor(bytes), tensor(bytes));
            (0..count).map(|at| if at == 0 { first } else { rest }).collect()
        }
        _ => Vec::new(),
    };
    let coefficient = match kind {
        1 => Coefficient::PerCell(&tensors),
        2 => Coefficient::PerPoint(&tensors),
        3 => Coefficient::Uniform(Tensor::scalar(bytes.real())),
        _ => Coefficient::Uniform(tensor(bytes)),
    };
    stiffness::fill(mesh, coefficient, points, &mut matrices.0, &mut matrices.1)?;
    let entries = matrices.0.as_flattened().iter().chain(matrices.1.as_flattened());
    assert!(entries.clone().all(|entry| entry.finite()));
    Ok(matrices)
}

/// Matrix and load, then the solver for some sweeps.
fn solved<R: Bits>(
    bytes: &mut Bytes,
    edges: &Edges<u16>,
    k: Stiffness<R>,
    conditions: &Conditions<R>,
) -> Result<(), Error> {
    let (counts, boundary) = (edges.counts(), conditions.boundary(edges)?);
    let diagonal = DiagonalTerms::new(&boundary);
    let nonzeros = edges.nonzeros();
    let (mut row_ptr, mut col_idx) = (vec![0; counts.unknowns() + 1], vec![0; nonzeros]);
    assembly::pattern(edges, &mut row_ptr, &mut col_idx)?;
    let (mut values, mut load) = (vec![R::ZERO; nonzeros], vec![R::ZERO; counts.unknowns()]);
    assembly::values(edges, k, diagonal, &row_ptr, &mut values)?;
    let (triangles, quads) = (bytes.reals(k.triangles.len()), bytes.reals(k.quads.len()));
    let cells = CellLoads { triangles: &triangles, quads: &quads };
    assembly::load(edges, cells, &boundary, &mut load)?;
    let spans = bytes.spans(counts.contact);
    let (spans, parts) = (Spans::new(&spans)?, &mut vec![Part::default(); edges.cells()]);
    let _ = examine(edges, diagonal, (&load, spans), bytes.real(), parts);
    let matrix = Csr::new(&row_ptr, &col_idx, &values, counts.edges())?;
    let mut memory = vec![Row::EMPTY; counts.unknowns()];
    let rows = Rows::<R, u16, QUADS>::new(edges, &mut memory)?;
    let lower = bytes.reals(counts.contact);
    let system = System::new(matrix, &load, Law::above(&lower).with_spans(spans), counts)?;
    let u = iterated(bytes, &system, diagonal, rows)?;
    let mut fluxes = vec![R::ZERO; u.len()];
    flux::recover(edges, k, cells, &u, &[], &mut fluxes).map(drop)
}

/// The iterate of a system after some sweeps from anywhere.
pub fn iterated<R: Bits, const WIDTH: usize>(
    bytes: &mut Bytes,
    system: &System<R, u16>,
    diagonal: DiagonalTerms<R, u16>,
    rows: Rows<R, u16, WIDTH>,
) -> Result<Vec<R>, Error> {
    let counts = system.counts();
    let shifts = Shifts { part: &[], parts: bytes.below(3), diagonal };
    let system = if bytes.flag() { system.with_shifts(shifts)? } else { *system };
    let low = &mut vec![R::ZERO; counts.edges()];
    let scratch = &mut vec![R::ZERO; refinement::scratch(counts)];
    let mut u = bytes.reals(counts.edges());
    let (settings, rounds) = (settings(bytes), bytes.below(4) as u32);
    let both = [&mut u[..], low];
    let outcome = refinement::run::<R, u16, Libm, WIDTH>(
        &system, diagonal, settings, rounds, both, rows, scratch,
    )?;
    sound(&outcome, counts, system.law(), &u);
    Ok(u)
}

fn settings<R: Bits>(bytes: &mut Bytes) -> Settings<R> {
    let omega = bytes.real();
    Settings {
        relaxation: match bytes.below(3) {
            0 => Relaxation::Fixed(omega),
            1 => Relaxation::Adaptive(omega),
            _ => Relaxation::for_unknowns(bytes.below(200)),
        },
        tolerance: bytes.real(),
        accuracy: bytes.real(),
        scale: bytes.real(),
        max_sweeps: bytes.below(100) as u32,
    }
}

/// An iterate that is no overflow is finite and on a side of the gap that there is.
fn sound<R: Bits>(outcome: &Outcome<R>, counts: EdgeCounts, law: Law<R>, u: &[R]) {
    if outcome.status == Status::NotFinite {
        return;
    }
    assert!(u.iter().take(counts.unknowns()).all(|u| u.finite()), "{outcome:?} {u:?}");
    let contact = u.iter().skip(counts.free).zip(law.edges());
    assert!(contact.into_iter().all(|(u, law)| law.admits(*u)), "{outcome:?} {u:?}");
    let residual = outcome.residual;
    assert!(residual.largest.finite() && residual.largest >= R::ZERO, "{outcome:?}");
}

/// Rows straight from element matrices, of any numbers.
fn swept<R: Bits>(
    bytes: &mut Bytes,
    edges: &Edges<u16>,
    k: Stiffness<R>,
    conditions: &Conditions<R>,
) -> Result<(), Error> {
    let counts = edges.counts();
    let mut memory = vec![Row::EMPTY; counts.unknowns()];
    let mut rows = Rows::<R, u16, QUADS>::new(edges, &mut memory)?;
    let (load, lower) = (bytes.reals(counts.unknowns()), bytes.reals(counts.contact));
    let mut u = bytes.reals(counts.edges());
    let diagonal = DiagonalTerms::new(&conditions.boundary(edges)?);
    rows.gather(edges, k, diagonal, &load, bytes.real())?;
    let spans = bytes.spans(counts.contact);
    let law = Law::above(&lower).with_spans(Spans::new(&spans)?);
    for _ in 0..bytes.below(5) {
        psor::sweep(&rows, law, &mut u)?;
        let defect = psor::defect(&rows, law, &u)?;
        assert!(defect.largest.wide().is_nan() || defect.largest >= R::ZERO, "{defect:?}");
    }
    psor::sweep_free(&rows, &mut u)
}
