//! The frame of every page, and the marks of checks.

use super::svg::escape;

/// The colours and measures of every page and picture.
pub(super) const STYLE: &str = include_str!("style.css");

/// The page around its body.
pub(super) fn frame(title: &str, body: &str) -> String {
    let title = escape(title);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{body}</body>\n</html>\n"
    )
}

/// ✓ or ✗.
pub(super) fn mark(passed: bool) -> &'static str {
    if passed {
        "<span class=\"mark pass\" role=\"img\" aria-label=\"pass\">✓</span>"
    } else {
        "<span class=\"mark fail\" role=\"img\" aria-label=\"FAIL\">✗</span>"
    }
}
