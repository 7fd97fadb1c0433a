//! Every round keeps the domain with its names, and closure does not spread.

use super::bases::corner;
use super::*;
use crate::mesh::adaptive::refined;
use crate::mesh::check::MOST_CELLS;
use crate::mesh::gmsh::write;
use crate::mesh::parse;
use crate::mesh::structured::{Cells, grid};

/// How many cells all rounds together may add for each that was marked: towards a point in a quad a round adds 43.
const MOST_ADDED: usize = 48;

#[test]
fn the_domain_keeps_its_names_and_sizes_and_cells_do_not_spread() {
    let point = Target::Point([0.1, 0.05]);
    for (target, count) in [(point, 16), (Target::Line(0.03), 6), (Target::Random(9), 6)] {
        let mut marked = 0;
        rounds(target, count, |Round { what, base, hierarchy, marks, .. }| {
            let (mesh, what) = (hierarchy.mesh(), format!("{what} {target:?}"));
            assert_same_domain(&what, base, mesh);
            assert_eq!(mesh.vertices[..base.vertices.len()], base.vertices, "{what}");
            if marks.len() == base.cells() {
                marked = 0;
            }
            marked += marks.iter().filter(|mark| **mark).count();
            let added = mesh.cells() - base.cells();
            assert!(added <= MOST_ADDED * marked, "{what}: {added} for {marked}");
        });
    }
}

#[test]
fn everything_marked_is_uniform_refinement() {
    for (what, base) in all() {
        let (mut hierarchy, mut uniform) = (Hierarchy::new(base.clone()).expect("a mesh"), base);
        for _ in 0..2 {
            hierarchy.refine(&vec![true; uniform.cells()]).expect("a finer mesh");
            uniform = refined(&uniform).expect("a finer mesh");
            assert_eq!(hierarchy.mesh().cells(), uniform.cells(), "{what}");
            assert_eq!(hierarchy.mesh().vertices.len(), uniform.vertices.len(), "{what}");
        }
        let exact = |mesh: &Mesh| in_places(mesh, |x| x.to_bits().cast_signed());
        assert_eq!(exact(hierarchy.mesh()), exact(&uniform), "{what}");
    }
}

#[test]
fn equal_marks_give_equal_meshes_and_no_marks_change_nothing() {
    let run = || {
        let mut meshes = Vec::new();
        rounds(Target::Random(5), 3, |round| meshes.push(round.hierarchy.mesh().clone()));
        meshes
    };
    assert!(run() == run());
    for (what, base) in all() {
        let mut hierarchy = Hierarchy::new(base).expect("a mesh");
        let marks = Target::Random(4).marks(hierarchy.mesh(), &mut Draw(7));
        hierarchy.refine(&marks).expect("a finer mesh");
        let before = hierarchy.mesh().clone();
        let carried = hierarchy.refine(&vec![false; before.cells()]).expect("the same mesh");
        assert_eq!(hierarchy.mesh(), &before, "{what}");
        assert!(carried.cells.into_iter().eq(0..before.cells() as u32), "{what}");
    }
}

/// The rest of the marked cells.
fn left(before: &Mesh, marks: &[bool], after: &Mesh) -> BTreeSet<Vec<u32>> {
    let after: BTreeSet<_> = cells(after).into_iter().map(from_least).collect();
    let marked = cells(before).into_iter().zip(marks).filter(|(_, marked)| **marked);
    marked.map(|(cell, _)| from_least(cell)).filter(|cell| after.contains(cell)).collect()
}

#[test]
fn marked_cells_are_gone_after_one_round_or_two() {
    for (what, base) in all() {
        let (mut hierarchy, mut draw) = (Hierarchy::new(base).expect("a mesh"), Draw(11));
        for _ in 0..3 {
            let before = hierarchy.mesh().clone();
            let marks = Target::Random(6).marks(&before, &mut draw);
            hierarchy.refine(&marks).expect("a finer mesh");
            // The corner of a triangle with two nodes is what its child will be.
            let left_over = left(&before, &marks, hierarchy.mesh());
            assert!(left_over.iter().all(|cell| cell.len() == 3), "{what}");
            let again = hierarchy.mesh().clone();
            let is_left = |cell| left_over.contains(&from_least(cell));
            let marks: Vec<_> = cells(&again).into_iter().map(is_left).collect();
            hierarchy.refine(&marks).expect("a finer mesh");
            assert!(left(&again, &marks, hierarchy.mesh()).is_empty(), "{what}");
        }
    }
}

#[test]
fn what_cannot_be_refined_is_refused_and_the_mesh_stays() {
    let mut hierarchy = Hierarchy::new(corner()).expect("a mesh");
    let error = hierarchy.refine(&[true]).expect_err("a mark for each");
    assert_eq!(error.to_string(), "1 marks, expected one for each of the 3 cells");
    let mut draw = Draw(0);
    // Towards a vertex away from the origin no number is as fine as wanted.
    let error = (0..100).find_map(|_| {
        let before = hierarchy.mesh().clone();
        let marks = Target::Point([1.0, 0.1]).marks(&before, &mut draw);
        let refused = hierarchy.refine(&marks).err();
        assert!(refused.is_none() || *hierarchy.mesh() == before);
        refused
    });
    let error = error.expect("an end").to_string();
    assert!(error.contains("is too small to be refined"), "{error}");

    let mut stray = corner();
    stray.curves[0].edges.push([1, 4]);
    let error = Hierarchy::new(stray).expect_err("no such edge").to_string();
    assert_eq!(error, "curve `corner`: no cell has the edge from 1 to 4");
}

#[test]
fn too_many_cells_are_refused() {
    let mut hierarchy = Hierarchy::new(grid(360, Cells::Triangles)).expect("a mesh");
    hierarchy.refine(&vec![true; hierarchy.mesh().cells()]).expect("two million cells");
    let marks = vec![true; hierarchy.mesh().cells()];
    let error = hierarchy.refine(&marks).expect_err("too many").to_string();
    assert_eq!(error, "the refined mesh would have 8294400 cells, expected at most 8000000");
    assert_eq!(hierarchy.mesh().cells(), marks.len());
    assert!(4 * marks.len() > MOST_CELLS);
}

#[test]
fn every_round_is_written_and_read_back() {
    rounds(Target::Random(6), 2, |Round { what, hierarchy, .. }| {
        let written = write::text(hierarchy.mesh());
        let read = parse(written.as_bytes());
        assert_eq!(read.as_ref().ok(), Some(hierarchy.mesh()), "{what}: {:?}", read.as_ref().err());
    });
}
