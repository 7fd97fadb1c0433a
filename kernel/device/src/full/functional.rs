//! Outputs: numbers read off an answer.

use super::pattern::Contribution;
use crate::tick::{Data, Report, Tick};
use signorini_kernel::index::{Index, read};
use signorini_kernel::mesh::edges::EdgeCounts;
use signorini_kernel::{Real, features};

/// What an output measures (borrowed).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Functional<'a, R, I> {
    /// ∫τ·n over these edges, within the law of contact on those that are in contact.
    Flux(&'a [I]),
    /// ∫(τ·n − q) ≥ 0 over these contact edges, counted from the first one; τ within the law of contact.
    Force(&'a [I]),
    /// The length of those of these contact edges that are active, with the length of each.
    Length(&'a [Contribution<R, I>]),
    /// The length of those of these contact edges whose flux is at its limit, with the length of each.
    Saturated(&'a [Contribution<R, I>]),
    /// u at a point: a sum over edges, with the weight of each.
    Probe(&'a [Contribution<R, I>]),
    /// The error bound; infinite where there is none.
    Bound,
}

/// What outputs are read off.
pub(super) struct TickState<'t, 'a, R: Real, I, const WIDTH: usize> {
    pub tick: &'t Tick<'a, R, I, WIDTH>,
    pub data: &'t Data<'a, R, I>,
    pub report: &'t Report<R>,
}

impl<R: Real, I: Index> Functional<'_, R, I> {
    pub(super) fn of<const WIDTH: usize>(&self, answer: &TickState<R, I, WIDTH>) -> R {
        let TickState { tick, data, report } = answer;
        let (u, tau, law) = (tick.u(), tick.tau(), data.law);
        let EdgeCounts { free, contact, .. } = tick.counts();
        let range = |at: usize| data.given.boundary.contact_flux(at);
        // Without a certificate τ is the flux (15) still.
        let pressed = |at: usize| {
            let (u, tau) = (read(u, free + at), read(tau, free + at));
            law.on(at).flux(u, tau, range(at))
        };
        match *self {
            Self::Flux(edges) => edges.iter().fold(R::ZERO, |sum, edge| {
                sum + match edge.at().checked_sub(free) {
                    Some(at) if features::CONTACT && at < contact => pressed(at),
                    _ => read(tau, edge.at()),
                }
            }),
            Self::Force(edges) if features::CONTACT => edges
                .iter()
                .fold(R::ZERO, |sum, at| sum + range(at.at()).multiplier(pressed(at.at()))),
            Self::Length(shares) if features::CONTACT => sum(shares, |at, length| {
                let touches = law.on(at).touches(read(u, free + at));
                if touches { length } else { R::ZERO }
            }),
            Self::Saturated(shares) if features::LIMITED => sum(shares, |at, length| {
                let at_limit = law.on(at).is_saturated(read(u, free + at));
                if at_limit { length } else { R::ZERO }
            }),
            Self::Force(_) | Self::Length(_) | Self::Saturated(_) => R::ZERO,
            Self::Probe(shares) => sum(shares, |at, weight| weight * read(u, at)),
            Self::Bound => match report.verdict.certificate() {
                Some(certificate) => certificate.total,
                None => R::ONE / R::ZERO,
            },
        }
    }
}

fn sum<R: Real, I: Index>(shares: &[Contribution<R, I>], take: impl Fn(usize, R) -> R) -> R {
    shares.iter().fold(R::ZERO, |sum, share| sum + take(share.at.at(), share.weight))
}
