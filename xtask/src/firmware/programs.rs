//! A scene baked, and the two programs that hold it.

use std::fs;
use std::io::IsTerminal as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::{Failure, Options};
use crate::board::{Board, Build};
use crate::cargo::{cargo, root, run as run_cargo, target_dir};
use crate::export::take;
use crate::toolchain::output;

const PACKAGE: &str = "signorini-scene";

/// What the baked module says of the kernel's features that it needs.
const FEATURES: &str = "//! Kernel features:";

/// An image, and the same for the desk.
#[derive(Debug)]
pub struct Programs {
    board: Board,
    image: PathBuf,
    desk: PathBuf,
    /// Features of the kernel that both are built with.
    pub features: Vec<String>,
}

impl Programs {
    /// Bakes the scene and builds both.
    pub fn build(options: &Options) -> Result<Self, Failure> {
        let board = options.board()?;
        let scene = bake(options)?;
        let source = fs::read_to_string(&scene);
        let source = source.map_err(|error| format!("{}: {error}", scene.display()))?;
        let features = features(&source);
        let of_kernel: Vec<String> =
            features.iter().map(|feature| format!("signorini-kernel/{feature}")).collect();
        let of_kernel: Vec<&str> = of_kernel.iter().map(String::as_str).collect();
        let image = image(&board, &scene, &of_kernel)
            .map_err(|why| format!("{why}: no image for {}, see above", options.board))?;
        let desk = desk(&scene, &of_kernel)?;
        Ok(Self { board, image, desk, features })
    }

    /// What the board prints.
    pub fn on_board(&self) -> Result<String, String> {
        self.board.run(&self.image, true)
    }

    /// What the desk prints.
    pub fn on_desk(&self) -> Result<String, String> {
        // It says why a tick has no answer.
        output(Command::new(&self.desk).stderr(Stdio::inherit()))
    }

    /// The image.
    pub fn image(&self) -> &Path {
        &self.image
    }
}

/// Writes the scene's module; the command tells itself what is wrong with a scene.
fn bake(options: &Options) -> Result<PathBuf, Failure> {
    let folder = target_dir("firmware").join("baked");
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let model = options.model.as_deref();
    let name = format!("{}_{}{}", options.name(), options.scalar, model.unwrap_or_default());
    let fresh = folder.join(format!("{name}.{}.rs", std::process::id()));
    // The build that tests and exports use, optimised like a release.
    let mut command = cargo(&["run", "--locked", "--package", "signorini-host"]);
    if !std::io::stderr().is_terminal() {
        command.arg("--quiet");
    }
    command.arg("--manifest-path").arg(root().join("Cargo.toml"));
    command.args(["--", "bake"]).arg(&options.scene).arg("-o").arg(&fresh);
    command.args(["--scalar", &options.scalar]).args(model);
    for input in &options.inputs {
        command.args(["--input", input]);
    }
    // Where this one was called: the scene's path is from there.
    command.current_dir(std::env::current_dir().map_err(|error| error.to_string())?);
    let status = command.status().map_err(|error| error.to_string())?;
    if !status.success() {
        let _ = fs::remove_file(&fresh);
        let why = format!("signorini bake: {status}");
        return Err(Failure { why, status: if status.code() == Some(2) { 2 } else { 1 } });
    }
    let kept = folder.join(format!("{name}.rs"));
    take(&fresh, &kept)?;
    Ok(kept)
}

fn image(board: &Board, scene: &Path, features: &[&str]) -> Result<PathBuf, String> {
    // This package reads one scene; the folder of the exported ones is for others.
    let build = Build { package: PACKAGE, bins: &["scene"], features, scenes: scene };
    let (mut command, folder) = board.build(build)?;
    command.env("SIGNORINI_SCENE", scene);
    run_cargo(command)?;
    Ok(folder.join("scene"))
}

fn desk(scene: &Path, features: &[&str]) -> Result<PathBuf, String> {
    let folder = target_dir("desk");
    let mut command = cargo(&["build", "--release", "--locked", "-p", PACKAGE]);
    command.args(["--bin", "scene_desk", "--target-dir"]).arg(&folder);
    command.arg("--features").arg([features, &["desk"]].concat().join(","));
    command.env("SIGNORINI_SCENE", scene).current_dir(root().join("tests/firmware"));
    run_cargo(command)?;
    Ok(folder.join("release/scene_desk"))
}

/// The kernel's features that a module names; none where it names none.
fn features(module: &str) -> Vec<String> {
    let line = module.lines().find_map(|line| line.strip_prefix(FEATURES));
    let names = line.unwrap_or_default().trim_end_matches('.').split(',').map(str::trim);
    names.filter(|name| !name.is_empty()).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_module_names_its_features() {
        let module =
            "//! Levee.\n//!\n//! Kernel features: contact, triangles.\n\npub type Scalar = f32;\n";
        assert_eq!(features(module), ["contact", "triangles"]);
        assert_eq!(features("//! Levee.\n"), [""; 0]);
    }
}
