//! Ticks that stop, are saved, and go on: `--save`, `--from`, and Ctrl-C.

use std::path::Path;

use serde_json::{Value, json};

use signorini_tolerances::some;

use crate::command::{self, Folder, json as json_in, meshes, says, says_of, text};
use crate::tick::{Table, pushed};

const LEVEE: &str = "scenes/levee.toml";

/// A body whose contact opens and closes, of materials with these numbers; an input heats it.
fn body(folder: &Folder, cells: &str, conductivity: f64, more: &str) -> String {
    let mesh = meshes(&format!("catalogue/square-{cells}-16.msh"));
    let text = format!(
        "mesh = {mesh:?}\n[material.default]\nconductivity = {conductivity}\n{more}\n\
         [boundary.contact]\nkind = \"contact\"\n[boundary.default]\nkind = \"neumann\"\nflux = 0\n\
         [boundary.dirichlet]\nkind = \"dirichlet\"\nvalue = \"0.3*sin(7*t)\"\n\
         [source]\nf = \"{conductivity}*(4*sin(20*t) - 1)\"\n\
         [input.heat]\nof = \"source\"\nfield = \"f\"\npattern = \"{conductivity}*x\"\ndefault = 0.2\n\
         [output.power]\nkind = \"force\"\n[output.wet]\nkind = \"length\"\n[time]\nstep = 0.01\nend = 0.06\n"
    );
    folder.write("body.toml", text)
}

/// The rows of two runs, of which the second goes on from the first, are those of one.
#[track_caller]
fn one_of_two(scene: &str, folder: &Folder, [whole, first, second]: [&[&str]; 3], status: i32) {
    let [state, next, last] =
        ["state.json", "next.json", "last.json"].map(|name| folder.word(name));
    let ran = |out: &str, more: &[&[&str]]| {
        let run = folder.run(out, "tick", scene, &more.concat());
        assert_eq!(run.status, status, "{more:?}: {}{}", run.stdout, run.stderr);
    };
    ran("whole", &[whole, &["--save", &last]]);
    ran("first", &[first, &["--save", &state]]);
    ran("second", &[second, &["--from", &state, "--save", &next]]);
    for name in ["ticks.csv", "output_bounds.csv"] {
        let rows = |out: &str| text(folder.path(out).join(name));
        let second = rows("second");
        let (header, more) = second.split_once('\n').expect("rows");
        assert!(!header.is_empty() && !more.contains("start"), "{more}");
        assert_eq!(rows("first") + more, rows("whole"), "{name} of {scene}: {whole:?}");
    }
    assert_eq!(text(&last), text(&next), "the states after the last tick");
}

#[test]
fn steps_in_time_go_on_bit_for_bit() {
    let folder = Folder::new();
    let stored = "capacity = \"1 + x^2\"";
    for (cells, conductivity, stored, more) in [
        ("tri", 1.0, stored, &[][..]),
        ("mixed", 1.0, stored, &["--scalar", "f32"]),
        // Far from 1: the session has other units.
        ("quad", 1e-12, "capacity = 3e-12", &["--tolerance", "1e-9", "--scalar", "f32"]),
        ("tri", 1e-12, "capacity = 3e-12", &["--tolerance", "1e-9", "--step", "0.02"]),
    ] {
        let scene = body(&folder, cells, conductivity, stored);
        let with = |own: &[&'static str]| [more, own].concat();
        let [whole, first, second] =
            [&["--ticks", "5"][..], &["--ticks", "2"], &["--ticks", "3"]].map(with);
        one_of_two(&scene, &folder, [&whole, &first, &second], 0);
        let state = json_in(folder.path("state.json"));
        let units = &state["units"];
        assert_eq!(units["conductivity"] == 1.0, conductivity == 1.0, "{units}");
    }
    let scene = body(&folder, "tri", 1.0, "capacity = 2");
    // What a log said last stays.
    let first = folder.write("first.csv", "t,heat\n0.01,0\n0.02,3\n");
    let log = folder.write("log.csv", "t,heat\n0.01,0\n0.02,3\n0.03,3\n");
    one_of_two(&scene, &folder, [&["--log", &log], &["--log", &first], &["--ticks", "1"]], 0);
    // To the end of the scene; what the command line said of inputs stays.
    let heat = &["--input", "heat=3"];
    one_of_two(&scene, &folder, [heat, &[heat, &["--ticks", "2"][..]].concat(), &[]], 0);
    assert_eq!(text(folder.path("second/ticks.csv")).lines().count(), 5);
    let from = ["--from", &folder.word("last.json")];
    let said = folder.run("done", "tick", &scene, &from).refuses();
    says(&said, &["time.end: 0.06 comes before the next tick"]);
    let log = folder.write("log.csv", "t,heat\n0.08,1\n");
    let said =
        folder.run("done", "tick", &scene, &[&["--log", &log], &from[..]].concat()).refuses();
    says(&said, &["log.csv:2: t: 0.08 comes", "after 0.06"]);
}

/// Both models, in both scalars, with inputs by the command line; what another controller left is refused.
#[test]
fn controllers_go_on_bit_for_bit() {
    let folder = Folder::new();
    let stored = "capacity = \"1 + x^2\"";
    let scene = body(&folder, "tri", 1.0, stored);
    let held = [("0.3*sin(7*t)", "0.3"), ("4*sin(20*t) - 1", "-1")];
    let plain = held.iter().fold(text(&scene), |text, (moves, held)| text.replace(moves, held));
    for (model, scalar) in [("condensed", "f64"), ("full", "f32")] {
        folder.write("body.toml", format!("{plain}\n[setting]\nmodel = \"{model}\"\n"));
        let with = |own: &[&'static str]| [&["--baked", "--scalar", scalar][..], own].concat();
        let [whole, first, second] = [
            &["--ticks", "4", "--input", "heat=2"][..],
            &["--ticks", "2", "--input", "heat=2"],
            &["--ticks", "2"],
        ]
        .map(with);
        one_of_two(&scene, &folder, [&whole, &first, &second], 0);
    }
    let state = folder.word("state.json");
    let other = |more: &[&str]| {
        folder.run("other", "tick", &scene, &[&["--from", &state], more].concat()).refuses()
    };
    says(&other(&["--scalar", "f32"]), &["state.json", "the controller that `bake` writes"]);
    says(&other(&["--baked", "--scalar", "f64"]), &["state.json", "in f32, and not in f64"]);
    let steady = ["--baked", "--ticks", "2", "--save", &state];
    let said = folder.run("other", "tick", &meshes(LEVEE), &steady).refuses();
    says(&said, &["--save: no material has a capacity"]);
}

/// The error over time of a run that goes on is that of one run, in other units too.
#[test]
fn an_error_over_time_goes_on_bit_for_bit() {
    let folder = Folder::new();
    let exact = text(meshes("time/release-tri.toml"));
    let exact = exact.replace("column-tri-16.msh", &meshes("time/column-tri-16.msh"));
    for of_one in some(2, ["1", "1e-12"]) {
        let other = exact.replace("conductivity = \"1\"", &format!("conductivity = {of_one}"));
        let scene = other.replace("capacity = 1", &format!("capacity = {of_one}"));
        let scene = folder.write("release.toml", scene);
        let all = [&["--ticks", "3"][..], &["--ticks", "1"], &["--ticks", "2"]];
        one_of_two(&scene, &folder, all, 0);
        let ticks = Table::read(folder.path("second/ticks.csv"));
        let numbers = |name| ticks.numbers(name);
        let pairs = numbers("window_energy").into_iter().zip(numbers("window_error"));
        assert!(pairs.clone().all(|(bound, error)| bound >= error && error > 0.0), "{of_one}");
        assert_eq!(pairs.count(), 2);
    }
}

#[test]
fn ticks_of_steady_scenes_go_on_bit_for_bit() {
    let folder = Folder::new();
    for more in [&[][..], &["--budget-sweeps", "3"], &["--scalar", "f32", "--tolerance", "1e-4"]] {
        let with = |own: &[&'static str]| [more, own].concat();
        let [whole, first, second] =
            [&["--ticks", "4"][..], &["--ticks", "3"], &["--ticks", "1"]].map(with);
        one_of_two(&meshes(LEVEE), &folder, [&whole, &first, &second], 0);
    }
}

/// Rows that contact cannot hold before the break, at it, and behind it.
#[test]
fn a_log_goes_on_beyond_refused_rows() {
    let folder = Folder::new();
    let side = "input.side = { of = \"default\", field = \"flux\", pattern = \"y\" }\n";
    let scene = pushed(&folder, side);
    let rows = ["0,2", "1,-1", "2,2", "3,-1.5", "4,3", "5,-1"];
    let log =
        |name: &str, rows: &[&str]| folder.write(name, format!("t,push\n{}\n", rows.join("\n")));
    let (whole, first, second) =
        (log("whole.csv", &rows), log("a.csv", &rows[..3]), log("b.csv", &rows[3..]));
    let side = ["--input", "side=-0.25"];
    let with = |log| [&["--log", log], &side[..]].concat();
    one_of_two(&scene, &folder, [&with(&whole), &with(&first), &["--log", &second]], 3);
    // Nothing has been answered: there is nothing to go on from.
    let never = log("never.csv", &["0,2"]);
    let lost = folder.word("lost.json");
    let run = folder.run("never", "tick", &scene, &["--log", &never, "--save", &lost]);
    assert!(run.status == 3 && run.stderr.contains("lost.json: not written"), "{}", run.stderr);
    assert!(!Path::new(&lost).exists());
}

/// A part of a state, by the names of its parents, and what it is changed to; a part of the message.
fn spoilt() -> Vec<(&'static str, Value, &'static str)> {
    vec![
        ("/version", json!(2), "version: 2, expected 1"),
        ("/origin/scene", json!("0"), "another scene"),
        ("/origin/mesh", json!("0"), "another mesh"),
        ("/origin/step", json!(0.5), "step 0.5, and not 0.01"),
        ("/origin/scalar", json!("f32"), "in f32, and not in f64"),
        ("/last/inputs", json!([]), "last.inputs: 0 numbers, expected 2"),
        ("/begun/inputs", json!([1, 2, 3]), "begun.inputs: 3 numbers, expected 2"),
        ("/units/u", json!(2), "units"),
        ("/session/tick/u", json!([1]), "session.u: 1 numbers"),
        ("/session/tick/u/0", Value::Null, "expected f64"),
        ("/session/tick/active", json!([]), "session.active: 0 numbers"),
        ("/session/tick/omega", json!(2.5), "session.omega"),
        ("/session", json!({"solve": {"u": [], "omega": null}}), "session: "),
        ("/session", json!({"walk": {}}), "unknown variant `walk`"),
    ]
}

#[test]
fn states_of_anything_else_are_refused() {
    let folder = Folder::new();
    let (state, other) = (folder.word("state.json"), folder.word("other.json"));
    let levee = meshes(LEVEE);
    folder.run("out", "tick", &levee, &["--ticks", "1", "--save", &state]).succeeds();
    let whole = text(&state);
    let refused = |file: &str, more: &[&str]| {
        let from = [&["--ticks", "1", "--from", file], more].concat();
        let message = folder.run("never", "tick", &levee, &from).refuses();
        assert!(!folder.path("never").exists(), "{message}");
        message
    };
    let said = |text: &str| refused(&folder.write("other.json", text), &[]);
    for (part, value, expected) in spoilt() {
        let mut spoilt: Value = serde_json::from_str(&whole).expect("JSON");
        *spoilt.pointer_mut(part).unwrap_or_else(|| panic!("{part}")) = value;
        says_of(part, &said(&spoilt.to_string()), &["other.json", expected]);
    }
    let number = whole.find("\"u\":[").expect("means") + 5;
    let nan = format!("{}NaN,{}", &whole[..number], &whole[number..]);
    for (text, expected) in [("", "EOF"), (&whole[..number], "EOF"), (&nan, "expected value")] {
        says(&said(text), &["other.json:", expected]);
    }
    says(&refused(&folder.word("none.json"), &[]), &["none.json"]);
    for more in [&["--step", "0.02"][..], &["--scalar", "f32"], &["--tolerance", "1e-9"]] {
        assert!(refused(&state, more).contains("state.json"), "{more:?}");
    }
    assert!(refused(&state, &["--coarse", "a.msh"]).contains("cannot be used with"));
    // Not over the scene, and not into a folder.
    for place in [&*levee, &folder.word("out")] {
        let message =
            folder.run("never", "tick", &levee, &["--ticks", "1", "--save", place]).refuses();
        assert!(message.contains("--save"), "{message}");
    }
    assert_eq!(text(&state), whole);
    assert!(Path::new(&other).exists());
}

/// Ctrl-C: the files have the ticks that were played, and the state goes on from them.
#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_its_files_and_its_state() {
    let folder = Folder::new();
    let scene = body(&folder, "tri", 1.0, "capacity = 2");
    let (out, state) = (folder.word("out"), folder.word("state.json"));
    let words = ["tick", &scene, "--out", &out, "--ticks", "100000", "--vtu", "--save", &state];
    let run = command::interrupted(&words, || folder.path("out/ticks/0002.vtu").exists());
    let said = run.stderr;
    assert_eq!(run.status, 130, "{said}");
    let rows = text(folder.path("out/ticks.csv"));
    let ticks = rows.lines().count() - 2;
    assert!(said.contains(&format!("interrupted after {ticks} of 100000 ticks")), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
    assert_eq!(text(folder.path("out/ticks.pvd")).matches("<DataSet").count(), ticks + 1);
    for name in ["output_bounds.csv", "ticks.svg"] {
        assert!(folder.path("out").join(name).exists(), "{name}");
    }
    folder.run("more", "tick", &scene, &["--ticks", "2", "--from", &state]).succeeds();
    let more = text(folder.path("more/ticks.csv"));
    folder.run("whole", "tick", &scene, &["--ticks", &(ticks + 2).to_string()]).succeeds();
    let more = more.split_once('\n').expect("rows").1;
    assert_eq!(rows + more, text(folder.path("whole/ticks.csv")));
}
