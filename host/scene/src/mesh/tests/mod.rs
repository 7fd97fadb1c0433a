//! Meshes refined, paired and cut: what must stay, and what must come out.

mod adaptive;
mod pairing;
mod refine;

use signorini_tolerances::scene::MEASURE;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::check::edges;
use super::read;
use super::shape::{Orientation, orientation};
use super::{Curve, Mesh, Surface};

/// The generator splitmix64: a counter, scrambled.
pub(super) struct Draw(pub u64);

impl Draw {
    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A whole number below another one.
    pub fn below(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }

    /// A number of [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The folder of standard scenes.
fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes")
}

/// Every mesh of the standard scenes, in the order of their names.
fn meshes() -> Vec<(String, Mesh)> {
    let entries = |of: &str| std::fs::read_dir(folder().join(of)).expect("a folder");
    let entries = ["catalogue", "scenes"].into_iter().flat_map(entries);
    let mut files: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.retain(|path| path.extension().is_some_and(|found| found == "msh"));
    files.sort();
    let named = |path: PathBuf| (path.display().to_string(), read(&path).expect("a mesh"));
    let meshes: Vec<_> = files.into_iter().map(named).collect();
    assert!(meshes.len() >= 8);
    meshes
}

fn standard(name: &str) -> Mesh {
    read(&folder().join(name)).expect("a mesh")
}

fn cells(mesh: &Mesh) -> Vec<Vec<u32>> {
    mesh.corners().map(<[u32]>::to_vec).collect()
}

pub(super) fn points(mesh: &Mesh, cell: &[u32]) -> Vec<[f64; 2]> {
    cell.iter().map(|&vertex| mesh.vertices[vertex as usize]).collect()
}

/// The signed area, by triangles at the first corner: far from the origin Gauss's formula loses digits.
pub(super) fn area(corners: &[[f64; 2]]) -> f64 {
    let ways: Vec<_> =
        corners.iter().map(|to| [to[0] - corners[0][0], to[1] - corners[0][1]]).collect();
    ways.windows(2).map(|pair| pair[0][0] * pair[1][1] - pair[0][1] * pair[1][0]).sum::<f64>() / 2.0
}

/// The sum, by halves: its rounding grows with the logarithm of their number.
fn total(terms: &[f64]) -> f64 {
    match terms {
        [] => 0.0,
        &[term] => term,
        _ => {
            let (first, second) = terms.split_at(terms.len() / 2);
            total(first) + total(second)
        }
    }
}

fn length(mesh: &Mesh, edge: &[u32; 2]) -> f64 {
    let [a, b] = edge.map(|vertex| mesh.vertices[vertex as usize]);
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// The areas of the surfaces, the lengths of the curves, and the area of the whole.
pub(super) fn measures(mesh: &Mesh) -> Vec<(String, f64)> {
    let areas: Vec<_> = cells(mesh).iter().map(|cell| area(&points(mesh, cell))).collect();
    let of_surface = |surface: &Surface| {
        let own: Vec<_> = surface.cells.iter().map(|&cell| areas[cell as usize]).collect();
        (surface.name.clone(), total(&own))
    };
    let of_curve = |curve: &Curve| {
        let lengths: Vec<_> = curve.edges.iter().map(|edge| length(mesh, edge)).collect();
        (curve.name.clone(), total(&lengths))
    };
    let curves = mesh.curves.iter().map(of_curve);
    let surfaces = mesh.surfaces.iter().map(of_surface);
    surfaces.chain(curves).chain([(String::new(), total(&areas))]).collect()
}

/// The mesh keeps its contract, and everything in `before` has kept its size.
fn assert_same_domain(what: &str, before: &Mesh, after: &Mesh) {
    let edges = edges(after).expect("a conforming mesh");
    for cell in cells(after) {
        let sense = orientation(&points(after, &cell));
        assert_eq!(sense, Ok(Orientation::Counterclockwise), "{what}: {cell:?}");
    }
    let used: BTreeSet<_> = cells(after).into_iter().flatten().collect();
    assert!(used.into_iter().eq(0..after.vertices.len() as u32), "{what}");
    for surface in &after.surfaces {
        assert!(surface.cells.is_sorted_by(|a, b| a < b), "{what}: {}", surface.name);
    }
    for curve in &after.curves {
        assert!(curve.edges.is_sorted_by(|a, b| a < b), "{what}: {}", curve.name);
        let known = |edge| edges.binary_search(edge).is_ok();
        assert!(curve.edges.iter().all(known), "{what}: {}", curve.name);
    }
    let (before, after) = (measures(before), measures(after));
    assert_eq!(before.len(), after.len(), "{what}");
    for (before, after) in before.iter().zip(&after) {
        assert_eq!(before.0, after.0, "{what}");
        MEASURE.check_over(what, before.1 - after.1, before.1);
    }
}

type Place = [i64; 2];

/// The items from the least one on, in their order around.
fn from_least<T: Ord>(mut items: Vec<T>) -> Vec<T> {
    let least = (0..items.len()).min_by_key(|&k| &items[k]).expect("items");
    items.rotate_left(least);
    items
}

/// A mesh whatever its numbering: cells from their least corner on with their surfaces, edges with
/// their curves; coordinates as `written`.
fn in_places(mesh: &Mesh, written: fn(f64) -> i64) -> [Vec<(Vec<Place>, Vec<String>)>; 2] {
    let places = |corners: &[u32]| -> Vec<Place> {
        points(mesh, corners).into_iter().map(|point| point.map(written)).collect()
    };
    let cell = |(number, corners): (u32, &[u32])| {
        let surfaces = mesh.surfaces.iter();
        let inside = surfaces.filter(|surface| surface.cells.binary_search(&number).is_ok());
        (from_least(places(corners)), inside.map(|surface| surface.name.clone()).collect())
    };
    let edges = mesh.curves.iter().flat_map(|curve| curve.edges.iter().map(move |of| (curve, of)));
    let edge = |(curve, ends): (&Curve, &[u32; 2])| {
        let mut ends = places(ends);
        ends.sort_unstable();
        (ends, vec![curve.name.clone()])
    };
    let mut all = [(0..).zip(mesh.corners()).map(cell).collect(), edges.map(edge).collect()];
    all.iter_mut().for_each(|all: &mut Vec<_>| all.sort_unstable());
    all
}

/// The mesh in multiples of 2⁻²⁰.
fn shape(mesh: &Mesh) -> [Vec<(Vec<Place>, Vec<String>)>; 2] {
    in_places(mesh, |x| (x * f64::from(1 << 20)).round() as i64)
}
