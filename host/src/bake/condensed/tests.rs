use super::*;
use crate::condense::condense;
use crate::mesh::gmsh;
use crate::problem::Problem;
use crate::scene::Scene;
#[test]
fn probe() {
    for name in [
        "meshes/scenes/pit.toml",
        "meshes/scenes/levee.toml",
        "meshes/scenes/slab.toml",
        "meshes/scenes/strip.toml",
        "tests/firmware/scenes/levee-64.toml",
        "tests/firmware/scenes/levee-96.toml",
    ] {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
        let scene = Scene::read(&root.join(name)).unwrap();
        let problem = Problem::new(&scene, gmsh::read(&scene.mesh.value).unwrap()).unwrap();
        let c = condense(&scene, &problem).unwrap();
        let work = Work { pivots: Some(200), sweeps: 20 };
        let baked = Baked::<f32>::new(&c, work, true).unwrap();
        let mut controller = Controller::new(&baked);
        let p: Vec<f32> = c.defaults[1..].iter().map(|&x| x as f32).collect();
        println!("{name} n {} omega {}", c.contact, baked.sweeps.omega);
        for tick in 0..4 {
            let p: Vec<f32> = p.iter().map(|x| x + 0.01 * tick as f32).collect();
            let (_, r) = controller.tick(&p).unwrap();
            println!(
                "  {:?} pivots {} sweeps {} active {} {:?}",
                r.ended, r.pivots, r.sweeps, r.active, r.certificate
            );
        }
    }
}
