//! Local refinement: what every round keeps, what shapes may become, and where new cells came from.

mod bases;
mod carried;
mod rounds;
mod shapes;

use super::*;
use crate::mesh::adaptive::{Carried, Hierarchy};

use self::bases::all;

/// Which cells to refine in a round.
#[derive(Debug, Clone, Copy)]
enum Target {
    /// The cells that a point lies nearest to, by their mean.
    Point([f64; 2]),
    /// The cells that the line x = const. meets.
    Line(f64),
    /// Each cell with a probability of 1/n.
    Random(u64),
}

impl Target {
    fn marks(self, mesh: &Mesh, draw: &mut Draw) -> Vec<bool> {
        let cells = cells(mesh);
        let corners = cells.iter().map(|cell| points(mesh, cell));
        match self {
            Self::Random(n) => corners.map(|_| draw.bits().is_multiple_of(n)).collect(),
            Self::Line(x) => {
                let meets = |cell: Vec<[f64; 2]>| {
                    cell.iter().any(|p| p[0] <= x) && cell.iter().any(|p| p[0] >= x)
                };
                corners.map(meets).collect()
            }
            Self::Point([x, y]) => {
                let away = |cell: Vec<[f64; 2]>| {
                    let to =
                        |axis: usize| cell.iter().map(|p| p[axis]).sum::<f64>() / cell.len() as f64;
                    (to(0) - x).hypot(to(1) - y)
                };
                let away: Vec<_> = corners.map(away).collect();
                let least = away.iter().copied().fold(f64::INFINITY, f64::min);
                away.iter().map(|&away| away <= least).collect()
            }
        }
    }
}

/// A round of refinement, just done.
struct Round<'r> {
    what: &'r str,
    base: &'r Mesh,
    before: &'r Mesh,
    marks: &'r [bool],
    carried: &'r Carried,
    hierarchy: &'r Hierarchy,
}

/// So many rounds of refinement on every base mesh, with whatever `each` looks at after a round.
fn rounds(target: Target, count: u32, mut each: impl FnMut(Round)) {
    for (what, base) in all() {
        let mut draw = Draw(base.cells() as u64);
        let mut hierarchy = Hierarchy::new(base.clone()).expect("a mesh");
        assert_eq!(hierarchy.mesh(), &base, "{what}");
        for _ in 0..count {
            let before = hierarchy.mesh().clone();
            let marks = target.marks(&before, &mut draw);
            let carried = hierarchy.refine(&marks).expect("a finer mesh");
            let (base, before, marks, carried) = (&base, &before, &marks[..], &carried);
            each(Round { what: &what, base, before, marks, carried, hierarchy: &hierarchy });
        }
    }
}
