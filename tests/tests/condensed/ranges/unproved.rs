//! Random scenes whose inputs have random ranges agree; where nothing is proved, nothing is taken out.

use signorini_condense::CondensedModel;
use signorini_condense::ranges::reduced::Reduced;
use signorini_condense::ranges::sides::{EdgeSide, Sides};
use signorini_tests::random::Random;
use signorini_tolerances::cases;

use super::standard::standard;
use super::{Pair, limited};

fn keeps_all(what: &str, whole: &CondensedModel) {
    let sides = Sides::new(whole).expect("finite loads");
    assert_eq!(sides.count(EdgeSide::MayChange), whole.contact, "{what}");
    assert!(sides.kept.iter().all(|&kept| kept), "{what}");
    assert!(sides.limits.iter().all(|&limits| limits == [0.0, f64::INFINITY]), "{what}");
    assert!(Reduced::new(whole, sides).is_none(), "{what}");
}

#[test]
fn what_contact_alone_holds_is_kept() {
    let mut whole = standard("membrane");
    assert!(!whole.held_by_contact.is_empty());
    keeps_all("membrane", &whole);
    // Rounding may make a singular matrix a definite one: it proves no more then.
    let n = whole.contact;
    (0..n).for_each(|i| whole.matrix[i * n + i] += 1e-9);
    keeps_all("membrane, rounded", &whole);
}

#[test]
fn an_input_without_a_range_keeps_all() {
    for name in ["levee", "slab", "strip"] {
        let whole = standard(name);
        let without = [f64::NEG_INFINITY, f64::INFINITY];
        for range in [without, [without[0], 0.0], [0.0, without[1]]] {
            let mut whole = whole.clone();
            *whole.ranges.last_mut().expect("an input") = range;
            keeps_all(name, &whole);
        }
    }
}

/// Loads that are in range, and answers that are not.
#[test]
fn ranges_that_overflow_keep_all() {
    for name in ["levee", "slab", "strip"] {
        for most in [1e300, 1e308, f64::MAX] {
            let mut whole = standard(name);
            whole.ranges.iter_mut().skip(1).for_each(|range| *range = [-most, most]);
            let Ok(sides) = Sides::new(&whole) else { continue };
            assert_eq!(sides.count(EdgeSide::Open) + sides.count(EdgeSide::Touching), 0, "{name}");
        }
    }
}

/// Scenes to draw.
const SEEDS: u64 = 400;
/// Samples of each that has edges to take out, solutions and others each.
const SAMPLES: usize = 40;

/// Oblique tensors make entries positive: some of these scenes are proved all the same, and right.
#[test]
fn random_scenes_agree() {
    let (mut pairs, mut empty, mut pushed, mut refused) = (0, 0, 0, 0);
    let count = cases(SEEDS);
    for seed in 0..count {
        let Some((what, whole)) = limited(seed) else { continue };
        let n = whole.contact;
        let is_off = |at: usize| at / n != at % n && whole.matrix[at] > 1e-6;
        let pushes = u64::from((0..n * n).any(is_off));
        let Some(pair) = Pair::new(&what, &whole) else {
            refused += pushes;
            continue;
        };
        (pairs, pushed) = (pairs + 1, pushed + pushes);
        empty += u64::from(pair.reduced.model.contact == 0);
        pair.sampled(SAMPLES, &mut Random::new(seed)).check(&what);
    }
    assert!(pairs > count / 3 && empty > count / 40, "{pairs} {empty}");
    assert!(pushed > cases(10) && refused > cases(10), "{pushed} {refused}");
}
