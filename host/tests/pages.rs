//! The page on scene files: its examples are read, and no key that a scene may have is missing.

use std::path::Path;

use miette::Diagnostic as _;
use signorini_scene::scene::Scene;

use crate::command::{repository, text};

/// A page of the repository.
fn page(name: &str) -> String {
    text(repository(name))
}

/// The first block of TOML on a page.
fn example(page: &str) -> &str {
    let (_, rest) = page.split_once("```toml\n").expect("a block of TOML");
    rest.split_once("```").expect("its end").0
}

#[test]
fn examples_are_scenes() {
    for name in ["README.md", "docs/scene.md"] {
        let page = page(name);
        Scene::parse(example(&page), Path::new(name)).expect(name);
    }
    // A piece of a scene: the levee has it.
    let (page, levee) = (page("docs/firmware.md"), page("meshes/scenes/levee.toml"));
    let (head, _) = levee.split_once("[input.").expect("inputs");
    Scene::parse(&(head.to_owned() + example(&page)), Path::new("levee.toml")).expect("a piece");
}

/// The keys that are allowed beside a wrong one: the error lists them.
fn allowed(text: &str) -> Vec<String> {
    let error = Scene::parse(text, Path::new("wrong.toml")).expect_err(text);
    let hint = error.help().expect("a hint").to_string();
    let (_, keys) = hint.split_once("allowed here: ").unwrap_or_else(|| panic!("{hint}"));
    keys.split(", ").map(str::to_owned).collect()
}

#[test]
fn the_page_has_every_key() {
    let page = page("docs/scene.md");
    let whole = example(&page);
    let table = |name: &str, keys: &str| format!("{whole}\n[{name}]\n{keys}\nwrong = 1\n");
    let boundary = |kind: &str| table("boundary.more", &format!("kind = \"{kind}\""));
    let output = |kind: &str| table("output.more", &format!("kind = \"{kind}\""));
    let extended = |name: &str| {
        let header = format!("[{name}]\n");
        whole.replace(&header, &format!("{header}wrong = 1\n"))
    };
    let asked = [
        ("", vec![format!("wrong = 1\n{whole}")]),
        ("material.NAME.", vec![table("material.more", "")]),
        ("source.", vec![extended("source")]),
        ("boundary.NAME.", vec![boundary("dirichlet"), boundary("neumann")]),
        ("boundary.NAME.", vec![boundary("robin"), boundary("contact")]),
        ("input.NAME.", vec![table("input.more", "")]),
        ("output.NAME.", vec![output("flux"), output("force"), output("length")]),
        ("output.NAME.", vec![output("probe"), output("bound")]),
        ("target.", vec![table("target", "")]),
        ("time.", vec![extended("time")]),
        ("exact.", vec![table("exact", "")]),
        ("setting.", vec![table("setting", "")]),
    ];
    let tables =
        ["material", "source", "boundary", "input", "output", "target", "time", "exact", "setting"];
    let mut missing = Vec::new();
    for (prefix, texts) in &asked {
        for key in texts.iter().flat_map(|text| allowed(text)) {
            let is_known = prefix.is_empty() && tables.contains(&key.as_str());
            if !is_known && !page.contains(&format!("\n| `{prefix}{key}` |")) {
                missing.push(format!("{prefix}{key}"));
            }
        }
    }
    assert!(missing.is_empty(), "docs/scene.md lacks {missing:?}");
}
