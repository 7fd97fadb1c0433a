//! The continuous function of the error bound: exact where u is linear, and admissible everywhere.

use crate::numbering::Side;
use crate::owned::Packed;
use crate::plate::{Plate, plate};
use signorini_bound::averages;
use signorini_bound::conforming::{VertexData, impose};
use signorini_kernel::Error;
use signorini_kernel::assembly::CellLoads;
use signorini_kernel::law::Law;
use signorini_kernel::stiffness::Stiffness;
use signorini_tolerances::kernel::{LINEAR, WEIGHTED};

const SIDES: [Side; 4] = [Side::Contact, Side::Contact, Side::Insulated, Side::Given];

/// s from a function whose means are those of its middle values, data ψ and u_D, and α.
fn conforming(
    u: fn([f64; 2]) -> f64,
    psi: fn([f64; 2]) -> f64,
    given: fn([f64; 2]) -> f64,
    alpha: fn(usize) -> f64,
) -> Result<(Plate, Vec<f64>, f64), Error> {
    let plate = plate(SIDES)?;
    let (mesh, edges, counts) = (plate.mesh()?, plate.edges()?, plate.counts);
    let vertex = |at: u16| plate.vertices[usize::from(at)];
    let ends: Vec<_> =
        (0..counts.edges()).map(|edge| edges.endpoints(&mesh, edge).map(vertex)).collect();
    let middle = |[a, b]: [[f64; 2]; 2]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    let mut means: Vec<_> = ends.iter().map(|&ends| u(middle(ends))).collect();
    let on_contact = &ends[counts.free..counts.unknowns()];
    let lower: Vec<_> = on_contact.iter().map(|&ends| psi(middle(ends))).collect();
    for (mean, &lower) in means[counts.free..].iter_mut().zip(&lower) {
        *mean = mean.max(lower);
    }
    let gap: Vec<_> = on_contact.iter().map(|ends| ends.map(psi)).collect();
    let given: Vec<_> = ends[counts.unknowns()..].iter().map(|ends| ends.map(given)).collect();
    let mut values = averages(&plate, &(0..edges.cells()).map(alpha).collect::<Vec<_>>(), &means)?;
    let data = VertexData { gap: &gap, given: &given };
    let below = impose(&mesh, &edges, &means, Law::above(&lower), data, &mut values)?;
    Ok((plate, values, below))
}

/// The weighted means at the vertices.
fn averages(plate: &Plate, alpha: &[f64], means: &[f64]) -> Result<Vec<f64>, Error> {
    let (mesh, edges) = (plate.mesh()?, plate.edges()?);
    let root = |edge| edge >= edges.counts().unknowns();
    let (t, q) = (plate.triangles.len(), plate.quads.len());
    let stiffness = Stiffness { triangles: &vec![[0.0; 3]; t], quads: &vec![[0.0; 6]; q] };
    let a = [alpha, &vec![1.0; t]];
    let packed = Packed::new((&mesh, &edges), stiffness, a, |_| 1.0, root)?;
    let (mut values, mut tau) = (vec![f64::NAN; plate.vertices.len()], vec![0.0; means.len()]);
    let loads = CellLoads { triangles: &[], quads: &[] };
    averages::fill(&packed.cells(&edges)?, (loads, None), &[], means, &mut values, &mut tau)?;
    Ok(values)
}

fn linear([x, y]: [f64; 2]) -> f64 {
    3.0 + 2.0 * x - y
}

#[test]
fn linear_functions_are_kept() {
    let s = conforming(linear, |_| -100.0, linear, |cell| 1.0 + cell as f64);
    let (plate, values, below) = s.expect("valid");
    assert_eq!(below, 0.0);
    for (at, &s) in plate.vertices.iter().zip(&values) {
        LINEAR.check(format_args!("s at {at:?}"), s - linear(*at));
    }
}

#[test]
fn s_is_on_the_gap_where_u_is_and_above_it_elsewhere() {
    // Above the gap only right of x = 2.
    let psi = |[_, y]: [f64; 2]| 7.0 - y;
    let (plate, values, below) = conforming(linear, psi, |_| 20.0, |_| 1.0).expect("valid");
    assert_eq!(below, 0.0);
    for (&[x, y], &s) in plate.vertices.iter().zip(&values) {
        if x == 0.0 {
            assert_eq!(s, 20.0, "D wins in the corner");
        } else if y == 0.0 && x <= 2.0 {
            assert_eq!(s, psi([x, y]), "active at {x}");
        } else if y == 0.0 || x == 5.0 {
            assert!(s >= psi([x, y]), "{s} at {x}, {y}");
            LINEAR.check(format_args!("s at {x}, {y}"), s - linear([x, y]));
        }
    }
}

#[test]
fn stiff_cells_decide_and_u_d_below_the_gap_is_told() {
    // A kink at x = 3 that no cell crosses, and a stiff cell on its left.
    let kink = |[x, _]: [f64; 2]| if x > 3.0 { 10.0 } else { 0.0 };
    let left = |cell: usize| if cell == 2 { 1e9 } else { 1.0 };
    let (_, even, _) = conforming(kink, |_| -100.0, |_| 0.0, |_| 1.0).expect("valid");
    let (plate, weighted, _) = conforming(kink, |_| -100.0, |_| 0.0, left).expect("valid");
    // Cell 2 is the triangle (2, 0), (3, 0), (3, 1), where u = 0 and s must be 0 by its weight alone.
    let corners = plate.triangles[2].map(usize::from);
    assert!(corners.iter().any(|&vertex| even[vertex] > 1.0), "{even:?}");
    corners.iter().for_each(|&vertex| WEIGHTED.check("s in a corner", weighted[vertex]));
    let (_, _, below) = conforming(linear, |_| -1.0, |_| -1.5, |_| 1.0).expect("valid");
    assert_eq!(below, 0.5, "where D and C meet");
}
