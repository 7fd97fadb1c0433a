//! One change to the complete scene, one message: line, key, what was found.

use super::{LEVEE, parse};

/// The text that is replaced, by what, and the message after `FILE:`.
#[rustfmt::skip] // A table.
const CHANGES: &[(&str, &str, &str)] = &[
    // Keys and tables
    ("title =", "titel =", "1: titel: unknown key of the scene"),
    ("value = \"-4.0\"", "valeu = 1", "14: boundary.river.valeu: unknown key of a dirichlet boundary"),
    ("flux = \"0\"\n[boundary.face]", "value = 1\n[boundary.face]", "17: boundary.base.value: unknown key of a neumann boundary"),
    ("value = \"-4.0\"\n", "", "12: boundary.river.value: missing"),
    ("kind = \"robin\"\n", "", "23: boundary.air.kind: missing"),
    ("mesh = \"levee.msh\"", "", "1: mesh: missing"),
    ("mesh = \"levee.msh\"", "mesh = 3", "2: mesh: expected a text, found the number 3"),
    ("mesh = \"levee.msh\"", "mesh = ''", "2: mesh: expected the path of a mesh file, found the text \"\""),
    ("[source]\nf = \"0\"", "[source]", "9: source.f: missing"),
    ("[source]\n", "[source]\nt = 1\n", "10: source.t: unknown key of the source"),
    ("[boundary.face]", "[boundary.face.deep]", "18: boundary.face.kind: missing"),
    ("[boundary.face]\n", "[boundary]\n", "19: boundary.kind: expected a table, found the text \"contact\""),
    // Kinds
    ("\"robin\"", "\"Robin\"", "24: boundary.air.kind: `Robin` is not one of: dirichlet, neumann, robin, contact"),
    ("\"robin\"", "4", "24: boundary.air.kind: expected a text, found the number 4"),
    ("kind = \"flux\"\nof = \"face\"", "kind = \"mean\"", "33: output.seepage.of: missing"),
    ("kind = \"flux\"", "kind = \"flow\"", "34: output.seepage.kind: `flow` is not one of: flux, force, length, saturated, probe, mean, content, bound, window"),
    // Expressions and numbers
    ("\"-y\"", "\"2y\"", "20: boundary.face.gap: expected an operator before `y`"),
    ("\"-y\"", "\"\"\"\n-z\"\"\"", "21: boundary.face.gap: unknown name `z`"),
    ("\"-y\"", "[1]", "20: boundary.face.gap: expected a number or an expression in quotes, found an array of 1"),
    ("\"-4.0\"", "nan", "14: boundary.river.value: not a finite number"),
    ("\"-4.0\"", "-inf", "14: boundary.river.value: not a finite number"),
    ("\"-4.0\"", "1e999", "14: boundary.river.value: not a finite number"),
    ("\"-4.0\"", "\"1/0\"", "14: boundary.river.value: its value is inf, not a finite number"),
    ("\"-4.0\"", "true", "14: boundary.river.value: expected a number or an expression in quotes, found true"),
    ("\"1e-4\"", "\"1 + t\"", "7: material.sand.conductivity: unknown name `t`"),
    ("\"2e-7\"", "\"q\"", "5: material.clay.conductivity: unknown name `q`"),
    ("\"0\", \"2e-7\"", "\"2e-7\"", "5: material.clay.conductivity: expected a scalar or an array of three: a_xx, a_xy, a_yy, found an array of 2"),
    ("\"15\"", "\"15*t\"", "25: boundary.air.coefficient: unknown name `t`"),
    ("\"15\"", "\"-3*5\"", "25: boundary.air.coefficient: -15 is negative"),
    ("\"x + t\"", "\"x +\"", "46: exact.u: expected a number, a name or `(`, found the end"),
    ("[\"1\", 0]", "\"1\"", "47: exact.gradient: expected an array of two: ∂u/∂x, ∂u/∂y, found the text \"1\""),
    // Inputs and outputs
    ("of = \"face\"", "of = []", "35: output.seepage.of: expected a boundary, or a list of boundaries, found an array of 0"),
    ("of = \"face\"", "of = [\"face\", \"roof\"]", "35: output.seepage.of: no boundary `roof` in the scene"),
    ("of = \"face\"", "of = [\"face\", \"face\"]", "35: output.seepage.of: `face` comes twice"),
    ("of = \"face\"", "of = [\"face\", [\"base\"]]", "35: output.seepage.of: expected a text, found an array of 1"),
    ("\"flux\"\nof = \"face\"", "\"length\"\nof = [\"face\", \"air\"]", "35: output.seepage.of: expected a contact boundary, this one is robin"),
    ("\"flux\"\nof = \"face\"", "\"mean\"\nof = [\"face\", \"air\"]", "35: output.seepage.of: expected a text, found an array of 2"),
    ("\"flux\"\nof = \"face\"", "\"mean\"\nof = \"roof\"", "35: output.seepage.of: no boundary or material `roof` in the scene"),
    ("kind = \"flux\"\nof = \"face\"", "kind = \"content\"", "34: output.seepage.kind: no material that it is about has a capacity"),
    ("kind = \"flux\"\nof = \"face\"", "kind = \"window\"", "34: output.seepage.kind: no material that it is about has a capacity"),
    ("\"flux\"\nof = \"face\"", "\"window\"\nof = \"face\"", "35: output.seepage.of: unknown key of a window"),
    ("\"flux\"\nof = \"face\"", "\"content\"\nof = \"sand\"", "35: output.seepage.of: no material that it is about has a capacity"),
    ("\"flux\"\nof = \"face\"", "\"content\"\nof = [\"sand\", \"gravel\"]", "35: output.seepage.of: no material `gravel` in the scene"),
    ("\"flux\"\nof = \"face\"", "\"content\"\nof = [\"sand\", \"sand\"]", "35: output.seepage.of: `sand` comes twice"),
    ("of = \"base\"", "of = \"roof\"", "29: input.rain.of: no boundary `roof` in the scene"),
    ("of = \"base\"", "of = \"source\"", "30: input.rain.field: the source has no field `flux`"),
    ("of = \"base\"", "of = \"air\"", "30: input.rain.field: a robin boundary has no field `flux`"),
    ("field = \"flux\"", "field = \"f\"", "30: input.rain.field: a neumann boundary has no field `f`"),
    ("field = \"flux\"", "field = \"rain\"", "30: input.rain.field: `rain` is not one of: flux, limit, value, gap, ambient, coefficient, f"),
    ("pattern = \"1\"", "pattern = \"t\"", "31: input.rain.pattern: unknown name `t`"),
    ("default = 0.0", "default = '0'", "32: input.rain.default: expected a number, found the text \"0\""),
    ("default = 0.0", "range = [5, 0]", "32: input.rain.range: from 5 to 0 there is no value"),
    ("default = 0.0", "range = [1, 5]", "32: input.rain.range: the default 0 is outside the range of `rain`, [1, 5]"),
    ("default = 0.0", "default = 6\nrange = [1, 5]", "32: input.rain.default: the default 6 is outside the range of `rain`, [1, 5]"),
    ("default = 0.0", "range = [0, nan]", "32: input.rain.range: not a finite number"),
    ("default = 0.0", "range = [-inf, 0]", "32: input.rain.range: not a finite number"),
    ("default = 0.0", "range = [0, inf]", "32: input.rain.range: not a finite number"),
    ("default = 0.0", "range = [0, 1e999]", "32: input.rain.range: not a finite number"),
    ("default = 0.0", "range = 5", "32: input.rain.range: expected an array of two: the least and the largest value, found the number 5"),
    ("default = 0.0", "range = \"0, 5\"", "32: input.rain.range: expected an array of two: the least and the largest value, found the text \"0, 5\""),
    ("default = 0.0", "range = [0, 1, 2]", "32: input.rain.range: expected an array of two: the least and the largest value, found an array of 3"),
    ("default = 0.0", "range = [0, '5']", "32: input.rain.range: expected a number, found the text \"5\""),
    ("default = 0.0", "default = -1e-300\nrange = [0, 5]", "32: input.rain.default: the default -1e-300 is outside the range of `rain`, [0, 5]"),
    ("default = 0.0", "range = [0, 5]\nranges = 1", "33: input.rain.ranges: unknown key of an input"),
    ("default = 0.0", "range = [0]", "32: input.rain.range: expected an array of two: the least and the largest value, found an array of 1"),
    ("of = \"face\"", "of = \"sand\"", "35: output.seepage.of: no boundary `sand` in the scene"),
    ("of = \"face\"", "at = [0, 0]", "35: output.seepage.at: unknown key of a flux"),
    ("of = \"face\"", "", "33: output.seepage.of: missing"),
    ("\"flux\"\nof = \"face\"", "\"force\"\nof = \"air\"", "35: output.seepage.of: expected a contact boundary, this one is robin"),
    ("\"flux\"\nof = \"face\"", "\"probe\"", "33: output.seepage.at: missing"),
    ("\"flux\"\nof = \"face\"", "\"probe\"\nat = [0]", "35: output.seepage.at: expected an array of two: x, y, found an array of 1"),
    // Budgets and time
    ("ram = 196608", "ram = -1", "37: target.ram: expected a positive whole number of bytes, found the number -1"),
    ("ram = 196608", "ram = 1.5", "37: target.ram: expected a positive whole number of bytes, found the number 1.5"),
    ("clock = 168e6", "clock = 0", "40: target.clock: 0 is not a positive number of hertz"),
    ("step = 0.01", "step = 0", "42: time.step: 0 is not a positive number of seconds"),
    ("end = 1.0", "end = 0.005", "43: time.end: 0.005 comes before the first step, 0.01"),
    ("end = 1.0", "end = nan", "43: time.end: not a finite number"),
    ("end = 1.0", "", "41: time.end: missing"),
    // TOML
    ("title = \"drained", "title = drained\"", "1: not TOML: missing opening quote, expected `\"`"),
    ("[source]", "[time]\n[source]", "42: not TOML: duplicate key"),
];

#[test]
fn each_mistake_has_one_message_with_line_and_key() {
    let mut wrong = Vec::new();
    for (from, to, message) in CHANGES {
        assert_eq!(LEVEE.matches(from).count(), 1, "{from}");
        let error = parse(&LEVEE.replacen(from, to, 1)).expect_err(message);
        assert_eq!(error.exit_status(), 2);
        let (expected, said) = (format!("scenes/levee.toml:{message}"), error.to_string());
        if said != expected {
            wrong.push(format!("expected {expected}\n   found {said}\n"));
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.concat());
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
        parse(&format!("{}{inputs}", super::SMALL))
    };
    assert_eq!(with(256).expect("a scene").inputs.len(), 256);
    let error = with(257).expect_err("too many").to_string();
    let expected = "scenes/levee.toml:1029: input.p256: 257 tables [input.…], expected at most 256";
    assert_eq!(error, expected);
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
        let error = parse(&(start.to_owned() + text)).expect_err(message).to_string();
        assert_eq!(error, format!("scenes/levee.toml:{message}"));
    }
}
