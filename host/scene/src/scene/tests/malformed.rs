//! One change to the complete scene, one message: line, key, what was found.

use super::{LEVEE, parse, refused};

/// The text that is replaced, by what, and the message after `FILE:`. The schema is tried on them, too.
fn changes() -> Vec<[String; 3]> {
    super::cases(include_str!("malformed.toml"))
}

#[test]
fn each_mistake_has_one_message_with_line_and_key() {
    for [from, to, message] in changes() {
        assert_eq!(LEVEE.matches(&from).count(), 1, "{from}");
        refused(&LEVEE.replacen(&from, &to, 1), &message);
    }
}

#[test]
fn the_report_underlines_the_culprit_and_says_what_to_do() {
    let text = LEVEE.replace("\"-y\"", "\"1 - 2y\"");
    let report = miette::GraphicalReportHandler::new_themed(miette::GraphicalTheme::none());
    let mut shown = String::new();
    let error = parse(&text).expect_err("2y");
    report.render_report(&mut shown, &error).expect("a report");
    let expected = r#"  x scenes/levee.toml:20: boundary.face.gap: expected an operator before `y`
    ,-[scenes/levee.toml:20:13]
 19 | kind = "contact"
 20 | gap = "1 - 2y"
    :             ^
 21 | flux = "0"
    `----
  help: write `2*y`
"#;
    assert_eq!(shown, expected);
}

#[test]
fn what_toml_cannot_read_has_a_hint() {
    for (value, hint) in [
        ("2,5", "numbers are written with a point, as in 2.5"),
        ("2.5 W/mK # dry", "numbers have no units here, and products a `*`: write `2.5`"),
        ("-10 °C", "numbers have no units here: write the number alone"),
        (".5", "write `0.5`"),
        ("1.", "write `1.0`"),
        ("2*x", "texts and expressions stand in quotes: write `\"2*x\"`"),
        ("robin", "texts and expressions stand in quotes: write `\"robin\"`"),
        ("", "write a value behind the `=`"),
    ] {
        let error = parse(&LEVEE.replacen("\"-4.0\"", value, 1)).expect_err(value);
        let said = miette::Diagnostic::help(&error).expect(value).to_string();
        assert!(said.starts_with(hint), "{value}: {said}");
    }
}

#[test]
fn deep_nesting_is_refused_before_the_stack_ends() {
    for (open, close) in [("[", "]"), ("{a=", "}"), ("a.", ""), ("{a.b.c=[", "]}")] {
        let count = 800_000 / (open.len() + close.len());
        let nest = open.repeat(count) + "1" + &close.repeat(count);
        for text in
            [format!("mesh = {nest}"), nest.clone(), format!("{nest} = 1"), format!("[{nest}]")]
        {
            let error = parse(&text).expect_err("no scene").to_string();
            assert!(error.starts_with("scenes/levee.toml:1: "), "{:.80}", error);
            assert!(error.len() < 200, "{} bytes: {:.80}", error.len(), error);
        }
    }
}

#[test]
fn more_tables_than_anyone_writes_by_hand_are_refused() {
    let with = |count: usize| {
        let input = |at| format!("[input.p{at}]\nof = 'source'\nfield = 'f'\npattern = 1\n");
        let inputs: String = (0..count).map(input).collect();
        format!("{}{inputs}", super::SMALL)
    };
    assert_eq!(parse(&with(256)).expect("a scene").inputs.len(), 256);
    refused(&with(257), "1029: input.p256: 257 tables [input.…], expected at most 256");
}

#[test]
fn empty_sections_are_refused() {
    let start = "mesh = 'm'\n";
    for (text, message) in [
        ("", "1: boundary: missing"),
        ("[boundary]", "1: boundary: missing"),
        ("[boundary.a]\nkind='contact'\n", "1: material: missing"),
        ("[boundary.a]\nkind='contact'\n[material]", "1: material: missing"),
    ] {
        refused(&(start.to_owned() + text), message);
    }
}
