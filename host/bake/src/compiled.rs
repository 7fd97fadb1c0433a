//! Generated text as the compiler sees it, for tests: no warnings, and then it runs.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Kernels that this build has made, the newest first: other features or profiles may be among them.
fn kernels(folder: &Path) -> Vec<PathBuf> {
    let files = std::fs::read_dir(folder).expect("the folder of this test");
    let paths = files.filter_map(|file| Some(file.ok()?.path()));
    let is_kernel = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with("libsignorini_device-") && name.ends_with(".rlib")
    };
    let age = |path: &PathBuf| path.metadata().and_then(|of| of.modified()).ok();
    let mut kernels: Vec<_> = paths.filter(is_kernel).collect();
    kernels.sort_by_key(|path| std::cmp::Reverse(age(path)));
    kernels
}

/// The text that a module with a `main` prints when it runs.
pub fn printed(text: &str) -> String {
    ran(text).unwrap_or_else(|said| panic!("{said}"))
}

/// The same, or what the compiler says against it.
pub fn ran(text: &str) -> Result<String, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let (file, program) = (folder.path().join("scene.rs"), folder.path().join("scene"));
    std::fs::write(&file, text).expect("a file");
    let test = std::env::current_exe().expect("this test");
    let dependencies = test.parent().expect("its folder");
    let mut said = String::new();
    for kernel in kernels(dependencies) {
        let compiled = Command::new(std::env::var("RUSTC").unwrap_or("rustc".to_owned()))
            .args(["--edition", "2024", "-D", "warnings"])
            .arg("-L")
            .arg(dependencies)
            .arg("--extern")
            .arg(format!("signorini_device={}", kernel.display()))
            .arg("-o")
            .args([&program, &file])
            .output()
            .expect("a compiler");
        if compiled.status.success() {
            let ran = Command::new(&program).output().expect("a program");
            return Ok(String::from_utf8_lossy(&ran.stdout).into_owned());
        }
        // Of the newest: an older one may be of other features.
        if said.is_empty() {
            said = String::from_utf8_lossy(&compiled.stderr).into_owned();
        }
    }
    Err(said)
}
