//! `signorini tick` as users and scripts meet it: its table, its logs, its messages.

use signorini_tolerances::command::{
    BAKED, COARSE_START, LIMIT_OF_TICKS, MOVING_FORCE, REPLAYED, STATED,
};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use signorini_bake::tick::{Budget, ScheduledTick, play};
use signorini_scene::mesh::gmsh;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::scene::Scene;
use signorini_scene::scene::units::Units;
use signorini_solve::norms::errors;
use signorini_solve::outputs::outputs as outputs_of;
use signorini_solve::problem::Problem;
use signorini_solve::solve::{Options, ScalarKind, solve};

const MOVING: &str = "catalogue/moving-tri.toml";
const LEVEE: &str = "scenes/levee.toml";

fn meshes(scene: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../meshes").join(scene)
}

fn tick(scene: &Path, out: &Path, more: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_signorini"));
    command.arg("tick").arg(scene).arg("--out").arg(out).args(more);
    command.output().expect("the binary runs")
}

/// `ticks.csv`: the names of its columns, and the fields of each line.
struct Table {
    header: Vec<String>,
    lines: Vec<Vec<String>>,
}

impl Table {
    fn read(path: &Path) -> Self {
        let mut reader = csv::Reader::from_path(path).expect("ticks.csv");
        let fields = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect();
        let header = fields(reader.headers().expect("a header"));
        let lines = reader.records().map(|record| fields(&record.expect("a line"))).collect();
        Self { header, lines }
    }

    fn column(&self, name: &str) -> Vec<&str> {
        let at = self.header.iter().position(|column| column == name).expect("a column");
        self.lines.iter().map(|line| line[at].as_str()).collect()
    }

    fn numbers(&self, name: &str) -> Vec<f64> {
        self.column(name).iter().map(|field| field.parse().expect("a number")).collect()
    }
}

/// Plays a scene of the repository, which must end with status 0.
fn played(scene: &str, more: &[&str]) -> Table {
    let folder = tempfile::tempdir().expect("a folder");
    let output = tick(&meshes(scene), folder.path(), more);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(output.stderr.is_empty(), "quiet in a pipe");
    let picture = std::fs::read_to_string(folder.path().join("ticks.svg")).expect("a picture");
    assert!(picture.starts_with("<svg ") && !picture.contains("NaN"));
    Table::read(&folder.path().join("ticks.csv"))
}

#[test]
fn a_line_a_tick_and_a_column_an_output() {
    let levee = played(LEVEE, &["--ticks", "3"]);
    let fixed = ["t", "status", "sweeps", "contact_force", "contact_length", "error_bound"];
    assert_eq!(levee.header, [&fixed[..], &["seepage", "wet", "head"]].concat());
    assert_eq!(levee.column("t"), ["0.0", "0.01", "0.02"]);
    let moving = played(MOVING, &[]);
    assert_eq!(moving.header, [&fixed[..], &["error_combined"]].concat());
    assert_eq!(moving.lines.len(), 21);
    assert_eq!(moving.numbers("t")[20], 1.0);
}

/// By the solver's own answers and by the controller's few numbers; the seepage of a finer mesh lies within both.
#[test]
fn outputs_have_bounds_beside_them() {
    let bounds = |more: &[&str]| {
        let folder = tempfile::tempdir().expect("a folder");
        let output = tick(&meshes(LEVEE), folder.path(), &[&["--ticks", "2"], more].concat());
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        Table::read(&folder.path().join("output_bounds.csv"))
    };
    let (own, baked) = (bounds(&[]), bounds(&["--baked"]));
    // Around the mean over the cell, which is not what ticks.csv has under the name of a probe.
    let of_probe = ["head_cell_least", "head_cell_most"];
    assert_eq!(own.header, [&["t", "seepage_least", "seepage_most"][..], &of_probe].concat());
    assert_eq!(baked.header, ["t", "seepage_least", "seepage_most"]);
    // 115 425 unknowns (solve --max-error 1%).
    const FINE: f64 = 3.2607e-5;
    let mut widths = Vec::new();
    for table in [&own, &baked] {
        let (least, most) = (table.numbers("seepage_least")[0], table.numbers("seepage_most")[0]);
        assert!(least < FINE && FINE < most, "{least} {most}");
        widths.push(most - least);
    }
    assert!(widths[0] < 0.1 * FINE && widths[0] < widths[1], "{widths:?}");
    assert_eq!(bounds(&["--no-intervals"]).header, ["t"]);
}

#[test]
fn a_series_has_a_file_for_each_tick_and_none_of_an_earlier_run() {
    let folder = tempfile::tempdir().expect("a folder");
    let listed = |more: &[&str]| {
        let output = tick(&meshes(LEVEE), folder.path(), more);
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        let series = std::fs::read_to_string(folder.path().join("ticks.pvd")).expect("a series");
        let files = std::fs::read_dir(folder.path().join("ticks")).expect("files").count();
        assert_eq!(series.matches("<DataSet").count(), files);
        assert!(
            series.contains("timestep=\"0.01\" part=\"0\" file=\"ticks/0001.vtu\""),
            "{series}"
        );
        files
    };
    assert_eq!(listed(&["--vtu", "--ticks", "4"]), 4);
    assert_eq!(listed(&["--vtu", "--ticks", "2", "--baked"]), 2);
}

#[test]
fn the_force_of_a_moving_contact_is_pi_a_squared() {
    for scalar in ["f64", "f32"] {
        let table = played(MOVING, &["--scalar", scalar]);
        for (t, force) in table.numbers("t").into_iter().zip(table.numbers("contact_force")) {
            let a = 0.55 + 0.1 * (2.0 * std::f64::consts::PI * t).sin();
            let exact = std::f64::consts::PI * a * a;
            MOVING_FORCE.check_relative(format_args!("{scalar}, t = {t}"), force, exact);
        }
    }
}

#[test]
fn ticks_start_from_the_last_answer() {
    let sweeps = played(LEVEE, &["--ticks", "4"]).numbers("sweeps");
    assert!(sweeps[0] > 100.0 && sweeps[1..].iter().all(|&sweeps| sweeps < 20.0), "{sweeps:?}");
    let moving = played(MOVING, &[]).numbers("sweeps");
    assert!(moving[1..].iter().all(|&warm| warm < 0.8 * moving[0]), "{moving:?}");
}

#[test]
fn a_budget_cuts_off_and_is_carried_on() {
    let table = played(LEVEE, &["--ticks", "80", "--budget-sweeps", "50"]);
    assert!(table.numbers("sweeps").iter().all(|&sweeps| sweeps <= 50.0));
    let status = table.column("status");
    assert_eq!((status[0], status[79]), ("out-of-sweeps", "settled"));
}

#[test]
fn a_log_replays_what_inputs_say() {
    let folder = tempfile::tempdir().expect("a folder");
    let log = folder.path().join("inputs.csv");
    std::fs::write(&log, "t,rain,river\n-1,2,0.5\n0.25, 2, 0.5\n").expect("a log");
    let log = log.to_str().expect("UTF-8");
    let replayed = played(LEVEE, &["--log", log]);
    let set = played(LEVEE, &["--ticks", "1", "--input", "rain=2", "--input", "river=0.5"]);
    assert_eq!(replayed.column("t"), ["-1.0", "0.25"]);
    assert_eq!(replayed.lines[0][1..], set.lines[0][1..]);
    let force = |table: &Table, line: usize| table.numbers("contact_force")[line];
    let moved = force(&replayed, 1) / force(&set, 0) - 1.0;
    REPLAYED.check("nothing changed", moved);
    assert!(replayed.numbers("sweeps")[1] <= 4.0, "nothing changed");

    std::fs::write(log, "t,rain\n0,2\n").expect("a log");
    let rest = played(LEVEE, &["--log", log, "--input", "river=0.5"]);
    assert_eq!(rest.lines[0][1..], set.lines[0][1..]);
}

#[test]
fn a_log_is_replayed_by_the_baked_controller() {
    let folder = tempfile::tempdir().expect("a folder");
    let log = folder.path().join("inputs.csv");
    std::fs::write(&log, "t,rain,river\n0,0,0\n1,2,0.5\n2,2,0.5\n").expect("a log");
    let log = log.to_str().expect("UTF-8");
    let (full, baked) = (played(LEVEE, &["--log", log]), played(LEVEE, &["--log", log, "--baked"]));
    assert_eq!((&baked.header, baked.column("t")), (&full.header, full.column("t")));
    assert_eq!(baked.column("status"), ["exact"; 3]);
    for name in ["seepage", "head", "contact_force"] {
        for (own, other) in baked.numbers(name).into_iter().zip(full.numbers(name)) {
            BAKED.check_relative(name, own, other);
        }
    }
    // Outputs are in the controller's scalar, f32.
    let narrow = |x: &f64| f64::from(*x as f32) == *x;
    assert!(baked.numbers("seepage").iter().all(narrow));
    let out = folder.path().join("out");
    for other in [&["--budget-sweeps", "9"][..], &["--error", "0.1"], &["--coarse", "a.msh"]] {
        let arguments = [&["--log", log, "--baked"], other].concat();
        assert!(refused(&meshes(LEVEE), &out, &arguments).contains(other[0]));
    }
}

/// A log, the line that is wrong in it, and a part of the message.
const WRONG_LOGS: &[(&str, &str, &str)] = &[
    ("", "1", "`t`"),
    ("t,rain\n", "1", "no tick"),
    ("t,snow\n0,1\n", "1", "`snow`"),
    ("t,snow\n0,1\n", "1", "rain, river"),
    ("t,rain,rain\n0,1,1\n", "1", "twice"),
    ("rain,t\n1,0\n", "1", "`rain`"),
    ("t,rain\n0,1\n1,much\n", "3", "rain: `much`"),
    ("t,rain\n0,1\n1,\n", "3", "rain"),
    ("t,rain\n0,1\n1,inf\n", "3", "not finite"),
    ("t,rain\nNaN,1\n", "2", "not finite"),
    ("t,rain\n0,1\n1,1\n1,1\n", "4", "does not come after 1"),
    ("t,rain\n0,1\n1\n", "3", "1 fields, expected 2"),
];

/// Runs `tick`, which must refuse its input; returns the message.
fn refused(scene: &Path, out: &Path, more: &[&str]) -> String {
    let output = tick(scene, out, more);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{more:?}: {message}");
    assert!(!message.contains("panicked") && !out.exists(), "{more:?}: {message}");
    message
}

/// What is far from 1 plays in other units, and each number of the table comes back in the scene's.
#[test]
fn other_units_change_no_digit() {
    let units = Units { u: 2f64.powi(-60), conductivity: 2f64.powi(-80) };
    let moments = [0.0, 0.05].map(|time| ScheduledTick { time, inputs: Vec::new() });
    for (name, scalar) in [
        (MOVING, ScalarKind::F32),
        (MOVING, ScalarKind::F64),
        ("scenes/membrane.toml", ScalarKind::F64),
    ] {
        let path = meshes(name);
        let scene = Scene::read(&path).expect("a scene");
        let mesh = gmsh::read(&scene.mesh.value).expect("a mesh");
        let played = |units: Units| {
            let scene = units.inverse().scene(&scene);
            let problem = Problem::new(&scene, mesh.clone()).expect("a problem");
            let budget = Budget { scalar, sweeps: 20_000, error: 0.0, intervals: false };
            play(&problem, None, &moments, &budget, |_, _| Ok(())).expect("ticks")
        };
        let (near, far) = (played(Units::default()), played(units));
        for (near, far) in near.iter().zip(&far) {
            let times = |x: Option<f64>, unit: f64| x.map(|x| x * unit);
            assert_eq!((far.status, far.sweeps), (near.status, near.sweeps), "{name}");
            assert_eq!(far.contact_force, times(near.contact_force, units.flux()), "{name}");
            assert_eq!(far.contact_length, near.contact_length, "{name}");
            assert_eq!(far.combined, times(near.combined, units.energy()), "{name}");
            let [far, near] = [far, near].map(|tick| tick.bound.expect("a bound"));
            assert_eq!(far, near.times(units.energy()), "{name}");
        }
    }
}

#[test]
fn wrong_logs_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let (log, out) = (folder.path().join("inputs.csv"), folder.path().join("out"));
    for (text, line, expected) in WRONG_LOGS {
        std::fs::write(&log, text).expect("a log");
        let message = refused(&meshes(LEVEE), &out, &["--log", log.to_str().expect("UTF-8")]);
        assert!(message.contains(&format!("inputs.csv:{line}:")), "{text:?}: {message}");
        assert!(message.contains(expected), "{text:?}: {message}");
    }
    std::fs::write(&log, b"t,rain\n0,\xff\n").expect("a log");
    let message = refused(&meshes(LEVEE), &out, &["--log", log.to_str().expect("UTF-8")]);
    assert!(message.contains("inputs.csv:2: not UTF-8"), "{message}");
    let message = refused(&meshes(LEVEE), &out, &["--log", "nowhere.csv"]);
    assert!(message.contains("nowhere.csv"), "{message}");
}

#[test]
fn a_scene_without_time_needs_a_number_of_ticks() {
    let folder = tempfile::tempdir().expect("a folder");
    let message = refused(&meshes("catalogue/h-tri.toml"), &folder.path().join("out"), &[]);
    assert!(message.contains("h-tri.toml: time:") && message.contains("--ticks"), "{message}");
    let table = played("catalogue/h-tri.toml", &["--ticks", "2"]);
    assert_eq!(table.column("t"), ["0.0", "1.0"]);
}

/// The mesh holds u exactly, and rounding of its large values is all that is left.
#[test]
fn ticks_end_where_rounding_is_all_that_is_left() {
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, out) = (folder.path().join("a.toml"), folder.path().join("out"));
    let mesh = meshes("catalogue/square-quad-16.msh");
    let text = format!(
        "mesh = {mesh:?}\n[material.default]\nconductivity = 1\n[boundary.dirichlet]\n\
         kind = \"dirichlet\"\nvalue = \"1000.3 + x + t\"\n[boundary.contact]\n\
         kind = \"contact\"\ngap = \"900\"\n"
    );
    std::fs::write(&scene, text).expect("a scene");
    for scalar in ["f64", "f32"] {
        let output = tick(&scene, &out, &["--ticks", "6", "--scalar", scalar]);
        assert_eq!(output.status.code(), Some(0));
        let table = Table::read(&out.join("ticks.csv"));
        assert!(table.column("status").iter().all(|status| *status == "settled"));
        assert!(table.numbers("sweeps").iter().all(|sweeps| *sweeps < 5000.0), "{scalar}");
    }
}

/// What to put for the Dirichlet value and the gap of a scene, further sections, and parts of the
/// message.
const WRONG_IN_TIME: &[(&str, &str, &str, &[&str])] = &[
    ("1/(2 - t)", "0", "", &["boundary.dirichlet.value", "a.toml:7:", "t = 2"]),
    ("1 - t", "0", "", &["below the gap", "t = 2"]),
    ("1", "ln(2.5 - t)", "", &["boundary.contact.gap", "t = 3"]),
    ("1", "0", "[time]\nstep = 1e-9\nend = 1e9\n", &["time", "--ticks"]),
];

#[test]
fn data_that_turn_wrong_are_refused_with_their_time() {
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, out) = (folder.path().join("a.toml"), folder.path().join("out"));
    let mesh = meshes("catalogue/square-tri-16.msh");
    for (value, gap, more, expected) in WRONG_IN_TIME {
        let text = format!(
            "mesh = {mesh:?}\n[material.default]\nconductivity = 1\n\n[boundary.dirichlet]\n\
             kind = \"dirichlet\"\nvalue = \"{value}\"\n[boundary.contact]\nkind = \"contact\"\n\
             gap = \"{gap}\"\n{more}"
        );
        std::fs::write(&scene, text).expect("a scene");
        let count: &[&str] = if more.is_empty() { &["--ticks", "4"] } else { &[] };
        let message = refused(&scene, &out, count);
        expected.iter().for_each(|part| assert!(message.contains(part), "{part}: {message}"));
    }
}

#[test]
fn wrong_arguments_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out");
    for (arguments, expected) in [
        (&["--ticks", "0"][..], "--ticks"),
        (&["--ticks", "1000001"], "--ticks"),
        (&["--budget-sweeps", "0"], "--budget-sweeps"),
        (&["--ticks", "2", "--log", "inputs.csv"], "--log"),
        (&["--input", "snow=1"], "snow"),
    ] {
        let message = refused(&meshes(LEVEE), &out, arguments);
        assert!(message.contains(expected), "{arguments:?}: {message}");
    }
}

/// A heater whose supply sags: each tick ends where a solve with this limit does, within its bound.
#[test]
fn a_limit_may_change_from_tick_to_tick() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = std::fs::read_to_string(meshes("limits/l-tri.toml")).expect("a scene");
    let mesh = meshes("catalogue/square-tri-16.msh");
    let text = text.replace("../catalogue/square-tri-16.msh", mesh.to_str().expect("UTF-8"));
    let (text, _) = text.split_once("[exact]").expect("an exact solution");
    let outputs = "[input.supply]\nof = \"contact\"\nfield = \"limit\"\npattern = \"1\"\n\
                   [output.power]\nkind = \"flux\"\nof = \"contact\"\n\
                   [output.short]\nkind = \"saturated\"\n[output.kept]\nkind = \"length\"\n";
    let (scene, log) = (folder.path().join("sags.toml"), folder.path().join("log.csv"));
    std::fs::write(&scene, format!("{text}{outputs}")).expect("a scene");
    let supply = [0.0, -0.5, -1.2, -1.5, 3.0, 1e6, 0.0];
    let lines = supply.iter().enumerate().map(|(t, supply)| format!("{t},{supply}\n"));
    std::fs::write(&log, format!("t,supply\n{}", lines.collect::<String>())).expect("a log");
    let out = folder.path().join("out");
    let found = tick(&scene, &out, &["--log", log.to_str().expect("UTF-8")]);
    assert_eq!(found.status.code(), Some(0), "{}", String::from_utf8_lossy(&found.stderr));
    let table = Table::read(&out.join("ticks.csv"));
    let posed = Scene::read(&scene).expect("a scene");
    let posed = Problem::new(&posed, gmsh::read(&mesh).expect("a mesh")).expect("a problem");
    for (at, &supply) in supply.iter().enumerate() {
        let now = posed.with_inputs(&[supply]).expect("loads");
        let solved = solve(&now, &Options::default()).expect("a solution");
        let values = outputs_of(&now, &solved).expect("outputs");
        for name in ["power", "short", "kept"] {
            let (ticked, exact) = (table.numbers(name)[at], values[name].expect("a value"));
            LIMIT_OF_TICKS
                .check(format_args!("{name} at {supply}: {ticked} {exact}"), ticked - exact);
        }
        assert!(table.numbers("error_bound")[at] >= solved.bound.expect("a bound").total * 0.99);
    }
    let refusal = tick(&scene, &out, &["--ticks", "1", "--input", "supply=-2"]);
    let said = String::from_utf8_lossy(&refusal.stderr).into_owned();
    assert!(said.contains("the limit is -0.5") && said.contains("less than flux = 0"), "{said}");
}

/// The slab with its coefficient as an input, at the value that it had: each tick is the scene's own, and its own baked
/// module's.
#[test]
fn a_coefficient_that_an_input_sets_is_the_one_that_the_scene_states() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join("slab.toml");
    std::fs::copy(meshes("scenes/slab.msh"), folder.path().join("slab.msh")).expect("a mesh");
    let text = std::fs::read_to_string(meshes("scenes/slab.toml")).expect("a scene");
    let input = "[input.h]\nof = \"air\"\nfield = \"coefficient\"\npattern = \"1\"\ndefault = 15\nrange = [5, 80]\n";
    let own = text.replace("coefficient = \"15\"", "coefficient = \"0\"") + input;
    std::fs::write(&scene, own).expect("a scene");
    let power = |scene: &Path, name: &str, more: &[&str]| {
        let out = folder.path().join(name);
        let output = tick(scene, &out, &[&["--ticks", "2"], more].concat());
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        Table::read(&out.join("ticks.csv")).numbers("power")
    };
    let stated = power(&meshes("scenes/slab.toml"), "stated", &[]);
    for (name, more) in [("own", &[][..]), ("module", &["--baked", "--scalar", "f64"])] {
        for (own, stated) in power(&scene, name, more).iter().zip(&stated) {
            STATED.check_relative(name, *own, *stated);
        }
    }
    let message = refused(&scene, &folder.path().join("out"), &["--input", "h=81"]);
    assert!(message.contains("--input h=81"), "{message}");
}

#[test]
fn errors_are_measured_at_the_time_of_the_problem() {
    let scene = Scene::read(&meshes(MOVING)).expect("a scene");
    let exact = scene.exact.as_ref().expect("an exact solution");
    let mut problem = Problem::new(&scene, grid(8, Cells::Triangles)).expect("a problem");
    let error = |problem: &Problem| {
        let solution = solve(problem, &Options::default()).expect("a solution");
        errors(exact, problem, &solution.u, &solution.flux).expect("errors").l2
    };
    let at_start = error(&problem);
    problem.set_time(0.25).expect("loads");
    assert!(error(&problem) < 2.0 * at_start);
    problem.time = 0.0;
    assert!(
        error(&problem) > 10.0 * at_start,
        "the error against another time's solution is large"
    );
}

#[test]
fn a_coarser_mesh_saves_sweeps_at_the_first_tick() {
    let scene = Scene::read(&meshes(MOVING)).expect("a scene");
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        let on = |n| Problem::new(&scene, grid(n, cells)).expect("a problem");
        let (fine, coarse) = (on(24), on(12));
        let moments = [ScheduledTick { time: 0.3, inputs: Vec::new() }];
        let budget =
            Budget { scalar: ScalarKind::F64, sweeps: 10_000, error: 0.0, intervals: false };
        let first = |coarse: Option<&Problem>| {
            let ticks = play(&fine, coarse, &moments, &budget, |_, _| Ok(())).expect("a tick");
            (ticks[0].sweeps, ticks[0].bound.expect("a bound").total)
        };
        let ((cold, bound), (warm, same)) = (first(None), first(Some(&coarse)));
        assert!(2 * warm <= cold, "{cells:?}: {warm} sweeps, {cold} without");
        COARSE_START.check_relative(format_args!("{cells:?}"), same, bound);
    }
}

/// A heater whose supply sags below what it gives at least: the log's line says so, not the scene's.
#[test]
fn ends_that_a_log_turns_round_are_blamed_on_its_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, log) = (folder.path().join("l.toml"), folder.path().join("sagging.csv"));
    let mesh = meshes("catalogue/square-tri-16.msh");
    std::fs::copy(mesh, folder.path().join("square.msh")).expect("a mesh");
    let text = "mesh = \"square.msh\"\n[material.default]\nconductivity = \"1\"\n\
        [boundary.dirichlet]\nkind = \"dirichlet\"\nvalue = \"0\"\n\
        [boundary.contact]\nkind = \"contact\"\nflux = \"-2\"\nlimit = \"0\"\n\
        [input.cap]\nof = \"contact\"\nfield = \"limit\"\npattern = \"1\"\ndefault = 1\n";
    std::fs::write(&scene, text).expect("a scene");
    std::fs::write(&log, "t,cap\n0,1\n1,-3\n2,1\n").expect("a log");
    let log = log.to_str().expect("UTF-8");
    let message = refused(&scene, &folder.path().join("out"), &["--log", log]);
    assert!(message.contains("sagging.csv:3:") && message.contains("at t = 1"), "{message}");
    assert!(message.contains("the limit is -3") && !message.contains("l.toml"), "{message}");
}
