//! `cargo xtask quick`: format, clippy and tests of the packages that the working tree changes, or the last commit where it
//! changes nothing.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;

use crate::counted::counted_by;
use crate::crates::KERNEL;
use crate::steps::Steps;
use signorini_image::cargo::{cargo, root, run as run_cargo};
use signorini_image::toolchain::output;

/// The verb.
pub fn run(steps: &mut Steps) {
    let touched = match touched() {
        Ok(touched) => touched,
        Err(why) => return steps.lint("what the working tree changes", || Err(why)),
    };
    println!("changed: {}", touched.iter().cloned().collect::<Vec<_>>().join(", "));
    steps.lint("formatting", || run_cargo(cargo(&["fmt", "--all", "--check"])));
    if touched.is_empty() {
        return;
    }
    steps.lint("clippy", || {
        let mut clippy = cargo(&["clippy", "--release", "--all-targets", "--locked"]);
        clippy.args(touched.iter().flat_map(|package| ["--package", package]));
        clippy.args(["--", "-D", "warnings"]);
        run_cargo(clippy)
    });
    let is_kernel = |package: &&String| KERNEL.contains(&package.as_str());
    let (kernel, host): (Vec<_>, Vec<_>) = touched.iter().partition(is_kernel);
    for (profile, packages) in [(&[][..], kernel), (&["--release"], host)] {
        for package in packages {
            steps.step(&format!("tests of {package}"), || {
                let mut test = cargo(&["test", "--locked", "--no-fail-fast"]);
                test.args(profile).args(["--package", package]);
                Ok(counted_by(test))
            });
        }
    }
}

/// The packages of this workspace that have changed files.
fn touched() -> Result<BTreeSet<String>, String> {
    let changed =
        [git(&["diff", "--name-only", "HEAD"])?, git(&["ls-files", "-o", "--exclude-standard"])?];
    let mut changed = changed.concat();
    if changed.is_empty() {
        changed = git(&["diff", "--name-only", "HEAD~1"])?;
    }
    let said = output(&mut cargo(&["metadata", "--no-deps", "--format-version", "1"]))?;
    let workspace: Workspace = serde_json::from_str(&said).map_err(|error| error.to_string())?;
    Ok(changed.iter().filter_map(|file| workspace.package_of(&root().join(file))).collect())
}

fn git(words: &[&str]) -> Result<Vec<String>, String> {
    let said = output(Command::new("git").args(words).current_dir(root()))?;
    Ok(said.lines().map(str::to_owned).collect())
}

/// The workspace as cargo tells it.
#[derive(Deserialize)]
struct Workspace {
    packages: Vec<Package>,
}

#[derive(Deserialize)]
struct Package {
    name: String,
    manifest_path: PathBuf,
}

impl Workspace {
    /// The package whose folder is the innermost that a file lies in.
    fn package_of(&self, file: &Path) -> Option<String> {
        let depth = |package: &Package| {
            let folder = package.manifest_path.parent()?;
            file.starts_with(folder).then(|| folder.components().count())
        };
        let inside = self.packages.iter().filter_map(|package| Some((depth(package)?, package)));
        inside.max_by_key(|(depth, _)| *depth).map(|(_, package)| package.name.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_belongs_to_the_innermost_member() {
        let packages = ["host", "host/bake", "kernel"].map(|name| Package {
            name: name.to_owned(),
            manifest_path: Path::new(name).join("Cargo.toml"),
        });
        let workspace = Workspace { packages: packages.into() };
        let of = |file| workspace.package_of(Path::new(file));
        assert_eq!(of("host/bake/src/lib.rs").as_deref(), Some("host/bake"));
        assert_eq!(of("host/src/main.rs").as_deref(), Some("host"));
        assert_eq!((of("docs/c.md"), of("kernels/a.rs")), (None, None));
    }
}
