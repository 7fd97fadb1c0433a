//! The walk over the packed cells: each is balanced and then gives its share of the bound.

use super::metric::Varying;
use super::parts::{CellTerms, Parts};
use super::quad::{self, Means, Values};
use super::{Continuous, Discretization, LoadCase, Metric, triangle};
use crate::cells::{Either, Quad, Triangle, pick};
use signorini_kernel::index::{Index, read, write};
use signorini_kernel::{Real, features};

/// The walk over the cells from the leaves: balances each and takes its share.
#[inline(always)]
pub(super) fn over_cells<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    given: &LoadCase<R, I>,
    u: &[R],
    s: Continuous<R>,
    tau: &mut [R],
    indicators: &mut [R],
) -> Parts<R> {
    let cells = &discretization.cells;
    let plain = !(features::QUADS || features::VARYING || features::INDICATORS);
    if features::TRIANGLES
        && (plain
            || cells.quads.is_empty()
                && discretization.metric.place.is_empty()
                && indicators.is_empty())
    {
        return over_triangles(cells.triangles, given.loads.triangles, u, s.vertices, tau);
    }
    let mut parts = Parts::default();
    for cell in cells.from_leaves() {
        let (number, share) = match cell {
            Either::Triangle(cell) => {
                let load = read(given.loads.triangles, cell.number.at());
                (cell.number, of_triangle_cell(discretization.metric, cell, s, u, load, tau))
            }
            Either::Quad(cell) => {
                let number = cell.number.at().wrapping_sub(cells.triangles.len());
                let load = read(given.loads.quads, number);
                (cell.number, of_quad_cell(discretization.metric, (cell, number), s, u, load, tau))
            }
        };
        let Some(share) = share else { break };
        write(indicators, number.at(), share.gap + share.open);
        parts.add(share);
    }
    parts
}

/// Walks over triangles with constant A alone, without indicators: the loop of a control loop. A
/// function of its own, with few slices, keeps its pointers in registers.
#[inline(never)]
fn over_triangles<R: Real, I: Index>(
    cells: &[Triangle<R, I>],
    loads: &[R],
    u: &[R],
    vertices: &[R],
    tau: &mut [R],
) -> Parts<R> {
    let mut parts = Parts::default();
    for cell in cells {
        let load = read(loads, cell.number.at());
        let Some(out) = cell.settle(load, tau) else { break };
        let (s, means) = (pick(&cell.vertices, vertices), pick(&cell.edges, u));
        let (Some(s), Some(means)) = (s, means) else { break };
        parts.add(triangle::share(cell, s, out, means, load));
    }
    parts
}

fn of_triangle_cell<R: Real, I: Index>(
    metric: Metric<R>,
    cell: &Triangle<R, I>,
    s: Continuous<R>,
    u: &[R],
    load: R,
    tau: &mut [R],
) -> Option<CellTerms<R>> {
    if !features::TRIANGLES {
        return None;
    }
    let out = cell.settle(load, tau)?;
    share_of_triangle(metric, cell, pick(&cell.vertices, s.vertices)?, u, (load, out))
}

/// A triangle's share for s at its vertices and the fluxes `out` that balance `load`.
#[inline(always)]
pub(super) fn share_of_triangle<R: Real, I: Index>(
    metric: Metric<R>,
    cell: &Triangle<R, I>,
    s: [R; 3],
    u: &[R],
    (load, out): (R, [R; 3]),
) -> Option<CellTerms<R>> {
    let u = pick(&cell.edges, u)?;
    let Some(varying) = metric.varying(cell.number.at()) else {
        return Some(triangle::share(cell, s, out, u, load));
    };
    let (k, s) = (cell.stiffness_in_mesh(), cell.vertices_in_mesh(s));
    let ([out, u], above) =
        ([out, u].map(|packed| cell.sides_in_mesh(packed)), metric.above(cell.number.at()));
    Some(match varying {
        Varying::Points(points) => {
            let mean = (&k, cell.compliance);
            triangle::share_at_points(points, above[0], mean, s, out, u, load)
        }
        Varying::Factor(factor) => {
            let difference = triangle::difference(&k, out, u, load);
            triangle::share_by_factor(factor, above, s, u, [out, difference], load)
        }
    })
}

fn of_quad_cell<R: Real, I: Index>(
    metric: Metric<R>,
    (cell, number): (&Quad<R, I>, usize),
    s: Continuous<R>,
    u: &[R],
    load: R,
    tau: &mut [R],
) -> Option<CellTerms<R>> {
    if !features::QUADS {
        return None;
    }
    let out = cell.settle(load, tau)?;
    share_of_quad(metric, (cell, number), s.in_quad(cell)?, u, (load, out))
}

/// A quad's share for s on it and the fluxes `out` that balance `load`.
#[inline(always)]
pub(super) fn share_of_quad<R: Real, I: Index>(
    metric: Metric<R>,
    (cell, number): (&Quad<R, I>, usize),
    s: Values<R>,
    u: &[R],
    (load, out): (R, [R; 4]),
) -> Option<CellTerms<R>> {
    let u = pick(&cell.edges, u)?;
    let Some(varying) = metric.varying(cell.number.at()) else {
        return Some(quad::share(cell, s, out, u, load));
    };
    let Values { corners, bubbles } = s;
    let difference = cell.sides_in_mesh(quad::difference(cell, out, u, load));
    let (corners, bubbles) = (cell.vertices_in_mesh(corners), cell.sides_in_mesh(bubbles));
    let [out, means] = [out, u].map(|packed| cell.sides_in_mesh(packed));
    let u = Means { means, distortion: metric.distortion(number) };
    let (s, above) = (Values { corners, bubbles }, metric.above(cell.number.at()));
    Some(match varying {
        Varying::Points(points) => {
            quad::share_at_points(points, above[0], s, u, out, difference, load)
        }
        Varying::Factor(factor) => {
            quad::share_by_factor(factor, above, s, u, [out, difference], load)
        }
    })
}
