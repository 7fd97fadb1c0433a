//! Where the new mesh lies in the old one, checked by geometry alone.

use signorini_tolerances::scene::PLACE;
use std::collections::BTreeMap;

use super::*;

/// The old mesh, the new one, and what says how they lie in each other, over three rounds of every base mesh.
fn each_round(check: impl Fn(&str, &Mesh, &Mesh, &Carried)) {
    rounds(Target::Random(6), 3, |Round { what, before, hierarchy, carried, .. }| {
        check(what, before, hierarchy.mesh(), carried);
    });
}

fn mean(points: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|axis| points.iter().map(|p| p[axis]).sum::<f64>() / points.len() as f64)
}

/// The point lies in the polygon or on its sides: no wedge with a side is turned round.
fn assert_holds(what: &str, polygon: &[[f64; 2]], point: [f64; 2]) {
    let from = |to: &[f64; 2]| [to[0] - point[0], to[1] - point[1]];
    let polygon: Vec<_> = polygon.iter().map(from).collect();
    for (&p, &q) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        let wedge = area(&[p, q, [0.0; 2]]).min(0.0);
        PLACE.check_over(what, wedge, area(&polygon));
    }
}

#[test]
fn old_cells_hold_the_middles_of_cells_and_sides() {
    each_round(|what, old, new, carried| {
        let old_cells: Vec<_> = cells(old).iter().map(|cell| points(old, cell)).collect();
        let sides = carried.triangle_sides.iter().map(|sides| &sides[..]);
        let sides = sides.chain(carried.quad_sides.iter().map(|sides| &sides[..]));
        assert_eq!(carried.cells.len(), new.cells(), "{what}");
        for ((cell, &holder), holders) in cells(new).iter().zip(&carried.cells).zip(sides) {
            let cell = points(new, cell);
            assert_holds(what, &old_cells[holder as usize], mean(&cell));
            assert_eq!(holders.len(), cell.len(), "{what}");
            for (k, &holder) in holders.iter().enumerate() {
                let middle = mean(&[cell[k], cell[(k + 1) % cell.len()]]);
                assert_holds(what, &old_cells[holder as usize], middle);
            }
        }
    });
}

#[test]
fn cells_of_a_mesh_without_pieces_hold_their_new_cells_whole() {
    rounds(Target::Random(4), 1, |Round { what, base, hierarchy, carried, .. }| {
        let mesh = hierarchy.mesh();
        assert_eq!(carried.cells, hierarchy.roots(), "{what}");
        let mut covered = vec![0.0; base.cells()];
        for (cell, &holder) in cells(mesh).iter().zip(&carried.cells) {
            let (cell, holder) = (points(mesh, cell), holder as usize);
            let around = points(base, &cells(base)[holder]);
            cell.iter().for_each(|&corner| assert_holds(what, &around, corner));
            covered[holder] += area(&cell);
        }
        assert_covered(what, base, &covered);
    });
}

/// Of each cell so much is covered as it has.
fn assert_covered(what: &str, mesh: &Mesh, covered: &[f64]) {
    for (cell, &covered) in cells(mesh).iter().zip(covered) {
        PLACE.check_relative(what, covered, area(&points(mesh, cell)));
    }
}

#[test]
fn roots_are_covered_by_their_cells() {
    rounds(Target::Random(6), 3, |Round { what, base, hierarchy, .. }| {
        let mut covered = vec![0.0; base.cells()];
        for (cell, root) in cells(hierarchy.mesh()).iter().zip(hierarchy.roots()) {
            covered[root as usize] += area(&points(hierarchy.mesh(), cell));
        }
        assert_covered(what, base, &covered);
    });
}

/// The cell of each boundary edge, and its side there.
fn boundary(mesh: &Mesh) -> BTreeMap<[u32; 2], (usize, usize)> {
    let mut found = BTreeMap::new();
    for (at, cell) in cells(mesh).iter().enumerate() {
        for (k, (&a, &b)) in cell.iter().zip(cell.iter().cycle().skip(1)).enumerate() {
            let edge = [a.min(b), a.max(b)];
            if found.insert(edge, (at, k)).is_some() {
                found.remove(&edge);
            }
        }
    }
    found
}

/// The old cell behind a new boundary edge has a boundary edge there, and no other lip of a slit.
#[test]
fn boundary_edges_lie_on_boundary_edges_of_the_old_cells() {
    each_round(|what, old, new, carried| {
        let (old_boundary, mut lengths) = (boundary(old), BTreeMap::new());
        for (edge, (cell, side)) in boundary(new) {
            let holder = match cell.checked_sub(new.triangles.len()) {
                None => carried.triangle_sides[cell][side],
                Some(quad) => carried.quad_sides[quad][side],
            };
            let has_an_end = |origin: &[u32; 2]| origin.iter().any(|end| edge.contains(end));
            let own = old_boundary.iter().filter(|(_, (cell, _))| *cell == holder as usize);
            let middle = mean(&edge.map(|end| new.vertices[end as usize]));
            let origin = own.map(|(origin, _)| origin).filter(|origin| has_an_end(origin));
            let near = origin.min_by(|a, b| {
                let off = |of: &[u32; 2]| area(&[points(old, of), vec![middle]].concat()).abs();
                off(a).total_cmp(&off(b))
            });
            *lengths.entry(*near.expect("a boundary edge")).or_insert(0.0) += length(new, &edge);
        }
        assert!(lengths.keys().eq(old_boundary.keys()), "{what}");
        for (origin, length) in lengths {
            PLACE.check_relative(what, length, super::length(old, &origin));
        }
    });
}
