//! The standard scenes: how many edges change, and 10 000 ticks each.

use std::sync::LazyLock;

use signorini_condense::ranges::sides::{EdgeSide, Sides};
use signorini_condense::{CondensedModel, condense};
use signorini_tests::random::Random;

use super::{Off, Pair, drawn};
use crate::standard::{SCENES, standard as scene};

/// Samples of each scene: half of them solutions.
const TICKS: usize = 10_000;

/// The condensed model of a standard scene.
pub fn standard(name: &str) -> CondensedModel {
    static ALL: LazyLock<[CondensedModel; 5]> =
        LazyLock::new(|| SCENES.map(|name| condense(&scene(name)).expect("a condensed model")));
    let at = SCENES.iter().position(|other| *other == name).expect("a standard scene");
    ALL[at].clone()
}

/// The standard scenes of which something can be taken out.
pub fn pairs() -> &'static [Pair] {
    static ALL: LazyLock<Vec<Pair>> = LazyLock::new(|| {
        let pair = |name: &&str| Pair::new(name, &standard(name)).expect("edges to take out");
        SCENES[..3].iter().map(pair).collect()
    });
    &ALL
}

/// The bound is why some edges are kept that never change.
#[test]
fn few_edges_change_sides() {
    let counts = SCENES.map(|name| {
        let whole = standard(name);
        let sides = Sides::new(&whole).expect("finite loads");
        let [open, touching, may_change] =
            [EdgeSide::Open, EdgeSide::Touching, EdgeSide::MayChange].map(|of| sides.count(of));
        let kept = sides.kept.iter().filter(|&&kept| kept).count();
        format!("{name:9}{:5}{open:5}{touching:9}{may_change:11}{kept:5}", whole.contact)
    });
    let expected = "\
scene    edges open touching may change kept
levee       50   26       18          6    7
slab        82   12       44         26   28
strip       64   56        2          6    8
membrane    48    0        0         48   48
pit         65   61        4          0    0";
    let header = "scene    edges open touching may change kept";
    let found = [&[header.to_owned()], &counts[..]].concat().join("\n");
    assert_eq!(found, expected, "{found}");
}

#[test]
fn the_levee_agrees() {
    agrees(&pairs()[0], 6);
}

#[test]
fn the_slab_agrees() {
    agrees(&pairs()[1], 26);
}

/// Positive entries of its matrix widen the enclosure: two edges that may change never do.
#[test]
fn the_strip_agrees() {
    agrees(&pairs()[2], 4);
}

/// So many edges are seen on both sides.
fn agrees(pair: &Pair, seen_to_change: usize) {
    let (random, mut off) = (&mut Random::new(1), Off::default());
    let mut seen = vec![[false; 2]; pair.whole.contact];
    for _ in 0..TICKS / 2 {
        let p = drawn(&pair.whole, random);
        let x = pair.at_solution(&p, &mut off);
        pair.at(&p, &pair.within(random), &mut off);
        seen.iter_mut().zip(x).for_each(|(seen, x)| seen[usize::from(x > 0.0)] = true);
    }
    off.check(&pair.what);
    let changed = seen.iter().filter(|seen| seen.iter().all(|&side| side)).count();
    assert_eq!(off.samples, TICKS);
    assert_eq!(changed, seen_to_change, "{}", pair.what);
}
