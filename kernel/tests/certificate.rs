//! The bound against its definition, integrated from coordinates; and what it says of poor input.
#![allow(clippy::indexing_slicing, clippy::expect_used)]

mod plate;

use plate::{NONE, Plate, Side};
use signorini_kernel::assembly::CellLoads;
use signorini_kernel::boundary::{Boundary, Neumann, Robin};
use signorini_kernel::certificate::{self, Buffers, Curved, Given, Ground, Metric, Verdict};
use signorini_kernel::conforming::VertexData;
use signorini_kernel::element::{crouzeix_raviart, rannacher_turek};
use signorini_kernel::equilibrium::{Cell, Iterate, is_root};
use signorini_kernel::forest::{ForestBuffers, grow};
use signorini_kernel::stiffness::{self, Coefficient, Stiffness};
use signorini_kernel::{Error, Real, Tensor};

const A: Tensor<f64> = Tensor { xx: 3.0, xy: -1.2, yy: 1.5 };
const LOAD: f64 = -0.8;
const GAP: f64 = -0.5;
const LAW: [f64; 2] = [0.7, 0.4];

struct Found {
    verdict: Verdict<f64>,
    /// gap² from coordinates.
    expected: f64,
    indicators: f64,
}

/// A pseudorandom iterate, above the gap on half of the contact edges.
fn iterate(edges: usize, free: usize) -> Vec<f64> {
    let mut state = 7_u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as f64 / (1_u64 << 31) as f64
    };
    let mut u: Vec<_> = (0..edges).map(|_| next()).collect();
    u[free..].iter_mut().step_by(2).for_each(|u| *u = GAP);
    u
}

fn run(sides: [Side; 4], at_points: bool, curved: &[Curved<f64, u16>]) -> Result<Found, Error> {
    let plate = Plate::new(sides)?;
    let (mesh, edges) = (plate.mesh()?, plate.edges()?);
    let (counts, halves) = (edges.counts(), edges.half_edges());
    let free = 0..counts.free as u16;
    let on = |side: Side| {
        let (plate, mesh) = (&plate, mesh);
        free.clone().filter(move |&edge| {
            let ends = edges.endpoints(&mesh, usize::from(edge));
            halves[usize::from(edge)][1] == NONE && plate.side(ends) == side
        })
    };
    let neumann: Vec<_> = on(Side::Insulated).map(|edge| Neumann { edge, flux: 0.3 }).collect();
    let law = |edge| Robin { edge, coefficient: LAW[0], ambient: LAW[0] * LAW[1] };
    let robin: Vec<_> = on(Side::Transfer).map(law).collect();
    let q = vec![-0.2; counts.contact];
    let boundary = Boundary::new(&edges, &neumann, &robin, &q)?;
    let mut k = (vec![[0.0; 3]; plate.triangles.len()], vec![[0.0; 6]; plate.quads.len()]);
    stiffness::fill(&mesh, Coefficient::Uniform(A), 2, &mut k.0, &mut k.1)?;
    let stiffness = Stiffness { triangles: &k.0, quads: &k.1 };
    let compliance = vec![0.25 / (A.xx * A.yy - A.xy * A.xy); k.0.len()];
    let corner = |vertex: u16| plate.vertices[usize::from(vertex)];
    let of_triangles = plate.triangles.iter().map(|cell| {
        let b = certificate::of_triangle(cell.map(corner), A);
        [b; 64]
    });
    let of_quads = plate.quads.iter().map(|cell| {
        let corners = cell.map(corner);
        let at = |k: usize| f64::GAUSS[7][k][0];
        std::array::from_fn(|p| {
            let place = rannacher_turek::place(corners, [at(p % 8), at(p / 8)]);
            certificate::of_quad(&place, A)
        })
    });
    let points: Vec<_> = of_triangles.chain(of_quads).collect();
    let place: Vec<u32> = (0..edges.cells() as u32).collect();
    let metric = Metric {
        compliance: &compliance,
        at_points: &points,
        place: if at_points { &place } else { &[] },
    };
    let mut ways = [(); 3].map(|()| vec![NONE; edges.cells()]);
    let [order, parent, place] = &mut ways;
    let mut distance = vec![0.0; edges.cells()];
    let buffers = ForestBuffers { order, parent, place, distance: &mut distance };
    let forest = grow(&edges, |_| 1.0, |edge| is_root(&edges, &boundary, edge), buffers)?;
    let mut way = vec![0.0; edges.cells()];
    let reach = certificate::reach(&edges, stiffness, metric, &forest, &mut way)?;
    let ground = Ground { mesh, edges, stiffness, metric, alpha: &[], forest, reach };

    let loads = (vec![LOAD / 2.0; k.0.len()], vec![LOAD; k.1.len()]);
    let (gap, given) = (vec![[GAP; 2]; counts.contact], vec![[0.9; 2]; counts.dirichlet]);
    let given = Given {
        loads: CellLoads { triangles: &loads.0, quads: &loads.1 },
        boundary,
        ends: VertexData { gap: &gap, given: &given },
        curved,
        transfer: &[],
        oscillation: 0.0,
    };
    let (u, lower) = (iterate(counts.edges(), counts.free), vec![GAP; counts.contact]);
    let vertices = plate.vertices.len();
    let (mut s, mut weights) = (vec![f64::NAN; vertices], vec![f64::NAN; vertices]);
    let (mut d, mut tau) = (vec![f64::NAN; counts.edges()], vec![f64::NAN; counts.edges()]);
    let mut indicators = vec![f64::NAN; edges.cells()];
    let buffers = Buffers {
        vertices: &mut s,
        weights: &mut weights,
        bubbles: &mut d,
        tau: &mut tau,
        indicators: &mut indicators,
    };
    let verdict = certificate::certify(&ground, &given, Iterate { u: &u, lower: &lower }, buffers)?;
    let expected =
        from_coordinates(&ground, &s, &d, &tau) + on_boundary(&ground, &given, &s, &d, &tau);
    Ok(Found { verdict, expected, indicators: indicators.iter().sum() })
}

/// Σ_T ∫ |A^½∇s − A^{−½}τ|² with 6×6 points a cell, by the chain rule in the plane.
fn from_coordinates(ground: &Ground<f64, u16>, s: &[f64], d: &[f64], tau: &[f64]) -> f64 {
    let (mesh, edges) = (ground.mesh, ground.edges);
    let halves = edges.half_edges();
    let determinant = A.xx * A.yy - A.xy * A.xy;
    let square = |[gx, gy]: [f64; 2], field: [f64; 2]| {
        let r = [A.xx * gx + A.xy * gy - field[0], A.xy * gx + A.yy * gy - field[1]];
        (A.yy * r[0] * r[0] - 2.0 * A.xy * r[0] * r[1] + A.xx * r[1] * r[1]) / determinant
    };
    let rule = f64::GAUSS[5];
    let mut sum = 0.0;
    for (at, vertices) in mesh.triangles().iter().enumerate() {
        let corners = mesh.triangle(vertices);
        let out = Cell::new(3 * at, edges.of_triangles()[at]).outward(halves, tau);
        let values = vertices.map(|vertex| s[usize::from(vertex)]);
        let means = [0, 1, 2].map(|k| 0.5 * (values[k] + values[(k + 1) % 3]));
        let gradient = crouzeix_raviart::gradient(corners, means);
        let area = signorini_kernel::geometry::triangle_area(corners);
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
        let out = Cell::new(first + 4 * at, sides).outward(halves, tau);
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
    ground: &Ground<f64, u16>,
    given: &Given<f64, u16>,
    s: &[f64],
    d: &[f64],
    tau: &[f64],
) -> f64 {
    let counts = ground.edges.counts();
    let along = |edge: usize, f: &dyn Fn(f64) -> f64| {
        let [a, b] = ground.edges.endpoints(&ground.mesh, edge).map(|v| s[usize::from(v)]);
        let value = |t: f64| a * (1.0 - t) + b * t + 4.0 * t * (1.0 - t) * d[edge];
        f64::GAUSS[5].iter().map(|&[t, weight]| weight * f(value(t))).sum::<f64>()
    };
    let contact = (0..counts.contact).map(|at| {
        let edge = counts.free + at;
        2.0 * (tau[edge] - given.boundary.contact_flux(at)) * along(edge, &|s| s - GAP)
    });
    let transfer = given.boundary.robin().iter().map(|law| {
        let edge = usize::from(law.edge);
        along(edge, &|s| (tau[edge] + LAW[0] * (s - LAW[1])).powi(2) / LAW[0])
    });
    contact.sum::<f64>() + transfer.sum::<f64>()
}

const SIDES: [Side; 4] = [Side::Contact, Side::Transfer, Side::Insulated, Side::Given];

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
            let ratio = certificate.gap.powi(2) / found.expected;
            assert!((ratio - 1.0).abs() < 1e-12, "{ratio}");
            assert!((found.indicators / found.expected - 1.0).abs() < 1e-12);
            assert!(certificate.algebraic > 0.0 && certificate.algebraic < 3.0 * certificate.gap);
            assert!(certificate.rounding < 1e-12 * certificate.gap && certificate.rounding > 0.0);
            assert_eq!(certificate.total, certificate.gap + certificate.rounding);
        }
    }
}

#[test]
fn overflow_is_no_bound() {
    let curved = Curved { edge: 0, energy: f64::MAX, mean: 1e200, coupling: [1e200; 8] };
    let found = run(SIDES, false, &[curved; 4]).expect("valid");
    assert_eq!(found.verdict, Verdict::NotFinite);
}
