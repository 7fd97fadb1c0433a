//! Makes a baked scene a module of this library, and gives its functions the scene's name.

use std::path::PathBuf;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    for name in ["SIGNORINI_SCENE", "SIGNORINI_C_NAME"] {
        println!("cargo:rerun-if-env-changed={name}");
    }
    let (Some(scene), Ok(name)) = (env::var_os("SIGNORINI_SCENE"), env::var("SIGNORINI_C_NAME"))
    else {
        let why = "built by `signorini bake SCENE --c DIR`, which names the scene's module and its functions";
        return Err(io::Error::other(why));
    };
    let scene = PathBuf::from(scene);
    println!("cargo:rerun-if-changed={}", scene.display());
    println!("cargo:rustc-env=SIGNORINI_C_NAME={name}");
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    fs::write(out.join("module.rs"), format!("#[path = {scene:?}]\nmod scene;\n"))
}
