//! The catalogue's grid: 2n × n squares on (−1, 1) × (0, 1), for convergence studies.
//!
//! Squares stay quads, or are cut from the lower left to the upper right corner, or both in turn, or they
//! become trapezoids that keep their shape however fine the grid is.
//! Physical curves: `contact` (y = 0) and `dirichlet` (the rest); surfaces: `left` (x < 0), `right`.

use super::{Curve, Mesh, Surface};

/// The cells that a square becomes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cells {
    /// Two triangles.
    Triangles,
    /// A quad.
    Quads,
    /// Triangles and quads like the fields of a chessboard.
    Mixed,
}

/// Where quads become trapezoids that keep their shape however fine the grid is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Trapezoids {
    /// In two rows, along the bottom and the top; parallelograms between.
    InTwoRows,
    /// Everywhere.
    Everywhere,
}

/// The grid with 2n × n squares.
pub fn grid(n: u32, cells: Cells) -> Mesh {
    let columns = 2 * n;
    let vertex = |i: u32, j: u32| j * (columns + 1) + i;
    let width = f64::from(n);
    let mut mesh = Mesh::default();
    for j in 0..=n {
        let place = |i: u32| [f64::from(i) / width - 1.0, f64::from(j) / width];
        mesh.vertices.extend((0..=columns).map(place));
    }
    // Triangles are numbered before quads, so regions are collected by kind.
    let mut in_left: [Vec<bool>; 2] = Default::default();
    for (i, j) in (0..n).flat_map(|j| (0..columns).map(move |i| (i, j))) {
        let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
        let whole = match cells {
            Cells::Triangles => false,
            Cells::Quads => true,
            Cells::Mixed => (i + j) % 2 == 0,
        };
        if whole {
            mesh.quads.push([a, b, c, d]);
            in_left[1].push(i < n);
        } else {
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
            in_left[0].extend([i < n; 2]);
        }
    }
    let left: Vec<bool> = in_left.concat();
    let numbers = |wanted: bool| {
        let all = (0u32..).zip(&left);
        all.filter(move |&(_, &left)| left == wanted).map(|(cell, _)| cell).collect()
    };
    mesh.surfaces = vec![
        Surface { name: "left".to_owned(), cells: numbers(true) },
        Surface { name: "right".to_owned(), cells: numbers(false) },
    ];
    let bottom = (0..columns).map(|i| [vertex(i, 0), vertex(i + 1, 0)]).collect();
    let top = (0..columns).map(|i| [vertex(i, n), vertex(i + 1, n)]);
    let sides = (0..n).flat_map(|j| [0, columns].map(|i| [vertex(i, j), vertex(i, j + 1)]));
    let mut rest: Vec<_> = top.chain(sides).collect();
    rest.sort_unstable();
    mesh.curves = vec![
        Curve { name: "contact".to_owned(), edges: bottom },
        Curve { name: "dirichlet".to_owned(), edges: rest },
    ];
    mesh
}

/// The grid of quads with vertices moved up and down in turn by h/4: in every other row (n even), which
/// makes vertical sides of 5/4 h and 3/4 h, or all those inside.
pub fn trapezoids(n: u32, place: Trapezoids) -> Mesh {
    let mut mesh = grid(n, Cells::Quads);
    let (columns, quarter) = (2 * n as usize + 1, 0.25 / f64::from(n));
    for (at, [x, y]) in mesh.vertices.iter_mut().enumerate() {
        let moves = match place {
            Trapezoids::InTwoRows => x.abs() < 1.0 && *y > 0.0 && *y < 1.0,
            Trapezoids::Everywhere => !(at / columns).is_multiple_of(2),
        };
        if moves {
            *y += if (at % columns).is_multiple_of(2) { quarter } else { -quarter };
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_of_the_catalogue() {
        for (cells, edges) in [(Cells::Triangles, 1584), (Cells::Quads, 1072)] {
            let mesh = grid(16, cells);
            assert_eq!(super::super::check::edges(&mesh).map(|edges| edges.len()), Ok(edges));
            assert_eq!(mesh.curves[0].edges.len() + mesh.curves[1].edges.len(), 96);
        }
        let mixed = grid(4, Cells::Mixed);
        assert_eq!((mixed.triangles.len(), mixed.quads.len()), (32, 16));
        assert_eq!(mixed.surfaces[0].cells.len(), mixed.surfaces[1].cells.len());
    }

    /// Of how many quads the vertical sides differ, and by how much in the unit h.
    fn uneven(n: u32, place: Trapezoids) -> (usize, f64) {
        let mesh = trapezoids(n, place);
        let difference = |quad: &[u32; 4]| {
            let [a, b, c, d] = quad.map(|at| mesh.vertices[at as usize]);
            assert_eq!((a[0], b[0]), (d[0], c[0]));
            ((d[1] - a[1]) - (c[1] - b[1])).abs() * f64::from(n)
        };
        let all: Vec<_> = mesh.quads.iter().map(difference).filter(|of| *of > 1e-9).collect();
        (all.len(), all.iter().fold(0.0, |most, of| of.max(most)))
    }

    #[test]
    fn trapezoids_keep_their_shape() {
        for n in [4, 16] {
            let (count, difference) = uneven(n, Trapezoids::Everywhere);
            assert_eq!(count, 2 * (n * n) as usize);
            assert_eq!(difference, 0.5);
            let (count, difference) = uneven(n, Trapezoids::InTwoRows);
            assert_eq!(count, 4 * n as usize);
            assert_eq!(difference, 0.5);
        }
    }
}
