//! Makes a baked scene, wherever it is, a module of this package: what `mod scene;` is to a user's own; and a log, if there is
//! one, a constant.

use std::path::PathBuf;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo:rerun-if-env-changed=SIGNORINI_SCENE");
    let Some(scene) = env::var_os("SIGNORINI_SCENE") else {
        return Err(io::Error::other(
            "SIGNORINI_SCENE names no file; see cargo xtask firmware --help",
        ));
    };
    let scene = PathBuf::from(scene);
    println!("cargo:rerun-if-changed={}", scene.display());
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    fs::write(out.join("module.rs"), format!("#[path = {scene:?}]\npub mod scene;\n"))?;
    println!("cargo:rerun-if-env-changed=SIGNORINI_LOG");
    let log = match env::var_os("SIGNORINI_LOG") {
        Some(log) => {
            println!("cargo:rerun-if-changed={}", PathBuf::from(&log).display());
            fs::read_to_string(log)?
        }
        None => String::new(),
    };
    fs::write(out.join("log.rs"), format!("&[{}]", stretches(&log).concat()))
}

/// Elements of an array: for how many ticks inputs stay as they are, and the inputs.
fn stretches(log: &str) -> Vec<String> {
    let mut lines = log.lines();
    let names: Vec<_> = lines.next().unwrap_or_default().split(',').skip(1).collect();
    let rows: Vec<_> = lines.map(|line| line.split_once(',').unwrap_or_default().1).collect();
    let element = |rows: &[&str]| {
        // A whole number is one of the scalar, too.
        let values = names.iter().zip(rows[0].split(','));
        let fields: String = values.map(|(name, x)| format!("{name}: {x} as Scalar, ")).collect();
        format!("({}, Inputs {{ {fields}..Inputs::DEFAULT }}),\n", rows.len())
    };
    rows.chunk_by(|one, next| one == next).map(element).collect()
}
