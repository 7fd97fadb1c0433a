//! Makes a baked scene, wherever it is, a module of this package: what `mod scene;` is to a user's own.

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
    fs::write(out.join("module.rs"), format!("#[path = {scene:?}]\npub mod scene;\n"))
}
