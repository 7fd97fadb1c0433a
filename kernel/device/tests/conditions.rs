//! Conditions on edges that are not of length 1, and what is said of too many or none.

use crate::workspace::{OPEN, UNIT, ZERO, sides};
use signorini_device::condition::{BoundaryEdge, Condition};
use signorini_device::{Workspace, workspace};
use signorini_kernel::error::{Array, CellId};
use signorini_kernel::flux_range::Spans;
use signorini_kernel::mesh::boundary::{Boundary, Robin};
use signorini_kernel::mesh::components::{Part, PartCounts, examine};
use signorini_kernel::mesh::diagonal::DiagonalTerms;
use signorini_kernel::mesh::edges::{EdgeCounts, Edges};
use signorini_kernel::solver::{Settings, Status};
use signorini_kernel::{Error, Libm, Math, Mesh, Micromath, Real};
use signorini_tolerances::kernel::{FAST_ROOT, SOLVED};

/// 2 wide, 3 high; the right side in two edges.
const CORNERS: [[f64; 2]; 5] = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [2.0, 3.0], [0.0, 3.0]];
const CELLS: [[u16; 3]; 3] = [[0, 1, 2], [0, 2, 4], [2, 3, 4]];

/// Room for all of it.
type Bar = workspace!(f64, u16: vertices 5, triangles 3, quads 0, boundary 5);

/// u = x with 0 on the left, given what happens on the right.
fn bar(right: Condition<f64>) -> Result<(), Error> {
    let mesh = Mesh::new(&CORNERS, &CELLS, &[])?;
    let mut bar = Bar::new();
    bar.build(&mesh, UNIT, sides(2.0, [ZERO, right, OPEN]))?;
    let outcome = bar.solve(Settings::default())?;
    assert!(matches!(outcome.status, Status::Converged | Status::RoundingLimit), "{outcome:?}");
    let highest = bar.u().iter().fold(0.0, |most: f64, u| most.max(*u));
    SOLVED.check(format_args!("u with {right:?}"), highest - 2.0);
    // Off the gap nothing presses beyond what is given.
    SOLVED.check(format_args!("force with {right:?}"), bar.contact_force());
    Ok(())
}

#[test]
fn laws_are_integrated_over_their_edges() -> Result<(), Error> {
    bar(Condition::Neumann { flux: 1.0 })?;
    // ½ (4 − u) = 1 at u = 2.
    bar(Condition::Robin { coefficient: 0.5, ambient: 4.0 })?;
    bar(Condition::Contact { gap: -10.0, flux: 1.0 })
}

#[test]
fn a_condition_is_asked_for_at_the_middle_of_every_boundary_edge() -> Result<(), Error> {
    let mesh = Mesh::new(&CORNERS, &CELLS, &[])?;
    let mut middles = Vec::new();
    let mut bar = Bar::new();
    bar.build(&mesh, UNIT, |edge: &BoundaryEdge<f64, u16>| {
        middles.push(edge.middle());
        Some(Condition::Dirichlet { value: 0.0 })
    })?;
    for expected in [[1.0, 0.0], [2.0, 0.5], [2.0, 2.0], [1.0, 3.0], [0.0, 1.5]] {
        assert!(middles.contains(&expected), "{expected:?} in {middles:?}");
    }
    Ok(())
}

#[test]
fn too_many_records_are_counted() {
    let mesh = Mesh::new(&CORNERS, &CELLS, &[]).expect("valid");
    type Tight = Workspace<f64, u16, 5, 3, 0, 2, 3, 8, 40, 4>;
    let mut tight = Tight::new();
    let refused = tight.build(&mesh, UNIT, |_| Some(Condition::Neumann { flux: 0.0 }));
    assert_eq!(refused, Err(Error::Capacity { of: Array::Boundary, needed: 5, limit: 2 }));
    assert_eq!(mesh.cells(), 3);
    let square = Mesh::new(&CORNERS, &[[0_u16, 1, 2]], &[[0_u16, 2, 3, 4]]).expect("valid");
    assert_eq!(square.cells(), 2);
}

/// Solves with the first conditions, is refused others, and solves again: as if nobody had asked for them.
#[test]
fn a_workspace_keeps_its_answer_where_it_refuses() -> Result<(), Error> {
    let mesh = Mesh::new(&CORNERS, &CELLS, &[])?;
    let mut bar = Bar::new();
    let given = |value: f64, flux: f64, coefficient: f64| {
        move |edge: &BoundaryEdge<f64, u16>| {
            let [x, y] = edge.middle();
            Some(match (x == 0.0, y == 0.0) {
                (true, _) => Condition::Dirichlet { value },
                (_, true) => Condition::Robin { coefficient, ambient: 1.0 },
                _ => Condition::Neumann { flux },
            })
        }
    };
    bar.build(&mesh, UNIT, given(1.0, 0.5, 2.0))?;
    let bits = |bar: &Bar| {
        let numbers = bar.u().iter().chain(bar.flux());
        numbers.map(|x| x.to_bits()).collect::<Vec<_>>()
    };
    bar.solve(Settings::default())?;
    let before = bits(&bar);
    let not_finite = |of, at| Some(Error::NotFinite { of, at });
    for ([value, flux, coefficient], refused) in [
        ([f64::NAN, 0.5, 2.0], not_finite(Array::Dirichlet, 6)),
        ([1.0, f64::INFINITY, 2.0], not_finite(Array::Neumann, 1)),
        // A coefficient may be as large as it likes where its edge is short.
        ([3.0, 0.7, f64::MAX], None),
        ([3.0, 0.7, -1.0], Some(Error::NegativeRobin { edge: 0 })),
    ] {
        let found = bar.set_conditions(&mesh, given(value, flux, coefficient));
        if refused.is_some() {
            assert_eq!(found.err(), refused, "{value} {flux} {coefficient}");
        } else {
            bar.set_conditions(&mesh, given(1.0, 0.5, 2.0))?;
        }
        assert_eq!(bits(&bar), before, "{value} {flux} {coefficient}");
    }
    assert_eq!(bar.set_conditions(&mesh, |_| None).err(), Some(Error::NoCondition([0, 1])));
    assert_eq!(bits(&bar), before);
    // Finite, and too large for an answer: the data are taken, and no answer is tried.
    for large in [1e285, f64::MAX / 8.0] {
        for (value, flux) in [(1.0, large), (large, 0.5)] {
            bar.set_conditions(&mesh, given(value, flux, 2.0))?;
            let found = bar.solve(Settings::default());
            assert!(matches!(found, Err(Error::NotFinite { .. })), "{value} {flux}: {found:?}");
            bar.set_conditions(&mesh, given(1.0, 0.5, 2.0))?;
            assert_eq!(bits(&bar), before, "{value} {flux}");
        }
    }
    bar.solve(Settings::default())?;
    let mut other = Bar::new();
    other.build(&mesh, UNIT, given(1.0, 0.5, 2.0))?;
    other.solve(Settings::default())?;
    other.solve(Settings::default())?;
    assert_eq!(bits(&bar), bits(&other));
    Ok(())
}

/// Edges of a triangle with three free sides.
fn triangle() -> Result<Edges<'static, u16>, Error> {
    let counts = EdgeCounts { free: 3, contact: 0, dirichlet: 0 };
    Edges::new(&[[0, 1, 2]], &[], &[[0, u16::MAX], [1, u16::MAX], [2, u16::MAX]], counts)
}

#[test]
fn a_part_floats_where_nothing_passes_its_boundary() -> Result<(), Error> {
    let edges = triangle()?;
    let found = |coefficient: f64, load: [f64; 3], slack: f64| {
        let laws = [Robin { edge: 0, coefficient, ambient: 0.0 }];
        let boundary = Boundary::new(&edges, &[], &laws, &[])?;
        let (diagonal, load) = (DiagonalTerms::new(&boundary), (&load[..], Spans::UNLIMITED));
        examine(&edges, diagonal, load, slack, &mut [Part::default()])
    };
    let counts = |held, floating| Ok(PartCounts { held, contact: 0, floating });
    assert_eq!(found(1.0, [1.0; 3], 1e-9), counts(1, 0));
    assert_eq!(found(0.0, [1.0, -1.0, 0.0], 1e-9), counts(0, 1));
    // ¼ is more than half of ¼: no rounding of a quadrature.
    assert_eq!(found(0.0, [0.25, 0.0, 0.0], 0.5), Err(Error::NoSolution { cell: 0 }));
    Ok(())
}

#[test]
fn half_edges_end_with_the_cells() -> Result<(), Error> {
    let edges = triangle()?;
    assert_eq!([0, 2, 3, 4].map(|half| edges.cell_of(half)), [Some(0), Some(0), None, None]);
    Ok(())
}

#[test]
fn roots_and_the_larger_of_two_zeros() {
    let root = <Micromath as Math<f32>>::sqrt(9.0);
    FAST_ROOT.check_relative("√9", root, 3.0);
    assert_eq!(<Libm as Math<f64>>::sqrt(9.0), 3.0);
    assert!(0.0_f64.or_larger(-0.0).is_sign_positive());
    assert!((-0.0_f64).or_larger(0.0).is_sign_negative());
    assert!(0.0_f64.or_smaller(-0.0).is_sign_positive());
    assert!((-0.0_f64).or_smaller(0.0).is_sign_negative());
}

#[test]
fn errors_are_sentences() {
    assert!(Error::Relaxation.to_string().contains('2'), "{}", Error::Relaxation);
    assert!(CellId::Quad(7).to_string().contains('7'));
}
