//! The short way through the layers: answers with a bound at a deadline, and a plate that has none.

use super::{OPEN, UNIT, ZERO, sides};
use crate::numbering::{Cut, cells, corners};
use signorini_device::condition::{BoundaryEdge, Condition};
use signorini_device::tick::{Deadline, Limits, Report};
use signorini_device::workspace;
use signorini_kernel::error::Array;
use signorini_kernel::relaxation::Relaxation;
use signorini_kernel::report::Ended;
use signorini_kernel::solver::Settings;
use signorini_kernel::{Error, Mesh};

/// Squares in each direction of the unit square.
const N: usize = 8;
const NODES: usize = (N + 1) * (N + 1);

type Triangles = workspace!(f64, u16: vertices NODES, triangles 2 * N * N, quads 0, boundary 4 * N);
type Lean =
    workspace!(f64, u16: vertices NODES, triangles 2 * N * N, quads 0, boundary 4 * N, ticks only);
type Quads = workspace!(f64, u16: vertices NODES, triangles 0, quads N * N, boundary 4 * N);

fn nodes() -> Vec<[f64; 2]> {
    corners([N, N]).map(|node| node.map(|k| k / N as f64)).collect()
}

fn quads() -> Vec<[u16; 4]> {
    cells([N, N], |_, _| Cut::Whole).1
}

fn triangles() -> Vec<[u16; 3]> {
    cells([N, N], |_, _| Cut::First).0
}

/// −u″ = 2 with u(0) = 0 on the left, and `right` there; nothing passes the rest.
fn bar(right: Condition<f64>) -> impl Fn(&BoundaryEdge<f64, u16>) -> Option<Condition<f64>> {
    sides(1.0, [ZERO, right, OPEN])
}

/// Until more sweeps change this share of the bound.
fn until(share: f64) -> Limits<f64> {
    Limits { error: 0.0, share, sweeps: 10_000 }
}

/// ∫|∇s − ∇u|² for u = x(2 − x) and s linear on each triangle, by the middles of the sides: exact.
fn error_of_s(s: &[f64]) -> f64 {
    let nodes = nodes();
    let of = |[a, b, c]: [u16; 3]| {
        let [p, q, r] = [a, b, c].map(|node| nodes[node as usize]);
        let [u, v, w] = [a, b, c].map(|node| s[node as usize]);
        let double = (q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]);
        let dx = ((v - u) * (r[1] - p[1]) - (w - u) * (q[1] - p[1])) / double;
        let dy = ((w - u) * (q[0] - p[0]) - (v - u) * (r[0] - p[0])) / double;
        let middles = [[p, q], [q, r], [r, p]].map(|[a, b]| 0.5 * (a[0] + b[0]));
        let square = |x: f64| (dx - (2.0 - 2.0 * x)).powi(2) + dy * dy;
        double / 6.0 * middles.into_iter().map(square).sum::<f64>()
    };
    triangles().into_iter().map(of).sum::<f64>().sqrt()
}

/// Report, bound, and error of s of a tick of the bar that touches nothing.
fn insulated(
    of: &mut Triangles,
    deadline: &mut Deadline<impl FnMut() -> u32>,
) -> Result<(Report<f64>, [f64; 2]), Error> {
    let (nodes, cells) = (nodes(), triangles());
    let mesh = Mesh::new(&nodes, &cells, &[])?;
    of.build(&mesh, UNIT, bar(Condition::Contact { gap: -1.0, flux: 0.0 }))?;
    of.set_source(&[2.0 / (2 * N * N) as f64; 2 * N * N], &[])?;
    let report = of.tick(&mesh, until(1e-6), deadline)?;
    let bound = report.verdict.certificate().expect("a bound").total;
    Ok((report, [bound, error_of_s(of.vertices())]))
}

#[test]
fn the_bound_is_one_and_no_more_than_twice_the_error() -> Result<(), Error> {
    let mut bar_of_triangles = Triangles::new();
    let (report, [bound, error]) = insulated(&mut bar_of_triangles, &mut Deadline::never())?;
    println!("bound {bound:e}, error of s {error:e}");
    assert!(bound >= error && bound < 2.0 * error, "{bound} {error}");
    assert_eq!(report.active, 0);
    // Cut off before the first sweep: wrong by far more, and it says so.
    let mut late = Deadline { remaining: || 0, sweep: 1, certificate: 1 };
    let (report, [bound, error]) = insulated(&mut bar_of_triangles, &mut late)?;
    assert_eq!((report.ended, report.sweeps), (Ended::OutOfTime, 0));
    assert!(bound >= error && error > 0.5, "{bound} {error}");
    Ok(())
}

/// The largest difference.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
}

/// Both models of a cell, with and without the matrix, give the solution that a solve gives.
#[test]
fn a_tick_to_the_end_is_a_solve() -> Result<(), Error> {
    let (nodes, triangles, quads) = (nodes(), triangles(), quads());
    let contact = || bar(Condition::Contact { gap: 1.5, flux: 0.0 });
    let load = 2.0 / (N * N) as f64;
    let mesh = Mesh::new(&nodes, &triangles, &[])?;
    let (mut whole, mut lean) = (Triangles::new(), Lean::new());
    whole.build(&mesh, UNIT, contact())?;
    lean.build(&mesh, UNIT, contact())?;
    whole.set_source(&[load / 2.0; 2 * N * N], &[])?;
    lean.set_source(&[load / 2.0; 2 * N * N], &[])?;
    whole.solve(Settings::default())?;
    let (limits, mut never) = (until(1e-12), Deadline::never());
    let report = lean.tick(&mesh, limits, &mut never)?;
    let needed = whole.edges()?.nonzeros();
    let refused = Error::Capacity { of: Array::MatrixValues, needed, limit: 0 };
    assert_eq!(lean.solve(Settings::default()), Err(refused));
    assert!(apart(whole.u(), lean.u()) < 1e-9, "{}", apart(whole.u(), lean.u()));
    assert!((whole.contact_force() - lean.contact_force()).abs() < 1e-9);
    assert!((report.figures.force - lean.contact_force()).abs() < 1e-12);
    assert_eq!(report.active, N as u32);
    // Held at 1.5 on the right: the slope there is ½ by −u″ = 2 and u(1) = 3/2.
    assert!((lean.contact_force() - 0.5).abs() < 1e-6, "{}", lean.contact_force());
    let mesh = Mesh::new(&nodes, &[], &quads)?;
    let mut of_quads = Quads::new();
    of_quads.build(&mesh, UNIT, contact())?;
    of_quads.set_source(&[], &[load; N * N])?;
    let report = of_quads.tick(&mesh, limits, &mut never)?;
    assert!(report.verdict.certificate().is_some_and(|bound| bound.total < 0.1), "{report:?}");
    assert!((of_quads.contact_force() - 0.5).abs() < 1e-6, "{}", of_quads.contact_force());
    Ok(())
}

/// New data and a transfer coefficient that changes: as if they had been there from the start.
#[test]
fn data_that_change_are_data_that_were_there() -> Result<(), Error> {
    let (nodes, cells) = (nodes(), triangles());
    let mesh = Mesh::new(&nodes, &cells, &[])?;
    let conditions = |h: f64, gap: f64| {
        move |edge: &BoundaryEdge<f64, u16>| {
            Some(match edge.middle() {
                [0.0, _] => Condition::Robin { coefficient: h, ambient: -1.0 },
                [1.0, y] => Condition::ContactBetween { gaps: [gap, gap + y], flux: -0.1 },
                [_, 0.0] => Condition::DirichletBetween { values: edge.ends.map(|[x, _]| x * x) },
                _ => Condition::Neumann { flux: 0.2 * h },
            })
        }
    };
    let (limits, mut never) = (until(1e-6), Deadline::never());
    let (mut changed, mut new) = (Triangles::new(), Triangles::new());
    changed.build(&mesh, UNIT, conditions(1.0, 0.2))?;
    changed.set_source(&[0.01; 2 * N * N], &[])?;
    changed.tick(&mesh, limits, &mut never)?;
    for (h, gap) in [(1.0, 0.5), (3.0, 0.5), (0.0, 0.1), (2.0, -0.4)] {
        let mut asked = 0;
        let counted = |edge: &BoundaryEdge<f64, u16>| {
            asked += 1;
            conditions(h, gap)(edge)
        };
        changed.set_conditions(&mesh, counted)?;
        assert_eq!(asked, 2 * 4 * N);
        new.build(&mesh, UNIT, conditions(h, gap))?;
        new.set_source(&[0.01; 2 * N * N], &[])?;
        for plate in [&mut changed, &mut new] {
            plate.set_relaxation(Relaxation::Fixed(1.5))?;
        }
        let [a, b] = [&mut changed, &mut new].map(|plate| plate.tick(&mesh, limits, &mut never));
        let total = |report: &Report<f64>| report.verdict.certificate().map(|bound| bound.total);
        let [a, b] = [total(&a?).expect("a bound"), total(&b?).expect("a bound")];
        assert!((a / b - 1.0).abs() < 1e-4, "{a} {b}");
        let worst = apart(changed.u(), new.u());
        assert!(worst < 1e-5, "{worst}");
        changed.solve(Settings::default())?;
        new.solve(Settings::default())?;
        let worst = apart(changed.u(), new.u());
        assert!(worst < 1e-9, "{worst}");
    }
    Ok(())
}

/// Contact alone holds the plate: no bound, and a solve goes on.
#[test]
fn contact_alone_leaves_no_way_out() -> Result<(), Error> {
    let (nodes, cells) = (nodes(), triangles());
    let mesh = Mesh::new(&nodes, &cells, &[])?;
    let mut plate = Triangles::new();
    let (limits, mut never) = (until(1e-6), Deadline::never());
    let (contact, out) =
        (Condition::Contact { gap: 0.0, flux: 0.0 }, Condition::Neumann { flux: -0.1 });
    plate.build(&mesh, UNIT, sides(1.0, [out, contact, out]))?;
    assert!(matches!(plate.tick(&mesh, limits, &mut never), Err(Error::NoWayOut { .. })));
    plate.solve(Settings::default())?;
    assert!((plate.contact_force() - 0.3).abs() < 1e-9, "{}", plate.contact_force());
    Ok(())
}

/// Another mesh of the same sizes has neighbours of its own: rows that were laid out for the first are laid out anew.
#[test]
fn a_workspace_forgets_its_mesh() -> Result<(), Error> {
    let (nodes, triangles) = (nodes(), triangles());
    let turned: Vec<_> = triangles.iter().rev().copied().collect();
    let contact = || bar(Condition::Contact { gap: 1.5, flux: 0.0 });
    let (first, second) = (Mesh::new(&nodes, &triangles, &[])?, Mesh::new(&nodes, &turned, &[])?);
    let tick = |of: &mut Triangles| {
        of.build(&second, UNIT, contact())?;
        of.set_source(&[1.0 / (N * N) as f64; 2 * N * N], &[])?;
        of.tick(&second, until(1e-6), &mut Deadline::never())
    };
    let (mut used, mut fresh) = (Triangles::new(), Triangles::new());
    used.build(&first, UNIT, contact())?;
    used.tick(&first, until(1e-6), &mut Deadline::never())?;
    assert_eq!(tick(&mut used)?, tick(&mut fresh)?);
    assert_eq!(used.u(), fresh.u());
    Ok(())
}
