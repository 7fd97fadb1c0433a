//! The text as the compiler sees it: no warnings, and the bits of the same arrays on the host.

use std::path::{Path, PathBuf};
use std::process::Command;

use signorini_kernel::rows;

use super::{BENT, Baked, Controller, fixtures, source};
use crate::error::Result;
use crate::mesh::structured::{Cells, grid};
use crate::scalar::Scalar;

/// Prints the outputs of a cold and a warm tick as bits.
const MAIN: &str = "
fn main() {
    let mut controller = Box::new(Controller::new());
    for lift in [0.3, -0.2] {
        let inputs = Inputs { lift, ..Inputs::DEFAULT };
        let outputs = controller.tick(inputs).map(|answer| answer.outputs.to_array());
        println!(\"{:?}\", outputs.map(|outputs| outputs.map(Scalar::to_bits)));
    }
}
";

/// Kernels that this build has made, the newest first: other features or profiles may be among them.
fn kernels(folder: &Path) -> Vec<PathBuf> {
    let files = std::fs::read_dir(folder).expect("the folder of this test");
    let paths = files.filter_map(|file| Some(file.ok()?.path()));
    let is_kernel = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with("libsignorini_kernel-") && name.ends_with(".rlib")
    };
    let age = |path: &PathBuf| path.metadata().and_then(|of| of.modified()).ok();
    let mut kernels: Vec<_> = paths.filter(is_kernel).collect();
    kernels.sort_by_key(|path| std::cmp::Reverse(age(path)));
    kernels
}

/// What the module prints when it runs.
fn printed(text: &str) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let (file, program) = (folder.path().join("scene.rs"), folder.path().join("scene"));
    std::fs::write(&file, text).expect("a file");
    let test = std::env::current_exe().expect("this test");
    let dependencies = test.parent().expect("its folder");
    let mut said = String::new();
    for kernel in kernels(dependencies) {
        let compiled = Command::new(std::env::var("RUSTC").unwrap_or("rustc".to_owned()))
            .args(["--edition", "2024", "-D", "warnings", "-A", "dead_code"])
            .arg("-L")
            .arg(dependencies)
            .arg("--extern")
            .arg(format!("signorini_kernel={}", kernel.display()))
            .arg("-o")
            .args([&program, &file])
            .output()
            .expect("a compiler");
        if compiled.status.success() {
            let ran = Command::new(&program).output().expect("a program");
            return String::from_utf8_lossy(&ran.stdout).into_owned();
        }
        said = String::from_utf8_lossy(&compiled.stderr).into_owned();
    }
    panic!("{said}");
}

fn same_bits<R: Scalar, const WIDTH: usize>(cells: Cells, bits: impl Fn(R) -> u64) -> Result<()> {
    let (scene, problem) = fixtures::on_grid(BENT, grid(3, cells))?;
    let baked = Baked::<R>::new(&scene, &problem)?;
    let mut controller = Controller::<R, WIDTH>::new(&baked);
    let lines = [0.3, -0.2].map(|lift| {
        let defaults = scene.inputs.iter().skip(1).map(|input| R::narrow(input.default));
        let inputs: Vec<R> = std::iter::once(R::narrow(lift)).chain(defaults).collect();
        let (outputs, _) = controller.tick(&inputs, crate::bake::full::limits()).expect("a tick");
        format!("Ok({:?})\n", outputs.into_iter().map(&bits).collect::<Vec<_>>())
    });
    assert_eq!(printed(&(source(&baked) + MAIN)), lines.concat());
    Ok(())
}

#[test]
fn triangles_in_f32() -> Result<()> {
    same_bits::<f32, { rows::TRIANGLES }>(Cells::Triangles, |x| x.to_bits().into())
}

#[test]
fn both_kinds_of_cells_in_f64() -> Result<()> {
    same_bits::<f64, { rows::QUADS }>(Cells::Mixed, f64::to_bits)
}
