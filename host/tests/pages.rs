//! The page on scene files: its examples are read, and no key that a scene may have is missing.

use std::path::Path;

use signorini_scene::scene::Scene;
use signorini_scene::scene::keys::{Key, SECTIONS, Section, listed};

use crate::command::{repository, text};

/// The first block of TOML on a page.
fn example(page: &str) -> &str {
    let (_, rest) = page.split_once("```toml\n").expect("a block of TOML");
    rest.split_once("```").expect("its end").0
}

#[test]
fn examples_are_scenes() {
    for name in ["README.md", "docs/scene.md"] {
        let page = text(repository(name));
        Scene::parse(example(&page), Path::new(name)).expect(name);
    }
    // A piece of a scene: the levee has it.
    let [page, levee] =
        ["docs/firmware.md", "meshes/scenes/levee.toml"].map(|name| text(repository(name)));
    let (head, _) = levee.split_once("[input.").expect("inputs");
    Scene::parse(&(head.to_owned() + example(&page)), Path::new("levee.toml")).expect("a piece");
}

/// The line that stands before the table on the page, and the one behind it.
const MARKS: [&str; 2] = ["<!-- keys: written by a test -->\n", "<!-- end of keys -->\n"];

/// The table, a row per key and kind.
fn table() -> String {
    let head = "| key | meaning | unit | default |\n|---|---|---|---|\n".to_owned();
    let mut known = "";
    SECTIONS.iter().fold(head, |rows, section| {
        let kinds = (section.kind.is_some() && section.header != known).then(|| kinds(section));
        known = section.header;
        let keys = section.keys.iter().map(|key| row(section, key));
        rows + &kinds.unwrap_or_default() + &keys.collect::<String>()
    })
}

fn kinds(section: &Section) -> String {
    let words: Vec<_> = Section::kinds(section.header).collect();
    format!("| `{}.kind` | {} | | required |\n", section.header, listed(&words))
}

fn row(section: &Section, key: &Key) -> String {
    let name = match section.header {
        "" => key.name.to_owned(),
        header => format!("{header}.{}", key.name),
    };
    let kind = section.kind.map_or_else(String::new, |kind| format!("{kind}: "));
    let default = key.default.unwrap_or("required");
    format!("| `{name}` | {kind}{}{} | {} | {default} |\n", key.words(), key.meaning, key.unit)
}

/// The table of keys on the page is that of the list which the reader of scenes goes by; `SIGNORINI_BLESS=1` writes it anew.
#[test]
fn the_page_has_every_key() {
    let page = text(repository("docs/scene.md"));
    let [begin, end] = MARKS;
    let (before, rest) = page.split_once(begin).expect("the mark before the table");
    let (_, after) = rest.split_once(end).expect("the mark behind the table");
    let expected = format!("{before}{begin}{}{end}{after}", table());
    if std::env::var_os("SIGNORINI_BLESS").is_some() {
        std::fs::write(repository("docs/scene.md"), &expected).expect("written");
    }
    for (own, other) in page.lines().zip(expected.lines()) {
        assert_eq!(own, other, "SIGNORINI_BLESS=1 writes the table anew");
    }
    assert_eq!(page.len(), expected.len());
}
