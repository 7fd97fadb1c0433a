//! Makes a baked scene, if there is one, a module.

use std::path::PathBuf;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo:rerun-if-env-changed=SIGNORINI_SCENE");
    let Some(scene) = env::var_os("SIGNORINI_SCENE").map(PathBuf::from) else { return Ok(()) };
    println!("cargo:rerun-if-changed={}", scene.display());
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    fs::write(out.join("module.rs"), format!("#[path = {scene:?}]\npub mod scene;\n"))
}
