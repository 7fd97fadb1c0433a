//! Rust text: numbers that read back to the same bits, arrays in lines, identifiers from names, `use` lines; tables for
//! a terminal.

use std::collections::HashSet;
use std::fmt::Debug;

/// Columns of a line of numbers.
const WIDTH: usize = 96;

/// The entries of an array, with brackets, in lines. What [`Debug`] prints of numbers, arrays and records
/// is Rust, and of floating-point numbers the shortest text that reads back the same; ∞ is a constant of the module's `Scalar`.
pub fn array<T: Debug>(entries: &[T], indent: usize) -> String {
    let mut text = "[".to_owned();
    let mut width = WIDTH;
    for entry in entries {
        let entry = format!(" {entry:?},").replace("inf", "Scalar::INFINITY");
        width += entry.len();
        if width > WIDTH {
            text += &format!("\n{:indent$}   ", "");
            width = indent + 3 + entry.len();
        }
        text += &entry;
    }
    if entries.is_empty() { text + "]" } else { format!("{text}\n{:indent$}]", "") }
}

/// Text for a doc comment: one line, nothing in it that rustdoc would read as a link or as HTML.
pub fn prose(text: &str) -> String {
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut safe = String::with_capacity(words.len());
    for letter in words.chars() {
        if matches!(letter, '[' | ']' | '<' | '>' | '`' | '*' | '_' | '\\' | '|') {
            safe.push('\\');
        }
        safe.push(letter);
    }
    safe
}

/// Code for a doc comment: one line, in backticks.
pub fn code(text: &str) -> String {
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    format!("`{}`", words.replace('`', "'"))
}

/// One identifier a name, all different: lower-case letters, digits and single underscores.
pub fn identifiers<'n>(names: impl Iterator<Item = &'n str>) -> Vec<String> {
    let mut taken = HashSet::new();
    names
        .map(|name| {
            let first = identifier(name);
            let more = (2..).map(|number| format!("{first}_{number}"));
            let all = std::iter::once(first.clone()).chain(more);
            let mut free = all.filter(|identifier| !taken.contains(identifier));
            let chosen = free.next().unwrap_or_default();
            drop(free);
            taken.insert(chosen.clone());
            chosen
        })
        .collect()
}

/// Of a name without a letter or digit of ASCII its code points stand: such names differ as they do.
fn identifier(name: &str) -> String {
    let words = name.split(|letter: char| !letter.is_ascii_alphanumeric());
    let words: Vec<_> = words.filter(|word| !word.is_empty()).map(str::to_owned).collect();
    let words = match words.is_empty() {
        true => name.chars().map(|letter| format!("u{:x}", u32::from(letter))).collect(),
        false => words,
    };
    let joined = words.join("_").to_ascii_lowercase();
    match joined.chars().next() {
        None => "unnamed".to_owned(),
        Some(first) if first.is_ascii_digit() => format!("n{joined}"),
        Some(_) if is_among(KEYWORDS, &joined) => format!("{joined}_"),
        Some(_) => joined,
    }
}

/// Whether a word is one of `words`, which spaces part.
pub fn is_among(words: &str, word: &str) -> bool {
    words.split_whitespace().any(|known| known == word)
}

/// The words that Rust keeps for itself.
const KEYWORDS: &str = "\
    abstract as async await become box break const continue crate do dyn else enum extern false \
    final fn for gen if impl in let loop macro match mod move mut override priv pub ref return \
    self static struct super trait true try type typeof unsafe unsized use virtual where while \
    yield";

/// `use` of those items of the kernel, by their `paths`, whose names the text has as words, comments aside.
pub fn imports(paths: &str, text: &str, indent: &str) -> String {
    let code = text.lines().filter(|line| !line.trim_start().starts_with("///"));
    let is_inside = |letter: char| letter.is_alphanumeric() || letter == '_';
    let words: HashSet<_> = code.flat_map(|line| line.split(|letter| !is_inside(letter))).collect();
    let is_named = |path: &&str| path.rsplit("::").next().is_some_and(|name| words.contains(name));
    let used = paths.split_whitespace().filter(is_named);
    let lines = used.map(|path| format!("{indent}use signorini_device::{path};\n"));
    "\n".to_owned() + &lines.collect::<String>()
}

/// Rows in columns of their width, the first and the last to the left.
pub fn table<const N: usize>(rows: &[[String; N]]) -> String {
    let width =
        |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: [usize; N] = std::array::from_fn(width);
    let mut text = String::new();
    for row in rows {
        let cells = row.iter().zip(widths).enumerate().map(|(at, (cell, width))| match at {
            0 => format!("{cell:<width$}"),
            _ if at + 1 == N => cell.clone(),
            _ => format!("{cell:>width$}"),
        });
        let line: Vec<String> = cells.collect();
        text += line.join("  ").trim_end();
        text += "\n";
    }
    text
}

/// A number with five digits.
pub fn short(x: f64) -> String {
    let rounded: f64 = format!("{x:.4e}").parse().unwrap_or(x);
    // Rounding around 0.
    let rounded = if rounded == 0.0 { 0.0 } else { rounded };
    format!("{rounded:?}").trim_end_matches(".0").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_different_identifiers() {
        let names = ["rib foot", "rib-foot", "3rd", "type", "größe", "", "yield", "Air__T"];
        let expected =
            ["rib_foot", "rib_foot_2", "n3rd", "type_", "gr_e", "unnamed", "yield_", "air_t"];
        assert_eq!(identifiers(names.into_iter()), expected);
        // Each by itself, as the names of files are.
        let alone = |name: &str| identifiers(std::iter::once(name)).concat();
        assert_eq!(
            ["雪", "霜", "温度", "+", "Δ"].map(alone),
            ["u96ea", "u971c", "u6e29_u5ea6", "u2b", "u394"]
        );
    }

    #[test]
    fn numbers_read_back_the_same() {
        for x in [0.1_f32, 1e-30, 16_777_216.0, f32::MIN_POSITIVE, -0.0, 1.0 / 3.0] {
            let text = array(&[x], 0);
            let read: f32 =
                text.trim_matches(['[', ']', ',', ' ', '\n']).parse().expect("a number");
            assert_eq!(read.to_bits(), x.to_bits(), "{text}");
        }
    }

    #[test]
    fn infinity_has_a_name() {
        assert_eq!(
            array(&[-f32::INFINITY], 0).trim_matches(['[', ']', ',', ' ', '\n']),
            "-Scalar::INFINITY"
        );
    }

    #[test]
    fn prose_has_no_links() {
        assert_eq!(prose("head [m]\n <b>"), "head \\[m\\] \\<b\\>");
        assert_eq!(code("a`b\nc"), "`a'b c`");
    }
}
