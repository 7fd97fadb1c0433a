//! JSON, as much of it as a flat report needs.

/// A string.
pub fn string(text: &str) -> String {
    let escaped = |c: char| match c {
        '"' => "\\\"".to_owned(),
        '\\' => "\\\\".to_owned(),
        '\n' => "\\n".to_owned(),
        c if c < ' ' => format!("\\u{:04x}", u32::from(c)),
        c => c.to_string(),
    };
    format!("\"{}\"", text.chars().map(escaped).collect::<String>())
}

/// An object of values that are JSON already, a line each.
pub fn object(members: &[(&str, String)]) -> String {
    let member = |(name, value): &(&str, String)| format!("  {}: {value}", string(name));
    let lines: Vec<String> = members.iter().map(member).collect();
    format!("{{\n{}\n}}\n", lines.join(",\n"))
}

/// An object on one line.
pub fn record<'a>(members: impl IntoIterator<Item = (&'a str, String)>) -> String {
    let member = |(name, value)| format!("{}: {value}", string(name));
    format!("{{{}}}", members.into_iter().map(member).collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_may_hold_anything() {
        assert_eq!(string("rib \"foot\"\\\n\u{1}°"), "\"rib \\\"foot\\\"\\\\\\n\\u0001°\"");
    }

    #[test]
    fn objects_nest() {
        let inner = record([("a", "1".to_owned()), ("b", "null".to_owned())]);
        let text = object(&[("x", string("y")), ("of", inner)]);
        assert_eq!(text, "{\n  \"x\": \"y\",\n  \"of\": {\"a\": 1, \"b\": null}\n}\n");
        assert_eq!(record([]), "{}");
    }
}
