//! A mesh cut along lines x = c and y = c, whose cells each lie in one of the mesh before.
//!
//! Cells become convex polygons, and these become triangles. A vertex of a line on an edge belongs to both cells beside it.

use std::collections::HashMap;

use signorini_scene::Mesh;
use signorini_scene::mesh::Curve;

/// Where one coordinate, x or y, has a value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// 0 of x, 1 of y.
    pub axis: usize,
    /// Its value there.
    pub at: f64,
}

/// A vertex counts as on a line up to this distance; domains have the size of 1.
const ON: f64 = 1e-10;

/// `mesh` cut into triangles that no line crosses, and of each the cell that it lies in.
pub fn cut_along(mesh: &Mesh, lines: &[Line]) -> (Mesh, Vec<u32>) {
    let polygons = (0..).zip(mesh.corners().map(<[u32]>::to_vec)).collect();
    let (vertices, curves) = (mesh.vertices.clone(), mesh.curves.clone());
    let mut parts = Parts { vertices, polygons, curves };
    lines.iter().for_each(|line| parts.cut(*line));
    let fan = |(parent, corners): &(u32, Vec<u32>)| {
        let (first, parent) = (corners[0], *parent);
        let sides = corners[1..].windows(2).map(move |side| ([first, side[0], side[1]], parent));
        sides.collect::<Vec<_>>()
    };
    let (triangles, parents): (Vec<_>, Vec<_>) = parts.polygons.iter().flat_map(fan).unzip();
    let surfaces = mesh.inherited(&parents);
    let Parts { vertices, curves, .. } = parts;
    (Mesh { vertices, triangles, quads: Vec::new(), surfaces, curves }, parents)
}

/// The mesh so far: polygons, each with the cell that it lies in.
struct Parts {
    vertices: Vec<[f64; 2]>,
    polygons: Vec<(u32, Vec<u32>)>,
    curves: Vec<Curve>,
}

/// The vertices that a line makes on edges.
type Crossings = HashMap<[u32; 2], u32>;

impl Parts {
    fn cut(&mut self, line: Line) {
        let mut crossings = Crossings::new();
        let polygons = std::mem::take(&mut self.polygons);
        for (parent, corners) in polygons {
            let halves = [-1.0, 1.0].map(|side| self.half(&corners, line, side, &mut crossings));
            let kept = halves.into_iter().filter(|half| half.len() > 2);
            self.polygons.extend(kept.map(|half| (parent, half)));
        }
        for curve in &mut self.curves {
            let halves = |&[a, b]: &[u32; 2]| match crossings.get(&[a, b]) {
                Some(&middle) => vec![[a, middle], [b, middle]],
                None => vec![[a, b]],
            };
            curve.edges = curve.edges.iter().flat_map(halves).collect();
            curve.edges.sort_unstable();
        }
    }

    /// The part of a polygon on one side of a line; two corners or fewer where there is none.
    fn half(
        &mut self,
        corners: &[u32],
        line: Line,
        side: f64,
        crossings: &mut Crossings,
    ) -> Vec<u32> {
        let mut half = Vec::new();
        for (&a, &b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let [before, after] = [a, b].map(|vertex| side * self.off(vertex, line));
            if before >= 0.0 {
                half.push(a);
            }
            if before * after < 0.0 {
                let edge = [a.min(b), a.max(b)];
                half.push(*crossings.entry(edge).or_insert_with(|| self.crossing(edge, line)));
            }
        }
        half
    }

    fn off(&self, vertex: u32, line: Line) -> f64 {
        let off = self.vertices[vertex as usize][line.axis] - line.at;
        if off.abs() <= ON { 0.0 } else { off }
    }

    fn crossing(&mut self, [a, b]: [u32; 2], line: Line) -> u32 {
        let [from, to] = [a, b].map(|vertex| self.vertices[vertex as usize]);
        let t = (line.at - from[line.axis]) / (to[line.axis] - from[line.axis]);
        let mut place = [0, 1].map(|k| from[k] + t * (to[k] - from[k]));
        place[line.axis] = line.at;
        self.vertices.push(place);
        self.vertices.len() as u32 - 1
    }
}
