//! `cargo xtask imports`: no two files import each other, and no two folders at the top of a crate; each crate depends on
//! those before it alone.
//!
//! A file and its own folder, `a.rs` or `a/mod.rs` and `a/b.rs`, may name each other. Tests may name everything.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::steps::Steps;
use signorini_image::cargo::root;

/// The crates, each with those of this project that it may depend on.
const CRATES: [(&str, &[&str]); 21] = [
    ("kernel", &[]),
    ("kernel/bound", &["kernel"]),
    ("kernel/contact", &["kernel"]),
    ("kernel/device", &["kernel", "bound", "contact"]),
    ("host/draw", &[]),
    ("host/image", &[]),
    ("host/scene", &["kernel"]),
    ("host/reference", &[]),
    ("host/problem", &["kernel", "bound", "device", "scene"]),
    ("host/certify", &["kernel", "bound", "scene", "problem"]),
    ("host/solve", &["kernel", "contact", "device", "scene", "reference", "problem", "certify"]),
    ("host/condense", &["kernel", "bound", "scene", "reference", "problem", "certify", "solve"]),
    ("host/intervals", &["kernel", "scene", "problem", "certify", "solve"]),
    ("host/files", &["kernel", "scene", "problem", "certify", "solve", "intervals"]),
    (
        "host/bake",
        &[
            "kernel",
            "scene",
            "image",
            "reference",
            "problem",
            "certify",
            "solve",
            "condense",
            "intervals",
        ],
    ),
    (
        "host/session",
        &[
            "kernel",
            "bound",
            "device",
            "scene",
            "problem",
            "certify",
            "solve",
            "condense",
            "intervals",
            "bake",
        ],
    ),
    (
        "host/lab",
        &[
            "kernel",
            "scene",
            "draw",
            "image",
            "reference",
            "problem",
            "certify",
            "solve",
            "condense",
            "intervals",
            "files",
            "bake",
            "session",
        ],
    ),
    (
        "host",
        &[
            "scene", "draw", "image", "problem", "solve", "condense", "files", "bake", "session",
            "lab",
        ],
    ),
    ("tests/tolerances", &[]),
    (
        "tests",
        &[
            "kernel",
            "scene",
            "problem",
            "certify",
            "solve",
            "condense",
            "files",
            "bake",
            "session",
            "tolerances",
        ],
    ),
    ("xtask", &["image"]),
];

/// The path of a module in its crate.
type Module = Vec<String>;

/// Files with what they hold, tests and comments left out.
type Files = BTreeMap<Module, String>;

/// Two steps per crate.
pub fn run(steps: &mut Steps) {
    for (of, before) in CRATES {
        steps.check(&format!("no circle of imports in {of}"), || {
            let mut files = Files::new();
            read(&root().join(of).join("src"), &[], &mut files)?;
            let circles = circles(&files);
            if circles.is_empty() { Ok(()) } else { Err(circles.join("; ")) }
        });
        steps.check(&format!("{of} depends on the crates before it alone"), || {
            let path = root().join(of).join("Cargo.toml");
            let manifest = fs::read_to_string(&path)
                .map_err(|error| format!("{}: {error}", path.display()))?;
            match beyond(&manifest, before) {
                found if found.is_empty() => Ok(()),
                found => Err(format!("{of} depends on {}", found.join(", "))),
            }
        });
    }
}

/// The crates of this project under `[dependencies]` of a manifest that are none of `before`.
fn beyond(manifest: &str, before: &[&str]) -> Vec<String> {
    let section = manifest.split("\n[").find(|section| section.starts_with("dependencies]"));
    let names = section.unwrap_or_default().lines().filter_map(|line| {
        let name = line.strip_prefix("signorini-")?.split(['.', ' ', '=']).next()?;
        (!before.contains(&name)).then(|| name.to_owned())
    });
    names.collect()
}

/// The files below `folder`, which is the module `at`.
fn read(folder: &Path, at: &[String], files: &mut Files) -> Result<(), String> {
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    for entry in fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let module: Module = match name.as_str() {
            "mod" | "lib" | "main" => at.to_vec(),
            _ => at.iter().cloned().chain([name.clone()]).collect(),
        };
        if name == "tests" {
            continue;
        }
        if path.is_dir() {
            read(&path, &module, files)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(&path).map_err(failed)?;
            files.insert(module, code(&text));
        }
    }
    Ok(())
}

/// The lines before its own tests, without comments.
fn code(text: &str) -> String {
    let before = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    let lines = before.lines().map(|line| line.split("//").next().unwrap_or_default());
    lines.collect::<Vec<_>>().join("\n")
}

/// Files that import each other, perhaps through others, then pairs of folders.
fn circles(files: &Files) -> Vec<String> {
    let only_tests: BTreeSet<Module> =
        files.iter().flat_map(|(at, text)| test_modules(at, text)).collect();
    let counts = |module: &Module| !only_tests.iter().any(|test| module.starts_with(test));
    let imports: BTreeMap<&Module, BTreeSet<Module>> = files
        .iter()
        .filter(|(at, _)| counts(at))
        .map(|(at, text)| (at, imported(at, text, files)))
        .collect();
    let related = |a: &Module, b: &Module| a.starts_with(b) || b.starts_with(a);
    let next = |at: &Module| {
        let others = imports.get(at).into_iter().flatten();
        others.filter(|other| counts(other) && !related(at, other)).cloned().collect::<Vec<_>>()
    };
    let beyond: BTreeMap<&Module, BTreeSet<Module>> =
        imports.keys().map(|&at| (at, reached(at, next))).collect();
    let mut found = BTreeSet::new();
    let mut folders = BTreeSet::new();
    for (&at, others) in &imports {
        let back = |other: &Module| beyond.get(other).is_some_and(|reached| reached.contains(at));
        let circle: BTreeSet<_> = beyond[at].iter().filter(|other| back(other)).collect();
        if circle.contains(at) {
            let names: Vec<_> = circle.iter().map(|module| module.join("::")).collect();
            found.insert(format!("{} import each other", names.join(" and ")));
        }
        for other in others.iter().filter(|other| counts(other)) {
            if let (Some(from), Some(to)) = (at.first(), other.first()) {
                folders.insert((from.clone(), to.clone()));
            }
        }
    }
    for (from, to) in &folders {
        if from != to && folders.contains(&(to.clone(), from.clone())) {
            found.insert(pair(from, to));
        }
    }
    found.into_iter().collect()
}

/// All modules that imports lead to from `at`; `at` itself where a circle leads back.
fn reached(at: &Module, next: impl Fn(&Module) -> Vec<Module>) -> BTreeSet<Module> {
    let (mut reached, mut ahead) = (BTreeSet::new(), next(at));
    while let Some(module) = ahead.pop() {
        if reached.insert(module.clone()) {
            ahead.extend(next(&module));
        }
    }
    reached
}

fn pair(a: &str, b: &str) -> String {
    let (a, b) = if a < b { (a, b) } else { (b, a) };
    format!("{a} and {b} import each other")
}

/// Modules that only tests have: `#[cfg(test)]` before `mod NAME;`.
fn test_modules(at: &Module, text: &str) -> Vec<Module> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let tests = lines.windows(2).filter(|pair| pair[0] == "#[cfg(test)]");
    let names = tests.filter_map(|pair| pair[1].split_once("mod ")?.1.strip_suffix(';'));
    names.map(|name| at.iter().cloned().chain([name.to_owned()]).collect()).collect()
}

/// The files that `text`, the module `at`, names.
fn imported(at: &Module, text: &str, files: &Files) -> BTreeSet<Module> {
    let uses = text.split("use ").skip(1).filter_map(|rest| rest.split_once(';'));
    let uses = uses.flat_map(|(tree, _)| expanded(tree));
    let words = text.split(|letter: char| !(letter.is_alphanumeric() || "_:".contains(letter)));
    let paths = words.filter(|word| word.starts_with("crate::") || word.starts_with("super::"));
    let all = uses.chain(paths.map(str::to_owned));
    let found = all.filter_map(|path| resolved(at, &path, files));
    found.filter(|module| module != at).collect()
}

/// `a::{b, c::{d, e}}` as `a::b`, `a::c::d`, `a::c::e`.
fn expanded(tree: &str) -> Vec<String> {
    let tree = tree.trim();
    let Some((head, rest)) = tree.split_once('{') else { return vec![tree.to_owned()] };
    let (mut depth, mut part, mut parts) = (0_usize, String::new(), Vec::new());
    for letter in rest.trim_end().trim_end_matches('}').chars().chain([',']) {
        match letter {
            ',' if depth == 0 => parts.push(std::mem::take(&mut part)),
            _ => {
                depth = match letter {
                    '{' => depth + 1,
                    '}' => depth.saturating_sub(1),
                    _ => depth,
                };
                part.push(letter);
            }
        }
    }
    let inside = parts.iter().filter(|part| !part.trim().is_empty());
    inside.flat_map(|part| expanded(part)).map(|path| format!("{head}{path}")).collect()
}

/// The file that holds what `path` names, if it is one of `files`.
fn resolved(at: &Module, path: &str, files: &Files) -> Option<Module> {
    let mut words =
        path.split("::").map(|word| word.split(" as ").next().unwrap_or_default().trim());
    let mut whole: Module = at.clone();
    let first = words.next()?;
    match first {
        "crate" => whole.clear(),
        "self" => {}
        "super" => {
            whole.pop();
        }
        _ => {
            whole.push(first.to_owned());
            files.get(&whole)?;
        }
    }
    for word in words {
        match word {
            "super" => {
                whole.pop();
            }
            _ => whole.push(word.to_owned()),
        }
    }
    while !whole.is_empty() && !files.contains_key(&whole) {
        whole.pop();
    }
    (!whole.is_empty()).then_some(whole)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(files: &[(&str, &str)]) -> Vec<String> {
        let module = |name: &str| name.split("::").map(str::to_owned).collect::<Module>();
        circles(&files.iter().map(|(name, text)| (module(name), code(text))).collect())
    }

    #[test]
    fn two_files_that_name_each_other_are_found() {
        let mesh = ("mesh", "use crate::solve::{Options, limits::Most};\n");
        assert_eq!(of(&[mesh, ("solve", "use crate::scene;\n")]), Vec::<String>::new());
        let found = of(&[mesh, ("solve", "fn f() { crate::mesh::read(); }\n")]);
        assert_eq!(found, ["mesh and solve import each other"]);
    }

    #[test]
    fn a_circle_of_three_files_is_found() {
        let [a, b] = [("m::a", "use super::b;\n"), ("m::b", "use super::c;\n")];
        assert_eq!(of(&[a, b, ("m::c", "fn f() {}\n")]), Vec::<String>::new());
        let found = of(&[a, b, ("m::c", "use super::a::x;\n")]);
        assert_eq!(found, ["m::a and m::b and m::c import each other"]);
    }

    #[test]
    fn a_crate_that_comes_later_is_found() {
        let manifest = "[package]\nname = \"a\"\n\n[dependencies]\nsignorini-scene.workspace = true\n\
                        signorini-lab = { path = \"lab\" }\ncsv = \"1\"\n\n\
                        [dev-dependencies]\nsignorini-bake.workspace = true\n";
        assert_eq!(beyond(manifest, &["scene"]), ["lab"]);
        assert_eq!(beyond(manifest, &["scene", "lab"]), Vec::<String>::new());
    }

    #[test]
    fn folders_count_and_own_modules_do_not() {
        let own = [("a", "mod b;\nuse b::x;\n"), ("a::b", "use super::y;\n")];
        assert_eq!(of(&own), Vec::<String>::new());
        let folders = [
            ("a", "mod b;\n"),
            ("a::b", "use crate::c::d;\n"),
            ("c", "mod e;\n"),
            ("c::e", "use crate::a;\n"),
        ];
        assert_eq!(of(&folders), ["a and c import each other"]);
    }

    #[test]
    fn comments_and_tests_may_name_everything() {
        let mesh = ("mesh", "use crate::solve;\n");
        let solve = "/// See [`crate::mesh`].\n#[cfg(test)]\nmod tests {\nuse crate::mesh;\n}\n";
        assert_eq!(of(&[mesh, ("solve", solve)]), Vec::<String>::new());
        let tried =
            [("solve", "#[cfg(test)]\nmod tried;\n"), ("solve::tried", "use crate::mesh;\n")];
        assert_eq!(of(&[mesh, tried[0], tried[1]]), Vec::<String>::new());
    }
}
