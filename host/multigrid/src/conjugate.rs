//! Preconditioned conjugate gradients in f32, for a correction whose residual is then measured in f64.
//!
//! ```text
//!   z = M⁻¹ r,   β = −q·z / last p·q,   p ← z + β p,   q ← K z + β q = K p,   α = p·r / p·q,   x ← x + α p,   r ← r − α q
//! ```
//! The direction outlives a correction, so that β is not r·z over the last one. K z comes with z ([`crate::relaxation`]). √(r·z) follows
//! the error in the energy norm. Where u is large beside its last correction f32 has nothing more to say: then a new residual in
//! f64 begins another correction.

use crate::edges::Edges;

/// Vectors of the iteration.
#[derive(Debug)]
pub(crate) struct Conjugate {
    /// The correction.
    pub x: Vec<f32>,
    /// The residual that it corrects, then the rest of it.
    pub residual: Vec<f32>,
    direction: Vec<f32>,
    product: Vec<f32>,
    /// p·q of the last direction; ∞ where there is none to go on from.
    curvature: f64,
    /// The part of the first √(r·z) that was last seen in a correction.
    pub left: f64,
}

impl Conjugate {
    pub fn new(n: usize) -> Self {
        Self {
            x: vec![0.0; n],
            residual: vec![0.0; n],
            direction: vec![0.0; n],
            product: vec![0.0; n],
            curvature: f64::INFINITY,
            left: 1.0,
        }
    }

    /// Forgets the last direction: the next correction is of another system.
    pub fn restart(&mut self) {
        self.curvature = f64::INFINITY;
        self.direction.fill(0.0);
        self.product.fill(0.0);
    }

    /// Corrects from x = 0 until √(r·z) has fallen to `reduction` of what it was, or will have, by `most` iterations at most. How many
    /// were made; none where rounding or an indefinite matrix ended it at once.
    ///
    /// Where r·z goes on to fall as it did in the last iteration, e to e²/e₋, and that is enough, the next one is not worked out:
    /// it would take a preconditioner whose z nobody uses.
    pub fn correct<const W: usize>(
        &mut self,
        edges: &mut Edges<W>,
        reduction: f64,
        most: usize,
    ) -> usize {
        self.x.fill(0.0);
        edges.rest.copy_from_slice(&self.residual);
        let (mut first, mut last) = (0.0, 0.0);
        for iteration in 0..most {
            edges.precondition(&self.residual);
            let energy = dot(&self.residual, &edges.z);
            if iteration == 0 {
                first = energy;
            }
            self.left = (energy / first).sqrt();
            let enough = reduction * reduction * first;
            if !(energy > enough && energy.is_finite()) {
                return iteration;
            }
            let beta = -dot(&self.product, &edges.z) / self.curvature;
            let [curvature, descent] = self.turn(edges, beta as f32);
            if !(curvature > 0.0 && curvature.is_finite()) {
                return iteration;
            }
            self.advance(&mut edges.rest, (descent / curvature) as f32);
            self.curvature = curvature;
            if energy * energy <= enough * last {
                return iteration + 1;
            }
            last = energy;
        }
        most
    }

    /// p and q; returns p·q and p·r.
    fn turn<const W: usize>(&mut self, edges: &Edges<W>, beta: f32) -> [f64; 2] {
        let (mut curvature, mut descent) = (0.0, 0.0);
        for start in (0..self.residual.len()).step_by(BLOCK) {
            let block = start..self.residual.len().min(start + BLOCK);
            let (p, q) = (&mut self.direction[block.clone()], &mut self.product[block.clone()]);
            let (r, y) = (&self.residual[block.clone()], &edges.rest[block.clone()]);
            p.iter_mut().zip(&edges.z[block]).for_each(|(p, z)| *p = z + beta * *p);
            q.iter_mut().zip(r.iter().zip(y)).for_each(|(q, (r, y))| *q = r + y + beta * *q);
            curvature += dot(p, q);
            descent += dot(p, r);
        }
        [curvature, descent]
    }

    /// x and r, of which `copy` becomes one.
    fn advance(&mut self, copy: &mut [f32], alpha: f32) {
        let news = self.direction.iter().zip(&self.product);
        let pairs = self.x.iter_mut().zip(&mut self.residual).zip(copy);
        for (((x, r), copy), (p, q)) in pairs.zip(news) {
            *x += alpha * p;
            *r -= alpha * q;
            *copy = *r;
        }
    }
}

/// Numbers that stay in the nearest cache from one pass to the next.
const BLOCK: usize = 1024;
/// Sums side by side, for the processor to add at once.
const LANES: usize = 8;

/// a·b, summed in f64 and in an order that depends on the length alone.
fn dot(a: &[f32], b: &[f32]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (a, b) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest = a.remainder().iter().zip(b.remainder()).map(|(&a, &b)| f64::from(a) * f64::from(b));
    let rest: f64 = rest.sum();
    for (a, b) in a.zip(b) {
        for (lane, (&a, &b)) in lanes.iter_mut().zip(a.iter().zip(b)) {
            *lane += f64::from(a) * f64::from(b);
        }
    }
    lanes.iter().sum::<f64>() + rest
}
