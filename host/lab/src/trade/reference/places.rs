//! Where the points of a reference lie in the mesh of an answer.

use signorini_problem::search::{LocatedPoint, Search};
use signorini_problem::{EdgeKind, Problem};
use signorini_scene::{InputError, Result};

/// The places of all points of a reference in one mesh.
#[derive(Debug, Default)]
pub(super) struct Places {
    /// Of the points inside.
    pub(super) cells: Vec<LocatedPoint>,
    /// Of those on the Robin boundary.
    pub(super) edges: Vec<OnEdge>,
}

/// A point of the boundary as an edge sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct OnEdge {
    pub(super) edge: usize,
    /// From 0 to 1 in the edge's direction.
    pub(super) t: f64,
}

impl Places {
    /// Finds points inside and points on the Robin boundary in the mesh of `problem`.
    pub(super) fn find(
        problem: &Problem,
        inside: impl Iterator<Item = [f64; 2]>,
        robin: impl Iterator<Item = [f64; 2]>,
    ) -> Result<Self> {
        let search = Search::new(problem);
        let mut places = Self::default();
        for x in inside {
            let last = places.cells.last().copied();
            places.cells.push(search.find_near(last, x).ok_or_else(elsewhere)?);
        }
        let edges: Vec<usize> = (0..problem.ends.len())
            .filter(|&edge| problem.kinds[edge] == EdgeKind::Robin)
            .collect();
        for x in robin {
            places.edges.push(nearest(problem, &edges, x).ok_or_else(elsewhere)?);
        }
        Ok(places)
    }
}

/// The edge that a point lies on, up to rounding.
fn nearest(problem: &Problem, edges: &[usize], x: [f64; 2]) -> Option<OnEdge> {
    let foot = |&edge: &usize| {
        let [a, b] = problem.segment(edge);
        let (along, to) = ([b[0] - a[0], b[1] - a[1]], [x[0] - a[0], x[1] - a[1]]);
        let square = along[0] * along[0] + along[1] * along[1];
        let t = ((along[0] * to[0] + along[1] * to[1]) / square).clamp(0.0, 1.0);
        let apart = (to[0] - t * along[0]).hypot(to[1] - t * along[1]);
        (apart, OnEdge { edge, t })
    };
    let closest = edges.iter().map(foot).min_by(|a, b| a.0.total_cmp(&b.0));
    closest.map(|(_, place)| place)
}

fn elsewhere() -> InputError {
    InputError::new("the reference and an answer have different domains")
        .hint("an answer's mesh must be one of the scene's own mesh, refined or paired")
}
