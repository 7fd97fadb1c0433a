//! A baked controller as a static library for C: objects that show the functions of its header and nothing else.
//!
//! ```text
//!   module ─► cargo (host/c) ─► archive ─► ld -r: what the functions reach ─► objcopy: all other names become its own
//!                └─ the tick with a deadline, the same way: an object of its own ─► ar: libNAME.a
//! ```
//! Each name of the header ends with the [`mark`] of the module, in the header as in the library: those of different bakes do
//! not link. So that two such libraries link into one image, though each has a panic handler and parts of `core`. The panic handler asks
//! for a function that is defined nowhere: a library that needs more than memcpy and the like is refused.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::binutils::Binutils;
use crate::board::{Board, Build, M4, M4F, M7, M33};
use crate::cargo::{build, cargo, root, target_dir};
use crate::checkout::locked;
use crate::files;
use crate::lock;
use crate::objects::ARM;
use crate::tools;

const PACKAGE: &str = "signorini-c";

/// The machine that a library is built for.
#[derive(Debug, Clone, Copy)]
pub struct Machine {
    /// Its name for `signorini bake --board`.
    pub word: &'static str,
    /// None: the machine that bakes.
    pub board: Option<Board>,
    /// Flags of GCC and Clang for it.
    pub flags: &'static [&'static str],
}

/// All machines.
pub const MACHINES: [Machine; 5] = [
    Machine {
        word: "m4",
        board: Some(M4F),
        flags: &["-mcpu=cortex-m4", "-mthumb", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard"],
    },
    Machine {
        word: "m4-soft",
        board: Some(M4),
        flags: &["-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=soft"],
    },
    Machine {
        word: "m7",
        board: Some(M7),
        flags: &["-mcpu=cortex-m7", "-mthumb", "-mfpu=fpv5-d16", "-mfloat-abi=hard"],
    },
    Machine {
        word: "m33",
        board: Some(M33),
        flags: &["-mcpu=cortex-m33", "-mthumb", "-mfpu=fpv5-sp-d16", "-mfloat-abi=hard"],
    },
    Machine { word: "host", board: None, flags: &[] },
];

/// Functions and constants of every header, without the scene's name and an underscore before each.
const EXPORTS: [&str; 14] = [
    "init",
    "tick",
    "reset",
    "seal_state",
    "check_state",
    "culprit",
    "between",
    "clamp",
    "error_name",
    "status_name",
    "bounded_name",
    "default_inputs",
    "least_inputs",
    "most_inputs",
];

/// The end of all names of one bake: the scene's hash, and one of the module's text, which has the model and its numbers.
pub fn mark(module: &str) -> String {
    let scene = module.split("SCENE_HASH: u64 = 0x").nth(1).unwrap_or_default();
    let scene: String = scene.chars().take_while(char::is_ascii_hexdigit).collect();
    // FNV-1a.
    let hash = |hash: u32, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193);
    format!("_of_{scene}_{:08x}", module.bytes().fold(0x811c_9dc5, hash))
}

/// The functions of a controller that steps in time, beside them.
const EXPORTS_IN_TIME: [&str; 3] = ["save", "restore", "window"];

/// The functions of the second object: host/c says why it is one.
const EXPORTS_WITHIN: [&str; 1] = ["tick_within"];

/// Functions and constants that the library of a module shows, without the scene's name and an underscore before each.
pub fn exports(steps_in_time: bool) -> Vec<&'static str> {
    [&of_first(steps_in_time)[..], &EXPORTS_WITHIN].concat()
}

/// The functions of the first object.
fn of_first(steps_in_time: bool) -> Vec<&'static str> {
    [&EXPORTS[..], if steps_in_time { &EXPORTS_IN_TIME } else { &[] }].concat()
}

/// Whether the controller of a module steps in time: then it has a state that outlives the program.
pub fn steps_in_time(module: &str) -> bool {
    module.contains("\npub type State = ")
}

/// A library.
#[derive(Debug)]
pub struct Library {
    /// `libNAME.a`, as it stands in its file.
    pub archive: Vec<u8>,
    /// Bytes of a state.
    pub state: usize,
    /// Bytes of a report.
    pub report: usize,
    /// Bytes of what outlives the program, of a controller that steps in time.
    pub saved: Option<usize>,
    /// Its [`mark`].
    pub mark: String,
}

impl Library {
    /// The library of a module: its text, the features of the kernel that it needs, and the name before its functions.
    ///
    /// # Errors
    /// A tool that is missing, a build that fails, a library that needs what no C library has.
    pub fn build(
        module: &str,
        features: &[String],
        name: &str,
        on: &Machine,
    ) -> Result<Self, String> {
        let bench = Bench::new(module, features, name, on)?;
        let within = bench.object(&bench.built(&["within"])?, &EXPORTS_WITHIN)?;
        let whole = bench.built(&[])?;
        bench.library(&whole, &[bench.object(&whole, &of_first(bench.steps_in_time))?, within])
    }

    /// The library without its tick with a deadline, built with features of host/c's own, and with more functions: for the
    /// checks of `cargo xtask`.
    ///
    /// # Errors
    /// As for [`Library::build`].
    pub fn build_with(
        own: &[&str],
        more: &[&str],
        module: &str,
        features: &[String],
        name: &str,
        on: &Machine,
    ) -> Result<Self, String> {
        let bench = Bench::new(module, features, name, on)?;
        let whole = bench.built(own)?;
        let shown = [&of_first(bench.steps_in_time)[..], more].concat();
        bench.library(&whole, &[bench.object(&whole, &shown)?])
    }
}

/// The place where a library is made: its folder is no other command's meanwhile.
struct Bench<'a> {
    tools: Binutils,
    features: &'a [String],
    name: &'a str,
    on: &'a Machine,
    steps_in_time: bool,
    mark: String,
    folder: PathBuf,
    scene: PathBuf,
    _turn: File,
}

impl<'a> Bench<'a> {
    fn new(
        module: &str,
        features: &'a [String],
        name: &'a str,
        on: &'a Machine,
    ) -> Result<Self, String> {
        if let Some(board) = on.board {
            tools::ensure(&[board.triple])?;
        }
        let folder = target_dir("c").join(on.word);
        let turn = lock::hold(&folder.join("lock"))?;
        let scene = folder.join("scene.rs");
        files::write(&scene, module)?;
        let tools = Binutils { prefix: if on.board.is_some() { ARM } else { "" } };
        let (mark, steps_in_time) = (mark(module), steps_in_time(module));
        Ok(Self { tools, features, name, on, steps_in_time, mark, folder, scene, _turn: turn })
    }

    /// The archive of cargo, built with these features of host/c.
    fn built(&self, own: &[&str]) -> Result<PathBuf, String> {
        let in_time: &[&str] = if self.steps_in_time { &["in-time"] } else { &[] };
        let features = features_of(self.features, &[own, in_time].concat());
        let (mut command, built) = build_command(self.on, &features, &self.scene)?;
        command.env("SIGNORINI_SCENE", &self.scene).env("SIGNORINI_C_NAME", self.name);
        build(command, true)?;
        self.tools.without_bitcode(&built.join("libsignorini_c.a"), &self.folder)
    }

    /// An object of `whole` that shows these exports alone.
    fn object(&self, whole: &Path, exports: &[&str]) -> Result<PathBuf, String> {
        let of_header = self::exports(self.steps_in_time);
        let marked = |own| if of_header.contains(own) { self.mark.as_str() } else { "" };
        let shown: Vec<_> = exports.iter().map(|own| (*own, marked(own))).collect();
        self.tools.object(whole, self.name, &shown, &self.folder)
    }

    fn library(&self, whole: &Path, objects: &[PathBuf]) -> Result<Library, String> {
        let archive = self.tools.archive(self.name, objects, &self.folder)?;
        let size =
            |of: &str| self.tools.size(whole, &format!("{}_size_of_{of}", self.name), &self.folder);
        let (state, report) = (size("state")?, size("report")?);
        let saved = self.steps_in_time.then(|| size("saved")).transpose()?;
        let archive = files::named(&archive, fs::read(&archive))?;
        Ok(Library { archive, state, report, saved, mark: self.mark.clone() })
    }
}

fn features_of(kernel: &[String], own: &[&str]) -> Vec<String> {
    let kernel = kernel.iter().map(|feature| format!("signorini-device/{feature}"));
    kernel.chain(own.iter().map(|&feature| feature.to_owned())).collect()
}

/// The command of cargo, and the folder of what it makes.
fn build_command(
    on: &Machine,
    features: &[String],
    scene: &Path,
) -> Result<(Command, PathBuf), String> {
    let features: Vec<&str> = features.iter().map(String::as_str).collect();
    if let Some(board) = on.board {
        return board.build(Build {
            package: PACKAGE,
            bins: &[],
            features: &features,
            scenes: scene,
        });
    }
    let folder = target_dir("desk");
    let mut command = cargo(&["build", "--release", "-p", PACKAGE, "--target-dir"]);
    command.arg(&folder).args(locked()).arg("--features").arg(features.join(","));
    command.current_dir(root().join("tests/firmware"));
    Ok((command, folder.join("release")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mark_tells_bakes_apart() {
        let text = |number| {
            format!("pub const SCENE_HASH: u64 = 0x0123_4567_89ab_cdef;\nstatic X: f32 = {number};")
        };
        let marks = [1, 2].map(|number| mark(&text(number).replace('_', "")));
        assert!(marks.iter().all(|mark| mark.starts_with("_of_") && mark.len() <= 29), "{marks:?}");
        assert_ne!(marks[0], marks[1]);
    }

    #[test]
    fn flags_are_those_of_the_targets() {
        let hard = |machine: &Machine| machine.flags.contains(&"-mfloat-abi=hard");
        for machine in &MACHINES {
            let command = build_command(machine, &[], Path::new("scene.rs"));
            let Ok((command, _)) = command else { continue };
            let words: Vec<_> = command.get_args().map(|word| word.to_string_lossy()).collect();
            assert_eq!(
                words.iter().any(|word| word.ends_with("eabihf")),
                hard(machine),
                "{words:?}"
            );
        }
    }
}
