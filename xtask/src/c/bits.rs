//! Every kind of scene on every board, played from C: the lines of the Rust program for the desk, bit for bit.

use super::program::played;
use crate::modules::{ROWS, Row};
use crate::steps::Steps;

/// Ticks that must be there.
const TICKS: usize = 101;

/// A step for each module: nothing in contact, edges by exchanges, quads, lengths, limits and modes; then meshes of both kinds of
/// cells, by sweeps and by a factor, with transfer laws, and without a bound.
pub fn run(steps: &mut Steps) {
    for row in &ROWS {
        let words = row.c_played.words(steps.is_whole());
        if !words.is_empty() {
            steps.check(&format!("{}, from C, bit for bit", row.name()), || compare(row, &words));
        }
    }
}

/// `Ok` where all boards say from C what the desk says in Rust.
fn compare(row: &Row, words: &[&str]) -> Result<(), String> {
    let desk = row.module()?.on_desk()?;
    if desk.count() != TICKS {
        return Err(format!("{} ticks on the desk", desk.count()));
    }
    words.iter().try_for_each(|word| {
        let package = row.package(word)?;
        let board = package.machine.board.ok_or("the desk is no board")?;
        let played = played(&package, &package.library(), &[], &board);
        let played = played.map_err(|why| format!("{word}: {why}"))?;
        println!("  {word}: {} ticks", played.count());
        played.difference(&desk).map_or(Ok(()), |why| Err(format!("{word}: {why}")))
    })
}
