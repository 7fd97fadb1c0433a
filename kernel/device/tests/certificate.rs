//! The bound against its definition, integrated from coordinates; and what it says of poor input.

use crate::memory::Draw;
use crate::numbering::{SIDES, Side};
use crate::plate::foundation::{A, Foundation, GAP, LAW};
use signorini_bound::certificate::{Buffers, Curved, Discretization, LoadCase, Verdict, certify};
use signorini_bound::equilibrium::Iterate;
use signorini_kernel::element::{crouzeix_raviart, rannacher_turek};
use signorini_kernel::law::Law;
use signorini_kernel::mesh::edges::Edges;
use signorini_kernel::{Error, Real};
use signorini_tolerances::kernel::BOUND;

struct Found {
    verdict: Verdict<f64>,
    /// gap² from coordinates.
    expected: f64,
    indicators: f64,
}

/// A pseudorandom iterate, above the gap on half of the contact edges.
fn iterate(edges: usize, free: usize) -> Vec<f64> {
    let mut draw = Draw(7);
    let mut u: Vec<_> = (0..edges).map(|_| draw.part()).collect();
    u[free..].iter_mut().step_by(2).for_each(|u| *u = GAP);
    u
}

fn run(sides: [Side; 4], at_points: bool, curved: &[Curved<f64, u16>]) -> Result<Found, Error> {
    run_from(iterate, sides, at_points, curved)
}

fn run_from(
    iterate: fn(usize, usize) -> Vec<f64>,
    sides: [Side; 4],
    at_points: bool,
    curved: &[Curved<f64, u16>],
) -> Result<Found, Error> {
    let foundation = Foundation::new(sides, at_points)?;
    let discretization = foundation.discretization()?;
    let given = LoadCase { curved, ..foundation.given()? };
    let counts = discretization.edges.counts();
    let u = iterate(counts.edges(), counts.free);
    let vertices = foundation.plate.vertices.len();
    let mut s = vec![f64::NAN; vertices];
    let (mut d, mut tau) = (vec![f64::NAN; counts.edges()], vec![f64::NAN; counts.edges()]);
    let mut indicators = vec![f64::NAN; discretization.edges.cells()];
    let buffers =
        Buffers { vertices: &mut s, bubbles: &mut d, tau: &mut tau, indicators: &mut indicators };
    let iterate = Iterate { u: &u, law: Law::above(&foundation.lower) };
    let verdict = certify(&discretization, &given, iterate, buffers)?;
    let fields = [&s[..], &d, &tau];
    let expected =
        from_coordinates(&discretization, fields) + on_boundary(&discretization, &given, fields);
    Ok(Found { verdict, expected, indicators: indicators.iter().sum() })
}

/// ∫τ·n over the sides of the cell whose half-edges begin with `first`.
fn outward<const N: usize>(
    edges: &Edges<u16>,
    first: usize,
    sides: [u16; N],
    tau: &[f64],
) -> [f64; N] {
    std::array::from_fn(|k| {
        let edge = usize::from(sides[k]);
        let along = usize::from(edges.half_edges()[edge][0]) == first + k;
        if along { tau[edge] } else { -tau[edge] }
    })
}

/// Σ_T ∫ |A^½∇s − A^{−½}τ|² with 6×6 points a cell, by the chain rule in the plane.
fn from_coordinates(of: &Discretization<f64, u16>, [s, d, tau]: [&[f64]; 3]) -> f64 {
    let (mesh, edges) = (of.mesh, of.edges);
    let determinant = A.xx * A.yy - A.xy * A.xy;
    let square = |[gx, gy]: [f64; 2], field: [f64; 2]| {
        let r = [A.xx * gx + A.xy * gy - field[0], A.xy * gx + A.yy * gy - field[1]];
        (A.yy * r[0] * r[0] - 2.0 * A.xy * r[0] * r[1] + A.xx * r[1] * r[1]) / determinant
    };
    let rule = f64::GAUSS[5];
    let mut sum = 0.0;
    for (at, vertices) in mesh.triangles().iter().enumerate() {
        let corners = mesh.triangle(vertices);
        let out = outward(&edges, 3 * at, edges.of_triangles()[at], tau);
        let values = vertices.map(|vertex| s[usize::from(vertex)]);
        let means = [0, 1, 2].map(|k| 0.5 * (values[k] + values[(k + 1) % 3]));
        let gradient = crouzeix_raviart::gradient(corners, means);
        let area = signorini_kernel::mesh::geometry::triangle_area(corners);
        for &[y, wy] in rule {
            for &[x, wx] in rule {
                let l = [(1.0 - x) * (1.0 - y), x * (1.0 - y), y];
                let point = [0, 1].map(|k| (0..3).map(|i| l[i] * corners[i][k]).sum());
                let field = crouzeix_raviart::raviart_thomas(corners, out, point);
                let weight = 2.0 * area * wx * wy * (1.0 - y);
                sum += weight * square(gradient.into(), field.into());
            }
        }
    }
    let first = 3 * mesh.triangles().len();
    for (at, vertices) in mesh.quads().iter().enumerate() {
        let corners = mesh.quad(vertices);
        let sides = edges.of_quads()[at];
        let out = outward(&edges, first + 4 * at, sides, tau);
        let values = vertices.map(|vertex| s[usize::from(vertex)]);
        let bubbles = sides.map(|edge| d[usize::from(edge)]);
        // Unit squares: physical derivatives are those on the reference square.
        let value = |[x, y]: [f64; 2]| {
            let shape = [(1.0 - x) * (1.0 - y), x * (1.0 - y), x * y, (1.0 - x) * y];
            let arch = [4.0 * x * (1.0 - x), 4.0 * y * (1.0 - y)];
            let bubble = [arch[0] * (1.0 - y), arch[1] * x, arch[0] * y, arch[1] * (1.0 - x)];
            (0..4).map(|k| shape[k] * values[k] + bubble[k] * bubbles[k]).sum::<f64>()
        };
        for &[y, wy] in rule {
            for &[x, wx] in rule {
                // Central differences are exact for quadratics in each variable.
                let slope = |dx: f64, dy: f64| value([x + dx, y + dy]) - value([x - dx, y - dy]);
                let gradient = [slope(0.5, 0.0), slope(0.0, 0.5)];
                let field = rannacher_turek::place(corners, [x, y]).raviart_thomas(out);
                sum += wx * wy * square(gradient, field.into());
            }
        }
    }
    sum
}

fn on_boundary(
    of: &Discretization<f64, u16>,
    given: &LoadCase<f64, u16>,
    [s, d, tau]: [&[f64]; 3],
) -> f64 {
    let counts = of.edges.counts();
    let along = |edge: usize, f: &dyn Fn(f64) -> f64| {
        let [a, b] = of.edges.endpoints(&of.mesh, edge).map(|v| s[usize::from(v)]);
        let value = |t: f64| a * (1.0 - t) + b * t + 4.0 * t * (1.0 - t) * d[edge];
        f64::GAUSS[5].iter().map(|&[t, weight]| weight * f(value(t))).sum::<f64>()
    };
    let contact = (0..counts.contact).map(|at| {
        let edge = counts.free + at;
        2.0 * (tau[edge] - given.boundary.contact_flux(at).base()) * along(edge, &|s| s - GAP)
    });
    let transfer = given.boundary.robin().iter().map(|law| {
        let edge = usize::from(law.edge);
        along(edge, &|s| (tau[edge] + LAW[0] * (s - LAW[1])).powi(2) / LAW[0])
    });
    contact.sum::<f64>() + transfer.sum::<f64>()
}

#[test]
fn the_bound_is_what_its_definition_says() {
    let layouts = [
        SIDES,
        [Side::Given, Side::Contact, Side::Transfer, Side::Insulated],
        [Side::Transfer, Side::Given, Side::Contact, Side::Contact],
    ];
    for sides in layouts {
        for at_points in [false, true] {
            let found = run(sides, at_points, &[]).expect("valid");
            let certificate = found.verdict.certificate().copied().expect("a bound");
            let ratio = certificate.duality_gap.powi(2) / found.expected;
            BOUND.check("gap²", ratio - 1.0);
            BOUND.check_relative("sum of the cells", found.indicators, found.expected);
            let (gap, rounding) = (certificate.duality_gap, certificate.rounding);
            assert!(certificate.algebraic > 0.0 && certificate.algebraic < 3.0 * gap);
            assert!(rounding > 0.0);
            BOUND.check_over("rounding", rounding, gap);
            assert_eq!(certificate.total, gap + rounding);
        }
    }
}

#[test]
fn overflow_is_no_bound() {
    let (energy, peak) = (f64::MAX, f64::INFINITY);
    let curved = Curved { edge: 0, energy, mean: 1e200, peak, coupling: [1e200; 8] };
    let found = run(SIDES, false, &[curved; 4]).expect("valid");
    assert_eq!(found.verdict, Verdict::NotFinite);
}

/// All contact edges are open, and s at least ¼ above the gap.
fn open(edges: usize, free: usize) -> Vec<f64> {
    iterate(edges, free).into_iter().map(|u| GAP + 0.25 + u.abs()).collect()
}

#[test]
fn s_follows_no_curve_that_it_is_clear_of() {
    let foundation = Foundation::new(SIDES, false).expect("valid");
    let edge = foundation.discretization().expect("valid").edges.counts().free as u16;
    let with = |peak: f64, on_edge: u16| {
        let (edge, energy) = (edge + on_edge, 7.0);
        let curved = Curved { edge, mean: 0.05, peak, energy, coupling: [0.0; 8] };
        let found = run_from(open, SIDES, false, &[curved]).expect("valid");
        found.verdict.certificate().expect("a bound").duality_gap
    };
    let plain = run_from(open, SIDES, false, &[]).expect("valid");
    let plain = plain.verdict.certificate().expect("a bound").duality_gap;
    // τ·n = q on open edges: s − ψ is less by w at no cost.
    assert_eq!([0.1, 0.2].map(|peak| with(peak, 0)), [plain; 2]);
    for peak in [5.0, f64::INFINITY, f64::NAN] {
        assert!(with(peak, 0) > plain + 0.1, "{peak}");
    }
}

#[test]
fn indicators_are_one_a_cell_or_none() -> Result<(), Error> {
    let foundation = Foundation::new(SIDES, false)?;
    let (discretization, given) = (foundation.discretization()?, foundation.given()?);
    let counts = discretization.edges.counts();
    let u = iterate(counts.edges(), counts.free);
    for (indicators, fits) in [(0, true), (discretization.edges.cells(), true), (1, false)] {
        let (mut s, mut tau) = (vec![0.0; foundation.plate.vertices.len()], u.clone());
        let (vertices, bubbles) = (&mut s[..], &mut vec![0.0; u.len()][..]);
        let indicators = &mut vec![0.0; indicators][..];
        let buffers = Buffers { vertices, bubbles, tau: &mut tau, indicators };
        let iterate = Iterate { u: &u, law: Law::above(&foundation.lower) };
        assert_eq!(certify(&discretization, &given, iterate, buffers).is_ok(), fits);
    }
    Ok(())
}
