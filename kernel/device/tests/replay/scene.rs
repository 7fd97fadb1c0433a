//! The problems: a grid whose inner vertices are moved at random, random data, and what makes it awkward.

use crate::numbering::{
    self,
    Side::{self, Contact, Given, Insulated, Transfer},
};
use signorini_kernel::Real;

/// A scalar that takes numbers of the host.
pub trait Scalar: Real {
    fn of(x: f64) -> Self;
}

impl Scalar for f32 {
    fn of(x: f64) -> Self {
        x as f32
    }
}

impl Scalar for f64 {
    fn of(x: f64) -> Self {
        x
    }
}

#[derive(Clone, Copy, PartialEq)]
pub enum Cells {
    Triangles,
    Quads,
    Mixed,
}

pub struct Scene {
    pub name: &'static str,
    pub cells: Cells,
    pub columns: usize,
    pub lines: usize,
    /// This column and the next have no cells: two parts, and vertices that are none of either.
    pub missing: Option<usize>,
    /// Bottom, right, top, left.
    pub sides: [Side; 4],
    /// The conductivity of every third cell; 1 elsewhere.
    pub jump: f64,
    /// The transfer coefficient.
    pub transfer: f64,
    /// f
    pub source: f64,
    /// How far inner vertices move, in cells.
    pub moved: f64,
    pub seed: u64,
}

const PLAIN: Scene = Scene {
    name: "",
    cells: Cells::Mixed,
    columns: 6,
    lines: 4,
    missing: None,
    sides: [Contact, Transfer, Given, Insulated],
    jump: 3.0,
    transfer: 0.7,
    source: -8.0,
    moved: 0.5,
    seed: 1,
};

pub const SCENES: [Scene; 8] = [
    Scene { name: "triangles", cells: Cells::Triangles, ..PLAIN },
    Scene { name: "quads", cells: Cells::Quads, seed: 2, ..PLAIN },
    Scene { name: "mixed, pushed up", source: 6.0, seed: 3, ..PLAIN },
    Scene { name: "parallelograms", cells: Cells::Quads, moved: 0.0, seed: 4, ..PLAIN },
    Scene {
        name: "contact alone",
        sides: [Contact, Insulated, Insulated, Contact],
        source: -3.0,
        seed: 5,
        ..PLAIN
    },
    Scene {
        name: "two parts, weakly held",
        missing: Some(3),
        sides: [Insulated, Contact, Transfer, Transfer],
        transfer: 1e-3,
        columns: 8,
        seed: 6,
        ..PLAIN
    },
    Scene { name: "a contrast of 10000", jump: 1e4, seed: 7, ..PLAIN },
    Scene {
        name: "contrast on triangles, a contact side and a given one",
        cells: Cells::Triangles,
        jump: 1e-5,
        sides: [Given, Insulated, Contact, Insulated],
        source: -4e-5,
        seed: 8,
        ..PLAIN
    },
];

/// Multiples of 1/256 from [0, 1).
pub struct Draw(pub u64);

impl Draw {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 56) as f64 / 256.0
    }

    /// From [−1, 1).
    pub fn signed(&mut self) -> f64 {
        2.0 * self.next() - 1.0
    }
}

impl Scene {
    /// Vertices and cells.
    pub fn mesh(&self) -> (Vec<[f64; 2]>, numbering::Cells<u16>) {
        let (mut draw, width) = (Draw(self.seed), self.columns + 1);
        let place = |at: usize| {
            let (i, j) = (at % width, at / width);
            let inner = i > 0 && i < self.columns && j > 0 && j < self.lines;
            let mut moved = || if inner { self.moved * (draw.next() - 0.5) } else { 0.0 };
            // Sheared, so that no side but the bottom is along an axis.
            let (x, y) = (i as f64 + moved(), j as f64 + moved());
            [0.25 * x + 0.0625 * y, 0.25 * y]
        };
        let vertices = (0..width * (self.lines + 1)).map(place).collect();
        let (mut triangles, mut quads) = (Vec::new(), Vec::new());
        for (i, j) in (0..self.lines).flat_map(|j| (0..self.columns).map(move |i| (i, j))) {
            if self.missing.is_some_and(|first| first == i || first + 1 == i) {
                continue;
            }
            let a = (j * width + i) as u16;
            let [b, c, d] = [a + 1, a + 2 + self.columns as u16, a + 1 + self.columns as u16];
            let cut = match self.cells {
                Cells::Triangles => true,
                Cells::Quads => false,
                Cells::Mixed => (i + j) % 2 == 0,
            };
            match (cut, j % 2) {
                (false, _) => quads.push([b, c, d, a]),
                (true, 0) => triangles.extend([[a, b, c], [c, d, a]]),
                (true, _) => triangles.extend([[d, a, b], [b, c, d]]),
            }
        }
        (vertices, (triangles, quads))
    }

    /// The condition on a boundary edge.
    pub fn side(&self, ends: [u16; 2]) -> Side {
        let width = self.columns + 1;
        let [p, q] = ends.map(|end| [usize::from(end) % width, usize::from(end) / width]);
        match (p, q) {
            ([_, 0], [_, 0]) => self.sides[0],
            ([i, _], [k, _]) if i == self.columns && k == i => self.sides[1],
            ([_, j], [_, l]) if j == self.lines && l == j => self.sides[2],
            ([0, _], [0, _]) => self.sides[3],
            _ => Insulated,
        }
    }
}
