//! Small facts worked out by hand: limits that are just met, and figures that larger problems hide.

use signorini_kernel::conjugate;
use signorini_kernel::csr::Csr;
use signorini_kernel::error::Array;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::Mesh;
use signorini_kernel::mesh::boundary::Boundary;
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::mesh::edges::{Block, EdgeCounts, Edges};
use signorini_kernel::mesh::numbering::{NumberingBuffers, number};
use signorini_kernel::refinement;
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::rows::{Row, Rows};
use signorini_kernel::solver::{Settings, Solver, Status};
use signorini_kernel::system::Shifts;
use signorini_kernel::system::{Residual, System};
use signorini_kernel::{Error, Index, Libm, psor};

const NONE: u16 = u16::MAX;

/// The residual of a tridiagonal matrix (2 on the diagonal) whose last unknown is on a contact edge.
fn residual(load: &[f64], lower: f64, u: &[f64]) -> Result<Residual<f64>, Error> {
    let n = load.len();
    let (mut row_ptr, mut col_idx, mut values) = (vec![0], Vec::new(), Vec::new());
    for i in 0..n {
        col_idx.push(i as u16);
        values.push(2.0);
        for j in [i.wrapping_sub(1), i + 1].into_iter().filter(|&j| j < n) {
            col_idx.push(j as u16);
            values.push(-1.0);
        }
        row_ptr.push(values.len() as u32);
    }
    let counts = EdgeCounts { free: n - 1, contact: 1, dirichlet: 0 };
    let matrix = Csr::new(&row_ptr, &col_idx, &values, n)?;
    Ok(System::new(matrix, load, Law::above(&[lower]), counts)?.residual(u))
}

#[test]
fn rounding_is_measured_where_the_residual_comes_from() -> Result<(), Error> {
    // The opening 10 − 9.5 is less than what the load presses: the terms are 10 and 9.5.
    let pressed = residual(&[-100.0], 9.5, &[10.0])?;
    assert_eq!((pressed.largest, pressed.rounding), (0.5, 19.5 * f64::EPSILON));
    // On the gap with r = −1 + ½ + ½ = 0 both say 0; the terms are those of the row, (1 + ½ + ½)/2.
    let at_rest = residual(&[0.0, 0.0, -1.0], -0.25, &[0.0, 0.5, -0.25])?;
    assert_eq!((at_rest.active, at_rest.rounding), (1, f64::EPSILON));
    Ok(())
}

#[test]
fn as_many_edges_as_offsets_can_tell() -> Result<(), Error> {
    // 8 · 8191 is the last multiple of 8 below 2¹⁶.
    let quads: Vec<[u16; 4]> = (0..2047).map(|at| [0, 1, 2, 3].map(|k| 3 + 4 * at + k)).collect();
    let halves: Vec<[u16; 2]> = (0..8191).map(|half| [half, NONE]).collect();
    let counts = EdgeCounts { free: 8191, contact: 0, dirichlet: 0 };
    let edges = Edges::new(&[[0, 1, 2]], &quads, &halves, counts)?;
    let mut memory = vec![Row::<f64, u16, 6>::EMPTY; 8191];
    assert!(Rows::new(&edges, &mut memory).is_ok());
    Ok(())
}

#[test]
fn a_matrix_with_more_columns_than_edges_is_refused() -> Result<(), Error> {
    let counts = EdgeCounts { free: 1, contact: 0, dirichlet: 1 };
    let mut memory = [Row::<f64, u16, 2>::EMPTY; 1];
    for (column, fits) in [(1, true), (2, false)] {
        let (columns, values) = ([0, column], [2.0, -1.0]);
        let matrix = Csr::new(&[0, 2], &columns, &values, 3)?;
        assert_eq!(Rows::of_matrix(&matrix, counts, &mut memory).is_ok(), fits);
    }
    Ok(())
}

#[test]
fn relaxation_starts_in_its_range() {
    let starts = |relaxation| Solver::new(Settings { relaxation, ..Settings::default() }).is_ok();
    assert!(starts(Relaxation::Adaptive(1.0)) && starts(Relaxation::Adaptive(1.999)));
    for omega in [2.0, 0.5, 7.0, f64::NAN] {
        assert!(!starts(Relaxation::Adaptive(omega)), "{omega}");
    }
}

/// Two unknowns joined by a spring and held by nothing; the second one is a contact edge.
fn spring<R>(
    load: [f64; 2],
    contact: usize,
    work: impl FnOnce(&System<f64, u16>, &mut Rows<f64, u16, 2>) -> R,
) -> Result<R, Error> {
    let counts = EdgeCounts { free: 2 - contact, contact, dirichlet: 0 };
    let matrix = Csr::new(&[0, 2, 4], &[0_u16, 1, 1, 0], &[1.0, -1.0, 1.0, -1.0], 2)?;
    let lower = &[-1.0][..contact];
    let mut memory = [Row::EMPTY; 2];
    let mut rows = Rows::of_matrix(&matrix, counts, &mut memory)?;
    let system = System::new(matrix, &load, Law::above(lower), counts)?;
    let nothing = Boundary::new(&Edges::baked(&[], &[], &[], counts), &[], &[], &[])?;
    let diagonal = DiagonalTerms::new(&nothing);
    let system = system.with_shifts(Shifts { part: &[], parts: 1, diagonal })?;
    Ok(work(&system, &mut rows))
}

#[test]
fn a_shift_without_end_is_none() -> Result<(), Error> {
    // Nothing stops what is pulled down, and nothing pulls at what is in balance.
    for (load, contact) in [([-1.0, -1.0], 0), ([1.0, -1.0], 1)] {
        let mut u = [0.5, 0.5];
        let relaxation = Relaxation::Fixed(0.5);
        let settings = Settings { relaxation, max_sweeps: 12, ..Settings::default() };
        let outcome = spring(load, contact, |system, rows| {
            Solver::new(settings)?.run(system, rows, &mut u)
        })??;
        assert_eq!(outcome.status, Status::OutOfSweeps);
        assert!(u.iter().all(|u| u.is_finite()) && (contact == 0 || u[1] > -0.5), "{u:?}");
    }
    Ok(())
}

#[test]
fn the_longest_block_is_a_quarter_of_a_million_sweeps() -> Result<(), Error> {
    // With 2 − ω = 1e−5 an error falls by e^(−1e−5) a sweep: to 0.07 in 2¹⁸ of them.
    let settings = Settings {
        relaxation: Relaxation::Fixed(2.0 - 1e-5),
        tolerance: 0.2,
        scale: 1.0,
        ..Settings::default()
    };
    let matrix = Csr::new(&[0, 1], &[0_u16], &[1.0], 1)?;
    let counts = EdgeCounts { free: 1, contact: 0, dirichlet: 0 };
    let mut memory = [Row::<f64, u16, 2>::EMPTY; 1];
    let mut rows = Rows::of_matrix(&matrix, counts, &mut memory)?;
    let system = System::new(matrix, &[0.0], Law::above(&[]), counts)?;
    let outcome = Solver::new(settings)?.run(&system, &mut rows, &mut [1.0])?;
    assert_eq!((outcome.status, outcome.sweeps), (Status::Converged, 1 << 18));
    Ok(())
}

#[test]
fn conjugate_gradients_stop_where_numbers_overflow() -> Result<(), Error> {
    for load in [1e200, f64::MAX] {
        let mut u = [0.0, 0.0];
        let (direction, residual) = (&mut [0.0; 2], &mut [0.0; 2]);
        spring([load, -load], 0, |system, rows| {
            conjugate::run(system, rows, 0.0, 1, &mut u, [direction, residual])?;
            conjugate::run(system, rows, 0.0, 5, &mut u, [direction, residual])
        })??;
        assert!(u.iter().all(|u| u.is_finite()), "{u:?}");
    }
    Ok(())
}

/// b = 2¹⁰²⁰ and u = b/49, which no number is, leave a residual of rounding. The values next to u are held at 0, and 4000
/// u is too large: in differences the defect is no number.
#[test]
fn a_defect_that_overflows_is_no_correction() -> Result<(), Error> {
    let matrix = Csr::new(&[0, 3], &[0_u16, 1, 2], &[49.0, -4000.0, 3951.0], 3)?;
    let counts = EdgeCounts { free: 1, contact: 0, dirichlet: 2 };
    let mut memory = [Row::<f64, u16, 2>::EMPTY; 1];
    let load = [2.0_f64.powi(1020)];
    let system = System::new(matrix, &load, Law::above(&[]), counts)?;
    let nothing = Boundary::new(&Edges::baked(&[], &[], &[], counts), &[], &[], &[])?;
    let rows = Rows::of_matrix(&matrix, counts, &mut memory)?;
    let settings = Settings { tolerance: 0.0, ..Settings::default() };
    let (diagonal, mut u) = (DiagonalTerms::new(&nothing), [0.0; 3]);
    let (both, scratch) = ([&mut u[..], &mut [7.0; 3]], &mut [0.0; 5]);
    let outcome =
        refinement::run::<_, _, Libm, 2>(&system, diagonal, settings, 1, both, rows, scratch)?;
    assert_eq!(outcome.status, Status::NotFinite, "{outcome:?}");
    assert!(outcome.residual.largest.is_finite() && u[0] == load[0] / 49.0, "{u:?}");
    Ok(())
}

#[test]
fn a_value_that_is_not_finite_is_told_even_where_no_row_reads_it() -> Result<(), Error> {
    let matrix = Csr::new(&[0, 1], &[0_u16], &[1.0], 2)?;
    let counts = EdgeCounts { free: 1, contact: 0, dirichlet: 1 };
    let mut memory = [Row::<f64, u16, 2>::EMPTY; 1];
    let mut rows = Rows::of_matrix(&matrix, counts, &mut memory)?;
    let system = System::new(matrix, &[0.0], Law::above(&[]), counts)?;
    let mut solver = Solver::new(Settings::default())?;
    let outcome = solver.run(&system, &mut rows, &mut [0.5, f64::INFINITY])?;
    assert_eq!((outcome.status, outcome.residual.largest), (Status::NotFinite, 0.5));
    Ok(())
}

#[test]
fn edges_without_room_are_counted() -> Result<(), Error> {
    let vertices = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let cells = [[0_u16, 1, 2], [0, 2, 3]];
    let mesh = Mesh::new(&vertices, &cells, &[])?;
    let buffers = NumberingBuffers {
        of_triangles: &mut [[NONE; 3]; 2],
        of_quads: &mut [],
        half_edges: &mut [[NONE; 2]; 4],
        at_vertex: &mut [[NONE; 2]; 4],
        next: &mut [NONE; 6],
    };
    let refused = number(&mesh, buffers, |_| Some(Block::Free)).map(|_| ());
    assert_eq!(refused, Err(Error::Capacity { of: Array::Edges, needed: 5, limit: 4 }));
    Ok(())
}

fn swept<I: Index>() -> Result<[f64; 3], Error> {
    let index = |at: usize| I::new(at).unwrap_or(I::NONE);
    let columns = [0, 1, 1, 0, 2, 2, 1].map(index);
    let values = [2.0, -1.0, 2.0, -1.0, -1.0, 2.0, -1.0];
    let counts = EdgeCounts { free: 2, contact: 1, dirichlet: 0 };
    let matrix = Csr::new(&[0, 2, 5, 7], &columns, &values, 3)?;
    let mut memory = [Row::<f64, I, 2>::EMPTY; 3];
    let mut rows = Rows::of_matrix(&matrix, counts, &mut memory)?;
    rows.set(&System::new(matrix, &[1.0, 2.0, -9.0], Law::above(&[-1.0]), counts)?, 1.0)?;
    let mut u = [0.0, 3.0, 5.0];
    psor::sweep(&rows, Law::above(&[-1.0]), &mut u)?;
    Ok(u)
}

#[test]
fn a_sweep_is_the_same_with_wide_indices() -> Result<(), Error> {
    // (1 + 3)/2, (2 + 2 + 5)/2, max(−1, (−9 + 4½)/2)
    assert_eq!(swept::<u16>()?, [2.0, 4.5, -1.0]);
    assert_eq!(swept::<u32>()?, [2.0, 4.5, -1.0]);
    Ok(())
}
