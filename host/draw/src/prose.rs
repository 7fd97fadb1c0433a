//! Sentences as readers like them: what is one of several stands on a line of its own.

use std::fmt::Write;

use super::svg::escape;

/// A list in the look of `class`, an entry a text.
pub fn list(class: &str, texts: &[impl AsRef<str>]) -> String {
    if texts.is_empty() {
        return String::new();
    }
    let mut html = format!("<ul class=\"{class}\">\n");
    for text in texts {
        let _ = writeln!(html, "<li>{}</li>", escape(text.as_ref()));
    }
    html + "</ul>\n"
}

/// The text as HTML; where it enumerates, its parts become a list below what stands before the colon.
pub fn unrolled(text: &str) -> String {
    let (lead, rest) = text.split_once(": ").unwrap_or(("", text));
    let parts: Vec<&str> = rest.split("; ").flat_map(counts).collect();
    if lead.is_empty() || parts.len() < 2 {
        return escape(text);
    }
    format!("{}:\n{}", escape(lead), list("parts", &parts))
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
