//! The smallest and strangest problems first: what they answer, and how they are refused.

use crate::workspace::{Edge, OPEN, SQUARE, TWO, UNIT, ZERO, built, sides};
use signorini_device::condition::Condition;
use signorini_device::workspace;
use signorini_kernel::csr::Csr;
use signorini_kernel::error::{Array, CellId};
use signorini_kernel::flux_range::Spans;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::boundary::{Boundary, Robin};
use signorini_kernel::mesh::components::{Part, PartCounts, examine};
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::mesh::edges::{EdgeCounts, Edges};
use signorini_kernel::rows::{Row, Rows};
use signorini_kernel::solver::{Settings, Status};
use signorini_kernel::stiffness::{Coefficient, Stiffness};
use signorini_kernel::{Error, Libm, Mesh, Micromath, Tensor, psor};
use signorini_tolerances::kernel::{BASIS, FAST_ROOT, SOLVED};

#[test]
fn a_single_triangle_and_a_single_quad() {
    for (triangles, quads) in [(&[[0u16, 1, 2]][..], &[][..]), (&[], &[[0u16, 1, 2, 3]])] {
        let mesh = Mesh::new(&SQUARE, triangles, quads).expect("a valid cell");
        // All sides given: nothing to solve, and the flux of u = x through the sides is exact.
        let value = |edge: &Edge| Some(Condition::Dirichlet { value: edge.middle()[0] });
        let mut cell = built(&mesh, UNIT, value).expect("fits");
        let outcome = cell.solve(Settings::default()).expect("finite");
        assert_eq!(outcome.status, Status::Converged);
        let total: f64 = cell.flux().iter().sum();
        BASIS.check("sum of fluxes", total);
        let outward = cell.flux().iter().copied().fold(0.0, f64::max);
        BASIS.check("flux through the right side", outward - 1.0);
    }
}

/// −Δu = −4 pushes the whole plate onto its gap: λ takes the load, and nothing moves.
#[test]
fn all_contact() {
    let mesh = Mesh::new(&SQUARE, &TWO, &[]).expect("valid");
    let gap = |_: &_| Some(Condition::Contact { gap: 1.0, flux: 0.0 });
    let mut plate = built(&mesh, UNIT, gap).expect("fits");
    plate.set_source(&[-2.0, -2.0], &[]).expect("lengths");
    let outcome = plate.solve(Settings::default()).expect("finite");
    assert!(matches!(outcome.status, Status::Converged | Status::RoundingLimit));
    // ∫λ = ∫σ·n = −∫f
    SOLVED.check("force", plate.contact_force() - 4.0);
    assert_eq!(outcome.residual.active, 4);
}

#[test]
fn no_contact_is_a_linear_problem() {
    let mesh = Mesh::new(&SQUARE, &[], &[[0u16, 1, 2, 3]]).expect("valid");
    let sides = sides(1.0, [ZERO, Condition::Neumann { flux: 3.0 }, OPEN]);
    let mut bar = built(&mesh, UNIT, sides).expect("fits");
    bar.solve(Settings::default()).expect("finite");
    let highest = bar.u().iter().fold(0.0, |most: f64, u| most.max(*u));
    SOLVED.check("u", highest - 3.0);
    assert_eq!(bar.contact_force(), 0.0);
}

/// Two separate triangles: one held, one not.
#[test]
fn parts_are_told_apart() {
    let vertices = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [5.0, 0.0], [6.0, 0.0], [5.0, 1.0]];
    let mesh = Mesh::<f64, u16>::new(&vertices, &[[0, 1, 2], [3, 4, 5]], &[]).expect("valid");
    let check = |second: Condition<f64>, load: f64| {
        let conditions = |edge: &Edge| {
            Some(if edge.middle()[0] < 2.0 { Condition::Dirichlet { value: 0.0 } } else { second })
        };
        let parts = built(&mesh, UNIT, conditions)?;
        let edges = parts.edges()?;
        let boundary = Boundary::new(&edges, &[], &[], &[])?;
        let unknowns = edges.counts().unknowns();
        let loads = vec![load; unknowns];
        let (diagonal, load) = (DiagonalTerms::new(&boundary), (&loads[..], Spans::UNLIMITED));
        examine(&edges, diagonal, load, 1e-9, &mut [Part::default(); 2])
    };
    let contact = Condition::Contact { gap: 0.0, flux: 0.0 };
    let counts = |held, contact, floating| Ok(PartCounts { held, contact, floating });
    assert_eq!(check(contact, -1.0), counts(1, 1, 0));
    assert_eq!(check(contact, 1.0), Err(Error::NoSolution { cell: 1 }));
    assert_eq!(check(contact, 0.0), Err(Error::NotUnique { cell: 1 }));
    assert_eq!(check(OPEN, 0.0), counts(1, 0, 1));
    assert_eq!(check(OPEN, 1.0), Err(Error::NoSolution { cell: 1 }));
}

#[test]
fn bad_meshes_are_named() {
    let new = |vertices: &[[f64; 2]], triangles: &[[u16; 3]], quads: &[[u16; 4]]| {
        Mesh::new(vertices, triangles, quads).map(|mesh| mesh.cells())
    };
    let triangle = CellId::Triangle(0);
    assert_eq!(new(&SQUARE, &[[0, 2, 1]], &[]), Err(Error::Clockwise(triangle)));
    assert_eq!(new(&SQUARE, &[[0, 1, 1]], &[]), Err(Error::RepeatedVertex(triangle)));
    let outside = Error::OutOfRange { of: Array::Triangles, at: 0 };
    assert_eq!(new(&SQUARE, &[[0, 1, 9]], &[]), Err(outside));
    let line = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]];
    assert_eq!(new(&line, &[[0, 1, 2]], &[]), Err(Error::Degenerate(triangle)));
    assert_eq!(new(&SQUARE, &[], &[[0, 1, 3, 2]]), Err(Error::NotConvex(CellId::Quad(0))));
    let nan = [[0.0, f64::NAN], [1.0, 0.0], [0.0, 1.0]];
    assert_eq!(new(&nan, &[], &[]), Err(Error::NotFinite { of: Array::Vertices, at: 0 }));
    let many = vec![[0u16, 1, 2]; 22_000];
    let capacity = Error::Capacity { of: Array::HalfEdges, needed: 66_000, limit: 65_535 };
    assert_eq!(new(&SQUARE, &many, &[]), Err(capacity));
}

#[test]
fn bad_topology_is_named() {
    let all = |_: &Edge| Some(OPEN);
    let error = |triangles: &[[u16; 3]]| {
        let vertices = [[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.5, -1.0], [0.5, 2.0]];
        built(&Mesh::new(&vertices, triangles, &[])?, UNIT, all).map(|_| ())
    };
    assert_eq!(error(&[[0, 1, 2], [0, 1, 2]]), Err(Error::Overlap([0, 1])));
    assert_eq!(error(&[[0, 1, 2], [1, 0, 3], [0, 1, 4]]), Err(Error::Overlap([0, 1])));
    let mesh = Mesh::new(&SQUARE, &[[0u16, 1, 2]], &[]).expect("valid");
    assert_eq!(built(&mesh, UNIT, |_| None).map(|_| ()), Err(Error::NoCondition([0, 1])));
}

#[test]
fn a_workspace_that_is_too_small_says_by_how_much() {
    let mesh = Mesh::new(&SQUARE, &TWO, &[]).expect("valid");
    let mut tight = <workspace!(f64, u16: vertices 4, triangles 1, quads 0, boundary 7)>::new();
    let error = tight.build(&mesh, UNIT, |_| Some(OPEN));
    assert_eq!(error, Err(Error::Capacity { of: Array::Triangles, needed: 2, limit: 1 }));
}

#[test]
fn arrays_that_do_not_fit_are_refused() {
    let outside = |of, at| Some(Error::OutOfRange { of, at });
    let length = |of, found, expected| Some(Error::Length { of, found, expected });
    let not_finite = Some(Error::NotFinite { of: Array::MatrixValues, at: 1 });
    let (pointers, columns) = (Array::RowPointers, Array::ColumnIndices);
    for (row_ptr, col_idx, values, refused) in [
        (&[0, 1, 2][..], &[0, 1][..], &[1.0, 1.0][..], None),
        (&[0, 2, 1], &[0, 1], &[1.0, 1.0], outside(pointers, 1)),
        (&[0, 1, 9], &[0, 1], &[1.0, 1.0], outside(pointers, 2)),
        (&[0, 1, 2], &[0, 7], &[1.0, 1.0], outside(columns, 1)),
        (&[0, 1, 2], &[1, 0], &[1.0, 1.0], outside(pointers, 0)),
        (&[0, 1, 2], &[0, 1], &[1.0, -1.0], outside(pointers, 1)),
        (&[0, 1, 2], &[0, 1], &[1.0, f64::NAN], not_finite),
        (&[], &[], &[], length(pointers, 0, 1)),
    ] {
        let found = Csr::<f64, u16>::new(row_ptr, col_idx, values, 2).map(|matrix| matrix.rows());
        assert_eq!(found, refused.map_or(Ok(2), Err), "{row_ptr:?} {col_idx:?} {values:?}");
    }
    let one = EdgeCounts { free: 1, contact: 0, dirichlet: 0 };
    let edges =
        |triangle: [u16; 3], half: u16| Edges::new(&[triangle], &[], &[[half, 1]], one).err();
    assert_eq!(edges([0, 0, 0], 0), length(Array::HalfEdges, 2, 3));
    assert_eq!(edges([7, 0, 0], 9), outside(Array::HalfEdges, 0));
}

#[test]
fn rows_and_sweeps_refuse_what_does_not_fit() {
    let sides = EdgeCounts { free: 2, contact: 1, dirichlet: 1 };
    let halves = [[0, NONE], [1, NONE], [2, NONE], [3, NONE]];
    let edges = Edges::<u16>::new(&[], &[[0, 1, 2, 3]], &halves, sides).expect("a square");
    let mut memory = [Row::<f64, u16, 6>::EMPTY; 3];
    let refused = Rows::new(&edges, &mut memory[..2]).err();
    assert_eq!(refused, Some(Error::Length { of: Array::Rows, found: 2, expected: 3 }));
    let narrow = &mut [Row::<f64, u16, 2>::EMPTY; 3];
    assert!(matches!(Rows::new(&edges, narrow), Err(Error::Capacity { needed: 3, limit: 2, .. })));
    let rows = Rows::new(&edges, &mut memory).expect("fits");
    let unknowns = |found| Error::Length { of: Array::Unknowns, found, expected: 4 };
    let bounds = |found| Error::Length { of: Array::LowerBounds, found, expected: 1 };
    let wrong = [(1, 3, unknowns(3)), (1, 5, unknowns(5)), (0, 4, bounds(0)), (2, 4, bounds(2))];
    for (lower, u, refused) in wrong {
        let (lower, mut u) = (vec![0.0; lower], vec![0.0; u]);
        assert_eq!(psor::sweep(&rows, Law::above(&lower), &mut u), Err(refused));
    }
    assert_eq!(psor::sweep_free(&rows, &mut [0.0; 3]).err(), Some(unknowns(3)));
    assert_eq!(psor::sweep(&rows, Law::above(&[0.0]), &mut [0.0; 4]), Ok(()));

    // The bill of memory in `docs/embedding.md`.
    assert_eq!((size_of::<Row<f32, u16, 4>>(), size_of::<Row<f32, u16, 6>>()), (28, 40));
    assert_eq!((size_of::<Row<f64, u16, 4>>(), size_of::<Row<f64, u16, 6>>()), (48, 72));

    // A free square fits four entries, but only the general rows know its matrix.
    let free = EdgeCounts { free: 4, contact: 0, dirichlet: 0 };
    let square = Edges::<u16>::new(&[], &[[0, 1, 2, 3]], &halves, free).expect("a square");
    let (mut memory, k) = ([Row::<f64, u16, 4>::EMPTY; 4], [[-1.0; 6]]);
    let k = Stiffness { triangles: &[], quads: &k };
    let nothing = Boundary::new(&square, &[], &[], &[]).expect("nothing");
    let law = |edge| Robin { edge, coefficient: 1.0, ambient: 0.0 };
    assert!(Boundary::new(&square, &[], &[law(0), law(2)], &[]).is_ok());
    let second = Some(Error::OutOfRange { of: Array::Robin, at: 1 });
    let refused = |laws: &[_]| Boundary::new(&square, &[], laws, &[]).err();
    assert_eq!(refused(&[law(2), law(0)]), second, "out of order");
    assert_eq!(refused(&[law(2), law(2)]), second, "two on one edge");
    let mut rows = Rows::new(&square, &mut memory).expect("three neighbours");
    let refused = rows.gather(&square, k, DiagonalTerms::new(&nothing), &[0.0; 4], 1.0).err();
    assert_eq!(refused, Some(Error::Capacity { of: Array::Quads, needed: 1, limit: 0 }));

    // A contact edge between two triangles, which no numbering of a mesh has.
    let inside = EdgeCounts { free: 2, contact: 1, dirichlet: 2 };
    let pairs = [[0, NONE], [1, NONE], [2, 3], [4, NONE], [5, NONE]];
    let edges = Edges::<u16>::new(&[[0, 1, 2], [2, 3, 4]], &[], &pairs, inside).expect("sound");
    let memory = &mut [Row::<f64, u16, 4>::EMPTY; 3];
    assert!(matches!(Rows::new(&edges, memory), Err(Error::Capacity { needed: 4, limit: 2, .. })));

    // 8192 edges of 8 bytes are one too many for 16-bit offsets.
    let count = 8192;
    let cells: Vec<[u16; 4]> =
        (0..count / 4).map(|cell| [0, 1, 2, 3].map(|k| 4 * cell + k)).collect();
    let halves: Vec<[u16; 2]> = (0..count).map(|edge| [edge, NONE]).collect();
    let all = EdgeCounts { free: usize::from(count), contact: 0, dirichlet: 0 };
    let edges = Edges::new(&[], &cells, &halves, all).expect("squares apart");
    let mut memory = vec![Row::<f64, u16, 6>::EMPTY; all.free];
    assert!(matches!(Rows::new(&edges, &mut memory), Err(Error::Capacity { limit: 8191, .. })));
    let mut memory = vec![Row::<f32, u16, 6>::EMPTY; all.free];
    assert!(Rows::new(&edges, &mut memory).is_ok());
}

const NONE: u16 = u16::MAX;

/// micromath's root is off by up to 6 %: it may serve a length, and never changes the solution.
#[test]
fn fast_math_costs_what_it_says() {
    let vertices = SQUARE.map(|v| v.map(|x| x as f32));
    let mesh = Mesh::<f32, u16>::new(&vertices, &[[0, 1, 2], [0, 2, 3]], &[]).expect("valid");
    let mut plate = <workspace!(f32, u16: vertices 4, triangles 2, quads 0, boundary 4)>::new();
    let unit = Coefficient::Uniform(Tensor::scalar(1.0));
    let contact = Condition::Contact { gap: 1.0, flux: 0.0 };
    let sides = sides(1.0, [Condition::Dirichlet { value: 0.0 }, contact, contact]);
    plate.build(&mesh, unit, sides).expect("fits");
    plate.solve(Settings::default()).expect("finite");
    let exact = plate.contact_length::<Libm>(&mesh).expect("built");
    let fast = plate.contact_length::<Micromath>(&mesh).expect("built");
    assert!(exact > 0.0, "{fast} against {exact}");
    FAST_ROOT.check_relative("length of contact", fast, exact);
}
