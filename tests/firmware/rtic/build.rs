//! Puts the memory map where the linker looks for it, and makes a baked scene, if there is one, a module.

use std::path::PathBuf;
use std::{env, fs, io};

/// mps2-an386, the board that QEMU emulates; put your part's numbers here.
const MEMORY: &str = "\
MEMORY
{
  FLASH : ORIGIN = 0x00000000, LENGTH = 4M
  RAM : ORIGIN = 0x20000000, LENGTH = 4M
}
";

fn main() -> io::Result<()> {
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    fs::write(out.join("memory.x"), MEMORY)?;
    println!("cargo:rustc-link-search={}", out.display());
    println!("cargo:rerun-if-env-changed=SIGNORINI_SCENE");
    let Some(scene) = env::var_os("SIGNORINI_SCENE").map(PathBuf::from) else { return Ok(()) };
    println!("cargo:rerun-if-changed={}", scene.display());
    fs::write(out.join("module.rs"), format!("#[path = {scene:?}]\nmod scene;\n"))
}
