//! Elements and areas against numbers worked out by hand, on cells of no special size.

use signorini_kernel::element::{crouzeix_raviart, rannacher_turek};
use signorini_kernel::error::{Array, CellId};
use signorini_kernel::law::Law;
use signorini_kernel::mesh::edges::EdgeCounts;
use signorini_kernel::mesh::geometry::{quad_area, triangle_area};
use signorini_kernel::stiffness::{Coefficient, fill};
use signorini_kernel::{Error, Mesh, Real, Tensor, contact};
use signorini_tolerances::kernel::BASIS;

/// Area 3.
const TRIANGLE: [[f64; 2]; 3] = [[1.0, 1.0], [3.0, 2.0], [2.0, 4.5]];
/// Area 6, sides along (3, 1) and (0, 2).
const PARALLELOGRAM: [[f64; 2]; 4] = [[1.0, 1.0], [4.0, 2.0], [4.0, 4.0], [1.0, 3.0]];
/// No two sides are parallel.
const QUAD: [[f64; 2]; 4] = [[1.0, 1.0], [5.0, 2.0], [6.0, 5.0], [0.5, 4.0]];

/// The outward flux of a constant field through every side.
fn outward<const N: usize>(corners: [[f64; 2]; N], field: [f64; 2]) -> [f64; N] {
    std::array::from_fn(|k| {
        let (a, b) = (corners[k], corners[(k + 1) % N]);
        field[0] * (b[1] - a[1]) - field[1] * (b[0] - a[0])
    })
}

/// Means of 2x + 3y + 1 over the sides.
fn means<const N: usize>(corners: [[f64; 2]; N]) -> [f64; N] {
    std::array::from_fn(|k| {
        let (a, b) = (corners[k], corners[(k + 1) % N]);
        a[0] + b[0] + 1.5 * (a[1] + b[1]) + 1.0
    })
}

fn close(found: [f64; 2], expected: [f64; 2]) {
    let apart = (found[0] - expected[0]).abs().max((found[1] - expected[1]).abs());
    BASIS.check(format_args!("{found:?} instead of {expected:?}"), apart);
}

#[test]
fn areas() {
    assert_eq!(triangle_area(TRIANGLE), 3.0);
    assert_eq!(quad_area(PARALLELOGRAM), 6.0);
    // Shoelaces: ½ (−3 + 13 + 21.5 − 3.5)
    assert_eq!(quad_area(QUAD), 14.0);
}

#[test]
fn bases_have_mean_1_over_their_own_side_and_0_over_the_others() {
    for k in 0..3 {
        let middle = std::array::from_fn(|i| if i == (k + 2) % 3 { 0.0 } else { 0.5 });
        let expected: [f64; 3] = std::array::from_fn(|j| f64::from(u8::from(j == k)));
        assert_eq!(crouzeix_raviart::basis(middle), expected);
    }
    assert_eq!(crouzeix_raviart::basis([0.5, 0.375, 0.125]), [0.75, 0.0, 0.25]);
    let along = |k: usize, t: f64| [[t, 0.0], [1.0, t], [t, 1.0], [0.0, t]][k];
    for k in 0..4 {
        let mut sums = [0.0; 4];
        for &[t, weight] in f64::GAUSS[1] {
            let basis = rannacher_turek::place(QUAD, along(k, t)).basis();
            sums.iter_mut().zip(basis).for_each(|(sum, value)| *sum += weight * value);
        }
        for (j, sum) in sums.into_iter().enumerate() {
            BASIS.check(format_args!("side {k}: {sums:?}"), sum - f64::from(u8::from(j == k)));
        }
    }
    // ¼ ∓ ½·centred coordinate… at (¼, 1): x = −¼, y = ½, bubble 3/2 (1/16 − 1/4) = −9/32.
    let basis = rannacher_turek::place(QUAD, [0.25, 1.0]).basis();
    assert_eq!(basis, [0.03125, -0.28125, 1.03125, 0.21875]);
}

#[test]
fn the_bilinear_map_goes_through_the_corners_and_is_linear_in_each_coordinate() {
    let at = |x: f64, y: f64| rannacher_turek::place(QUAD, [x, y]);
    let expected = |x: f64, y: f64| {
        [0, 1].map(|k| {
            let [a, b, c, d] = QUAD.map(|corner| corner[k]);
            a * (1.0 - x) * (1.0 - y) + b * x * (1.0 - y) + c * x * y + d * (1.0 - x) * y
        })
    };
    for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.25, 0.5), (0.75, 0.25), (0.5, 1.0)] {
        assert_eq!(at(x, y).x, expected(x, y));
        let [along_x, along_y] = at(x, y).directions();
        let difference = |p: [f64; 2], q: [f64; 2]| [q[0] - p[0], q[1] - p[1]];
        assert_eq!(along_x, difference(expected(0.0, y), expected(1.0, y)));
        assert_eq!(along_y, difference(expected(x, 0.0), expected(x, 1.0)));
        let determinant = along_x[0] * along_y[1] - along_x[1] * along_y[0];
        assert_eq!(at(x, y).determinant, determinant);
    }
}

#[test]
fn linear_functions_and_constant_fields_are_kept() {
    let gradient = crouzeix_raviart::gradient(TRIANGLE, means(TRIANGLE));
    close(gradient.into(), [2.0, 3.0]);
    let field = [2.0, -0.75];
    let flux = outward(TRIANGLE, field);
    close(crouzeix_raviart::raviart_thomas(TRIANGLE, flux, [2.0, 2.25]).into(), field);
    for point in [[0.25, 0.125], [0.5, 1.0]] {
        let place = rannacher_turek::place(PARALLELOGRAM, point);
        close(place.gradient(means(PARALLELOGRAM)).into(), [2.0, 3.0]);
        close(place.raviart_thomas(outward(PARALLELOGRAM, field)).into(), field);
        // Piola's map keeps them on any quad.
        let place = rannacher_turek::place(QUAD, point);
        close(place.raviart_thomas(outward(QUAD, field)).into(), field);
    }
}

#[test]
fn tensors_are_checked_cell_by_cell() -> Result<(), Error> {
    let vertices = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 0.0], [2.0, 1.0]];
    let triangles = [[0_u16, 1, 2], [0, 2, 3]];
    let quads = [[1_u16, 4, 5, 2]];
    let (good, bad) = (Tensor::scalar(1.0), Tensor { xx: 1.0, xy: 2.0, yy: 1.0 });
    let run = |triangles: &[[u16; 3]], quads: &[[u16; 4]], coefficient: Coefficient<f64>| {
        let mesh = Mesh::new(&vertices, triangles, quads)?;
        let (mut k3, mut k4) = (vec![[0.0; 3]; triangles.len()], vec![[0.0; 6]; quads.len()]);
        fill(&mesh, coefficient, 2, &mut k3, &mut k4)
    };
    let all = |tensors: &[Tensor<f64>]| run(&triangles, &quads, Coefficient::PerCell(tensors));
    assert_eq!(all(&[good; 3]), Ok(()));
    let refused = |cell| Err(Error::NotPositiveDefinite(cell));
    assert_eq!(all(&[good, bad, good]), refused(CellId::Triangle(1)));
    assert_eq!(all(&[good, good, bad]), refused(CellId::Quad(0)));
    for found in [2, 4] {
        let refused = Error::Length { of: Array::Coefficients, found, expected: 3 };
        assert_eq!(all(&vec![good; found]).err(), Some(refused));
    }
    let alone = run(&[], &quads, Coefficient::Uniform(bad));
    assert_eq!(alone, refused(CellId::Quad(0)));
    // One point of four.
    let points = [good, good, bad, good];
    assert_eq!(run(&[], &quads, Coefficient::PerPoint(&points)), refused(CellId::Quad(0)));

    // Squared by the geometry, the largest numbers overflow.
    let huge = Tensor::scalar(f64::MAX);
    let thin = [[0.0, 0.0], [1.0, 0.0], [0.0, 1e-3], [1.0, 1e-3]];
    let cells = [[0_u16, 1, 2], [1, 3, 2]];
    let mesh = Mesh::new(&thin, &cells, &[])?;
    let overflow = |at| Err(Error::NotFinite { of: Array::Stiffness, at });
    let mut k = [[0.0; 3]; 2];
    assert_eq!(fill(&mesh, Coefficient::Uniform(huge), 1, &mut k, &mut []), overflow(0));
    let second = [good, huge];
    assert_eq!(fill(&mesh, Coefficient::PerCell(&second), 1, &mut k, &mut []), overflow(1));
    Ok(())
}

#[test]
fn trace_and_determinant_decide() {
    let definite = |xx: f64, xy: f64, yy: f64| Tensor { xx, xy, yy }.is_positive_definite();
    assert!(definite(1.0, 0.75, 1.0) && definite(1e-300, 0.0, 1e-300) && definite(4.0, -1.5, 1.0));
    assert!(!definite(1.0, 1.0, 1.0) && !definite(1.0, 1.25, 1.0) && !definite(1.0, 0.6, 0.25));
    assert!(!definite(0.0, 0.0, 0.0) && !definite(-1.0, 0.0, -2.0) && !definite(-1.0, 0.0, 2.0));
    assert!(!definite(0.0, 0.0, 1.0) && !definite(1.0, 0.0, 0.0));
    assert!(!definite(f64::INFINITY, 0.0, 1.0) && !definite(1.0, f64::NAN, 1.0));
}

#[test]
fn corners_that_rounding_hides_turn_nowhere() {
    let refused = |vertices: &[[f64; 2]], triangles: &[[u16; 3]], quads: &[[u16; 4]]| {
        Mesh::new(vertices, triangles, quads).map(|_| ())
    };
    // A triangle of coordinates near 1 whose corner is off a line by ε: the products tell nothing.
    let off = |by: f64| [[1.0, 1.0], [2.0, 2.0], [3.0, 3.0 + by * f64::EPSILON]];
    let degenerate = Err(Error::Degenerate(CellId::Triangle(0)));
    assert_eq!(refused(&off(4.0), &[[0, 1, 2]], &[]), degenerate);
    assert_eq!(refused(&off(-4.0), &[[0, 1, 2]], &[]), degenerate);
    assert_eq!(refused(&off(64.0), &[[0, 1, 2]], &[]), Ok(()));
    let clockwise = Err(Error::Clockwise(CellId::Triangle(0)));
    assert_eq!(refused(&off(-64.0), &[[0, 1, 2]], &[]), clockwise);
    // What rounding hides grows with the products, 128 each, not with their product.
    let long = [[0.0, 0.0], [8.0, 8.0], [16.0, 16.0 * (1.0 + 64.0 * f64::EPSILON)]];
    assert_eq!(refused(&long, &[[0, 1, 2]], &[]), Ok(()));
    // Three corners of a square on a line are no quad, all four of them no cell at all.
    let three = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 1.0]];
    assert_eq!(refused(&three, &[], &[[0, 1, 2, 3]]), Err(Error::NotConvex(CellId::Quad(0))));
    let four = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]];
    assert_eq!(refused(&four, &[], &[[0, 1, 2, 3]]), Err(Error::Degenerate(CellId::Quad(0))));
}

#[test]
fn an_edge_beyond_the_contact_edges_is_not_active() {
    let counts = EdgeCounts { free: 0, contact: 1, dirichlet: 1 };
    assert!(contact::is_active(counts, Law::above(&[0.0]), &[0.0, 0.0], 0));
    assert!(!contact::is_active(counts, Law::above(&[0.0]), &[0.0, 0.0], 1));
}
