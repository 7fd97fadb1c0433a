//! What never changes sides is taken out of a condensed model, and nothing else: against the whole model.

use std::path::Path;

use signorini_scene::mesh::gmsh;
use signorini_scene::scene::Scene;
use signorini_solve::condense::{CondensedModel, condense};
use signorini_solve::problem::Problem;
use signorini_solve::ranges::reduced::Reduced;
use signorini_solve::ranges::sides::{EdgeSide, Sides};
use signorini_tests::random::Random;

fn standard(name: &str) -> CondensedModel {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../meshes/scenes");
    let scene = Scene::read(&folder.join(format!("{name}.toml"))).expect("a scene");
    let mesh = gmsh::read(&scene.mesh.value).expect("a mesh");
    condense(&Problem::new(&scene, mesh).expect("a problem")).expect("a condensed model")
}

#[test]
fn look() {
    for name in ["levee", "slab", "strip", "membrane"] {
        let whole = standard(name);
        let sides = Sides::new(&whole).unwrap();
        let count = |side| sides.count(side);
        println!(
            "{name}: n {} open {} touching {} may change {}; kept {}",
            whole.contact,
            count(EdgeSide::Open),
            count(EdgeSide::Touching),
            count(EdgeSide::MayChange),
            sides.kept.iter().filter(|c| **c).count()
        );
        if name == "strip" {
            let e = sides.enclosure.as_ref().unwrap();
            for i in 24..40 {
                println!(
                    "{i} {:?} kept {} lo {:.3e} hi {:.3e} r {:.3e}",
                    sides.of[i], sides.kept[i], e.lo[i], e.hi[i], e.reaction[i]
                );
            }
            for row in 28..36 {
                println!(
                    "{:?}",
                    whole.matrix[row * 64 + 28..row * 64 + 36]
                        .iter()
                        .map(|x| (x * 1e4).round() / 1e4)
                        .collect::<Vec<_>>()
                );
            }
        }
        let Some(reduced) = Reduced::new(&whole, sides) else { continue };
        let mut random = Random::new(1);
        let mut worst = [0.0_f64; 4];
        for _ in 0..1000 {
            let p: Vec<f64> = whole
                .ranges
                .iter()
                .map(|[lo, hi]| lo + (hi - lo) * f64::from(random.below(1 << 16)) / 65535.0)
                .collect();
            let x = whole.solve(&p).unwrap();
            let y = reduced.model.solve(&p).unwrap();
            let z = reduced.expand(&p, &y);
            let size = x.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            for (x, z) in x.iter().zip(&z) {
                worst[0] = worst[0].max((x - z).abs() / size);
            }
            for (a, b) in whole.outputs(&p, &x).iter().zip(reduced.model.outputs(&p, &y)) {
                let (a, b) = (a.unwrap(), b.unwrap());
                worst[1] = worst[1].max((a - b).abs() / a.abs().max(1e-3));
            }
            let (a, b) = (whole.bound(&p, &x).unwrap(), reduced.model.bound(&p, &y).unwrap());
            worst[2] = worst[2].max((a / b - 1.0).abs());
            let (a, b) =
                (whole.bound_of_u(&p, &x).unwrap(), reduced.model.bound_of_u(&p, &y).unwrap());
            worst[3] = worst[3].max((a / b - 1.0).abs());
        }
        println!("{name}: {worst:?}");
    }
}
