//! Comments in C: in lines, and with nothing in them that ends one.

/// The scene's own words, in which nothing is replaced by its name.
pub(super) fn as_is(text: &str) -> String {
    text.replace("NAME", &format!("N{MARK}AME")).replace("name_", &format!("n{MARK}ame_"))
}

/// What keeps the scene's words apart from the header's; it is taken out at the end.
pub(super) const MARK: &str = "\u{0}";

/// A comment in lines.
pub(super) fn comment(text: &str, indent: &str) -> String {
    let lines = wrapped(text, &format!("{indent} * "));
    let first = lines.trim_start().trim_start_matches("* ");
    format!("{indent}/* {first} */")
}

/// Text in lines with a margin, and nothing in it that ends a comment, begins another, or is a trigraph.
pub(super) fn wrapped(text: &str, margin: &str) -> String {
    let safe = text.replace("*/", "* /").replace("/*", "/ *").replace("??", "? ?");
    let (mut lines, mut line) = (Vec::new(), String::new());
    for word in safe.split_whitespace() {
        if !line.is_empty() && line.chars().count() + word.chars().count() > WIDTH {
            lines.push(format!("{margin}{}", line.trim_end()));
            line.clear();
        }
        line += word;
        line.push(' ');
    }
    lines.push(format!("{margin}{}", line.trim_end()));
    lines.join("\n")
}

const WIDTH: usize = 110;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_text_ends_a_comment() {
        let text = comment("u = 2*/x and /* more ??/", "    ");
        assert_eq!(text, "    /* u = 2* /x and / * more ? ?/ */");
    }

    #[test]
    fn long_comments_have_a_margin() {
        let text = comment(&"word ".repeat(40), "");
        let lines: Vec<_> = text.lines().collect();
        assert!(
            lines.len() == 2 && lines[0].starts_with("/* word") && lines[1].starts_with(" * word"),
            "{text}"
        );
        assert!(lines.iter().all(|line| line.len() < 120));
    }
}
