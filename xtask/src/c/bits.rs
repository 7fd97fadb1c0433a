//! Every kind of scene on every board, played from C: the lines of the Rust program for the desk, bit for bit.

use std::process::Command;
use std::thread;

use super::package::{Package, machine};
use super::program::play;
use crate::baked::Recipe;
use crate::steps::Steps;
use signorini_image::cargo::root;
use signorini_image::ticks::Ticks;
use signorini_image::toolchain::output;

/// Ticks that must be there.
const TICKS: usize = 101;

const BOARDS: &[&str] = &["m4", "m4-soft", "m7"];
/// For what takes minutes without a unit, or is there for its kind of scene alone.
const ONE: &[&str] = &["m4"];

/// A scene, its scalar, its model, its boards.
///
/// Nothing in contact, edges by exchanges, quads, lengths, limits and modes; then meshes of both kinds of cells, by sweeps and by a
/// factor, with transfer laws, and without a bound.
const PLAYED: [(&str, &str, &str, &[&str]); 11] = [
    ("tests/firmware/scenes/linear.toml", "f32", "--condensed", ONE),
    ("meshes/scenes/levee.toml", "f32", "--condensed", BOARDS),
    ("meshes/scenes/levee.toml", "f64", "--condensed", BOARDS),
    ("meshes/scenes/slab.toml", "f32", "--condensed", BOARDS),
    ("meshes/scenes/slab.toml", "f64", "--condensed", BOARDS),
    ("meshes/scenes/strip.toml", "f32", "--condensed", BOARDS),
    ("meshes/scenes/antiicing.toml", "f32", "--condensed", BOARDS),
    ("tests/firmware/scenes/strip-factored.toml", "f32", "--full", BOARDS),
    ("tests/firmware/scenes/slab-swept.toml", "f32", "--full", ONE),
    ("tests/firmware/scenes/levee-plain.toml", "f32", "--full", ONE),
    ("tests/firmware/scenes/strip-swept.toml", "f64", "--full", BOARDS),
];

/// A step for each scene.
pub fn run(steps: &mut Steps) {
    for (scene, scalar, model, boards) in PLAYED {
        let recipe = Recipe { scalar: Some(scalar.to_owned()), ..Recipe::of(scene, model) };
        let model = model.trim_start_matches('-');
        let name = format!("{} {model} in {scalar}, from C, bit for bit", recipe.scene_name());
        steps.check(&name, || compare(&recipe, boards));
    }
}

/// `Ok` where all boards say from C what the desk says in Rust.
fn compare(recipe: &Recipe, boards: &[&str]) -> Result<(), String> {
    let module = recipe.bake()?.quietly();
    let desk = Ticks::parse(&output(&mut Command::new(module.desk()?))?);
    if desk.count() != TICKS {
        return Err(format!("{} ticks on the desk", desk.count()));
    }
    // Each board has builds of its own: none waits for another.
    let played: Vec<_> = thread::scope(|scope| {
        let start = |&word| (word, scope.spawn(move || on_board(recipe, word)));
        let started: Vec<_> = boards.iter().map(start).collect();
        let panicked = |_| Err("it panicked".to_owned());
        started.into_iter().map(|(word, run)| (word, run.join().unwrap_or_else(panicked))).collect()
    });
    played.into_iter().try_for_each(|(word, played)| {
        let played = played.map_err(|why| format!("{word}: {why}"))?;
        println!("  {word}: {} ticks", played.count());
        played.difference(&desk).map_or(Ok(()), |why| Err(format!("{word}: {why}")))
    })
}

fn on_board(recipe: &Recipe, word: &str) -> Result<Ticks, String> {
    let machine = machine(word)?;
    let board = machine.board.ok_or("the desk is no board")?;
    let package = Package::bake(recipe, machine)?;
    let memory = root().join("tests/firmware/peers/board.ld");
    let image = play(&package, &package.library(), &[], &memory, &board)?;
    Ok(Ticks::parse(&board.run(&image, false)?))
}
