//! The headers of two controllers in one file, compiled as C and C++ of every age without a warning; what a library is not built
//! for is refused.

use std::process::Command;

use super::package::{Package, machine};
use super::program::{WARNINGS, sources};
use crate::caught::caught;
use crate::modules::row;
use crate::steps::Steps;
use signorini_image::library::{MACHINES, Machine};
use signorini_image::toolchain::output;

const C: [&str; 5] = ["c99", "c11", "c17", "gnu99", "gnu17"];
const CPP: [&str; 5] = ["c++98", "c++11", "c++14", "c++17", "c++20"];

/// How large an enumeration is, which the headers must not depend on.
const ENUMS: [&str; 2] = ["-fshort-enums", "-fno-short-enums"];

/// A library, and flags of a processor or an ABI that it is not for.
const REFUSED: [(&str, &[&str]); 9] = [
    ("m4", &["-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=soft"]),
    ("m4", &["-mcpu=cortex-m4", "-mthumb", "-mfpu=fpv4-sp-d16", "-mfloat-abi=softfp"]),
    ("m4", &["-mcpu=cortex-m3", "-mthumb"]),
    ("m4-soft", &["-mcpu=cortex-m4", "-mthumb", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard"]),
    ("m4-soft", &["-mcpu=cortex-m0", "-mthumb", "-mfloat-abi=soft"]),
    ("m7", &["-mcpu=cortex-m4", "-mthumb", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard"]),
    ("m7", &["-mcpu=cortex-m7", "-mthumb", "-mfloat-abi=soft"]),
    ("m33", &["-mcpu=cortex-m4", "-mthumb", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard"]),
    ("m33", &["-mcpu=cortex-m33", "-mthumb", "-mfloat-abi=soft"]),
];

/// A step for each machine that this run builds libraries for, and one for what is refused.
pub fn run(steps: &mut Steps) {
    let words = row("levee", "--condensed").map_or(Vec::new(), |row| row.c.words(steps.is_whole()));
    for machine in MACHINES.iter().filter(|machine| words.contains(&machine.word)) {
        steps.check(&format!("headers for {}: C and C++, no warning", machine.word), || {
            let packages = both(machine)?;
            ENUMS.iter().try_for_each(|enums| {
                C.iter().try_for_each(|age| compile(&packages, machine, age, &[enums]))?;
                CPP.iter().try_for_each(|age| compile(&packages, machine, age, &[enums]))
            })
        });
    }
    steps.check("headers refuse what their library is not built for", || refusals(&words));
}

fn both(machine: &Machine) -> Result<[Package; 2], String> {
    let package = |scene| row(scene, "--condensed")?.package(machine.word);
    Ok([package("levee")?, package("slab")?])
}

fn compile(packages: &[Package], on: &Machine, age: &str, more: &[&str]) -> Result<(), String> {
    compile_for(packages, on.board.is_some(), &[on.flags, more].concat(), age)
}

fn compile_for(packages: &[Package], arm: bool, flags: &[&str], age: &str) -> Result<(), String> {
    let is_cpp = age.contains("++");
    let program = format!(
        "{}{}",
        if arm { "arm-none-eabi-" } else { "" },
        if is_cpp { "g++" } else { "gcc" }
    );
    let mut command = Command::new(program);
    command.args(flags).arg(format!("-std={age}")).args(WARNINGS);
    command.args(if is_cpp {
        ["-Wold-style-cast", "-x", "c++"]
    } else {
        ["-Wstrict-prototypes", "-x", "c"]
    });
    packages.iter().for_each(|package| {
        command.arg("-I").arg(&package.folder);
    });
    command.arg("-fsyntax-only").arg(sources().join("both.c"));
    output(&mut command).map(drop).map_err(|why| format!("{age} {}: {why}", flags.join(" ")))
}

fn refusals(words: &[&str]) -> Result<(), String> {
    for (word, flags) in REFUSED.into_iter().filter(|(word, _)| words.contains(word)) {
        refused(word, true, flags)?;
    }
    for word in words.iter().filter(|word| **word != "host") {
        refused(word, false, &[])?;
    }
    let [m4, m7] = ["m4", "m7"].map(|word| machine(word).map(|machine| machine.flags));
    refused("host", true, m4?)?;
    // A core that runs it and passes numbers in the same way.
    compile_for(&both(machine("m4")?)?, true, m7?, "c99")
}

fn refused(word: &str, arm: bool, flags: &[&str]) -> Result<(), String> {
    let told = compile_for(&both(machine(word)?)?, arm, flags, "c99");
    let judged = caught(told, &["liblevee.a is built for: "]);
    judged.map_err(|why| format!("{word} with {}: {why}", flags.join(" ")))
}
