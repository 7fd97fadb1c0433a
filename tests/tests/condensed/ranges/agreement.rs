//! Random scenes whose inputs have random ranges.

use signorini_tests::random::Random;

use super::Pair;

/// Scenes to draw.
const SEEDS: u64 = 400;
/// Samples of each that has edges to take out, solutions and others each.
const SAMPLES: usize = 40;

#[test]
fn random_scenes_agree() {
    let (mut pairs, mut empty) = (0, 0);
    let count = std::env::var("SEEDS").ok().and_then(|n| n.parse().ok()).unwrap_or(SEEDS);
    for seed in 0..count {
        let Some(pair) = Pair::random(seed) else { continue };
        pairs += 1;
        empty += u64::from(pair.reduced.model.contact == 0);
        pair.sampled(SAMPLES, &mut Random::new(seed)).check(&pair.what);
    }
    assert!(pairs > count / 3 && empty > count / 40, "{pairs} {empty}");
}
