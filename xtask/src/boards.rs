//! `cargo xtask boards`: the images on emulated boards, bit for bit as on the desk.
//!
//! What the program `desk` prints on this machine stands in `tests/firmware/expected`, with decimal
//! numbers beside the bits; every board must print the same.

use std::path::Path;
use std::process::Command;

use crate::export::{scenes, stages};
use crate::flight;
use crate::replay;
use crate::setup;
use crate::snapshot::snapshot;
use crate::steps::Steps;
use signorini_image::board::{Board, Build, M4, M4F, M4F_192K, M7, M33};
use signorini_image::cargo::{cargo, root, run as run_cargo, target_dir};
use signorini_image::toolchain::output;

const STAGES: [&str; 5] = ["elements", "assembly", "sweeps", "flux", "scenes"];
/// Runs with subnormal numbers flushed to zero on the cores that can; the desk flushes nothing.
const FLUSHED: &str = "flushed";
const TICKS: [&str; 4] = ["tick_linear", "tick_triangles", "tick_quads", "tick_mixed"];

/// Bytes of stack that a tick may use, assembly and recovery of the flux included.
const STACK: u32 = 512;

/// All images on all boards.
pub fn run(steps: &mut Steps) {
    setup::run(steps);
    let bless = steps.blesses();
    steps.check("the stages on the desk", build_desk);
    for name in STAGES.into_iter().chain(TICKS).chain([FLUSHED]) {
        steps.check(&format!("{name} as recorded"), || {
            snapshot(&format!("tests/firmware/expected/{name}.txt"), &readable(&desk(name)?), bless)
        });
    }
    steps.check("signorini solve says the same", || replay::compare(&desk("scenes")?));
    on_board(steps, &M4F, &STAGES);
    // The core without a unit has a stage, and all of them in a whole run, as the other cores.
    on_board(steps, &M4, if steps.is_whole() { &STAGES } else { &["flux"] });
    on_board(steps, &M4F, &[FLUSHED]);
    if steps.is_whole() {
        on_board(steps, &M7, &STAGES);
        on_board(steps, &M7, &[FLUSHED]);
        on_board(steps, &M33, &STAGES);
    }
    on_board(steps, &M4F_192K, &TICKS);
    steps.check("RTIC example: no missed deadline", || match rtic(&[])? {
        said if said.contains("\ncut 0\n") => Err("no deadline was ever tight".to_owned()),
        _ => Ok(()),
    });
    steps.check("RTIC example: a flight of the baked anti-icing slab", || flight::check(bless));
    if steps.is_whole() {
        steps.check("RTIC example: overload is noticed", || match rtic(&["overload"]) {
            Ok(_) => Err("not noticed".to_owned()),
            Err(said) if said.contains("\nmisses 10000\n") => Ok(()),
            Err(said) => Err(format!("failed for another reason: {said}")),
        });
        steps.check("the cost image fits a part with 192 KiB", || {
            M4F_192K.run(&stages(&M4F_192K, &["cost"], &[])?.join("cost"), true).map(drop)
        });
    }
}

fn build_desk() -> Result<(), String> {
    let mut command = cargo(&["build", "--profile", "desk", "--locked", "--features", "desk"]);
    command.args(["-p", "signorini-firmware", "--bin", "desk", "--target-dir"]);
    command.arg(target_dir("desk")).env("SIGNORINI_SCENES", scenes()?);
    command.current_dir(root().join("tests/firmware"));
    run_cargo(command)
}

fn desk(name: &str) -> Result<String, String> {
    output(Command::new(target_dir("desk").join("desk/desk")).arg(name))
}

fn on_board(steps: &mut Steps, board: &Board, images: &[&str]) {
    let mut folder = Err("not built".to_owned());
    steps.check(&format!("images for the {}", board.name), || {
        folder = stages(board, images, &[]);
        folder.clone().map(drop)
    });
    for image in images {
        steps.check(&format!("{image} on the {}, bit for bit", board.name), || {
            compare(board, &folder.clone()?.join(image), &desk(image)?)
        });
    }
}

fn compare(board: &Board, image: &Path, expected: &str) -> Result<(), String> {
    let said = board.run(image, false)?;
    let (notes, lines): (Vec<_>, Vec<_>) = said.lines().partition(|line| line.starts_with('@'));
    notes.iter().try_for_each(|note| check_note(note))?;
    let differs = |(at, (line, expected)): (usize, (&&str, &str))| {
        (*line != expected).then(|| format!("line {}: `{line}`, the desk has `{expected}`", at + 1))
    };
    match lines.iter().zip(expected.lines()).enumerate().find_map(differs) {
        Some(difference) => Err(difference),
        None if lines.len() != expected.lines().count() => {
            Err("the output is cut short".to_owned())
        }
        None if lines.is_empty() => Err("no output".to_owned()),
        None => Ok(()),
    }
}

/// Notes are what a board says of itself: `@ stack BYTES`, and memory against its formula.
fn check_note(note: &str) -> Result<(), String> {
    println!("{note}");
    let words: Vec<_> = note.split_whitespace().collect();
    match words[..] {
        ["@", "stack", bytes] => match bytes.parse::<u32>() {
            Ok(bytes) if bytes <= STACK => Ok(()),
            _ => Err(format!("{bytes} bytes of stack, {STACK} are allowed")),
        },
        ["@", "memory", bytes, formula] if bytes == formula => Ok(()),
        _ => Err(format!("`{note}`: memory and formula differ")),
    }
}

fn rtic(features: &[&str]) -> Result<String, String> {
    let scenes = target_dir("firmware").join("scenes");
    let build = Build { package: "signorini-rtic", bins: &[], features, scenes: &scenes };
    let (command, folder) = M4F.build(build)?;
    run_cargo(command)?;
    let said = M4F.run(&folder.join("signorini-rtic"), true)?;
    print!("{said}");
    if said.contains("\nmisses 0\n") { Ok(said) } else { Err(said) }
}

/// Bits with the numbers that they are.
fn readable(text: &str) -> String {
    let line = |line: &str| {
        let number = match line.split_whitespace().collect::<Vec<_>>()[..] {
            [.., "f32", bits] => {
                u32::from_str_radix(bits, 16).ok().map(|bits| format!("{:e}", f32::from_bits(bits)))
            }
            [.., "f64", bits] => {
                u64::from_str_radix(bits, 16).ok().map(|bits| format!("{:e}", f64::from_bits(bits)))
            }
            _ => None,
        };
        number.map_or(format!("{line}\n"), |number| format!("{line} = {number}\n"))
    };
    text.lines().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_become_numbers() {
        let text = "# Levee, f32\nforce f32 3f800000\nu 0123456789abcdef\n";
        let shown = "# Levee, f32\nforce f32 3f800000 = 1e0\nu 0123456789abcdef\n";
        assert_eq!(readable(text), shown);
    }

    #[test]
    fn notes_are_checked() {
        assert_eq!(check_note("@ stack 512"), Ok(()));
        let refused = |note| check_note(note).expect_err("refused");
        assert_eq!(refused("@ stack 516"), "516 bytes of stack, 512 are allowed");
        assert_eq!(check_note("@ memory 1024 1024"), Ok(()));
        assert_eq!(
            refused("@ memory 1024 1000"),
            "`@ memory 1024 1000`: memory and formula differ"
        );
    }
}
