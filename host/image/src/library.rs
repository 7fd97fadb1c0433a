//! A baked controller as a static library for C: objects that show the functions of its header and nothing else.
//!
//! ```text
//!   module ─► cargo (host/c) ─► archive ─► ld -r: what the functions reach ─► objcopy: all other names become its own
//!                └─ the tick with a deadline, the same way: an object of its own ─► ar: libNAME.a
//! ```
//! So that two such libraries link into one image, though each has a panic handler and parts of `core`. The panic handler asks
//! for a function that is defined nowhere: a library that needs more than memcpy and the like is refused.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::board::{Board, Build, M4, M4F, M7};
use crate::cargo::{cargo, root, run_quietly, target_dir};
use crate::lock;
use crate::toolchain::output;
use crate::tools;

const PACKAGE: &str = "signorini-c";

/// What a library is built for.
#[derive(Debug, Clone, Copy)]
pub struct Machine {
    /// What `signorini bake --board` calls it.
    pub word: &'static str,
    /// None: the machine that bakes.
    pub board: Option<Board>,
    /// What GCC and Clang are told for it.
    pub flags: &'static [&'static str],
}

/// All of them.
pub const MACHINES: [Machine; 4] = [
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
    Machine { word: "host", board: None, flags: &[] },
];

/// Functions and constants of a header, without the scene's name and an underscore before each.
pub const EXPORTS: [&str; 13] = [
    "init",
    "tick",
    "reset",
    "seal_state",
    "check_state",
    "culprit",
    "clamp",
    "error_name",
    "status_name",
    "bounded_name",
    "default_inputs",
    "least_inputs",
    "most_inputs",
];

/// Those of the second object: host/c says why it is one.
pub const EXPORTS_WITHIN: [&str; 1] = ["tick_within"];

/// Constants of the build that the library does not have: their sizes are what they tell.
const SIZES: [&str; 2] = ["size_of_state", "size_of_report"];

/// What every C compiler may call, and every C library has.
const OF_C: [&str; 4] = ["memcpy", "memmove", "memset", "memcmp"];

/// A library.
#[derive(Debug)]
pub struct Library {
    /// `libNAME.a`, as it stands in its file.
    pub archive: Vec<u8>,
    /// Bytes of a state.
    pub state: usize,
    /// Bytes of a report.
    pub report: usize,
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
        Self::build_with(&[], &[], module, features, name, on)
    }

    /// The same with features of host/c's own, and more functions in its first object: what `cargo xtask` tries on it.
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
        if on.board.is_some() {
            tools::ensure()?;
        }
        let folder = target_dir("c").join(on.word);
        let _turn = lock::hold(&folder.join("lock"))?;
        let scene = folder.join("scene.rs");
        fs::write(&scene, module).map_err(|error| format!("{}: {error}", scene.display()))?;
        let tools = Binutils { prefix: if on.board.is_some() { "arm-none-eabi-" } else { "" } };
        let built = |own: &[&str]| {
            let (mut command, built) = build_command(on, &features_of(features, own), &scene)?;
            command.env("SIGNORINI_SCENE", &scene).env("SIGNORINI_C_NAME", name);
            run_quietly(command)?;
            tools.without_bitcode(&built.join("libsignorini_c.a"), &folder)
        };
        let within = tools.object(&built(&["within"])?, name, &EXPORTS_WITHIN, &folder)?;
        let whole = built(own)?;
        let object = tools.object(&whole, name, &[&EXPORTS[..], more].concat(), &folder)?;
        let archive = tools.archive(name, &[object, within], &folder)?;
        let [state, report] = tools.sizes(&whole, name, &folder)?;
        let archive =
            fs::read(&archive).map_err(|error| format!("{}: {error}", archive.display()))?;
        Ok(Self { archive, state, report })
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
    let mut command = cargo(&["build", "--release", "--locked", "-p", PACKAGE, "--target-dir"]);
    command.arg(&folder).arg("--features").arg(features.join(","));
    command.current_dir(root().join("tests/firmware"));
    Ok((command, folder.join("release")))
}

/// The programs that take objects apart and put them together.
struct Binutils {
    prefix: &'static str,
}

impl Binutils {
    fn command(&self, program: &str) -> Command {
        Command::new(format!("{}{program}", self.prefix))
    }

    fn run(&self, command: &mut Command) -> Result<String, String> {
        output(command).map_err(|why| match self.prefix {
            "" => format!("{why}; it belongs to what Debian calls binutils"),
            _ => why,
        })
    }

    /// The archive without LLVM's own copy of the code, which plugins of binutils take for it.
    fn without_bitcode(&self, whole: &Path, folder: &Path) -> Result<PathBuf, String> {
        let plain = folder.join("plain.a");
        let mut copy = self.command("objcopy");
        copy.args(["--remove-section=.llvmbc", "--remove-section=.llvmcmd"]).arg(whole).arg(&plain);
        self.run(&mut copy).map(|_| plain)
    }

    /// What `names` reach in `whole`, as one object.
    fn linked(&self, whole: &Path, names: &[String], object: &Path) -> Result<(), String> {
        let mut link = self.command("ld");
        link.args(["-r", "--gc-sections"]);
        names.iter().for_each(|name| {
            link.arg("-u").arg(name);
        });
        self.run(link.arg(whole).arg("-o").arg(object)).map(drop)
    }

    /// An object that shows these exports alone.
    fn object(
        &self,
        whole: &Path,
        name: &str,
        exports: &[&str],
        folder: &Path,
    ) -> Result<PathBuf, String> {
        let last = exports.last().copied().unwrap_or_default();
        let object = folder.join(format!("{name}_{last}.o"));
        let names: Vec<_> = exports.iter().map(|own| format!("{name}_{own}")).collect();
        self.linked(whole, &names, &object)?;
        let mut hide = self.command("objcopy");
        hide.arg("--strip-debug");
        names.iter().for_each(|name| {
            hide.arg(format!("--keep-global-symbol={name}"));
        });
        self.run(hide.arg(&object))?;
        let listing = self.run(self.command("nm").arg("-P").arg(&object))?;
        needs_nothing(&listing).map(|()| object)
    }

    /// The library.
    fn archive(&self, name: &str, objects: &[PathBuf], folder: &Path) -> Result<PathBuf, String> {
        let archive = folder.join(format!("lib{name}.a"));
        // `ar` adds to what is there.
        let _ = fs::remove_file(&archive);
        // D: without times and users, so that the same scene gives the same bytes.
        self.run(self.command("ar").arg("rcsD").arg(&archive).args(objects)).map(|_| archive)
    }

    fn sizes(&self, whole: &Path, name: &str, folder: &Path) -> Result<[usize; 2], String> {
        let object = folder.join(format!("{name}.sizes.o"));
        let names = SIZES.map(|own| format!("{name}_{own}"));
        self.linked(whole, &names, &object)?;
        let listing = self.run(self.command("nm").arg("-P").arg(&object))?;
        let size = |name: &String| {
            size_of_symbol(&listing, name)
                .ok_or_else(|| format!("the library does not tell {name}"))
        };
        Ok([size(&names[0])?, size(&names[1])?])
    }
}

/// `Ok` where no symbol is undefined but what every C library has.
fn needs_nothing(listing: &str) -> Result<(), String> {
    let undefined = listing.lines().filter_map(|line| {
        let (name, kind) = line.split_once(' ')?;
        kind.starts_with('U').then_some(name)
    });
    let known = |name: &&str| {
        let plain = name.strip_prefix("__aeabi_").unwrap_or(name).trim_end_matches(['4', '8']);
        OF_C.contains(&plain) || plain == "memclr"
    };
    match undefined.into_iter().find(|name| !known(name)) {
        None => Ok(()),
        Some(name) if name.contains("panic") => {
            Err(format!("the library can panic: it asks for {name}; this is a fault of signorini"))
        }
        Some(name) => Err(format!(
            "the library needs {name}, which no C library has; this is a fault of signorini"
        )),
    }
}

/// The size that `nm -P` tells of a symbol.
fn size_of_symbol(listing: &str, name: &str) -> Option<usize> {
    let line = listing.lines().find(|line| line.split(' ').next() == Some(name))?;
    usize::from_str_radix(line.split_whitespace().nth(3)?, 16).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_library_needs_is_read_from_its_symbols() {
        let listing = "levee_tick T 0 8c\nmemcpy U         \n__aeabi_memclr4 U         \n__aeabi_memcpy8 U \n";
        assert_eq!(needs_nothing(listing), Ok(()));
        let panics = "levee_tick T 0 8c\na_panic_path_is_reachable U         \n";
        assert!(needs_nothing(panics).is_err_and(|why| why.contains("can panic")));
        assert!(needs_nothing("malloc U \n").is_err_and(|why| why.contains("malloc")));
    }

    #[test]
    fn sizes_are_those_of_symbols() {
        let listing = "levee_size_of_report B 0 3c\nlevee_size_of_state R 1c 0278\n";
        assert_eq!(size_of_symbol(listing, "levee_size_of_state"), Some(0x278));
        assert_eq!(size_of_symbol(listing, "levee_size"), None);
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
