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
use signorini_kernel::system::System;
use signorini_kernel::{Error, Index, Libm, psor};
use signorini_tolerances::kernel::SOLVED;

const NONE: u16 = u16::MAX;

/// The entries of a row by columns, the diagonal first.
type Entries = &'static [(usize, f64)];

/// The chain −u″ = f of three unknowns.
const CHAIN: [Entries; 3] =
    [&[(0, 2.0), (1, -1.0)], &[(1, 2.0), (0, -1.0), (2, -1.0)], &[(2, 2.0), (1, -1.0)]];
/// Its last unknown is on a contact edge.
const OF_CHAIN: EdgeCounts = EdgeCounts { free: 2, contact: 1, dirichlet: 0 };
const FREE: EdgeCounts = EdgeCounts { free: 1, contact: 0, dirichlet: 0 };

/// Hands on a system of these rows, and the rows packed.
fn posed<I: Index, T, const N: usize>(
    rows: [Entries; N],
    counts: EdgeCounts,
    load: [f64; N],
    lower: &[f64],
    work: impl FnOnce(System<f64, I>, Rows<f64, I, 2>) -> Result<T, Error>,
) -> Result<T, Error> {
    let ends = (0..=N).map(|row| rows[..row].iter().map(|row| row.len() as u32).sum());
    let (columns, values): (Vec<_>, Vec<_>) = rows.concat().into_iter().unzip();
    let columns: Vec<_> = columns.into_iter().filter_map(I::new).collect();
    let ends: Vec<u32> = ends.collect();
    let matrix = Csr::new(&ends, &columns, &values, counts.edges())?;
    let mut memory = [Row::EMPTY; N];
    let rows = Rows::of_matrix(&matrix, counts, &mut memory)?;
    work(System::new(matrix, &load, Law::above(lower), counts)?, rows)
}

#[test]
fn rounding_is_measured_where_the_residual_comes_from() -> Result<(), Error> {
    // The opening 10 − 9.5 is less than what the load presses: the terms are 10 and 9.5.
    let on_contact = EdgeCounts { free: 0, contact: 1, dirichlet: 0 };
    let pressed = posed::<u16, _, 1>([&[(0, 2.0)]], on_contact, [-100.0], &[9.5], |of, _| {
        Ok(of.residual(&[10.0]))
    })?;
    assert_eq!((pressed.largest, pressed.rounding), (0.5, 19.5 * f64::EPSILON));
    // On the gap with r = −1 + ½ + ½ = 0 both say 0; the terms are those of the row, (1 + ½ + ½)/2.
    let at_rest = posed::<u16, _, 3>(CHAIN, OF_CHAIN, [0.0, 0.0, -1.0], &[-0.25], |of, _| {
        Ok(of.residual(&[0.0, 0.5, -0.25]))
    })?;
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
    let starts = |relaxation| Solver::new(Settings { relaxation, ..Settings::default() }).err();
    assert_eq!([1.0, 1.999].map(|omega| starts(Relaxation::Adaptive(omega))), [None; 2]);
    for omega in [2.0, 0.5, 7.0, f64::NAN] {
        assert_eq!(starts(Relaxation::Adaptive(omega)), Some(Error::Relaxation), "{omega}");
    }
    for omega in [0.0, 2.0, -1.0, f64::NAN] {
        assert_eq!(starts(Relaxation::Fixed(omega)), Some(Error::Relaxation), "{omega}");
    }
}

#[test]
fn a_system_refuses_loads_and_gaps_that_are_no_numbers() {
    let counts = EdgeCounts { free: 0, contact: 1, dirichlet: 0 };
    for wrong in [f64::NAN, f64::INFINITY] {
        for (load, gap, of) in [(wrong, 0.0, Array::Load), (0.0, wrong, Array::LowerBounds)] {
            let refused = posed::<u16, _, 1>([&[(0, 1.0)]], counts, [load], &[gap], |_, _| Ok(()));
            assert_eq!(refused, Err(Error::NotFinite { of, at: 0 }));
        }
    }
}

/// Solves the chain pressed by −1 onto −½; how it ended, and u.
fn solved(settings: Settings<f64>, start: [f64; 3]) -> Result<(Status, [f64; 3]), Error> {
    posed::<u16, _, 3>(CHAIN, OF_CHAIN, [-1.0; 3], &[-0.5], |system, mut rows| {
        let mut u = start;
        let outcome = Solver::new(settings)?.run(&system, &mut rows, &mut u)?;
        Ok((outcome.status, u))
    })
}

#[test]
fn every_start_and_every_relaxation_lead_to_the_same_answer() -> Result<(), Error> {
    let factors = [0.5, 1.0, 1.5, 1.9].map(Relaxation::Fixed);
    for relaxation in factors.into_iter().chain([Relaxation::Adaptive(1.0)]) {
        // The gap lifts what is not a number.
        for start in [[0.0; 3], [1e6, -1e6, 1e6], [-7.0, 3.0, f64::NAN]] {
            let settings = Settings { relaxation, tolerance: 1e-14, ..Settings::default() };
            let (status, u) = solved(settings, start)?;
            assert_eq!(status, Status::Converged, "{relaxation:?} from {start:?}");
            // u₃ = −½ is active; 2u₁ − u₂ = −1 and −u₁ + 2u₂ = −1 − ½ give u₁ = −7/6, u₂ = −4/3.
            let what = format!("{relaxation:?} from {start:?}");
            SOLVED.check_each(what, &u, &[-7.0 / 6.0, -4.0 / 3.0, -0.5]);
        }
    }
    Ok(())
}

#[test]
fn every_way_to_end() -> Result<(), Error> {
    let settings = Settings::<f64>::default();
    let run = |settings, start| solved(settings, start).map(|(status, _)| status);
    let near = Settings { tolerance: 1e-6, ..settings };
    assert_eq!(run(near, [0.0; 3])?, Status::Converged);
    assert_eq!(run(Settings { max_sweeps: 1, ..settings }, [0.0; 3])?, Status::OutOfSweeps);
    let ended = run(settings, [0.0; 3])?;
    assert!(matches!(ended, Status::RoundingLimit | Status::Converged), "{ended:?}");
    assert_eq!(run(settings, [f64::INFINITY, 0.0, 0.0])?, Status::NotFinite);
    Ok(())
}

/// Two unknowns joined by a spring and held by nothing; the second one is a contact edge.
fn spring<T>(
    load: [f64; 2],
    contact: usize,
    work: impl FnOnce(&System<f64, u16>, &mut Rows<f64, u16, 2>) -> Result<T, Error>,
) -> Result<T, Error> {
    let counts = EdgeCounts { free: 2 - contact, contact, dirichlet: 0 };
    let rows: [Entries; 2] = [&[(0, 1.0), (1, -1.0)], &[(1, 1.0), (0, -1.0)]];
    let nothing = Boundary::new(&Edges::baked(&[], &[], &[], counts), &[], &[], &[])?;
    let shifts = Shifts { part: &[], parts: 1, diagonal: DiagonalTerms::new(&nothing) };
    posed(rows, counts, load, &[-1.0][..contact], |system, mut rows| {
        work(&system.with_shifts(shifts)?, &mut rows)
    })
}

#[test]
fn a_shift_without_end_is_none() -> Result<(), Error> {
    // Nothing stops what is pulled down, and nothing pulls at what is in balance.
    for (load, contact) in [([-1.0, -1.0], 0), ([1.0, -1.0], 1)] {
        let mut u = [0.5, 0.5];
        let relaxation = Relaxation::Fixed(0.5);
        let settings = Settings { relaxation, max_sweeps: 12, ..Settings::default() };
        let outcome =
            spring(load, contact, |system, rows| Solver::new(settings)?.run(system, rows, &mut u))?;
        assert_eq!(outcome.status, Status::OutOfSweeps);
        assert!(u.iter().all(|u| u.is_finite()) && (contact == 0 || u[1] > -0.5), "{u:?}");
    }
    Ok(())
}

#[test]
fn the_longest_block_is_a_quarter_of_a_million_sweeps() -> Result<(), Error> {
    let plain = Settings::default();
    for (off, settings, ended, sweeps) in [
        // With 2 − ω = 1e−5 an error falls by e^(−1e−5) a sweep: to 0.07 in 2¹⁸ of them.
        (1e-5, Settings { tolerance: 0.2, scale: 1.0, ..plain }, Status::Converged, 1 << 18),
        // ω next to 2 keeps u going to and fro: no fall for 8 of the longest blocks is a stall.
        (1e-9, Settings { max_sweeps: u32::MAX, ..plain }, Status::Stalled, 9 << 18),
    ] {
        let settings = Settings { relaxation: Relaxation::Fixed(2.0 - off), ..settings };
        let outcome = posed::<u16, _, 1>([&[(0, 1.0)]], FREE, [0.0], &[], |system, mut rows| {
            Solver::new(settings)?.run(&system, &mut rows, &mut [1.0])
        })?;
        assert_eq!((outcome.status, outcome.sweeps), (ended, sweeps));
    }
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
        })?;
        assert!(u.iter().all(|u| u.is_finite()), "{u:?}");
    }
    Ok(())
}

/// b = 2¹⁰²⁰ and u = b/49, which no number is, leave a residual of rounding. The values next to u are held at 0, and 4000
/// u is too large: in differences the defect is no number.
#[test]
fn a_defect_that_overflows_is_no_correction() -> Result<(), Error> {
    let counts = EdgeCounts { dirichlet: 2, ..FREE };
    let load = 2.0_f64.powi(1020);
    let nothing = Boundary::new(&Edges::baked(&[], &[], &[], counts), &[], &[], &[])?;
    let (diagonal, mut u) = (DiagonalTerms::new(&nothing), [0.0; 3]);
    let row: Entries = &[(0, 49.0), (1, -4000.0), (2, 3951.0)];
    let outcome = posed::<u16, _, 1>([row], counts, [load], &[], |system, rows| {
        let settings = Settings { tolerance: 0.0, ..Settings::default() };
        let (both, scratch) = ([&mut u[..], &mut [7.0; 3]], &mut [0.0; 5]);
        refinement::run::<_, _, Libm, 2>(&system, diagonal, settings, 1, both, rows, scratch)
    })?;
    assert_eq!(outcome.status, Status::NotFinite, "{outcome:?}");
    assert!(outcome.residual.largest.is_finite() && u[0] == load / 49.0, "{u:?}");
    Ok(())
}

#[test]
fn a_value_that_is_not_finite_is_told_even_where_no_row_reads_it() -> Result<(), Error> {
    let counts = EdgeCounts { dirichlet: 1, ..FREE };
    let outcome = posed::<u16, _, 1>([&[(0, 1.0)]], counts, [0.0], &[], |system, mut rows| {
        Solver::new(Settings::default())?.run(&system, &mut rows, &mut [0.5, f64::INFINITY])
    })?;
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
    posed::<I, _, 3>(CHAIN, OF_CHAIN, [1.0, 2.0, -9.0], &[-1.0], |system, mut rows| {
        rows.set(&system, 1.0)?;
        let mut u = [0.0, 3.0, 5.0];
        psor::sweep(&rows, system.law(), &mut u)?;
        Ok(u)
    })
}

#[test]
fn a_sweep_is_the_same_with_wide_indices() -> Result<(), Error> {
    // (1 + 3)/2, (2 + 2 + 5)/2, max(−1, (−9 + 4½)/2)
    assert_eq!(swept::<u16>()?, [2.0, 4.5, -1.0]);
    assert_eq!(swept::<u32>()?, [2.0, 4.5, -1.0]);
    Ok(())
}
