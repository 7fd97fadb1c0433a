//! The two-level preconditioner: a sweep down over the edges, a cycle on the vertices, a sweep up.

use crate::Problem;
use crate::hierarchy::Hierarchy;
use crate::lines::Lines;
use crate::relaxation::Relaxation;
use crate::vertex_matrix::{Numbering, galerkin};

/// K in f32 and what approximates its inverse, with unknowns in an order of their own.
#[derive(Debug)]
pub(crate) struct Edges<const WIDTH: usize> {
    relaxation: Relaxation<WIDTH>,
    /// The unknown at each place.
    pub order: Vec<u32>,
    ends: Vec<[u32; 2]>,
    count: usize,
    free: usize,
    hierarchy: Hierarchy,
    /// The largest K_ii, by which all of K is divided.
    pub unit: f64,
    /// r − K z after a sweep down; y after a sweep up.
    pub rest: Vec<f32>,
    pub z: Vec<f32>,
}

impl<const WIDTH: usize> Edges<WIDTH> {
    pub fn new(problem: &Problem) -> Self {
        let n = problem.unknowns();
        let unit = (0..n).map(|at| problem.diagonal(at)).fold(f64::MIN_POSITIVE, f64::max);
        let numbering = Numbering::of(problem);
        let hierarchy = Hierarchy::new(galerkin(problem, &numbering, 1.0 / unit));
        let lines = Lines::of(problem);
        let order = lines.order.clone();
        let ends = order.iter().map(|&at| numbering.ends[at as usize]).collect();
        Self {
            relaxation: Relaxation::new(problem, unit, lines),
            order,
            ends,
            count: numbering.count,
            free: problem.contact.free(),
            hierarchy,
            unit,
            rest: vec![0.0; n],
            z: vec![0.0; n],
        }
    }

    /// Holds contact edges at 0 where `held` says so.
    pub fn hold(&mut self, held: impl Iterator<Item = bool>) {
        let mut vertices = Vec::new();
        for (at, is_held) in (self.free..).zip(held) {
            self.relaxation.hold(at, is_held);
            if is_held {
                vertices
                    .extend(self.ends[at].into_iter().filter(|&end| (end as usize) < self.count));
            }
        }
        vertices.sort_unstable();
        vertices.dedup();
        self.hierarchy.hold(&vertices);
    }

    /// z from `residual` r, of which a copy stands in [`Edges::rest`], and y in its place.
    pub fn precondition(&mut self, residual: &[f32]) {
        self.relaxation.down(&mut self.rest, &mut self.z);
        self.correct();
        self.relaxation.up(residual, &mut self.rest, &mut self.z);
    }

    fn correct(&mut self) {
        let load = self.hierarchy.load();
        load.fill(0.0);
        for (&[a, b], rest) in self.ends.iter().zip(&self.rest) {
            load[a as usize] += 0.5 * rest;
            load[b as usize] += 0.5 * rest;
        }
        let correction = self.hierarchy.cycle();
        for (&[a, b], z) in self.ends.iter().zip(&mut self.z) {
            *z += 0.5 * (correction[a as usize] + correction[b as usize]);
        }
    }
}
