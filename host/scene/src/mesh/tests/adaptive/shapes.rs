//! Shapes after twelve rounds are bounded by those of the base mesh.
//!
//! ```text
//!   triangles of triangles   least angle ≥ a third of the base's
//!   triangles of quads       sine of the least angle ≥ q/16
//!   quads                    q ≥ half of the base's
//! ```
//! q = J/h², J the least turn of two sides that follow each other, h the longest side. The bounds are met without
//! any room for rounding: where they are sharp, on squares, all coordinates are exact.

use super::*;

/// q of a quad.
fn shape_of_quad(corners: &[[f64; 2]]) -> f64 {
    let side = |k: usize| [0, 1].map(|axis| corners[(k + 1) % 4][axis] - corners[k % 4][axis]);
    let turn = |k: usize| side(k)[0] * side(k + 1)[1] - side(k)[1] * side(k + 1)[0];
    let longest = (0..4).map(|k| side(k)[0].hypot(side(k)[1])).fold(0.0, f64::max);
    (0..4).map(turn).fold(f64::INFINITY, f64::min) / (longest * longest)
}

/// The least angle of a triangle, by the law of cosines.
fn least_angle(corners: &[[f64; 2]]) -> f64 {
    let length = |k: usize| {
        let (p, q) = (corners[k % 3], corners[(k + 1) % 3]);
        (p[0] - q[0]).hypot(p[1] - q[1])
    };
    let angle = |k: usize| {
        let (a, b, c) = (length(k), length(k + 1), length(k + 2));
        // Half of the angle between a and b, from the semiperimeter's factors.
        (((c - a + b) * (c + a - b)).sqrt()).atan2(((a + b - c) * (a + b + c)).sqrt()) * 2.0
    };
    (0..3).map(angle).fold(f64::INFINITY, f64::min)
}

#[test]
fn twelve_rounds_towards_a_point_a_line_and_at_random() {
    for target in [Target::Point([0.0, 0.0]), Target::Line(0.0), Target::Random(40)] {
        for (what, base) in all() {
            let mut draw = Draw(base.cells() as u64);
            let mut hierarchy = Hierarchy::new(base.clone()).expect("a mesh");
            for _ in 0..12 {
                if hierarchy.mesh().cells() > 40_000 {
                    break;
                }
                let marks = target.marks(hierarchy.mesh(), &mut draw);
                hierarchy.refine(&marks).expect("a finer mesh");
            }
            compare(&format!("{what} {target:?}"), &base, &hierarchy);
        }
    }
}

/// Every cell against its root.
fn compare(what: &str, base: &Mesh, hierarchy: &Hierarchy) {
    let (mesh, roots) = (hierarchy.mesh(), cells(base));
    for (cell, root) in cells(mesh).iter().zip(hierarchy.roots()) {
        let (cell, root) = (points(mesh, cell), points(base, &roots[root as usize]));
        let (bound, found) = match (cell.len(), root.len()) {
            (3, 3) => (least_angle(&root) / 3.0, least_angle(&cell)),
            (3, 4) => (shape_of_quad(&root) / 16.0, least_angle(&cell).sin()),
            (4, 4) => (shape_of_quad(&root) / 2.0, shape_of_quad(&cell)),
            _ => panic!("{what}: a quad in a triangle"),
        };
        assert!(bound <= found, "{what}: {found}, at least {bound}");
    }
}
