use super::*;
use crate::condense::condense;
use crate::mesh::gmsh;
use crate::problem::Problem;
use crate::scene::Scene;
#[test]
fn probe() {
    for n in [16, 32, 64] {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        let scene =
            Scene::read(&root.join(format!("tests/firmware/peers/contact-{n}.toml"))).unwrap();
        let problem = Problem::new(&scene, gmsh::read(&scene.mesh.value).unwrap()).unwrap();
        let c = condense(&scene, &problem).unwrap();
        let work = Work { pivots: Some(2000), sweeps: 20 };
        let baked = Baked::<f32>::new(&c, work, true).unwrap();
        let mut controller = Controller::new(&baked);
        let mut s: u32 = 0x2545_f491;
        let mut draw = || {
            s ^= s << 13;
            s ^= s >> 17;
            s ^= s << 5;
            ((s >> 8) as i32 - (1 << 23)) as f32 / 8388608.0
        };
        let (mut pivots, mut changes) = (vec![], vec![]);
        let mut old = vec![false; n];
        for _ in 0..1000 {
            let p: Vec<f32> = (1..c.inputs).map(|_| draw()).collect();
            let (_, r) = controller.tick(&p).unwrap();
            let now: Vec<bool> = controller.x().iter().map(|x| *x > 0.0).collect();
            changes.push(now.iter().zip(&old).filter(|(a, b)| a != b).count());
            old = now;
            pivots.push(r.pivots);
        }
        let sum: u32 = pivots.iter().sum();
        let csum: usize = changes.iter().sum();
        pivots.sort();
        changes.sort();
        println!(
            "{n}: pivots {} median {} max {}  changes {} median {} max {}",
            sum, pivots[500], pivots[999], csum, changes[500], changes[999]
        );
    }
}
