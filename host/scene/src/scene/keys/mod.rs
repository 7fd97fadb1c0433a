//! Every key of a scene file, with what it means: one list for the reader, the page, the schema and new scenes.
//!
//! | who | takes from it |
//! |---|---|
//! | `scene::table` | which keys a table may hold |
//! | `docs/scene.md` | its table of keys, which a test of the command writes |
//! | `signorini schema` | the JSON Schema ([`super::schema`]) |
//! | `signorini new` | the comments below each group |

mod list;

pub use list::SECTIONS;

/// A table of a scene file, or one kind of such a table.
#[derive(Debug, Clone, Copy)]
pub struct Section {
    /// The header, `boundary.NAME`; empty for what stands above all tables.
    pub header: &'static str,
    /// The value of its key `kind`, where it has kinds.
    pub kind: Option<&'static str>,
    /// The table in words, as messages have it: "a robin boundary".
    pub what: &'static str,
    /// Its kind in words; empty where it has none.
    pub about: &'static str,
    /// The keys that it may hold, `kind` left out.
    pub keys: &'static [Key],
}

/// A key.
#[derive(Debug, Clone, Copy)]
pub struct Key {
    /// Its name.
    pub name: &'static str,
    /// How its value is written.
    pub value: Value,
    /// What it means, in Markdown.
    pub meaning: &'static str,
    /// The unit of its value; empty where it has none.
    pub unit: &'static str,
    /// What holds where it is left out; nothing where it must be there.
    pub default: Option<&'static str>,
}

/// How a value is written.
#[derive(Debug, Clone, Copy)]
pub enum Value {
    /// Any text.
    Text,
    /// A text of 1 to 24 characters.
    Unit,
    /// One of these words.
    Word(fn() -> Vec<&'static str>),
    /// A number, or an expression.
    Expression,
    /// An expression, or an infinity.
    End,
    /// An expression, or an array of one or three of them.
    Tensor,
    /// An array of two expressions.
    Gradient,
    /// A number.
    Number,
    /// An array of two numbers.
    Pair,
    /// A number > 0.
    Positive,
    /// A number inside (0, 1).
    Share,
    /// A whole number from here to there.
    Whole(u32, u32),
    /// A positive whole number.
    Bytes,
    /// True or false.
    Boolean,
    /// The name of a table.
    Name,
    /// The name of a table, or a list of such names.
    Names,
    /// A number inside (0, 2), or "auto".
    Omega,
    /// A number > 0, or a part such as "5%".
    Goal,
}

impl Key {
    /// A value to begin with, as TOML.
    pub fn sample(&self) -> String {
        let text = match self.value {
            Value::Word(words) => return format!("{:?}", words().first().unwrap_or(&"")),
            Value::Text | Value::Name | Value::Names => "\"NAME\"",
            Value::Unit => "\"m\"",
            Value::End if self.name == "limit" => "\"inf\"",
            Value::Expression if self.name == "initial" => "\"steady\"",
            Value::Tensor | Value::Positive | Value::Bytes => "1",
            Value::Gradient | Value::Pair => "[0, 0]",
            Value::Expression | Value::End | Value::Number => "0",
            Value::Whole(least, _) => return least.to_string(),
            Value::Share => "0.01",
            Value::Boolean => "true",
            Value::Omega => "\"auto\"",
            Value::Goal => "\"5%\"",
        };
        text.to_owned()
    }

    /// Its meaning in plain text, with unit and default.
    pub fn described(&self) -> String {
        let unit = Some(plain(self.unit)).filter(|unit| !unit.is_empty());
        let unit = unit.map_or_else(String::new, |unit| format!(" [{unit}]"));
        let default =
            self.default.map_or_else(String::new, |of| format!("; default {}", plain(of)));
        format!("{}{}{unit}{default}", self.words(), plain(self.meaning))
    }

    /// The words that its value may be, where its meaning does not tell them: "a, b or c: ".
    pub fn words(&self) -> String {
        match self.value {
            Value::Word(words) if !self.meaning.contains('`') => format!("{}: ", listed(&words())),
            _ => String::new(),
        }
    }
}

/// "a, b or c".
pub fn listed(words: &[&str]) -> String {
    match words {
        [most @ .., last] if !most.is_empty() => format!("{} or {last}", most.join(", ")),
        words => words.join(", "),
    }
}

impl Section {
    /// The section of this table: of this kind, where it has kinds.
    pub fn of(header: &str, kind: Option<&str>) -> Option<&'static Self> {
        Self::all(header).find(|section| section.kind == kind)
    }

    /// All sections of this table.
    pub fn all(header: &str) -> impl Iterator<Item = &'static Self> {
        SECTIONS.iter().filter(move |section| section.header == header)
    }

    /// The kinds of this table.
    pub fn kinds(header: &str) -> impl Iterator<Item = &'static str> {
        Self::all(header).filter_map(|of| of.kind)
    }

    /// The names of its keys.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        let kind = self.kind.map(|_| "kind");
        kind.into_iter().chain(self.keys.iter().map(|key| key.name))
    }

    /// Whether its header has a name of the user's.
    pub fn is_named(&self) -> bool {
        self.header.ends_with(".NAME")
    }

    /// The first part of its header.
    pub fn table(&self) -> &'static str {
        self.header.strip_suffix(".NAME").unwrap_or(self.header)
    }
}

/// The tables of a scene, each once.
pub fn tables() -> Vec<&'static str> {
    let mut tables: Vec<_> =
        SECTIONS.iter().map(Section::table).filter(|t| !t.is_empty()).collect();
    tables.dedup();
    tables
}

/// Markdown without its links and marks, and without references in brackets: `[energy_norm](accuracy.md)` is "energy_norm".
pub fn plain(markdown: &str) -> String {
    let mut plain = String::new();
    let mut rest = markdown;
    while let Some((before, after)) = rest.split_once("](") {
        plain.push_str(before);
        rest = after.split_once(')').map_or("", |(_, rest)| rest);
        let Some(open) = plain.rfind('[') else { continue };
        match (plain[..open].strip_suffix(" ("), rest.strip_prefix(')')) {
            (Some(head), Some(tail)) => {
                rest = tail;
                plain.truncate(head.len());
            }
            _ => drop(plain.remove(open)),
        }
    }
    plain.push_str(rest);
    plain.replace('`', "")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_are_left_out_of_plain_text() {
        assert_eq!(plain("a scalar or [axx, axy, ayy]"), "a scalar or [axx, axy, ayy]");
        assert_eq!(plain("error ([how](accuracy.md#x)): `f` or [g](h)."), "error: f or g.");
    }

    #[test]
    fn each_table_has_one_section_or_one_per_kind() {
        for section in SECTIONS {
            let same = SECTIONS.iter().filter(|other| other.header == section.header);
            let alike = same.filter(|other| other.kind == section.kind || other.kind.is_none());
            assert_eq!(alike.count(), 1, "{section:?}");
            let mut names: Vec<_> = section.names().collect();
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), section.names().count(), "{section:?}");
        }
    }
}
