//! Workspaces by numbers that are exact: thresholds from both sides, means, ways out, and the errors of long edges.

use super::{Edge, ONE, OPEN, Plate, SQUARE, TWO, UNIT, ZERO, beside, built, sides, sweeps};
use signorini_bound::certificate::{Certificate, Verdict};
use signorini_device::condition::Condition;
use signorini_device::tick::Deadline;
use signorini_kernel::error::{Array, CellId};
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::solver::Settings;
use signorini_kernel::stiffness::Coefficient;
use signorini_kernel::{Error, Mesh, Tensor};

const WHOLE: [[u16; 4]; 1] = [[0, 1, 2, 3]];

/// `condition` on the edge between these vertices, 0 on that from vertex 0 to 1 unless it is this one.
fn on(vertices: [u16; 2], condition: Condition<f64>) -> impl Fn(&Edge) -> Option<Condition<f64>> {
    move |edge| {
        Some(match edge.vertices {
            here if here == vertices => condition,
            [0, 1] => ZERO,
            _ => OPEN,
        })
    }
}

/// 0 from vertex 0 to 1, nothing passes the rest.
fn held(edge: &Edge) -> Option<Condition<f64>> {
    on([0, 1], ZERO)(edge)
}

fn verdict(plate: &mut Plate, mesh: &Mesh<f64, u16>, most: u32) -> Result<Verdict<f64>, Error> {
    Ok(plate.tick(mesh, sweeps(most), &mut Deadline::never())?.verdict)
}

fn bound(plate: &mut Plate, mesh: &Mesh<f64, u16>, sweeps: u32) -> Result<Certificate<f64>, Error> {
    Ok(*verdict(plate, mesh, sweeps)?.certificate().expect("a bound"))
}

/// Where the edge between these vertices stands.
fn number(plate: &Plate, mesh: &Mesh<f64, u16>, vertices: [u16; 2]) -> usize {
    let edges = plate.edges().expect("built");
    let is_it = |&edge: &usize| edges.endpoints(mesh, edge) == vertices;
    (0..edges.counts().edges()).find(is_it).expect("an edge")
}

/// The verdict on the square, cut in two or whole, with this A and this on the boundary.
fn of_square(
    (triangles, quads): (&[[u16; 3]], &[[u16; 4]]),
    a: Coefficient<f64>,
    condition: impl Fn(&Edge) -> Option<Condition<f64>>,
) -> Result<Verdict<f64>, Error> {
    of_mesh(&Mesh::new(&SQUARE, triangles, quads)?, a, condition)
}

fn of_mesh(
    mesh: &Mesh<f64, u16>,
    a: Coefficient<f64>,
    condition: impl Fn(&Edge) -> Option<Condition<f64>>,
) -> Result<Verdict<f64>, Error> {
    verdict(&mut built(mesh, a, condition)?, mesh, 100)
}

#[test]
fn an_edge_has_the_mean_of_its_ends() -> Result<(), Error> {
    let mesh = Mesh::new(&SQUARE, &TWO, &[])?;
    let mut plate =
        built(&mesh, UNIT, on([3, 0], Condition::DirichletBetween { values: [3.0, 8.0] }))?;
    plate.solve(Settings::default())?;
    assert_eq!(plate.u()[number(&plate, &mesh, [3, 0])], 5.5);
    // Drawn out, an edge of contact stays on its gap.
    let contact = Condition::ContactBetween { gaps: [0.75, 3.0], flux: 0.0 };
    plate.build(&mesh, UNIT, on([3, 0], contact))?;
    plate.set_source(&[-50.0; 2], &[])?;
    plate.solve(Settings::default())?;
    assert_eq!(plate.u()[number(&plate, &mesh, [3, 0])], 1.875);
    Ok(())
}

/// Numbers that are finite and whose integrals over an edge are not: named by the edge, and nothing has changed.
#[test]
fn integrals_that_overflow_are_refused() -> Result<(), Error> {
    let large = SQUARE.map(|vertex| vertex.map(|x| 1e10 * x));
    let mesh = Mesh::new(&large, &TWO, &[])?;
    let robin = |coefficient, ambient| Condition::Robin { coefficient, ambient };
    let contact = |flux| Condition::Contact { gap: -1.0, flux };
    for (of, fine, too_large) in [
        (Array::Neumann, OPEN, Condition::Neumann { flux: 1e300 }),
        (Array::Contact, contact(0.0), contact(1e300)),
        (Array::Robin, robin(1.0, 1.0), robin(1e300, 1.0)),
        (Array::Robin, robin(1.0, 1.0), robin(1e150, 1e160)),
    ] {
        let mut plate = built(&mesh, UNIT, on([2, 3], fine))?;
        let at = number(&plate, &mesh, [2, 3]);
        let refused = plate.set_conditions(&mesh, on([2, 3], too_large));
        assert_eq!(refused, Err(Error::NotFinite { of, at }));
        plate.solve(Settings::default())?;
    }
    Ok(())
}

/// Transfer moves from one edge to another with the same coefficient: the matrix is another one.
#[test]
fn a_law_that_moves_is_another_law() -> Result<(), Error> {
    let mesh = Mesh::new(&SQUARE, &TWO, &[])?;
    let robin = |coefficient| Condition::Robin { coefficient, ambient: 2.0 };
    let law = |left: f64, right: f64| sides(1.0, [robin(left), robin(right), OPEN]);
    let mut moved = built(&mesh, UNIT, law(1.0, 0.0))?;
    moved.set_conditions(&mesh, law(0.0, 1.0))?;
    let mut new = built(&mesh, UNIT, law(0.0, 1.0))?;
    for plate in [&mut moved, &mut new] {
        plate.set_source(&[1.0, 0.0], &[])?;
        plate.solve(Settings::default())?;
    }
    assert_eq!((moved.u(), moved.flux()), (new.u(), new.flux()));
    // ∫f = 1 leaves through the right: u = u_ext + 1 there.
    let right = moved.u()[number(&moved, &mesh, [1, 2])];
    // As far as the solver's own stopping test goes.
    assert!((right - 3.0).abs() < 1e-8, "{right}");
    Ok(())
}

#[test]
fn a_relaxation_out_of_range_is_refused() -> Result<(), Error> {
    let mut plate = Plate::new();
    for wrong in [Relaxation::Fixed(2.0), Relaxation::Fixed(0.0), Relaxation::Adaptive(0.5)] {
        assert_eq!(plate.set_relaxation(wrong), Err(Error::Relaxation));
    }
    plate.set_relaxation(Relaxation::Fixed(1.5))
}

/// s(v) = Σ α u_T(v)/Σ α with α = ½ tr A and u_T(v) from the means over the sides, where nothing is given.
#[test]
fn the_stiffer_cell_decides_at_a_vertex() -> Result<(), Error> {
    let mesh = Mesh::new(&SQUARE, &TWO, &[])?;
    let a = [Tensor { xx: 1.0, xy: 0.0, yy: 7.0 }, Tensor { xx: 3.0, xy: 0.0, yy: 2.0 }];
    let mut plate = built(&mesh, Coefficient::PerCell(&a), held)?;
    plate.set_source(&[1.0, 3.0], &[])?;
    bound(&mut plate, &mesh, 3)?;
    let of_triangles = plate.edges()?.of_triangles().to_vec();
    // At the end of side `k`: the means of both sides there less that of the third.
    let at_end = |cell: usize, k: usize| {
        let mean = |k: usize| plate.u()[usize::from(of_triangles[cell][k % 3])];
        mean(k) + mean(k + 1) - mean(k + 2)
    };
    let (first, second) = (at_end(0, 1), at_end(1, 0));
    let expected = (4.0 * first + 2.5 * second) / 6.5;
    let found = plate.vertices()[2];
    assert!((first - second).abs() > 0.1, "{first} {second}");
    // A dozen roundings of numbers below 1.
    assert!((found - expected).abs() < 1e-14, "{found} {expected}");
    Ok(())
}

/// Four squares in a row, 0 on both ends, ∫f = 1 in the third and u = 0: each of its sides says ¼ out of it. What is over
/// leaves to the left, where two stiff cells cost ⅛ + ⅛, not through the soft one on the right, which costs 1. Between
/// it and the soft one stands half of ¼ for either.
#[test]
fn surplus_leaves_through_stiff_cells() -> Result<(), Error> {
    let vertices: Vec<_> = (0..10_u16).map(|k| [f64::from(k / 2), f64::from(k % 2)]).collect();
    let quads: Vec<_> = (0..4).map(|k| [2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1]).collect();
    let mesh = Mesh::new(&vertices, &[], &quads)?;
    let ends = sides(4.0, [ZERO, ZERO, OPEN]);
    let a = [8.0, 8.0, 1.0, 1.0].map(Tensor::scalar);
    let mut plate = built(&mesh, Coefficient::PerCell(&a), ends)?;
    plate.set_source(&[], &[0.0, 0.0, 1.0, 0.0])?;
    bound(&mut plate, &mesh, 0)?;
    let through = |vertices| plate.flux()[number(&plate, &mesh, vertices)];
    assert_eq!([through([1, 0]), through([8, 9])], [-0.875, -0.125]);
    Ok(())
}

/// A and f four times as large: u is the same and the bound, √A times a slope, twice as large, to the last bit.
#[test]
fn the_bound_has_the_unit_of_the_energy() -> Result<(), Error> {
    for cells in [(&TWO[..], &[][..]), (&[], &WHOLE)] {
        let mesh = Mesh::new(&SQUARE, cells.0, cells.1)?;
        let total = |times: f64| {
            let a = Tensor { xx: 2.0 * times, xy: 0.5 * times, yy: times };
            let mut plate = built(&mesh, Coefficient::Uniform(a), held)?;
            plate.set_source(&vec![times; cells.0.len()], &vec![times; cells.1.len()])?;
            bound(&mut plate, &mesh, 3).map(|found| found.total)
        };
        assert_eq!(total(4.0)?, 2.0 * total(1.0)?);
    }
    Ok(())
}

/// The problem on a mesh is that on the mesh mapped by J with the tensor J A Jᵀ/|det J|.
#[test]
fn a_mapped_problem_has_the_same_bound() -> Result<(), Error> {
    // J = [[2, 1], [0.5, 1.5]], det J = 2.5.
    let map = |[x, y]: [f64; 2]| [2.0 * x + y, 0.5 * x + 1.5 * y];
    let mapped = Tensor { xx: 5.0 / 2.5, xy: 2.5 / 2.5, yy: 2.5 / 2.5 };
    for cells in [(&TWO[..], &[][..]), (&[], &WHOLE)] {
        let total = |vertices: [[f64; 2]; 4], a: Tensor<f64>| {
            let mesh = Mesh::new(&vertices, cells.0, cells.1)?;
            let mut plate = Plate::new();
            let pressed = Condition::Contact { gap: 0.25, flux: 0.0 };
            plate.build(&mesh, Coefficient::Uniform(a), on([2, 3], pressed))?;
            plate.set_source(&vec![-0.3; cells.0.len()], &vec![-0.3; cells.1.len()])?;
            plate.set_relaxation(Relaxation::Fixed(1.25))?;
            bound(&mut plate, &mesh, 3).map(|found| found.total)
        };
        let (plain, mapped) = (total(SQUARE, ONE)?, total(SQUARE.map(map), mapped)?);
        // The matrices differ by rounding.
        assert!((mapped / plain - 1.0).abs() < 1e-12, "{plain} {mapped}");
    }
    Ok(())
}

/// Triangles with A = 1 beside a square with A = 4: u rises by 4, then by 1, which all spaces hold.
#[test]
fn an_exact_answer_has_a_bound_of_rounding() -> Result<(), Error> {
    let vertices: Vec<_> = (0..6_u16).map(|k| [f64::from(k / 2), f64::from(k % 2)]).collect();
    let mesh = Mesh::new(&vertices, &[[0, 2, 3], [0, 3, 1]], &[[2, 4, 5, 3]])?;
    let ends = sides(2.0, [ZERO, Condition::Dirichlet { value: 5.0 }, OPEN]);
    let a = [1.0, 1.0, 4.0].map(Tensor::scalar);
    let mut plate = built(&mesh, Coefficient::PerCell(&a), ends)?;
    let found = bound(&mut plate, &mesh, 10_000)?;
    // ‖A^½∇u‖ is √(16 + 4): sweeps and rounding leave some hundred ε of it.
    assert!(found.total < 1e-12, "{found:?}");
    let middle = plate.u()[number(&plate, &mesh, [2, 3])];
    assert!((middle - 4.0).abs() < 1e-12, "{middle}");
    Ok(())
}

/// Opposite sides may differ by 4 · 10⁻¹² of the height. Bottom (4, ⅛) and left (−2, 3/2) have the area 25/4 and the height
/// 25/16: 6.25 · 10⁻¹².
#[test]
fn a_parallelogram_is_one_up_to_a_share_of_its_height() -> Result<(), Error> {
    for (off, is_one) in [(0.0, true), (6.2e-12, true), (6.3e-12, false)] {
        let vertices = [[3.0, -1.625], [7.0, -1.5], [5.0, off], [1.0, -0.125]];
        let mesh = Mesh::new(&vertices, &[], &WHOLE)?;
        let mut plate = built(&mesh, UNIT, held)?;
        plate.set_source(&[], &[1.0])?;
        let verdict = verdict(&mut plate, &mesh, 100)?;
        assert_eq!(verdict.certificate().is_some(), is_one, "{off}: {verdict:?}");
        assert_eq!(verdict == Verdict::Unavailable, !is_one, "{off}: {verdict:?}");
    }
    Ok(())
}

/// A is told on a square up to (tr A)²/(det A) = 1/(1000 ε), 4.5 · 10¹². With A = [[1, 1 − δ], [1 − δ, 1]] that is 2/δ,
/// and with diagonal entries 1 and δ it is 1/δ.
#[test]
fn a_square_tells_its_tensor_up_to_its_condition() -> Result<(), Error> {
    let oblique = |delta: f64| Tensor { xx: 1.0, xy: 1.0 - delta, yy: 1.0 };
    let stretched = |delta: f64| Tensor { xx: 1.0, xy: 0.0, yy: delta };
    for (a, is_told) in [
        (oblique(4.8e-13), true),
        (oblique(4.0e-13), false),
        (stretched(2.4e-13), true),
        (stretched(2.0e-13), false),
    ] {
        let found = of_square((&[], &WHOLE), Coefficient::Uniform(a), held)?;
        assert_eq!(found != Verdict::Unavailable, is_told, "{a:?}: {found:?}");
    }
    Ok(())
}

/// A tensor is that of its cell, quads after triangles; one that changes inside quads has no bound here.
#[test]
fn quads_are_asked_for_their_own_tensor() -> Result<(), Error> {
    let vertices = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 0.0]];
    let mesh = Mesh::new(&vertices, &[[1, 4, 2]], &WHOLE)?;
    let mut plate = Plate::new();
    let thin = Tensor { xx: 1.0, xy: 0.0, yy: 1e-13 };
    plate.build(&mesh, Coefficient::PerCell(&[ONE, thin]), held)?;
    assert_eq!(verdict(&mut plate, &mesh, 10)?, Verdict::Unavailable);
    plate.build(&mesh, Coefficient::PerCell(&[thin, ONE]), held)?;
    assert_ne!(verdict(&mut plate, &mesh, 10)?, Verdict::Unavailable);
    let oblique = Tensor { xx: 1.0, xy: 1.0 - 1e-15, yy: 1.0 };
    let refused = plate.build(&mesh, Coefficient::PerCell(&[ONE, oblique]), held);
    assert_eq!(refused, Err(Error::Oblique(CellId::Quad(0))));
    let at_points = of_square((&TWO, &[]), Coefficient::PerPoint(&[ONE; 2]), held)?;
    assert!(at_points.certificate().is_some(), "{at_points:?}");
    let at_points = of_square((&[], &WHOLE), Coefficient::PerPoint(&[ONE; 16]), held)?;
    assert_eq!(at_points, Verdict::Unavailable);
    Ok(())
}

/// Cells are refused from 32 ε κ = 1 on, in f64 κ = 2⁴⁷.
#[test]
fn cells_that_cancel_are_refused() -> Result<(), Error> {
    let cancelling = |power: i32| {
        let eta = 2.0_f64.powi(power);
        Tensor { xx: 1.0, xy: 0.5 - eta, yy: 0.25 + eta }
    };
    let (h, quad, triangle) = (2.0_f64.powi(-537), CellId::Quad(0), CellId::Triangle(0));
    let (aslant, flat) =
        ([[3.0, 5.0], [7.0, 5.0], [7.0, 7.0]], [[0.0, 0.0], [1.0, 0.0], [1.0, 1.1 * h]]);
    for (vertices, a, refused) in [
        // A square has κ of det A alone: ½ in all over 2η left.
        (&SQUARE[..], cancelling(-48), None),
        (&SQUARE, cancelling(-49), Some(quad)),
        // Across the side along (2, 1), with N = (−½, 1): 1 in all over 2η left, twice the κ of det A.
        (&aslant, cancelling(-47), None),
        (&aslant, cancelling(-48), Some(triangle)),
        // Across the side along (1, 1.1 h), where h² is the smallest number: A is definite, and of
        // N·AN = (1.21 − 1.54 + 1) h² each term is rounded to a whole h². Nothing is left.
        (&flat, Tensor { xx: 1.0, xy: 0.7 * h, yy: h * h }, Some(triangle)),
    ] {
        let is_whole = vertices.len() == 4;
        let (triangles, quads) =
            if is_whole { (&[][..], &WHOLE[..]) } else { (&TWO[..1], &[][..]) };
        let found = of_mesh(&Mesh::new(vertices, triangles, quads)?, Coefficient::Uniform(a), held);
        assert_eq!(found.err(), refused.map(Error::Oblique), "{a:?}");
    }
    Ok(())
}

#[test]
fn data_that_meet_may_be_off_by_rounding() -> Result<(), Error> {
    let value = |value| Condition::Dirichlet { value };
    let contact = Condition::Contact { gap: 1.0, flux: 0.0 };
    let off = |steps: f64| steps * f64::EPSILON;
    for (first, second, refused) in [
        // Values may differ by ε of the larger: 4 and the next number do, by 4 ε.
        (value(4.0), value(4.0 * (1.0 + off(1.0))), None),
        (value(4.0), value(4.0 * (1.0 + off(2.0))), Some(Verdict::Unavailable)),
        // u_D may lie below ψ by 64 ε of the largest value, here 1.
        (value(1.0 - off(64.0)), contact, None),
        (value(1.0 - off(65.0)), contact, Some(Verdict::BelowGap)),
    ] {
        let found = of_square((&TWO, &[]), UNIT, beside(first, second))?;
        assert_eq!(Some(found).filter(|found| found.certificate().is_none()), refused);
    }
    Ok(())
}
