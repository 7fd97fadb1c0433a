//! The largest error bound of a box against the bounds of solutions in it.

use signorini_condense::CondensedModel;
use signorini_condense::ranges::largest::LargestBound;
use signorini_tests::random::Random;
use signorini_tolerances::bake::GUARANTEE;
use signorini_tolerances::{cases, is_whole};

use super::standard::standard;
use super::{drawn, limited};

fn largest(whole: &CondensedModel) -> Option<LargestBound> {
    LargestBound::new(whole).expect("finite loads")
}

/// Asserts that no solution at inputs drawn from the box has a larger bound than what is proved; returns the largest.
fn holds(what: &str, model: &CondensedModel, found: LargestBound, samples: usize) -> f64 {
    let (random, mut most) = (&mut Random::new(3), 0.0_f64);
    for _ in 0..samples {
        let p = drawn(model, random);
        let bound = model.bound(&p, &model.solve(&p).expect("a solution")).expect("a bound");
        GUARANTEE.check_at_most(what, bound, found.proved);
        most = most.max(bound);
    }
    most
}

#[test]
fn no_random_scene_exceeds_what_is_proved() {
    let (mut sharp, mut wide, mut refused) = (0, 0, 0);
    for seed in 0..cases(120) {
        let Some((what, whole)) = limited(seed) else { continue };
        let Some(found) = largest(&whole) else {
            refused += 1;
            continue;
        };
        holds(&what, &whole, found, 40);
        *if found.is_sharp() { &mut sharp } else { &mut wide } += 1;
    }
    assert!(sharp >= cases(40) && (refused > 0 || !is_whole()), "{sharp} {wide} {refused}");
}

/// Positive entries of the strip's matrix leave its enclosure wide, however small the pieces are.
#[test]
fn standard_scenes_are_proved_near_what_is_reached() {
    for (name, within) in [("levee", 1.1), ("slab", 1.1), ("strip", 1.3), ("pit", 1.1)] {
        let whole = standard(name);
        let found = largest(&whole).expect("a proof");
        holds(name, &whole, found, 1000);
        assert!(found.proved <= within * found.reached && found.is_sharp(), "{name}: {found:?}");
        assert!(found.pieces <= 256 && found.reached <= found.proved, "{name}: {found:?}");
    }
}

/// A wide range in few pieces: the limit is there, and said not to be near.
#[test]
fn what_is_not_near_is_not_called_sharp() {
    let mut whole = standard("slab");
    whole.ranges[1] = [-200.0, 200.0];
    let found = largest(&whole).expect("a proof");
    let seen = holds("wide", &whole, found, 200);
    assert!(seen <= found.proved, "{found:?}");
    let blunt = LargestBound { proved: 2.1 * found.reached, ..found };
    assert!(!blunt.is_sharp());
}

#[test]
fn without_proof_there_is_none() {
    assert_eq!(largest(&standard("membrane")), None, "contact alone holds it");
    let mut whole = standard("levee");
    whole.ranges[2] = [f64::NEG_INFINITY, f64::INFINITY];
    assert_eq!(largest(&whole), None, "an input without a range");
    let mut whole = standard("levee");
    whole.certificate = Err("none".to_owned());
    assert_eq!(largest(&whole), None, "no bound");
}
