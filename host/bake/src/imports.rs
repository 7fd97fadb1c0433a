//! The `use` lines of a generated module.

/// `use` of those names that the text, comments aside, has as words.
pub(super) fn imports(known: &[(&str, &str)], text: &str, indent: &str) -> String {
    let code = text.lines().filter(|line| !line.trim_start().starts_with("///"));
    let text = code.collect::<Vec<_>>().join("\n");
    let is_named = |name: &str| {
        text.match_indices(name).any(|(at, _)| {
            let before = text[..at].chars().next_back().unwrap_or(' ');
            let after = text[at + name.len()..].chars().next().unwrap_or(' ');
            let inside = |letter: char| letter.is_alphanumeric() || letter == '_';
            !inside(before) && !inside(after)
        })
    };
    let used = known.iter().filter(|(name, _)| is_named(name));
    let line = |(_, path): &(&str, &str)| format!("{indent}use signorini_device::{path};\n");
    "\n".to_owned() + &used.map(line).collect::<String>()
}
