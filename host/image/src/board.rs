//! The boards, as QEMU emulates them: building an image for one, and running it there.

use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use crate::cargo::{root, target_dir};
use crate::checkout::locked;
use crate::toolchain::{Toolchain, first_words, output};

/// The targets: ARMv7E-M without and with a floating-point unit, and ARMv8-M with one.
pub const TRIPLES: [&str; 3] =
    ["thumbv7em-none-eabi", "thumbv7em-none-eabihf", "thumbv8m.main-none-eabihf"];

/// A board.
#[derive(Debug, Clone, Copy)]
pub struct Board {
    /// Its name in tables.
    pub name: &'static str,
    /// Its name for `cargo xtask firmware --board`.
    pub word: &'static str,
    /// Its target.
    pub triple: &'static str,
    /// Where code for this very core is asked for.
    cpu_flag: Option<&'static str>,
    /// Its name for QEMU.
    pub machine: &'static str,
    /// Its core.
    pub cpu: &'static str,
    /// The memory map, for the images' build script.
    memory: &'static str,
    /// Bytes of flash.
    pub flash: u64,
    /// Bytes of contiguous RAM.
    pub ram: u64,
}

/// Cortex-M4 with a unit for f32 and all the memory one may want.
pub const M4F: Board = Board {
    name: "M4F",
    word: "m4",
    triple: TRIPLES[1],
    cpu_flag: None,
    machine: "mps2-an386",
    cpu: "cortex-m4",
    memory: "mps2",
    flash: 4 << 20,
    ram: 4 << 20,
};

/// The core of the M4F with its unit left unused.
pub const M4: Board = Board { name: "M4", word: "m4-soft", triple: TRIPLES[0], ..M4F };

/// Cortex-M7 with a unit for f64.
pub const M7: Board = Board {
    name: "M7",
    word: "m7",
    cpu_flag: Some("-Ctarget-cpu=cortex-m7"),
    machine: "mps2-an500",
    cpu: "cortex-m7",
    ..M4F
};

/// Cortex-M33 with a unit for f32, as in the RP2350, STM32U5 and nRF5340: ARMv8-M, in its secure state.
pub const M33: Board = Board {
    name: "M33",
    word: "m33",
    triple: TRIPLES[2],
    machine: "mps2-an505",
    cpu: "cortex-m33",
    memory: "mps2-an505",
    ..M4F
};

/// An STM32F405: 192 KiB of RAM, 128 of them contiguous, and 1 MiB of flash.
pub const M4F_192K: Board = Board {
    name: "M4F-192K",
    word: "m4-192k",
    machine: "netduinoplus2",
    memory: "netduinoplus2",
    flash: 1 << 20,
    ram: 128 << 10,
    ..M4F
};

/// The part on a desk: QEMU is not asked.
pub const HARDWARE: Board = Board { name: "STM32F407", memory: "stm32f407", ..M4F_192K };

/// The program to build: a package of `tests/firmware`, some of its binaries (all, where empty), features.
#[derive(Debug, Clone, Copy)]
pub struct Build<'a> {
    /// The package.
    pub package: &'a str,
    /// Its binaries.
    pub bins: &'a [&'a str],
    /// Its features.
    pub features: &'a [&'a str],
    /// The folder of the exported scenes.
    pub scenes: &'a Path,
}

impl Board {
    /// A name that no other memory map has.
    pub(crate) fn memory_name(&self) -> String {
        format!("{}.{}", self.name, self.memory)
    }

    /// The board, with so much flash and RAM that every image has room: to link, not to run.
    pub fn boundless(self) -> Self {
        Self { memory: "boundless", ..self }
    }

    /// The command that builds images for this board, and the folder that they go to.
    ///
    /// # Errors
    /// No toolchain for it.
    pub fn build(&self, build: Build) -> Result<(Command, PathBuf), String> {
        let toolchain = Toolchain::find(self.triple)?;
        let mut command =
            toolchain.cargo(&["build", "--release", "-p", build.package], self.triple);
        command.args(locked());
        // Each set of flags has a `core` of its own: apart, they do not evict each other.
        let folder =
            target_dir("firmware").join(if self.cpu_flag.is_some() { self.name } else { "" });
        command.current_dir(root().join("tests/firmware"));
        command.arg("--target-dir").arg(&folder);
        build.bins.iter().for_each(|bin| {
            command.args(["--bin", bin]);
        });
        command.arg("--features").arg(build.features.join(","));
        command.env("SIGNORINI_BOARD", self.memory).env("SIGNORINI_SCENES", build.scenes);
        if let Some(flag) = self.cpu_flag {
            // Joined with the linker's flags of `.cargo/config.toml`, which RUSTFLAGS would replace.
            let name = self.triple.replace(['-', '.'], "_").to_uppercase();
            command.env(format!("CARGO_TARGET_{name}_RUSTFLAGS"), flag);
        }
        Ok((command, folder.join(self.triple).join("release")))
    }

    /// Runs an image to its end; what it prints. `counted` makes every instruction take the same time.
    ///
    /// # Errors
    /// It ends with a failure, or not within ten minutes: what it printed.
    pub fn run(&self, image: &Path, counted: bool) -> Result<String, String> {
        let mut command = Command::new("qemu-system-arm");
        command.args(["-cpu", self.cpu, "-machine", self.machine, "-nographic"]);
        command.args(["-semihosting-config", "enable=on,target=native"]);
        if counted {
            command.args(["-icount", "shift=0"]);
        }
        command.arg("-kernel").arg(image).stdin(Stdio::null());
        let name = image.file_name().unwrap_or_default().display().to_string();
        let (status, text) = within(LIMIT, command)?;
        if status == Some(0) {
            return Ok(text);
        }
        let why = status.map_or("ran out of time".to_owned(), |code| format!("status {code}"));
        Err(format!("{name} on {}: {why}\n{text}", self.name))
    }
}

/// The emulator's name and version.
///
/// # Errors
/// It does not answer.
pub fn emulator() -> Result<String, String> {
    let said = output(Command::new("qemu-system-arm").arg("--version"))?;
    let words = first_words(&said, 4);
    Ok(words.replace("emulator version ", ""))
}

/// Longer than any image needs, a loaded machine included.
const LIMIT: Duration = Duration::from_secs(600);

/// Exit status and output of a command; no status where it was stopped at the limit.
fn within(limit: Duration, mut command: Command) -> Result<(Option<i32>, String), String> {
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
    let mut child =
        child.map_err(|error| format!("{}: {error}", command.get_program().display()))?;
    let readers = [reader(child.stdout.take()), reader(child.stderr.take())];
    let status = wait(&mut child, Instant::now() + limit)?;
    let text = readers.map(|reader| reader.join().unwrap_or_default()).concat();
    Ok((status, text))
}

fn wait(child: &mut Child, deadline: Instant) -> Result<Option<i32>, String> {
    loop {
        if let Some(status) = child.try_wait().map_err(|error| error.to_string())? {
            // Killed by a signal, as QEMU is after a lockup: a failure too.
            return Ok(Some(status.code().unwrap_or(-1)));
        }
        if Instant::now() > deadline {
            let _ = child.kill();
            let _ = child.wait();
            return Ok(None);
        }
        thread::sleep(Duration::from_millis(20));
    }
}

/// Reads a pipe to its end beside everything else, so that the child never waits for a reader.
fn reader(pipe: Option<impl Read + Send + 'static>) -> thread::JoinHandle<String> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        let read = pipe.map(|mut pipe| pipe.read_to_end(&mut bytes));
        drop(read);
        String::from_utf8_lossy(&bytes).into_owned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_images_link_for_the_same_memory() {
        let maps = root().join("tests/firmware/board/build.rs");
        let maps = std::fs::read_to_string(maps).expect("the maps");
        for (board, said) in [(M4F, "LENGTH = 4M\\nRAM"), (M4F_192K, "LENGTH = 1M\\nRAM")] {
            assert!(maps.contains(said) && said.contains(&format!("{}M", board.flash >> 20)));
        }
        let kib = |board: Board| format!("0x20000000, LENGTH = {}", board.ram >> 10);
        assert!(maps.contains(&format!("{}K\"", kib(M4F_192K))));
        assert!(maps.contains("0x20000000, LENGTH = 4M\"") && M4F.ram == 4 << 20);
        assert!(maps.contains("0x38000000, LENGTH = 4M\"") && M33.ram == 4 << 20);
    }

    #[test]
    fn a_child_that_hangs_is_stopped() {
        let mut sleep = Command::new("sleep");
        sleep.arg("60");
        let ended = within(Duration::from_millis(100), sleep);
        assert_eq!(ended, Ok((None, String::new())));
    }

    #[test]
    fn output_and_status_are_kept() {
        let mut shell = Command::new("sh");
        shell.args(["-c", "echo out; echo err >&2; exit 3"]);
        assert_eq!(within(LIMIT, shell), Ok((Some(3), "out\nerr\n".to_owned())));
    }
}
