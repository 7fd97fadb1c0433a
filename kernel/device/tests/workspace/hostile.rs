//! Workspaces where the scalar or the caller fails them: no bound that is none, no answer to another question.

use super::{OPEN, Plate, SQUARE, TWO, UNIT, built, sides, sweeps};
use signorini_bound::certificate::Verdict;
use signorini_device::condition::{BoundaryEdge, Condition};
use signorini_device::tick::Deadline;
use signorini_kernel::solver::Settings;
use signorini_kernel::stiffness::Coefficient;
use signorini_kernel::{Error, Mesh, Real, Tensor};

/// 0 on the left, nothing passes the rest.
fn held<R: Real>(edge: &BoundaryEdge<R, u16>) -> Option<Condition<R>> {
    Some(match edge.middle()[0] == R::ZERO {
        true => Condition::Dirichlet { value: R::ZERO },
        false => Condition::Neumann { flux: R::ZERO },
    })
}

/// The element matrix of a thin rectangle in f32 has lost the small entry of B.
#[test]
fn thin_rectangles_have_no_bound_in_f32() -> Result<(), Error> {
    for (length, is_told) in [(1.0_f32, true), (10.0, true), (1e4, false), (1e5, false)] {
        let at = |k: u16| [f32::from(k % 3) * length * 0.5, f32::from(k / 3) * 0.5];
        let vertices: Vec<[f32; 2]> = (0..9).map(at).collect();
        let quads = [[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]];
        let mesh = Mesh::<f32, u16>::new(&vertices, &[], &quads)?;
        let mut plate = Plate::<f32>::new();
        plate.build(&mesh, Coefficient::Uniform(Tensor::scalar(1.0)), held)?;
        plate.set_source(&[], &[0.25; 4])?;
        let report = plate.tick(&mesh, sweeps(10_000), &mut Deadline::never())?;
        assert_eq!(report.verdict != Verdict::Unavailable, is_told, "{length}: {report:?}");
    }
    Ok(())
}

#[test]
fn a_determinant_that_overflows_has_no_bound() -> Result<(), Error> {
    let square = SQUARE.map(|vertex| vertex.map(|x| x as f32));
    let mesh = Mesh::<f32, u16>::new(&square, &TWO, &[])?;
    let mut plate = Plate::<f32>::new();
    plate.build(&mesh, Coefficient::Uniform(Tensor::scalar(2e19)), held)?;
    plate.set_source(&[1e8; 2], &[])?;
    let report = plate.tick(&mesh, sweeps(10_000), &mut Deadline::never())?;
    assert_eq!(report.verdict, Verdict::NotFinite);
    Ok(())
}

/// The gap of (s, τ) in f64, by the middles of the sides: exact for triangles.
fn gap(plate: &Plate<f32>, vertices: &[[f32; 2]], cells: &[[u16; 3]], a: Tensor<f64>) -> f64 {
    let edges = plate.edges().expect("built");
    let det = a.xx * a.yy - a.xy * a.xy;
    let of = |(at, cell): (usize, &[u16; 3])| {
        let p = cell.map(|vertex| vertices[usize::from(vertex)].map(f64::from));
        let s = cell.map(|vertex| f64::from(plate.vertices()[usize::from(vertex)]));
        let side = |k: usize| [p[k][0] - p[0][0], p[k][1] - p[0][1]];
        let (v, w) = (side(1), side(2));
        let double = v[0] * w[1] - w[0] * v[1];
        let slope = [
            ((s[1] - s[0]) * w[1] - (s[2] - s[0]) * v[1]) / double,
            ((s[2] - s[0]) * v[0] - (s[1] - s[0]) * w[0]) / double,
        ];
        let out: [f64; 3] = std::array::from_fn(|side| {
            let edge = usize::from(edges.of_triangles()[at][side]);
            let along = usize::from(edges.half_edges()[edge][0]) == 3 * at + side;
            f64::from(plate.flux()[edge]) * if along { 1.0 } else { -1.0 }
        });
        let square = |side: usize| {
            let x = [0, 1].map(|k| 0.5 * (p[side][k] + p[(side + 1) % 3][k]));
            let of_side = |j: usize, k: usize| out[j] * (x[k] - p[[2, 0, 1][j]][k]) / double;
            let tau = [0, 1].map(|k| (0..3).map(|j| of_side(j, k)).sum::<f64>());
            let e = [
                a.xx * slope[0] + a.xy * slope[1] - tau[0],
                a.xy * slope[0] + a.yy * slope[1] - tau[1],
            ];
            (a.yy * e[0] * e[0] - 2.0 * a.xy * e[0] * e[1] + a.xx * e[1] * e[1]) / det
        };
        double / 6.0 * (0..3).map(square).sum::<f64>()
    };
    cells.iter().enumerate().map(of).sum::<f64>().sqrt()
}

/// Rectangles stretched along an oblique A look square to their element matrices, but every sum has cancelled.
#[test]
fn bounds_hold_where_shape_and_tensor_cancel() -> Result<(), Error> {
    let (mut bounds, mut refused) = (0, 0);
    for (ratio, step) in
        [1.0_f64, 100.0, 1e4, 1e6].into_iter().flat_map(|r| (0..20).map(move |k| (r, k)))
    {
        let (sin, cos) = (0.3 + 0.05 * f64::from(step)).sin_cos();
        let a = Tensor {
            xx: (ratio * cos * cos + sin * sin) as f32,
            xy: ((ratio - 1.0) * cos * sin) as f32,
            yy: (ratio * sin * sin + cos * cos) as f32,
        };
        let turned = |x: f64, y: f64| [(cos * x - sin * y) as f32, (sin * x + cos * y) as f32];
        let at = |k: u16| turned(f64::from(k / 2) * ratio.sqrt(), f64::from(k % 2));
        let vertices: Vec<[f32; 2]> = (0..6).map(at).collect();
        let cells = [[0, 2, 3], [0, 3, 1], [2, 4, 5], [2, 5, 3]];
        let mesh = Mesh::<f32, u16>::new(&vertices, &cells, &[])?;
        let ends = |edge: &BoundaryEdge<f32, u16>| {
            let all = |from: u16, to: u16| edge.vertices.iter().all(|v| (from..to).contains(v));
            Some(match (all(0, 2), all(4, 6)) {
                (true, _) => Condition::Dirichlet { value: 0.0 },
                (_, true) => Condition::Dirichlet { value: 1.0 },
                _ => Condition::Neumann { flux: 0.0 },
            })
        };
        for most in [0, 3, 1000] {
            let mut plate = Plate::<f32>::new();
            match plate.build(&mesh, Coefficient::Uniform(a), ends) {
                Err(Error::Oblique(_)) => refused += 1,
                built => {
                    built?;
                    let report = plate.tick(&mesh, sweeps(most), &mut Deadline::never())?;
                    let total = f64::from(report.verdict.certificate().expect("a bound").total);
                    let tensor = Tensor { xx: a.xx.into(), xy: a.xy.into(), yy: a.yy.into() };
                    let exact = gap(&plate, &vertices, &cells, tensor);
                    assert!(total >= exact, "{ratio} {step} {most}: {total:e} {exact:e}");
                    bounds += 1;
                }
            }
        }
    }
    println!("{bounds} bounds, {refused} refused");
    assert!(bounds > 100 && refused > 0);
    Ok(())
}

/// A condition's second answer counts; where that is refused, nothing is answered.
#[test]
fn a_condition_that_changes_its_mind() -> Result<(), Error> {
    let mesh = Mesh::<f64, u16>::new(&SQUARE, &TWO, &[])?;
    let law = |coefficient: f64, value: f64| {
        let robin = Condition::Robin { coefficient, ambient: 0.0 };
        sides(1.0, [robin, Condition::Dirichlet { value }, OPEN])
    };
    let mut plate = built(&mesh, UNIT, law(1.0, 1.0))?;
    let mut plain = built(&mesh, UNIT, law(0.0, 1.0))?;
    let mut asked = 0;
    plate.set_conditions(&mesh, |edge| {
        asked += 1;
        law(if asked > 4 { 0.0 } else { 1.0 }, 1.0)(edge)
    })?;
    for plate in [&mut plate, &mut plain] {
        plate.set_source(&[1.0, 0.0], &[])?;
        plate.tick(&mesh, sweeps(0), &mut Deadline::never())?;
    }
    assert_eq!((plate.vertices(), plate.flux()), (plain.vertices(), plain.flux()));
    let mut asked = 0;
    let late = plate.set_conditions(&mesh, |edge| {
        asked += 1;
        law(0.0, if asked > 4 { f64::NAN } else { 1.0 })(edge)
    });
    assert!(matches!(late, Err(Error::NotFinite { .. })), "{late:?}");
    assert!(plate.u().iter().all(|u| u.is_finite()));
    assert_eq!(plate.tick(&mesh, sweeps(1), &mut Deadline::never()), Err(Error::NotBuilt));
    assert_eq!(plate.solve(Settings::default()), Err(Error::NotBuilt));
    assert_eq!(plate.set_conditions(&mesh, law(1.0, 1.0)), Err(Error::NotBuilt));
    plate.build(&mesh, UNIT, law(1.0, 1.0))?;
    plate.tick(&mesh, sweeps(1), &mut Deadline::never()).map(drop)
}

#[test]
fn a_workspace_answers_for_the_mesh_that_it_has() -> Result<(), Error> {
    let mesh = Mesh::<f64, u16>::new(&SQUARE, &TWO, &[])?;
    let mut plate = Plate::<f64>::new();
    assert_eq!(plate.tick(&mesh, sweeps(1), &mut Deadline::never()), Err(Error::NotBuilt));
    assert_eq!(plate.set_source(&[], &[]), Err(Error::NotBuilt));
    plate.build(&mesh, UNIT, held)?;
    let turned = [[2, 3, 0], [0, 1, 2]];
    let other = Mesh::<f64, u16>::new(&SQUARE, &turned, &[])?;
    assert_eq!(plate.tick(&other, sweeps(1), &mut Deadline::never()), Err(Error::OtherMesh));
    let smaller = Mesh::<f64, u16>::new(&SQUARE, &[TWO[0]], &[])?;
    assert_eq!(plate.set_conditions(&smaller, held), Err(Error::OtherMesh));
    plate.tick(&mesh, sweeps(1), &mut Deadline::never())?;
    assert_eq!(plate.build(&mesh, UNIT, |_| None), Err(Error::NoCondition([0, 1])));
    assert_eq!(plate.tick(&mesh, sweeps(1), &mut Deadline::never()), Err(Error::NotBuilt));
    Ok(())
}

/// New conditions are no new answer: force and touching edges stay those of the last one.
#[test]
fn the_last_answer_outlives_new_conditions() -> Result<(), Error> {
    let mesh = Mesh::<f64, u16>::new(&SQUARE, &TWO, &[])?;
    let at_least = |gap: f64, value: f64| {
        sides(1.0, [Condition::Dirichlet { value }, Condition::Contact { gap, flux: 0.0 }, OPEN])
    };
    let mut plate = built(&mesh, UNIT, at_least(2.0, 0.0))?;
    plate.tick(&mesh, sweeps(10_000), &mut Deadline::never())?;
    let u = plate.u().to_vec();
    assert!((plate.contact_force() - 2.0).abs() < 1e-9, "{}", plate.contact_force());
    plate.set_conditions(&mesh, at_least(1.0, 1e290))?;
    let refused = plate.tick(&mesh, sweeps(1), &mut Deadline::never());
    assert!(matches!(refused, Err(Error::NotFinite { .. })), "{refused:?}");
    assert_eq!(plate.u(), u);
    assert!((plate.contact_force() - 2.0).abs() < 1e-9, "{}", plate.contact_force());
    Ok(())
}
