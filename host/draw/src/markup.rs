//! The frame of every page, the marks of checks, what is folded away, and sentences as readers like them: what is one
//! of several stands on a line of its own.

use super::svg::{STYLE, escape};

/// The page around its body.
pub fn frame(title: &str, body: &str) -> String {
    let title = escape(title);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{body}</body>\n</html>\n"
    )
}

/// ✓ or ✗.
pub fn mark(passed: bool) -> &'static str {
    if passed {
        "<span class=\"mark pass\" role=\"img\" aria-label=\"pass\">✓</span>"
    } else {
        "<span class=\"mark fail\" role=\"img\" aria-label=\"FAIL\">✗</span>"
    }
}

/// Entries, a line each, between the tags `open` and `close`; nothing where there is no entry.
pub fn enclosed(open: &str, entries: impl Iterator<Item = String>, close: &str) -> String {
    let entries: String = entries.map(|entry| entry + "\n").collect();
    if entries.is_empty() { entries } else { format!("{open}\n{entries}{close}\n") }
}

/// A list in the look of `class`, an entry a text.
pub fn list(class: &str, texts: &[impl AsRef<str>]) -> String {
    let entries = texts.iter().map(|text| format!("<li>{}</li>", typeset(text.as_ref())));
    enclosed(&format!("<ul class=\"{class}\">"), entries, "</ul>")
}

/// The text as HTML, with its powers of a half raised.
pub fn typeset(text: &str) -> String {
    escape(text).replace("^½", "<sup>½</sup>").replace("^−½", "<sup>−½</sup>")
}

/// A block that opens below its summary; nothing where there is nothing in it.
pub fn folded(summary: &str, body: &str) -> String {
    if body.is_empty() {
        return String::new();
    }
    format!("<details>\n<summary>{summary}</summary>\n{body}</details>\n")
}

/// The text as HTML; where it enumerates, its parts become a list below what stands before the colon.
pub fn unrolled(text: &str) -> String {
    match enumerated(text) {
        Some((lead, parts)) => format!("{}:\n{}", typeset(lead), list("parts", &parts)),
        None => typeset(text),
    }
}

/// Entries of a list; what one of them enumerates is folded below what stands before the colon.
pub fn findings(sentences: &[String]) -> String {
    let entry = |sentence: &String| match enumerated(sentence) {
        Some((lead, parts)) => folded(&typeset(lead), &list("parts", &parts)),
        None => typeset(sentence),
    };
    let entries = sentences.iter().map(|sentence| format!("<li>{}</li>", entry(sentence)));
    enclosed("<ul class=\"findings\">", entries, "</ul>")
}

/// The words before the colon of a text and what they enumerate, where there is more than one thing.
fn enumerated(text: &str) -> Option<(&str, Vec<&str>)> {
    let (lead, rest) = text.split_once(": ")?;
    let parts: Vec<&str> = rest.split("; ").flat_map(counts).collect();
    (!lead.is_empty() && parts.len() > 1).then_some((lead, parts))
}

/// The parts of an enumeration by commas, each of which tells a number; anything else stays whole.
fn counts(clause: &str) -> Vec<&str> {
    let parts: Vec<&str> = clause.split(", ").collect();
    let tells = |part: &&str| part.contains(|letter: char| letter.is_ascii_digit());
    if parts.len() > 2 && parts.iter().all(tells) { parts } else { vec![clause] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_enumeration_is_a_list() {
        let text = "On the host, scalar: f32 wins 3 of 4, f64 1 of 4, both 0 of 4; x < y";
        let parts = ["f32 wins 3 of 4", "f64 1 of 4", "both 0 of 4", "x < y"];
        assert_eq!(unrolled(text), format!("On the host, scalar:\n{}", list("parts", &parts)));
        assert!(list("parts", &parts).contains("<li>x &lt; y</li>"));
        let found = findings(&[text.to_owned(), "plain".to_owned()]);
        assert!(found.contains("<summary>On the host, scalar</summary>\n<ul"), "{found}");
        assert!(found.contains("<li>plain</li>") && folded("empty", "").is_empty());
    }

    #[test]
    fn a_root_is_raised() {
        assert_eq!(typeset("‖A^½∇u‖ < ‖A^−½σ‖"), "‖A<sup>½</sup>∇u‖ &lt; ‖A<sup>−½</sup>σ‖");
    }

    #[test]
    fn a_plain_sentence_stays_one() {
        for text in ["s, τ and σ", "one: two, three and 4", "first; second", "a: b", ""] {
            assert_eq!(unrolled(text), text);
        }
        let clause = "its pair s, τ is off by 1 %, at most 2 %";
        assert_eq!(counts(clause), [clause]);
        assert!(list("parts", &[""; 0]).is_empty());
    }
}
