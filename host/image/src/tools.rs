//! The tools that images need, from Debian's packages.

use std::path::Path;
use std::process::Command;

use crate::board::TRIPLES;
use crate::cargo::run as run_command;
use crate::toolchain::{Toolchain, output};

/// A toolchain with the library's source, its linker, the emulator, and `nm` and `size` for ARM.
const PACKAGES: [&str; 6] =
    ["rustc-web", "cargo-web", "rust-web-src", "lld", "qemu-system-arm", "binutils-arm-none-eabi"];

/// Programs that must answer, beside the toolchain.
const PROGRAMS: [&str; 4] = ["ld.lld", "qemu-system-arm", "arm-none-eabi-nm", "arm-none-eabi-size"];

/// Compilers for C on boards and on the desk, the board's C library, and what builds examples.
const C_PACKAGES: [&str; 6] =
    ["gcc-arm-none-eabi", "libnewlib-arm-none-eabi", "gcc", "g++", "cmake", "make"];

/// Programs that must answer for them.
const C_PROGRAMS: [&str; 6] =
    ["arm-none-eabi-gcc", "arm-none-eabi-g++", "gcc", "g++", "cmake", "make"];

/// `Ok` where all tools for C are there too, installed just now where need be and possible.
///
/// # Errors
/// What is missing, and what to do about it.
pub fn ensure_for_c() -> Result<(), String> {
    ensure(&TRIPLES)?;
    ensured(&C_PACKAGES, || {
        answer(&C_PROGRAMS)?;
        // GCC says where a file of the C library is, or just its name.
        let specs = output(Command::new("arm-none-eabi-gcc").arg("-print-file-name=nano.specs"))?;
        match Path::new(specs.trim()).is_absolute() {
            true => Ok(()),
            false => Err("arm-none-eabi-gcc has no C library".to_owned()),
        }
    })
}

/// `Ok` where all tools for boards of these targets are there, installed just now where need be and possible.
///
/// # Errors
/// What is missing, and what to do about it.
pub fn ensure(triples: &[&str]) -> Result<(), String> {
    ensured(&PACKAGES, || {
        triples.iter().try_for_each(|triple| Toolchain::find(triple).map(drop))?;
        answer(&PROGRAMS)
    })
}

/// `Ok` where `is_there` says so, before or after these packages of Debian are installed.
///
/// # Errors
/// What is missing, and what to do about it.
pub fn ensured(packages: &[&str], is_there: impl Fn() -> Result<(), String>) -> Result<(), String> {
    let Err(why) = is_there() else { return Ok(()) };
    install_packages(packages).map_err(|remedy| format!("{why}; {remedy}"))?;
    is_there()
}

/// `Ok` where each of these programs tells its version.
///
/// # Errors
/// The first that does not.
pub fn answer(programs: &[&str]) -> Result<(), String> {
    programs.iter().try_for_each(|program| output(Command::new(program).arg("--version")).map(drop))
}

/// Installs packages of Debian; `Err` with what to do where that is not possible.
///
/// # Errors
/// No Debian, not its root, or no package of that name.
pub fn install_packages(packages: &[&str]) -> Result<(), String> {
    let names = packages.join(" ");
    if !Path::new("/etc/debian_version").exists() {
        return Err(format!("install what Debian calls {names}"));
    }
    let user = output(Command::new("id").arg("-u"))?;
    if user.trim() != "0" {
        return Err(format!("run `sudo apt-get install --no-install-recommends {names}`"));
    }
    println!("installing Debian's packages {names}");
    // Another apt may hold the lock for a while.
    let apt = |words: &[&str]| {
        let mut command = Command::new("apt-get");
        command.env("DEBIAN_FRONTEND", "noninteractive");
        command.args(["-o", "DPkg::Lock::Timeout=120", "-q"]).args(words);
        run_command(command)
    };
    apt(&["update"])?;
    apt(&[&["install", "-y", "--no-install-recommends"], packages].concat())
}
