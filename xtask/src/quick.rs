//! `cargo xtask quick`: format, clippy and tests of the packages that the working tree changes, or the last commit where it
//! changes nothing.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

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
                counted_by(test)
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
    let workspace = fs::read_to_string(root().join("Cargo.toml"));
    let workspace = workspace.map_err(|error| format!("Cargo.toml: {error}"))?;
    let members = members(&workspace);
    let folders = changed.iter().filter_map(|file| package_of(file, &members));
    let packages = folders.map(|folder| {
        let manifest = fs::read_to_string(root().join(&folder).join("Cargo.toml"));
        let manifest = manifest.map_err(|error| format!("{folder}: {error}"))?;
        name_in(&manifest).ok_or(format!("{folder}/Cargo.toml names no package"))
    });
    packages.collect()
}

fn git(words: &[&str]) -> Result<Vec<String>, String> {
    let said = output(Command::new("git").args(words).current_dir(root()))?;
    Ok(said.lines().map(str::to_owned).collect())
}

/// The folders of a workspace's members.
fn members(manifest: &str) -> Vec<String> {
    let list = manifest.split_once("\nmembers = [").and_then(|(_, rest)| rest.split_once(']'));
    let list = list.map_or("", |(list, _)| list);
    list.split('"').skip(1).step_by(2).map(str::to_owned).collect()
}

/// The innermost member that a file lies in.
fn package_of(file: &str, members: &[String]) -> Option<String> {
    let inside = members.iter().filter(|member| Path::new(file).starts_with(member));
    inside.max_by_key(|member| member.len()).cloned()
}

fn name_in(manifest: &str) -> Option<String> {
    let line = manifest.lines().find_map(|line| line.strip_prefix("name = \""))?;
    line.strip_suffix('"').map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_belongs_to_the_innermost_member() {
        let members = members(
            "[workspace]\nmembers = [\n  \"host\", \"host/bake\",\n  \"kernel\",\n]\nexclude = [\"host/c\"]\n",
        );
        assert_eq!(members, ["host", "host/bake", "kernel"]);
        let of = |file| package_of(file, &members);
        assert_eq!(of("host/bake/src/lib.rs").as_deref(), Some("host/bake"));
        assert_eq!(of("host/src/main.rs").as_deref(), Some("host"));
        assert_eq!((of("docs/c.md"), of("kernels/a.rs")), (None, None));
        assert_eq!(name_in("[package]\nname = \"a-b\"\n").as_deref(), Some("a-b"));
    }
}
