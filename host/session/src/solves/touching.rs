//! Contact edges at their gap: which they are in an answer, and where the next solve begins with them.

use signorini_problem::Assembled;
use signorini_problem::scalar::Scalar;

/// Whether each contact edge is at its gap.
pub(super) fn edges<R: Scalar>(assembled: &Assembled<R>, u: &[R]) -> Vec<bool> {
    let on_contact = u[assembled.edges().counts().free..].iter();
    on_contact.zip(assembled.law().edges()).map(|(&u, law)| law.touches(u)).collect()
}

/// Edges that were `active`, at their gap, go with it, but where the way is longer than the range of u: the tolerance may be wider than
/// a short way, and an edge that no sweep brings back to its gap would have no force.
pub(super) fn go_with_gaps<R: Scalar>(assembled: &Assembled<R>, u: &mut [R], active: &[bool]) {
    let [least, most] = u.iter().fold([R::INFINITY, -R::INFINITY], |[least, most], &u| {
        [least.or_smaller(u), most.or_larger(u)]
    });
    let on_contact = u[assembled.edges().counts().free..].iter_mut();
    for ((u, law), &active) in on_contact.zip(assembled.law().edges()).zip(active) {
        if active && law.opening(*u).magnitude() <= most - least {
            *u = law.gap();
        }
    }
}
