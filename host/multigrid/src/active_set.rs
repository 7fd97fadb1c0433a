//! The sides of the contact edges, and which of them are wrong for an iterate.
//!
//! ```text
//!   open u > ψ, λ = 0       touching u = ψ, 0 ≤ λ ≤ s       saturated u < ψ, λ = s
//! ```
//! All that are on a wrong side change at once: a semismooth Newton step, as in the reference. s may be negative: then
//! λ = s belongs to u > ψ, and λ = 0 to u < ψ; an infinite end has no side.

/// Where u of a contact edge is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// u > ψ
    Open,
    /// u = ψ
    Touching,
    /// u < ψ
    Saturated,
}

/// The law of contact and the present sides.
#[derive(Debug)]
pub(crate) struct ActiveSet<'a> {
    spans: &'a [f64],
    /// Contact edges of parts that contact alone holds: one of each part always touches.
    parts: Vec<Vec<usize>>,
    pub sides: Vec<Side>,
}

impl<'a> ActiveSet<'a> {
    /// The sides on which `start` is; all touch where it is empty.
    pub fn new(lower: &'a [f64], spans: &'a [f64], parts: Vec<Vec<usize>>, start: &[f64]) -> Self {
        let mut new = Self { spans, parts, sides: vec![Side::Touching; lower.len()] };
        for (at, (&u, &psi)) in start.iter().zip(lower).enumerate() {
            let [least, most] = new.ends(at);
            new.sides[at] = match () {
                () if u > psi && least.is_finite() => Side::Open,
                () if u < psi && most.is_finite() => Side::Saturated,
                () => Side::Touching,
            };
        }
        new.hold(|_| 0.0);
        new
    }

    /// The least and the largest λ.
    fn ends(&self, at: usize) -> [f64; 2] {
        let span = self.spans.get(at).copied().unwrap_or(f64::INFINITY);
        [span.min(0.0), span.max(0.0)]
    }

    /// λ of an edge that does not touch; 0 for one that does.
    pub fn force(&self, at: usize) -> f64 {
        let [least, most] = self.ends(at);
        match self.sides[at] {
            Side::Open => least,
            Side::Touching => 0.0,
            Side::Saturated => most,
        }
    }

    /// The edges that are not on the side where `opening` u − ψ and `force` λ want them, with that side. Neither counts below
    /// its noise; that of λ is the noise of u times `stiffness`.
    pub fn wrong(
        &self,
        noise: f64,
        opening: impl Fn(usize) -> f64,
        force: impl Fn(usize) -> f64,
        stiffness: impl Fn(usize) -> f64,
    ) -> Vec<(usize, Side)> {
        let wanted = |at: usize| match self.sides[at] {
            Side::Open => (opening(at) < -noise).then_some(Side::Touching),
            Side::Saturated => (opening(at) > noise).then_some(Side::Touching),
            Side::Touching => {
                let ([least, most], force) = (self.ends(at), force(at));
                let noise = noise * stiffness(at);
                match () {
                    () if force < least - noise => Some(Side::Open),
                    () if force > most + noise => Some(Side::Saturated),
                    () => None,
                }
            }
        };
        (0..self.sides.len()).filter_map(|at| Some((at, wanted(at)?))).collect()
    }

    /// Brings edges to these sides; `force` says what holds a part that would lose all that touches.
    pub fn change(&mut self, wrong: &[(usize, Side)], force: impl Fn(usize) -> f64) {
        wrong.iter().for_each(|&(at, side)| self.sides[at] = side);
        self.hold(force);
    }

    /// Lets the edge with the largest force touch in each part where none does.
    fn hold(&mut self, force: impl Fn(usize) -> f64) {
        for part in &self.parts {
            if part.iter().all(|&at| self.sides[at] != Side::Touching) {
                let most = part.iter().copied().max_by(|&a, &b| force(a).total_cmp(&force(b)));
                most.into_iter().for_each(|at| self.sides[at] = Side::Touching);
            }
        }
    }

    /// How far λ/K and the opening are from the law, in units of u.
    pub fn violation(&self, at: usize, opening: f64, force: f64, stiffness: f64) -> f64 {
        let [least, most] = self.ends(at).map(|end| end / stiffness);
        let scaled = force / stiffness;
        (scaled - (scaled - opening).clamp(least, most)).abs()
    }
}
