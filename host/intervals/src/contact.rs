//! Bounds of u and σ on contact edges, and the conditions that z and ζ have to keep there.
//!
//! With z′ = z − its given value and ζ′ = ζ·n − its given density the weights leave
//! ```text
//!   ∫_C (σ − τ)·n z′ − ∫_C ζ′ (u − s),
//! ```
//! and the identity of the error bound has ∫_C (σ·n − lo)(s − ψ) + ∫_C (τ·n − lo)(u − ψ) ≤ K/2 beside the energies. So
//! ```text
//!   s > ψ, τ·n = lo:   |z′| ≤ c (s − ψ),  ζ′ = 0           (likewise with hi where s < ψ)
//!   s = ψ:             |ζ′| ≤ c (τ·n − lo),  z′ = 0        (and c (hi − τ·n), where there is a limit)
//! ```
//! make it at most c K/2. What keeps to neither is bounded by lo ≤ σ·n ≤ hi alone.

use super::answer::OnMesh;
use signorini_certify::curved::peak;
use signorini_certify::deviation::Deviations;
use signorini_certify::ends::Ends;
use signorini_problem::{Problem, excess};
use signorini_scene::error::Result;

/// Roundings of its scalar up to which a number is taken for another one; what that drops is counted.
const ROUNDINGS: f64 = 64.0;

/// Bounds on one contact edge.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContactEdge {
    pub edge: usize,
    /// How far τ·n is from the nearer end of its range where s = ψ, as an integral over the edge; else 0.
    pub room: f64,
    /// A lower bound of |s − ψ| is linear between these where τ·n is at the end of its side; infinite where σ·n is given.
    pub clear: [f64; 2],
    /// ∫(lo − τ·n) and ∫(hi − τ·n)
    pub left: [f64; 2],
    /// Signs that u − ψ may have, or that σ·n − τ·n may have where `clear` is not 0.
    pub may: [bool; 2],
    /// Numbers taken for 0: |s − ψ|, and ∫|τ·n − its end|.
    pub dropped: [f64; 2],
}

/// All contact edges in their order.
///
/// # Errors
/// Data that are not finite.
pub(super) fn contact_edges(on: &OnMesh) -> Result<Vec<ContactEdge>> {
    let OnMesh { problem, answer, deviations: followed } = on;
    let counts = problem.topology.counts;
    if counts.contact == 0 {
        return Ok(Vec::new());
    }
    let (ends, s) = (Ends::of(problem)?, answer.certified.admissible());
    let epsilon = ROUNDINGS * answer.scalar.epsilon();
    let all = Deviations::of(problem)?;
    let mut edges = Vec::with_capacity(counts.contact);
    for (at, gap) in ends.gap.iter().enumerate() {
        let edge = counts.free + at;
        let values = problem.ends[edge].map(|vertex| s.vertices[vertex as usize]);
        let not_followed = all.on(edge).filter(|_| followed.on(edge).is_none());
        let above = Above {
            ends: [values[0] - gap[0], values[1] - gap[1]],
            bubble: s.bubbles[edge],
            peak: not_followed.map_or(Ok(0.0), peak)?,
        };
        // What s lies below ψ by rounding of stored data, the bound's rounding counts; what u_D does, the oscillation.
        let size = gap[0].abs().max(gap[1].abs());
        let stored = 2.0 * answer.scalar.epsilon() * size;
        let (above, dropped) =
            above.without(epsilon * ends.size(), ends.slack(problem).max(stored));
        edges.push(ContactEdge::new(problem, edge, s.tau[edge], &above, dropped, epsilon));
    }
    Ok(edges)
}

/// s − ψ along an edge: linear, with a bubble and what a curved gap may add to it.
struct Above {
    ends: [f64; 2],
    bubble: f64,
    peak: f64,
}

impl Above {
    /// Where all of it is rounding, 0 and how much that drops; ends that are below 0 by less than `counted` are 0.
    fn without(self, slack: f64, counted: f64) -> (Self, f64) {
        let size = self.ends.iter().map(|end| end.abs()).fold(self.bubble.abs(), f64::max);
        if size <= slack && self.peak == 0.0 {
            return (Self { ends: [0.0; 2], bubble: 0.0, peak: 0.0 }, 2.0 * size);
        }
        let end = |end: f64| if (-counted..=0.0).contains(&end) { 0.0 } else { end };
        (Self { ends: self.ends.map(end), ..self }, 0.0)
    }

    fn is_zero(&self) -> bool {
        self.ends == [0.0; 2] && self.bubble == 0.0 && self.peak == 0.0
    }

    /// Lower bounds of `sign`·(s − ψ) at both ends and between; 0 where a bubble leaves no more than rounding of it.
    fn clear(&self, sign: f64, epsilon: f64) -> [f64; 2] {
        let ends = self.ends.map(|end| (sign * end).max(0.0));
        let roots = ends[0].sqrt() + ends[1].sqrt();
        // (1 − θ) of the chord is left by a bubble of −θ (√a + √b)²/4.
        let left = match sign * self.bubble {
            up if up >= 0.0 => 1.0,
            down => match 1.0 + 4.0 * down / (roots * roots) {
                left if left <= epsilon => 0.0,
                left => left,
            },
        };
        let is_on_its_side = self.ends.iter().all(|end| sign * end >= 0.0) && left.is_finite();
        ends.map(|end| if is_on_its_side { (left * end - self.peak).max(0.0) } else { 0.0 })
    }
}

impl ContactEdge {
    /// Of an edge, counted from the first one, on whatever side it is. Where it is open in all answers nothing passes beyond its least
    /// flux, and s is at least so far above ψ at its ends. Where it touches in all answers, it is pressed by so much at least.
    pub fn unknown(problem: &Problem, at: usize, open: Option<[f64; 2]>, pressed: f64) -> Self {
        let [least, most] = problem.loads.flux_range(at).ends();
        let edge = problem.topology.counts.free + at;
        let left = [f64::NEG_INFINITY, f64::INFINITY];
        let none = Self { room: pressed, ..Self::of(edge, left) };
        // Inputs may open a range that is a point now.
        let is_given = least == most && problem.scene.limit_input().is_none();
        match (is_given, open) {
            (true, _) => Self { clear: [f64::INFINITY; 2], left: [0.0; 2], ..none },
            (_, Some(clear)) => {
                Self { clear, left: [0.0, f64::INFINITY], may: [false, true], ..none }
            }
            _ => none,
        }
    }

    /// An edge with such ends of σ·n − τ·n, of which nothing more is known.
    fn of(edge: usize, left: [f64; 2]) -> Self {
        Self { edge, room: 0.0, clear: [0.0; 2], left, may: [true; 2], dropped: [0.0; 2] }
    }

    /// Whether z has its value here where it may be off by so much of `clear`: all of [0, 1] is not within that.
    pub fn is_held(&self, part: f64) -> bool {
        !self.clear.iter().all(|&clear| clear == f64::INFINITY || part * clear >= 1.0)
    }

    /// This edge where z keeps its value, like s where it touches ψ, or does not.
    pub fn held(self, is_held: bool) -> Self {
        Self { room: if is_held { 1.0 } else { 0.0 }, ..self }
    }

    fn new(
        problem: &Problem,
        edge: usize,
        tau: f64,
        above: &Above,
        dropped: f64,
        epsilon: f64,
    ) -> Self {
        let at = edge - problem.topology.counts.free;
        let ends @ [least, most] = problem.loads.flux_range(at).ends();
        let left = ends.map(|end| end - tau);
        let off = |end: f64| (tau - end).abs();
        let is_at = |end: f64| end.is_finite() && off(end) <= epsilon * (tau.abs() + end.abs());
        let none = Self { dropped: [dropped, 0.0], ..Self::of(edge, left) };
        if least == most {
            // Of a condensed model τ has it but for rounding.
            let dropped = [dropped, off(least)];
            return Self { clear: [f64::INFINITY; 2], left: [0.0; 2], dropped, ..none };
        }
        if let Some(excess) = excess(problem, edge) {
            // σ·n and τ·n = lo + θ (hi − lo) may both be where hi − lo is widest.
            let widest = if most > least { 1.0 + excess / (most - least) } else { 1.0 };
            return Self { left: left.map(|left| widest * left), ..none };
        }
        if above.is_zero() {
            let room = (-left[0]).min(left[1]).max(0.0);
            // With one end alone u is on one side of ψ.
            return Self { room, may: [most < f64::INFINITY, least > f64::NEG_INFINITY], ..none };
        }
        let is_above = above.ends.iter().all(|&end| end >= 0.0);
        match is_above {
            true if is_at(least) => Self {
                clear: above.clear(1.0, epsilon),
                may: [false, true],
                dropped: [dropped, off(least)],
                ..none
            },
            false if is_at(most) => Self {
                clear: above.clear(-1.0, epsilon),
                may: [true, false],
                dropped: [dropped, off(most)],
                ..none
            },
            _ => none,
        }
    }
}
