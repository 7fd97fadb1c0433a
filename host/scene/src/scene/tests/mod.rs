//! A complete scene, and what may be left out of it.

mod malformed;
mod setting;

use std::path::{Path, PathBuf};

use super::{Condition, Field, Located, Material, Output, Quantity, Scene, Target, Time};
use crate::error::{Error, Result};
use crate::expression::Expression;

const LEVEE: &str = include_str!("levee.toml");

const SMALL: &str = "
mesh = '../plate.msh'
material.default.conductivity = 2
boundary.default = { kind = 'contact' }
";

/// The cases of a file, a list of texts each.
fn cases<const N: usize>(text: &str) -> Vec<[String; N]> {
    let mut all: toml::Table = text.parse().expect("TOML");
    let cases = all.remove("cases").expect("cases").try_into::<Vec<Vec<String>>>();
    let exactly = |case: Vec<String>| case.try_into().expect("so many texts");
    cases.expect("lists of texts").into_iter().map(exactly).collect()
}

fn parse(text: &str) -> Result<Scene> {
    Scene::parse(text, Path::new("scenes/levee.toml"))
}

/// The error of a text that is wrong input, with this message behind the name of its file.
fn refused(text: &str, message: &str) -> Error {
    let error = parse(text).expect_err(message);
    assert_eq!(error.to_string(), format!("scenes/levee.toml:{message}"));
    assert_eq!(error.exit_status(), 2);
    error
}

fn scene(text: &str) -> Scene {
    parse(text).unwrap_or_else(|error| panic!("{error}"))
}

/// The key, and the value of a constant or the text of anything else.
fn shown(Located { key, value, .. }: &Located<Expression>) -> String {
    format!("{key} = {}", value.is_constant().map_or(value.to_string(), |value| value.to_string()))
}

#[test]
fn a_complete_scene_is_read_in_the_order_of_the_file() {
    let scene = scene(LEVEE);
    assert_eq!(scene.title, "drained levee");
    assert_eq!(scene.mesh.value, PathBuf::from("scenes/levee.msh"));
    assert_eq!(scene.time, Some(Time { step: 0.01, end: Some(1.0), initial: None }));
    let (ram, flash, tick, clock) = (Some(196_608), Some(1 << 20), Some(1e-3), Some(168e6));
    assert_eq!(scene.target, Some(Target { ram, flash, tick, clock }));
    assert_eq!(shown(&scene.source), "source.f = 0");

    let [clay, sand] = &scene.materials[..] else { panic!("two materials") };
    let entries = |of: &Material| {
        of.conductivity.each_ref().map(|a| a.value.is_constant().expect("constant"))
    };
    assert_eq!((clay.name.value.as_str(), clay.is_scalar), ("clay", false));
    assert_eq!(entries(clay), [1e-6, 0.0, 2e-7]);
    assert_eq!((sand.name.key.as_str(), sand.is_scalar), ("material.sand", true));
    assert_eq!(entries(sand), [1e-4, 0.0, 1e-4]);

    let exact = scene.exact.expect("an exact solution");
    assert_eq!(shown(&exact.u), "exact.u = x + t");
    assert_eq!(exact.gradient.each_ref().map(|d| d.value.is_constant()), [Some(1.0), Some(0.0)]);
}

#[test]
fn each_kind_of_boundary_holds_its_data() {
    let scene = scene(LEVEE);
    let kinds: Vec<_> = scene.boundaries.iter().map(|of| of.condition.kind()).collect();
    assert_eq!(kinds, ["dirichlet", "neumann", "contact", "robin"]);
    let data: Vec<_> = scene.boundaries.iter().flat_map(|of| of.condition.data()).collect();
    let expected = [
        "boundary.river.value = -4",
        "boundary.base.flux = 0",
        "boundary.face.gap = -y",
        "boundary.face.flux = 0",
        "boundary.face.limit = inf",
        "boundary.air.coefficient = 15",
        "boundary.air.ambient = -10",
    ];
    assert_eq!(data.iter().map(|(_, of)| shown(of)).collect::<Vec<_>>(), expected);
    let written = |span: &std::ops::Range<usize>| &scene.text[span.clone()];
    let river = &scene.boundaries[0].name;
    assert_eq!((written(&data[0].1.span), written(&river.span)), ("\"-4.0\"", "river"));
    assert_eq!(river.value, "river");
}

#[test]
fn inputs_and_outputs_are_read_and_inputs_set() {
    let mut scene = scene(LEVEE);
    let rain = &scene.inputs[0];
    assert_eq!((rain.name.value.as_str(), rain.of.value.as_str()), ("rain", "base"));
    assert_eq!((rain.field.value, rain.default), (Field::Flux, 0.0));
    assert_eq!(rain.pattern.value.is_constant(), Some(1.0));
    let seepage = &scene.outputs[0];
    assert_eq!((seepage.name.value.as_str(), seepage.quantity), ("seepage", Quantity::Flux));
    assert_eq!(seepage.of.iter().map(|of| of.value.as_str()).collect::<Vec<_>>(), ["face"]);

    scene.set_input("rain=-0.3").expect("a known input");
    assert_eq!(scene.inputs[0].default, -0.3);
    for (assignment, message) in [
        ("rain", "--input rain: expected NAME=VALUE"),
        ("snow=1", "--input snow=1: no input `snow` in the scene"),
        ("rain=", "--input rain=: `` is not a finite number"),
        ("rain=much", "--input rain=much: `much` is not a finite number"),
        ("rain=inf", "--input rain=inf: `inf` is not a finite number"),
    ] {
        let error = scene.set_input(assignment).expect_err(assignment);
        assert_eq!((error.to_string().as_str(), error.exit_status()), (message, 2));
        assert_eq!(hint(&error), "inputs of the scene: rain");
    }
    assert_eq!(scene.inputs[0].default, -0.3);
}

#[test]
fn an_input_stays_within_its_range() {
    let text = LEVEE.replacen("default = 0.0", "default = 0.5\nrange = [0, 5.0]", 1);
    let mut scene = scene(&text);
    let range = scene.inputs[0].range.as_ref().expect("a range");
    assert_eq!((range.value, range.key.as_str()), ([0.0, 5.0], "input.rain.range"));
    for inside in ["0", "5", "0.1"] {
        scene.set_input(&format!("rain={inside}")).expect(inside);
    }
    for outside in ["-1e-300", "5.000001", "-5"] {
        let error = scene.set_input(&format!("rain={outside}")).expect_err(outside);
        assert_eq!(error.exit_status(), 2);
        assert!(error.to_string().contains("is outside the range of `rain`, [0, 5]"), "{error}");
    }
}

fn hint(error: &Error) -> String {
    miette::Diagnostic::help(error).map(|help| help.to_string()).unwrap_or_default()
}

#[test]
fn defaults_fill_what_is_left_out() {
    let scene = scene(SMALL);
    assert_eq!(scene.title, "levee");
    assert_eq!(scene.mesh.value, PathBuf::from("scenes/../plate.msh"));
    assert!(scene.source.value.is_zero());
    let Condition::Contact { gap, flux, .. } = &scene.boundaries[0].condition else { panic!() };
    assert!(gap.value.is_zero() && flux.value.is_zero());
    let said = scene.error(gap, "too wide").to_string();
    assert_eq!(said, "scenes/levee.toml:4: boundary.default.gap: too wide");
    assert_eq!((scene.target, scene.time, &scene.exact), (None, None, &None));
    assert!(scene.inputs.is_empty() && scene.outputs.is_empty());
}

#[test]
fn every_output_and_every_input_field_has_a_form() {
    let more = "
[output]
a = { kind = 'force' }
b = { kind = 'length', of = 'face' }
c = { kind = 'probe', at = [1, -0.5] }
d = { kind = 'bound' }
k = { kind = 'mean', of = 'face' }
[input]
e = { of = 'source', field = 'f', pattern = 'x' }
g = { of = 'river', field = 'value', pattern = 1 }
h = { of = 'face', field = 'gap', pattern = 0x10 }
i = { of = 'air', field = 'ambient', pattern = 1, default = 1_000 }
j = { of = 'face', field = 'flux', pattern = 1 }
";
    let kept = LEVEE.split("[input.rain]").next().expect("a text");
    let scene = scene(&(kept.to_owned() + more));
    let quantities: Vec<_> = scene.outputs.iter().map(|output| output.quantity).collect();
    let probe = Quantity::Probe { at: [1.0, -0.5] };
    let [force, length] = [Quantity::Force, Quantity::Length];
    assert_eq!(quantities, [force, length, probe, Quantity::Bound, Quantity::Mean]);
    let fields: Vec<_> = scene.inputs.iter().map(|input| input.field.value).collect();
    assert_eq!(fields, [Field::Source, Field::Value, Field::Gap, Field::Ambient, Field::Flux]);
    assert_eq!(scene.inputs[2].pattern.value.is_constant(), Some(16.0));
    assert_eq!((scene.inputs[0].default, scene.inputs[3].default), (0.0, 1000.0));
}

#[test]
fn a_material_that_stores_has_a_start() {
    let with = |capacity: &str, time: &str| {
        let stores = format!("material.default.capacity = {capacity}\n");
        parse(&format!("{SMALL}{stores}[time]\nstep = 0.5\n{time}\n"))
    };
    let scene = with("'1 + x^2'", "initial = '20 - y'").unwrap();
    let time = scene.time.clone().unwrap();
    assert!(scene.stores() && (time.step, time.end) == (0.5, None));
    assert_eq!(time.initial.map(|u| u.value.eval(0.0, 2.0, 0.0)), Some(18.0));
    let steady = with("1e6", "initial = 'steady'").unwrap();
    assert_eq!(steady.time.and_then(|time| time.initial), None);
    assert!(!with("0", "end = 1").unwrap().stores());
    assert!(with("0", "").expect_err("no end").to_string().contains("time.end: missing"));
    for (capacity, time, culprit) in [
        ("-1", "", "capacity: -1 is negative"),
        ("'t'", "", "capacity"),
        ("0", "end = 1\ninitial = 3", "time.initial: no material stores u"),
        ("1", "initial = 't'", "time.initial"),
    ] {
        let message = with(capacity, time).expect_err("refused").to_string();
        assert!(message.contains(culprit), "{message}");
    }
}

#[test]
fn an_output_may_be_over_a_list() {
    let listed = LEVEE.replace("of = \"face\"", "of = [\"face\", 'base', \"air\"]");
    let seepage = &scene(&listed).outputs[0];
    assert!(["face", "base", "air"].iter().all(|name| seepage.is_of(name)));
    assert!(!seepage.is_of("river"));
    let place = |output: &Output| output.place("all contact", |name| format!("`{name}`"));
    assert_eq!(place(seepage), "`face`, `base` and `air`");
    assert_eq!(place(&scene(LEVEE).outputs[0]), "`face`");
    assert_eq!(place(&Output { of: Vec::new(), ..seepage.clone() }), "all contact");
}

#[test]
fn names_may_be_any_text_and_lines_may_end_as_they_like() {
    let text = format!("\u{feff}{SMALL}[boundary.'nördlich \"A\"=1.x']\nkind = 'robin'\n")
        .replace('\n', "\r\n");
    refused(&text, r#"5: boundary."nördlich \"A\"=1.x".coefficient: missing"#);
}

#[test]
fn files_that_are_no_text_are_wrong_input() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scene.toml");
    let message = |path: &Path| {
        let error = Scene::read(path).expect_err("no scene");
        assert_eq!(error.exit_status(), 2);
        error.to_string().replace(&path.display().to_string(), "FILE")
    };
    assert!(message(&path).starts_with("FILE: No such file"));
    assert!(message(folder.path()).starts_with("FILE: Is a directory"));
    std::fs::write(&path, b"title = 'x'\nmesh = '\xff'").expect("written");
    assert_eq!(message(&path), "FILE:2: not UTF-8 text");
    std::fs::write(&path, " ".repeat((1 << 20) + 1)).expect("written");
    assert_eq!(message(&path), "FILE: longer than 1048576 bytes");
    std::fs::write(&path, SMALL).expect("written");
    assert_eq!(Scene::read(&path).expect("a scene").title, "scene");
}
