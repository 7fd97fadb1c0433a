//! The standard scenes: how many edges change, and 10 000 ticks each.

use std::path::Path;

use signorini_condense::ranges::sides::{EdgeSide, Sides};
use signorini_condense::{CondensedModel, condense};
use signorini_problem::Problem;
use signorini_scene::mesh;
use signorini_scene::scene::Scene;
use signorini_tests::random::Random;

use super::{Off, Pair, drawn};

/// Samples of each scene: half of them solutions.
const TICKS: usize = 10_000;

pub fn standard(name: &str) -> CondensedModel {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../meshes/scenes");
    let scene = Scene::read(&folder.join(format!("{name}.toml"))).expect("a scene");
    let mesh = mesh::read(&scene.mesh.value).expect("a mesh");
    condense(&Problem::new(&scene, mesh).expect("a problem")).expect("a condensed model")
}

/// The bound is why some edges are kept that never change. The membrane is held by contact alone, the pit has no inputs.
#[test]
fn few_edges_change_sides() {
    let counts = ["levee", "slab", "strip", "membrane", "pit"].map(|name| {
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
    agrees("levee", 6);
}

#[test]
fn the_slab_agrees() {
    agrees("slab", 26);
}

/// Positive entries of its matrix widen the enclosure: two edges that may change never do.
#[test]
fn the_strip_agrees() {
    agrees("strip", 4);
}

/// So many edges are seen on both sides.
fn agrees(name: &str, seen_to_change: usize) {
    let pair = Pair::new(name, &standard(name)).expect("edges to take out");
    let (random, mut off) = (&mut Random::new(1), Off::default());
    let mut seen = vec![[false; 2]; pair.whole.contact];
    for _ in 0..TICKS / 2 {
        let p = drawn(&pair.whole, random);
        pair.at_solution(&p, &mut off);
        pair.at(&p, &pair.within(random), &mut off);
        let x = pair.whole.solve(&p).expect("a solution");
        seen.iter_mut().zip(x).for_each(|(seen, x)| seen[usize::from(x > 0.0)] = true);
    }
    off.check(name);
    let changed = seen.iter().filter(|seen| seen.iter().all(|&side| side)).count();
    assert_eq!(off.samples, TICKS);
    assert_eq!(changed, seen_to_change, "{name}");
}
