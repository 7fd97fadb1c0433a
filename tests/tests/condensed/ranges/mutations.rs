//! Edges on wrong sides, one at a time: the comparisons must see each of them.

use signorini_condense::CondensedModel;
use signorini_condense::ranges::sides::{EdgeSide, Sides};
use signorini_tests::random::Random;
use signorini_tolerances::cases;

use super::standard::standard;
use super::{Off, Pair, drawn};

/// Samples after which a wrong side that nobody has seen counts as a right one.
const SAMPLES: usize = 400;

/// One edge on another side than it is proved to be on.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Mutation {
    /// The side is another, and the edge is not kept.
    Side(EdgeSide),
    /// An edge that never changes is not kept, though the bound needs it.
    Vertex,
}

/// All wrong sides of an edge of these.
fn mutations(sides: &Sides, at: usize) -> Vec<Mutation> {
    use EdgeSide::{MayChange, Open, Saturated, Touching};
    let other = match sides.of[at] {
        Open => vec![Mutation::Side(Touching)],
        Touching => vec![Mutation::Side(Open)],
        // No edge of these scenes has a limit.
        Saturated => Vec::new(),
        MayChange => vec![Mutation::Side(Open), Mutation::Side(Touching)],
    };
    let is_for_bound = sides.kept[at] && sides.of[at] != MayChange;
    other.into_iter().chain(is_for_bound.then_some(Mutation::Vertex)).collect()
}

fn mutated(sides: &Sides, at: usize, mutation: Mutation) -> Sides {
    let mut sides = sides.clone();
    sides.kept[at] = false;
    if let Mutation::Side(side) = mutation {
        sides.of[at] = side;
    }
    sides
}

/// Whether the comparisons see what is wrong with these sides.
fn is_seen(what: &str, whole: &CondensedModel, sides: Sides) -> bool {
    // A corner or a vertex whose edges are all gone.
    let (is_empty, form) = (!sides.kept.contains(&true), whole.certificate.as_ref());
    if is_empty && form.is_ok_and(|form| !form.corners.is_empty()) {
        return true;
    }
    let Some(pair) = Pair::with(what, whole, sides) else { return true };
    let form = pair.reduced.model.certificate.as_ref();
    if is_empty && form.is_ok_and(|form| !form.vertices.is_empty()) {
        return true;
    }
    let (random, mut off) = (&mut Random::new(3), Off::default());
    (0..SAMPLES).any(|_| {
        let p = drawn(whole, random);
        pair.at_solution(&p, &mut off);
        pair.at(&p, &pair.within(random), &mut off);
        off.is_wrong()
    })
}

/// Of mutations made, those seen, and what the others were.
fn tried(what: &str, whole: &CondensedModel) -> (usize, Vec<String>) {
    let sides = Sides::new(whole).expect("finite loads");
    let (mut seen, mut unseen) = (0, Vec::new());
    for at in 0..whole.contact {
        for mutation in mutations(&sides, at) {
            if is_seen(what, whole, mutated(&sides, at, mutation)) {
                seen += 1;
            } else {
                unseen.push(format!("{what}: {at}, {:?} as {mutation:?}", sides.of[at]));
            }
        }
    }
    (seen, unseen)
}

#[test]
fn every_wrong_side_of_the_standard_scenes_is_seen() {
    for (name, expected) in [("levee", 57), ("slab", 110), ("strip", 72)] {
        let (seen, unseen) = tried(name, &standard(name));
        assert!(unseen.is_empty(), "{unseen:#?}");
        assert_eq!(seen, expected, "{name}");
    }
}

/// Where an edge that may change was never seen to, another side of it may be right; and where e may fall below 0 at a
/// vertex as far as is proved, but does not, the bound needs no edge of it.
#[test]
fn wrong_sides_of_random_scenes_are_seen() {
    let (mut all, mut unseen) = (0, Vec::new());
    for seed in 0..cases(80) {
        let Some(pair) = Pair::random(seed) else { continue };
        let (seen, others) = tried(&pair.what, &pair.whole);
        all += seen + others.len();
        unseen.extend(others);
    }
    let is_doubtful = |of: &String| of.contains("MayChange as") || of.ends_with("as Vertex");
    assert!(unseen.iter().all(is_doubtful) && 50 * unseen.len() < all, "{unseen:#?}");
}
