//! `cargo xtask package`: each crate builds from its own archive, as a registry would hold it. Nothing is published.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use serde::Deserialize;

use crate::steps::Steps;
use signorini_image::cargo::{cargo, run as run_cargo, target_dir};
use signorini_image::files;
use signorini_image::toolchain::output;

/// Packages of the workspace without an archive, and why. Their manifests say `publish = false`, those of all others do not.
const LEFT_OUT: [(&str, &str); 4] = [
    ("signorini-python", "its users have it as a wheel, which maturin builds"),
    ("signorini-tests", "it judges the others, by scenes and pages of the checkout"),
    ("signorini-tolerances", "tests alone need it, and archives are built without"),
    ("xtask", "it runs tasks in a checkout"),
];

/// The steps: archives are made; whatever is run, but with `--all` alone each is unpacked and built.
pub fn run(steps: &mut Steps) {
    list(steps);
    let name = match steps.is_whole() {
        true => "each crate builds from its own archive",
        false => "each crate has an archive",
    };
    let is_whole = steps.is_whole();
    steps.check(name, || archives(is_whole));
}

/// Each crate builds from its own archive.
pub fn verify(steps: &mut Steps) {
    list(steps);
    steps.check("each crate builds from its own archive", || archives(true));
}

/// The list holds the packages that no registry may have; the others say what a registry asks for.
fn list(steps: &mut Steps) {
    steps.lint("what archives are made of, and their metadata", || {
        let packages = packages()?;
        for (name, why) in LEFT_OUT {
            println!("left out: {name}: {why}");
        }
        let wrong: Vec<_> = packages.iter().filter_map(Package::complaint).collect();
        if wrong.is_empty() { Ok(()) } else { Err(wrong.join("; ")) }
    });
}

fn archives(are_built: bool) -> Result<(), String> {
    let mut package = cargo(&["package", "--workspace", "--allow-dirty", "--locked"]);
    package.args(LEFT_OUT.iter().flat_map(|(name, _)| ["--exclude", name]));
    if are_built {
        forget()?;
        // One folder for all: what they share is compiled once.
        package.env("CARGO_TARGET_DIR", target_dir("archives"));
        // Archives do not have the workspace's profiles.
        package.env("CARGO_PROFILE_DEV_DEBUG", "false");
    } else {
        package.arg("--no-verify");
    }
    run_cargo(package)
}

/// Removes what was unpacked and built of earlier archives: cargo takes equal versions for equal packages, so that a crate would be
/// built with what another one was.
fn forget() -> Result<(), String> {
    let home = || Some(PathBuf::from(env::var_os("HOME")?).join(".cargo"));
    let cargo = env::var_os("CARGO_HOME").map(PathBuf::from).or_else(home).unwrap_or_default();
    // Registries of the web have a name before their number.
    let unpacked = starting("-", &cargo.join("registry/src"));
    let built = target_dir("archives").join("debug/.fingerprint");
    unpacked.iter().chain([&built]).flat_map(|folder| starting("signorini", folder)).try_for_each(
        |old| fs::remove_dir_all(&old).map_err(|error| format!("{}: {error}", old.display())),
    )
}

/// The folders in a folder whose names start like this; none where there is no folder.
fn starting(name: &str, folder: &Path) -> Vec<PathBuf> {
    let mut folders = files::within(folder).unwrap_or_default();
    let is_named = |path: &PathBuf| {
        path.file_name().is_some_and(|own| own.to_string_lossy().starts_with(name))
    };
    folders.retain(is_named);
    folders
}

fn packages() -> Result<Vec<Package>, String> {
    let mut metadata: Command = cargo(&["metadata", "--no-deps", "--locked"]);
    let said = output(metadata.args(["--format-version", "1"]))?;
    let all: Workspace = serde_json::from_str(&said).map_err(|error| error.to_string())?;
    Ok(all.packages)
}

#[derive(Deserialize)]
struct Workspace {
    packages: Vec<Package>,
}

/// What cargo tells of a package.
#[derive(Debug, Default, Clone, Deserialize)]
struct Package {
    name: String,
    description: Option<String>,
    license: Option<String>,
    readme: Option<String>,
    keywords: Vec<String>,
    categories: Vec<String>,
    /// Registries; none is any.
    publish: Option<Vec<String>>,
}

impl Package {
    /// What is wrong with its manifest.
    fn complaint(&self) -> Option<String> {
        let name = &self.name;
        let is_left_out = LEFT_OUT.iter().any(|(left, _)| left == name);
        let may_be_published =
            self.publish.as_ref().is_none_or(|registries| !registries.is_empty());
        if is_left_out {
            return may_be_published
                .then(|| format!("{name} is left out, without publish = false"));
        }
        if !may_be_published {
            return Some(format!("{name} has publish = false, and is not on the list"));
        }
        let fields = [
            ("description", self.description.is_none()),
            ("license", self.license.is_none()),
            ("readme", self.readme.is_none()),
            ("keywords", self.keywords.is_empty()),
            ("categories", self.categories.is_empty()),
        ];
        let (field, _) = fields.into_iter().find(|(_, is_missing)| *is_missing)?;
        Some(format!("{name} has no {field}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_manifest_and_the_list_agree() {
        let some = || Some("some".to_owned());
        let whole = Package {
            name: "signorini".to_owned(),
            description: some(),
            license: some(),
            readme: some(),
            keywords: vec!["contact".to_owned()],
            categories: vec!["science".to_owned()],
            publish: None,
        };
        assert_eq!(whole.complaint(), None);
        let of = |package: Package| package.complaint().unwrap_or_default();
        assert!(of(Package { readme: None, ..whole.clone() }).contains("no readme"));
        let hidden = Package { publish: Some(Vec::new()), ..whole.clone() };
        assert!(of(hidden.clone()).contains("not on the list"));
        let xtask = |package| Package { name: "xtask".to_owned(), ..package };
        assert_eq!(xtask(hidden).complaint(), None);
        assert!(of(xtask(whole)).contains("without publish = false"));
    }
}
