//! Terms of the boundary in the bound: contact, transfer laws, curved data.

use super::extension::{Curved, extension, is_clear, jump, of_means, of_s};
use super::parts::Parts;
pub(super) use super::transfer::Transfer;
use super::{Continuous, Discretization, LoadCase};
use crate::equilibrium::Iterate;
use signorini_kernel::excess::Excess;
use signorini_kernel::flux_range::FluxRange;
use signorini_kernel::index::{Index, read};
use signorini_kernel::law::Law;
use signorini_kernel::mesh::boundary::Robin;
use signorini_kernel::mesh::edges::Side;
use signorini_kernel::{Real, features};

/// Adds it all to the sums and to the indicators of the cells, but for the [`perturbation`] of the data. Returns the sum of the
/// terms of contact; `along` is told of each transfer law its number, the vertices of its edge, and what it adds to a [`Distance`](super::parts::Distance).
#[inline(always)]
pub(super) fn add<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    given: &LoadCase<R, I>,
    Iterate { u, law: contact }: Iterate<R>,
    (s, tau): (Continuous<R>, &[R]),
    indicators: &mut [R],
    parts: &mut Parts<R>,
    mut along: impl FnMut((usize, &Robin<R, I>), [I; 2], [R; 2]),
) -> R {
    let edges = &discretization.edges;
    let counts = edges.counts();
    let mut take = |parts: &mut Parts<R>, edge: usize, term: R, terms: R| {
        parts.gap.add(term);
        parts.direct += R::from_count(8) * R::EPSILON * terms;
        if !features::INDICATORS {
            return;
        }
        let cell = edges.cell_of(read(edges.half_edges(), edge)[0].at());
        if let Some(indicator) = cell.and_then(|cell| indicators.get_mut(cell)) {
            *indicator += term;
        }
    };
    let mut of_contact = R::ZERO;
    let gap = if features::CONTACT { given.ends.gap } else { &[] };
    for at in 0..gap.len() {
        let (term, terms) = contact_term(discretization, given, contact, (s, tau), at);
        take(parts, counts.free + at, term, terms);
        of_contact += term;
    }
    let mut moved = R::ZERO;
    let laws = if features::ROBIN { given.boundary.robin() } else { &[] };
    for (at, law) in laws.iter().enumerate() {
        let edge = law.edge.at();
        let vertices = edges.endpoints(&discretization.mesh, edge);
        let transfer =
            Transfer { flux: read(tau, edge), s: s.at(&vertices), bubble: read(s.bubbles, edge) };
        let [term, terms, open] = of_transfer(given, (at, law), &transfer);
        take(parts, edge, term, terms);
        along((at, law), vertices, [term, open]);
        if features::PIECES {
            parts.open += open;
        }
        moved += transfer.moved(law.coefficient, law.ambient);
        if law.coefficient > R::ZERO {
            let of_u = law.ambient - law.coefficient * read(u, edge);
            let off = read(tau, edge) - of_u;
            parts.algebraic += off * off / law.coefficient;
        }
    }
    parts.perturbation += moved;
    let curved = if features::CURVED { given.curved } else { &[] };
    for curved in curved {
        let edge = curved.edge.at();
        if let Some((term, terms)) = cleared(discretization, given, contact, (s, tau), curved) {
            take(parts, edge, term, terms);
            continue;
        }
        let in_cell = of_s(discretization, given, s, edge);
        let (term, terms) = extension(&in_cell, tau, curved);
        take(parts, edge, term, terms);
        jump(&in_cell, of_means(discretization, u, edge).as_ref(), curved, parts);
    }
    of_contact
}

/// The term of the transfer law `at`, the size of its terms, and the square of what is beyond it.
#[inline(always)]
pub(super) fn of_transfer<R: Real, I: Index>(
    given: &LoadCase<R, I>,
    (at, law): (usize, &Robin<R, I>),
    transfer: &Transfer<R>,
) -> [R; 3] {
    let forms = if features::PIECES { given.forms.first() } else { None };
    let by_form = forms.and_then(|forms| transfer.by_form(forms, at));
    match (by_form, given.transfer.get(at)) {
        (Some(known), _) => known,
        (None, Some(points)) => [transfer.at_points(points), R::ZERO, R::ZERO],
        (None, None) => [transfer.constant(law.coefficient, law.ambient), R::ZERO, R::ZERO],
    }
}

/// The term of contact edge `at`, counted from the first one, and the size of its terms.
#[inline(always)]
fn contact_term<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    given: &LoadCase<R, I>,
    contact: Law<R>,
    (s, tau): (Continuous<R>, &[R]),
    at: usize,
) -> (R, R) {
    let edge = discretization.edges.counts().free + at;
    let means = opening(discretization, given, contact, s, at);
    charge(given.boundary.contact_flux(at), contact, read(tau, edge), means)
}

/// The means of (s − ψ)⁺ and (ψ − s)⁺ along contact edge `at`; without limits that of s − ψ, and 0.
#[inline(always)]
pub(super) fn opening<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    given: &LoadCase<R, I>,
    contact: Law<R>,
    s: Continuous<R>,
    at: usize,
) -> [R; 2] {
    let edge = discretization.edges.counts().free + at;
    let ([a, b], gap) = (ends(discretization, s, edge), read(given.ends.gap, at));
    let excess = Excess { ends: [a - gap[0], b - gap[1]], bubble: read(s.bubbles, edge) };
    if contact.is_limited() { excess.sides() } else { [excess.mean(), R::ZERO] }
}

/// 2∫(s − ψ)⁺(τ·n − lo) + (ψ − s)⁺(hi − τ·n) along an edge for these means of both parts of s − ψ, and the size of its terms.
#[inline(always)]
pub(super) fn charge<R: Real>(
    range: FluxRange<R>,
    contact: Law<R>,
    tau: R,
    [above, below]: [R; 2],
) -> (R, R) {
    if !contact.is_limited() {
        let (above, terms) = (R::TWO * above, tau.magnitude() + range.base().magnitude());
        return (range.multiplier(tau) * above, terms * above.magnitude());
    }
    let (mut sum, mut size) = (R::ZERO, R::ZERO);
    for (end, mean) in range.ends().into_iter().zip([above, below]) {
        // On a side that there is not, s is but for rounding, which stands elsewhere.
        if end.finite() {
            let (mean, terms) = (R::TWO * mean, tau.magnitude() + end.magnitude());
            let distance = (tau - end).magnitude();
            let unseen = range.unseen(distance, contact.spans().excess());
            sum += (distance + unseen) * mean;
            size += terms * mean.magnitude();
        }
    }
    (sum, size)
}

/// Change of the contact term on an edge where s has no extension, so that s − ψ is less by w, and the size of its terms;
/// nothing where s has one.
fn cleared<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    given: &LoadCase<R, I>,
    contact: Law<R>,
    (s, tau): (Continuous<R>, &[R]),
    curved: &Curved<R, I>,
) -> Option<(R, R)> {
    let edge = curved.edge.at();
    let at = edge.checked_sub(discretization.edges.counts().free)?;
    let gap = if features::CONTACT { given.ends.gap.get(at)? } else { return None };
    let [a, b] = ends(discretization, s, edge);
    let excess = [a - gap[0], b - gap[1]];
    let means = match excess[0] > R::ZERO {
        true => [-curved.mean, R::ZERO],
        false => [R::ZERO, curved.mean],
    };
    let range = given.boundary.contact_flux(at);
    is_clear(excess, curved.peak).then(|| charge(range, contact, read(tau, edge), means))
}

pub(super) fn ends<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    s: Continuous<R>,
    edge: usize,
) -> [R; 2] {
    s.at(&discretization.edges.endpoints(&discretization.mesh, edge))
}

/// The square of what storing u_D and ψ in this scalar can do: each value moves by ε|value|, and the
/// perturbation's energy in the cells along the boundary is at most 4Σ|K| for each square. Where u_D lies below ψ, which only
/// rounding may do, s does as well, and ψ moves by what is missing.
#[inline(always)]
pub(super) fn perturbation<R: Real, I: Index>(
    discretization: &Discretization<R, I>,
    given: &LoadCase<R, I>,
    contact: Law<R>,
    s: Continuous<R>,
) -> R {
    let (edges, k) = (&discretization.edges, discretization.stiffness);
    let size = |entries: &[R]| entries.iter().fold(R::ZERO, |sum, k| sum + k.magnitude());
    let pairs = given.ends.gap.iter().chain(given.ends.given).enumerate();
    // More is no rounding, and there is no bound: it must not end a tick as if all but rounding were done.
    let slack = given.ends.slack();
    pairs.fold(R::ZERO, |sum, (at, pair)| {
        let value = pair[0].magnitude().or_larger(pair[1].magnitude());
        let (edge, mut moved) = (edges.counts().free + at, R::TWO * R::EPSILON * value);
        if features::CONTACT && at < given.ends.gap.len() {
            let [a, b] = ends(discretization, s, edge);
            let depth = |value, psi| contact.on(at).depth_at(value, psi);
            let missing = depth(a, pair[0]).or_larger(depth(b, pair[1])).or_larger(R::ZERO);
            moved += if missing <= slack { missing } else { R::ZERO };
        }
        let of_cell = match edges.first_side(edge) {
            Side::Triangle(cell, _) => size(&read(k.triangles, cell)),
            Side::Quad(cell, _) => size(&read(k.quads, cell)),
        };
        sum + R::from_count(4) * of_cell * moved * moved
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_kernel::flux_range::{Span, Spans};

    fn charged(span: f64, excess: f64, tau: f64, means: [f64; 2]) -> f64 {
        let lengths = [span];
        let spans = Spans::new(&lengths).unwrap_or(Spans::UNLIMITED).varying(excess);
        let law = Law::above(&[0.0]).with_spans(spans);
        charge(FluxRange::new(1.0, Span::new(span)), law, tau, means).0
    }

    #[test]
    fn either_side_is_charged_for_its_own_end_and_less_s_less_of_it() {
        // lo = 1, hi = 3.
        assert_eq!(charged(2.0, 0.0, 1.5, [0.25, 0.0]), 0.25);
        assert_eq!(charged(2.0, 0.0, 1.5, [0.0, 0.25]), 0.75);
        assert_eq!(charged(2.0, 0.0, 1.5, [-0.25, 0.0]), -0.25);
        assert_eq!(charged(2.0, 0.0, 1.5, [0.25, 0.25]), 1.0);
        // Where hi − lo varies, each by its share of the largest one: 2.5 instead of 2.
        assert_eq!(charged(2.0, 0.5, 1.5, [0.25, 0.0]), 0.3125);
        assert_eq!(charged(2.0, 0.5, 1.5, [0.0, 0.25]), 0.9375);
        assert_eq!(charged(2.0, 0.5, 1.0, [0.25, 0.0]), 0.0);
        // An edge that lets nothing vary, beside others on which hi − lo does.
        assert_eq!(charged(0.0, 0.5, 1.0, [0.25, 0.25]), 0.0);
        assert_eq!(charged(f64::INFINITY, 0.0, 1.5, [0.25, 0.0]), 0.25);
    }
}
