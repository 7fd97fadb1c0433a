//! The sections of a page, and the contents that lead to them.

use std::fmt::Write;

/// A part of the page with a heading.
pub struct Section {
    /// The name in links to it.
    pub id: &'static str,
    /// Its heading.
    pub heading: &'static str,
    /// How much there is of what; may be empty.
    pub extent: String,
    /// Everything below the heading, as HTML.
    pub body: String,
}

impl Section {
    /// The section as HTML.
    pub fn html(&self) -> String {
        let Self { id, heading, body, .. } = self;
        format!("<section id=\"{id}\">\n<h2>{heading}</h2>\n{body}</section>\n")
    }
}

/// Links to the sections, in their order; nothing where there is none.
pub fn contents(sections: &[Section]) -> String {
    if sections.is_empty() {
        return String::new();
    }
    let mut html = String::from("<nav aria-label=\"Contents\">\n<h2>Contents</h2>\n<ul>\n");
    for Section { id, heading, extent, .. } in sections {
        let _ = writeln!(html, "<li><a href=\"#{id}\">{heading}</a><small>{extent}</small></li>");
    }
    html + "</ul>\n</nav>\n"
}

/// `1 run`, `9 runs`
pub fn counted(count: usize, noun: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{plural}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_section_no_contents() {
        assert_eq!(contents(&[]), "");
        assert_eq!([0, 1, 2].map(|count| counted(count, "run")), ["0 runs", "1 run", "2 runs"]);
    }
}
