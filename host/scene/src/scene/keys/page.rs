//! The list of keys as a table of Markdown.

use super::{Key, SECTIONS, Section, listed};

/// The line that stands before the table on the page, and the one behind it.
pub const MARKS: [&str; 2] = ["<!-- keys: written by a test -->\n", "<!-- end of keys -->\n"];

/// The table, a row per key and kind.
pub fn table() -> String {
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
