//! The parts of a certificate, and certificates themselves.

use signorini_bound::certificate::{Buffers, Curved, LoadCase, certify, of_quad, of_triangle};
use signorini_bound::conforming::VertexData;
use signorini_bound::equilibrium::{Iterate, is_root};
use signorini_kernel::assembly::CellLoads;
use signorini_kernel::element::rannacher_turek::place;
use signorini_kernel::law::Law;
use signorini_kernel::mesh::edges::Block;
use signorini_kernel::{Error, Tensor};

use super::arrays::Arrays;
use super::journal::Journal;
use super::scene::{Draw, Scalar};
use crate::owned::{Ground, Packed};

/// The part of the discretization that stays in memory, with A at the points of the cells whose number is a multiple of
/// `every`; of none where that is 0.
pub fn ground<R: Scalar>(arrays: &Arrays<R>, every: usize) -> Result<Ground<R>, Error> {
    let (edges, boundary, mesh) = (arrays.edges()?, arrays.boundary()?, arrays.mesh()?);
    let alpha: Vec<_> = arrays.tensors.iter().map(|a| (a.xx + a.yy) * R::HALF).collect();
    let determinant = |a: &Tensor<R>| R::QUARTER / (a.xx * a.yy - a.xy * a.xy);
    let triangles = &arrays.tensors[..arrays.triangles.len()];
    let compliance: Vec<_> = triangles.iter().map(determinant).collect();
    let cost = |cell: usize| R::ONE / alpha[cell];
    // Contact edges are roots where nothing else is.
    let held = arrays.counts.dirichlet + arrays.robin.len() > 0;
    let is_way_out = |edge| {
        is_root(&edges, &boundary, edge) || (!held && arrays.counts.block(edge) == Block::Contact)
    };
    let (k, a) = (arrays.stiffness(), [&alpha[..], &compliance]);
    let packed = Packed::new((&mesh, &edges), k, a, cost, is_way_out)?;
    let mut place = vec![u32::MAX; if every > 0 { edges.cells() } else { 0 }];
    let mut points = Vec::new();
    for at in (0..edges.cells()).step_by(every.max(1)).filter(|_| every > 0) {
        place[at] = points.len() as u32;
        points.push(at_points(arrays, at));
    }
    Ground::new(packed, (points, place), &edges, &boundary)
}

/// A of a cell in reference coordinates, a little different at each point.
fn at_points<R: Scalar>(arrays: &Arrays<R>, cell: usize) -> [Tensor<R>; 64] {
    let corner = |vertex: u16| arrays.vertices[usize::from(vertex)];
    let varied = |point: usize| {
        let (a, factor) = (arrays.tensors[cell], R::of(1.0 + point as f64 / 256.0));
        Tensor { xx: a.xx * factor, ..a }
    };
    let first = arrays.triangles.len();
    std::array::from_fn(|point| match cell.checked_sub(first) {
        None => of_triangle(arrays.triangles[cell].map(corner), varied(point)),
        Some(quad) => {
            let at = |k: usize| R::GAUSS[7][k][0];
            let place = place(arrays.quads[quad].map(corner), [at(point % 8), at(point / 8)]);
            of_quad(&place, varied(point))
        }
    })
}

/// Curved edges and transfer laws at points, in the order of the kernel.
type More<R> = (Vec<Curved<R, u16>>, Vec<[[R; 2]; 8]>);

fn more<R: Scalar>(arrays: &Arrays<R>) -> More<R> {
    let mut draw = Draw(77);
    let mut number = |size: f64| R::of(size * draw.signed());
    let (free, all) = (arrays.counts.free, arrays.counts.edges());
    let curved = (free..all).step_by(3).map(|edge| Curved {
        edge: edge as u16,
        mean: number(0.05),
        peak: R::of(0.05),
        energy: number(0.01).magnitude(),
        coupling: std::array::from_fn(|_| number(0.05)),
    });
    let curved = curved.collect();
    let points = arrays.robin.iter().map(|law| {
        std::array::from_fn(|k| {
            let off = if k == 3 { R::ZERO } else { R::ONE };
            [law.coefficient * (R::ONE + number(0.25)), (law.ambient + number(0.25)) * off]
        })
    });
    (curved, points.collect())
}

/// The data of the scene, with their means alone.
fn given<R: Scalar>(arrays: &Arrays<R>) -> Result<LoadCase<'_, R, u16>, Error> {
    Ok(LoadCase {
        loads: arrays.cell_loads(),
        boundary: arrays.boundary()?,
        ends: arrays.ends(),
        ..LoadCase::default()
    })
}

pub fn run<R: Scalar>(arrays: &Arrays<R>, journal: &mut Journal) -> Result<(), Error> {
    let (curved, transfer) = more(arrays);
    for every in [0, 1, 2] {
        let ways = ground(arrays, every)?;
        let Packed { ways: [order, parent, places], triangles, quads, weights } = &ways.packed;
        journal.digest("forest", (order, parent, places));
        journal.digest("cells", (triangles, quads));
        journal.digest("weights", (&weights[0], &weights[1]));
        journal.line("reach", ways.stability.largest);
        journal.line("weighed", ways.stability.weighed);
        journal.line("oblique", ways.stability.oblique);
        let given = given(arrays)?;
        certified(arrays, &ways, &given, journal)?;
        let oscillation = R::of(0.125);
        let bent = LoadCase { curved: &curved, transfer: &transfer, oscillation, ..given };
        certified(arrays, &ways, &bent, journal)?;
    }
    closed(arrays, journal)?;
    let ways = ground(arrays, 0)?;
    nothing(arrays, &ways, journal)
}

/// A transfer law that lets nothing pass, and asks for nothing or for what it cannot do.
fn closed<R: Scalar>(arrays: &Arrays<R>, journal: &mut Journal) -> Result<(), Error> {
    for ambient in [R::ZERO, R::QUARTER] {
        let mut arrays = arrays.clone();
        let Some(law) = arrays.robin.first_mut() else { continue };
        (law.coefficient, law.ambient) = (R::ZERO, ambient);
        let edge = usize::from(law.edge);
        let way_out = is_root(&arrays.edges()?, &arrays.boundary()?, edge);
        journal.line("a way out", way_out);
        let given = given(&arrays)?;
        certified(&arrays, &ground(&arrays, 0)?, &given, journal)?;
    }
    Ok(())
}

/// All zeros: what is left of the bound is what squares near the smallest number may lose.
fn nothing<R: Scalar>(
    arrays: &Arrays<R>,
    ways: &Ground<R>,
    journal: &mut Journal,
) -> Result<(), Error> {
    let discretization =
        ways.discretization(arrays.mesh()?, arrays.edges()?, arrays.stiffness())?;
    let zeros = |count: usize| vec![R::ZERO; count];
    let (triangles, quads) = (zeros(arrays.loads.0.len()), zeros(arrays.loads.1.len()));
    let counts = arrays.counts;
    let pairs = |count: usize| vec![[R::ZERO; 2]; count];
    let (gap, ends) = (pairs(counts.contact), pairs(counts.dirichlet));
    let given = LoadCase {
        loads: CellLoads { triangles: &triangles, quads: &quads },
        ends: VertexData { gap: &gap, given: &ends },
        ..LoadCase::default()
    };
    let all = counts.edges();
    let (mut s, mut bubbles, mut tau) = (zeros(arrays.vertices.len()), zeros(all), zeros(all));
    let (vertices, bubbles, tau) = (&mut s, &mut bubbles, &mut tau);
    let buffers = Buffers { vertices, bubbles, tau, indicators: &mut [] };
    let (u, lower) = (zeros(all), zeros(counts.contact));
    let verdict =
        certify(&discretization, &given, Iterate { u: &u, law: Law::above(&lower) }, buffers)?;
    journal.line("of nothing", verdict);
    Ok(())
}

fn certified<R: Scalar>(
    arrays: &Arrays<R>,
    ways: &Ground<R>,
    given: &LoadCase<R, u16>,
    journal: &mut Journal,
) -> Result<(), Error> {
    let all = arrays.counts.edges();
    let lengths = [arrays.vertices.len(), all, all, arrays.tensors.len()];
    let discretization =
        ways.discretization(arrays.mesh()?, arrays.edges()?, arrays.stiffness())?;
    for factor in [1.0, 0.125] {
        let mut numbers = lengths.map(|length| vec![R::ONE; length]);
        let [vertices, bubbles, tau, indicators] = &mut numbers;
        let mut u = arrays.start.clone();
        let free = &mut u[..arrays.counts.free];
        free.iter_mut().for_each(|u| *u *= R::of(factor));
        let iterate = Iterate { u: &u, law: Law::above(&arrays.lower) };
        let buffers = Buffers { vertices, bubbles, tau, indicators };
        let verdict = certify(&discretization, given, iterate, buffers)?;
        journal.line("verdict", verdict);
        journal.digest("s and tau", &numbers[..3]);
        journal.digest("indicators", &numbers[3]);
        // What is not needed is not asked for.
        let [vertices, bubbles, tau, _] = &mut numbers;
        let bubbles = if arrays.quads.is_empty() { &mut [][..] } else { bubbles };
        let buffers = Buffers { vertices, bubbles, tau, indicators: &mut [] };
        let lean = certify(&discretization, given, iterate, buffers)?;
        journal.digest("lean", (lean, &numbers[..3]));
    }
    Ok(())
}
