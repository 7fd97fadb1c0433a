//! C programs around a controller, compiled by GCC and run on a board or on the desk; first of all the one that plays every kind
//! of scene on every board, to the lines of the Rust program for the desk, bit for bit.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::package::{Package, folder};
use crate::modules::{Row, rows};
use crate::steps::Steps;
use signorini_image::board::{Board, M4F_192K};
use signorini_image::cargo::root;
use signorini_image::ticks::Ticks;
use signorini_image::toolchain::output;

/// All warnings that C programs of this repository and the headers of controllers are free of.
pub const WARNINGS: [&str; 8] = [
    "-Wall",
    "-Wextra",
    "-Wpedantic",
    "-Wundef",
    "-Wshadow",
    "-Wconversion",
    "-Wcast-align",
    "-Werror",
];

/// Products and sums are rounded one by one, as in Rust; what is not called is left out.
const CODE: [&str; 5] =
    ["-std=c99", "-O2", "-ffp-contract=off", "-ffunction-sections", "-fdata-sections"];

/// The program that plays the ticks.
const PLAY: [&str; 3] = ["play.c", "journal.c", "loads.c"];

/// The ticks that a package plays on a board, with its own library or another one; every instruction is counted on the board that
/// counts to the instruction.
pub fn played(
    package: &Package,
    library: &Path,
    defines: &[&str],
    board: &Board,
) -> Result<Ticks, String> {
    let is_counted = board.machine == M4F_192K.machine;
    let peers = root().join("tests/firmware/peers");
    let memory = match sources().join(format!("{}.ld", board.machine)) {
        own if own.is_file() => own,
        _ => peers.join("board.ld"),
    };
    let made = package.folder.join(format!("play{}.elf", defines.concat()));
    let support = folder().join(format!("board-{}.o", package.machine.word));
    let mut compile = Command::new("arm-none-eabi-gcc");
    compile.args(package.machine.flags).args(["-O2", "-ffunction-sections", "-c"]);
    output(compile.arg(peers.join("board.c")).arg("-o").arg(&support))?;
    let mut link = Command::new("arm-none-eabi-gcc");
    link.args(package.machine.flags).args(CODE).args(WARNINGS).arg("-Wstrict-prototypes");
    link.args(defines).args(package.defines()?).arg("-I").arg(&peers);
    link.args(PLAY.map(|source| sources().join(source))).arg(&support).arg(library);
    link.args(["-nostartfiles", "-Wl,--gc-sections,-z,noexecstack,--no-warn-rwx-segments", "-T"]);
    output(link.arg(memory).arg("-o").arg(&made))
        .map_err(|why| format!("{}: {why}", board.name))?;
    Ok(Ticks::parse(&board.run(&made, is_counted)?))
}

/// Has CMake prepare the programs of `source` in an empty folder.
pub fn configure(source: &Path, build: &Path, defines: &[String]) -> Result<(), String> {
    let _ = fs::remove_dir_all(build);
    let mut cmake = Command::new("cmake");
    output(cmake.arg("-S").arg(source).arg("-B").arg(build).args(defines)).map(drop)
}

/// The folder of the C programs.
pub fn sources() -> PathBuf {
    root().join("tests/firmware/c")
}

/// Ticks that must be there.
const TICKS: usize = 101;

/// A step for each module: nothing in contact, edges by exchanges, quads, lengths, limits and modes; then meshes of both kinds of
/// cells, by sweeps and by a factor, with transfer laws, and without a bound.
pub fn run(steps: &mut Steps) {
    let is_whole = steps.is_whole();
    for row in rows(is_whole) {
        let words = row.c_played.words(is_whole);
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
