//! `signorini tick` as users and scripts meet it: its table, its logs, its messages.

use signorini_tolerances::command::{
    BAKED, COARSE_START, LIMIT_OF_TICKS, MOVING_FORCE, REPLAYED, STATED,
};
use std::path::Path;
use std::sync::OnceLock;

use signorini_problem::Problem;
use signorini_scene::mesh;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_scene::scene::Scene;
use signorini_scene::scene::units::Units;
use signorini_session::tick::{Budget, ScheduledTick, play};
use signorini_solve::norms::errors;
use signorini_solve::outputs::outputs as outputs_of;
use signorini_solve::{Options, ScalarKind, solve};

use crate::command::{
    Folder, each_refused, json, meshes, refused, repository, says, says_of, text,
};

const MOVING: &str = "catalogue/moving-tri.toml";
const LEVEE: &str = "scenes/levee.toml";

/// A scene of the repository.
fn standard(name: &str) -> Scene {
    Scene::read(&repository("meshes").join(name)).expect("a scene")
}

/// `ticks.csv`: the names of its columns, and the fields of each line.
pub struct Table {
    pub header: Vec<String>,
    pub lines: Vec<Vec<String>>,
}

impl Table {
    pub fn read(path: impl AsRef<Path>) -> Self {
        let mut reader = csv::Reader::from_path(path).expect("ticks.csv");
        let fields = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect();
        let header = fields(reader.headers().expect("a header"));
        let lines = reader.records().map(|record| fields(&record.expect("a line"))).collect();
        Self { header, lines }
    }

    pub fn column(&self, name: &str) -> Vec<&str> {
        let at = self.header.iter().position(|column| column == name).expect("a column");
        self.lines.iter().map(|line| line[at].as_str()).collect()
    }

    pub fn numbers(&self, name: &str) -> Vec<f64> {
        self.column(name).iter().map(|field| field.parse().expect("a number")).collect()
    }
}

/// Plays a scene of the repository, which must end with status 0.
pub fn played(scene: &str, more: &[&str]) -> Table {
    let folder = Folder::new();
    let run = folder.run("out", "tick", &meshes(scene), more).succeeds();
    assert_eq!(run.stderr, "", "quiet in a pipe");
    let picture = text(folder.path("out/ticks.svg"));
    assert!(picture.starts_with("<svg ") && !picture.contains("NaN"));
    Table::read(folder.path("out/ticks.csv"))
}

/// The ticks of a moving contact: ten seconds of work, for several tests.
fn moving() -> &'static Table {
    static PLAYED: OnceLock<Table> = OnceLock::new();
    PLAYED.get_or_init(|| played(MOVING, &[]))
}

#[test]
fn a_line_a_tick_and_a_column_an_output_each_from_the_last_answer() {
    let levee = played(LEVEE, &["--ticks", "4"]);
    let fixed = ["t", "status", "sweeps", "contact_force", "contact_length", "error_bound"];
    assert_eq!(levee.header, [&fixed[..], &["seepage", "wet", "head"]].concat());
    assert_eq!(levee.column("t"), ["0.0", "0.01", "0.02", "0.03"]);
    let moving = moving();
    assert_eq!(moving.header, [&fixed[..], &["error_combined"]].concat());
    assert_eq!(moving.lines.len(), 21);
    assert_eq!(moving.numbers("t")[20], 1.0);
    let sweeps = levee.numbers("sweeps");
    assert!(sweeps[0] > 100.0 && sweeps[1..].iter().all(|&sweeps| sweeps < 20.0), "{sweeps:?}");
    let moving = moving.numbers("sweeps");
    assert!(moving[1..].iter().all(|&warm| warm < 0.8 * moving[0]), "{moving:?}");
}

/// By the solver's own answers and by the controller's few numbers; the seepage of a finer mesh lies within both.
#[test]
fn outputs_have_bounds_beside_them() {
    let bounds = |more: &[&str]| {
        let folder = Folder::new();
        folder.run("out", "tick", &meshes(LEVEE), &[&["--ticks", "2"], more].concat()).succeeds();
        Table::read(folder.path("out/output_bounds.csv"))
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

/// A head that jumps along the river leaves no bound: the reason stands where the interval would.
#[test]
fn without_a_bound_the_reason_is_said() {
    let folder = Folder::new();
    let jump = [("\"-4.5\"", "\"-4.5 + 0.1*sign(y - 2.3)\"")];
    let scene = folder.scene("levee.toml", LEVEE, &jump);
    for more in [&["--ticks", "2"][..], &["--ticks", "2", "--baked"]] {
        let said = folder.run("out", "tick", &scene, more).succeeds().stdout;
        says(
            &said,
            &["no interval of seepage, head in 2 of 2 ticks: the value of boundary.river near"],
        );
    }
}

#[test]
fn a_series_has_a_file_for_each_tick_and_none_of_an_earlier_run() {
    let folder = Folder::new();
    let listed = |more: &[&str]| {
        folder.run("out", "tick", &meshes(LEVEE), more).succeeds();
        let series = text(folder.path("out/ticks.pvd"));
        let files = std::fs::read_dir(folder.path("out/ticks")).expect("files").count();
        assert_eq!(series.matches("<DataSet").count(), files);
        let second = "timestep=\"0.01\" part=\"0\" file=\"ticks/0001.vtu\"";
        assert!(series.contains(second), "{series}");
        files
    };
    assert_eq!(listed(&["--vtu", "--ticks", "4"]), 4);
    assert_eq!(listed(&["--vtu", "--ticks", "2", "--baked"]), 2);
}

#[test]
fn the_force_of_a_moving_contact_is_pi_a_squared() {
    let narrow = played(MOVING, &["--scalar", "f32", "--no-intervals"]);
    for (scalar, table) in [("f64", moving()), ("f32", &narrow)] {
        for (t, force) in table.numbers("t").into_iter().zip(table.numbers("contact_force")) {
            let a = 0.55 + 0.1 * (2.0 * std::f64::consts::PI * t).sin();
            let exact = std::f64::consts::PI * a * a;
            MOVING_FORCE.check_relative(format_args!("{scalar}, t = {t}"), force, exact);
        }
    }
}

#[test]
fn a_budget_cuts_off_and_is_carried_on() {
    let table = played(LEVEE, &["--ticks", "80", "--budget-sweeps", "50", "--no-intervals"]);
    assert!(table.numbers("sweeps").iter().all(|&sweeps| sweeps <= 50.0));
    let status = table.column("status");
    assert_eq!((status[0], status[79]), ("out-of-sweeps", "settled"));
}

#[test]
fn a_log_replays_what_inputs_say() {
    let folder = Folder::new();
    // As an editor may have left it, with a byte order mark.
    let log = &*folder.write("inputs.csv", "\u{feff}t,rain,river\n-1,2,0.5\n0.25, 2, 0.5\n");
    let replayed = played(LEVEE, &["--log", log]);
    let set = played(LEVEE, &["--ticks", "1", "--input", "rain=2", "--input", "river=0.5"]);
    assert_eq!(replayed.column("t"), ["-1.0", "0.25"]);
    assert_eq!(replayed.lines[0][1..], set.lines[0][1..]);
    let force = |table: &Table, line: usize| table.numbers("contact_force")[line];
    let moved = force(&replayed, 1) / force(&set, 0) - 1.0;
    REPLAYED.check("nothing changed", moved);
    assert!(replayed.numbers("sweeps")[1] <= 4.0, "nothing changed");

    folder.write("inputs.csv", "t,rain\n0,2\n");
    let rest = played(LEVEE, &["--log", log, "--input", "river=0.5"]);
    assert_eq!(rest.lines[0][1..], set.lines[0][1..]);
}

#[test]
fn a_log_is_replayed_by_the_baked_controller() {
    let folder = Folder::new();
    let log = &*folder.write("inputs.csv", "t,rain,river\n0,0,0\n1,2,0.5\n2,2,0.5\n");
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
    for other in [&["--budget-sweeps", "9"][..], &["--error", "0.1"], &["--coarse", "a.msh"]] {
        let arguments = [&["--log", log, "--baked"], other].concat();
        says(&refused("tick", &meshes(LEVEE), &arguments), &other[..1]);
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

/// Data far from 1 are played in other units, and each number of the table comes back in the scene's.
#[test]
fn other_units_change_no_digit() {
    let units = Units { u: 2f64.powi(-60), conductivity: 2f64.powi(-80), zero: 0.0 };
    let moments = [0.0, 0.05].map(|time| ScheduledTick { time, inputs: Vec::new() });
    let membrane = "scenes/membrane.toml";
    for (name, scalar) in
        [(MOVING, ScalarKind::F32), (MOVING, ScalarKind::F64), (membrane, ScalarKind::F64)]
    {
        let scene = standard(name);
        let mesh = mesh::read(&scene.mesh.value).expect("a mesh");
        let played = |units: Units| {
            let scene = units.inverse().scene(&scene);
            let problem = Problem::new(&scene, mesh.clone()).expect("a problem");
            let own = Budget { scalar, sweeps: 20_000, ..Budget::of(&scene) };
            let budget = Budget { intervals: false, shows_start: false, ..own };
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
    let folder = Folder::new();
    let said = |log: &[u8]| {
        let log = folder.write("inputs.csv", log);
        refused("tick", &meshes(LEVEE), &["--log", &log])
    };
    for (text, line, expected) in WRONG_LOGS {
        let message = said(text.as_bytes());
        assert!(message.contains(&format!("inputs.csv:{line}:")), "{text:?}: {message}");
        assert!(message.contains(expected), "{text:?}: {message}");
    }
    says(&said(b"t,rain\n0,\xff\n"), &["inputs.csv:2: not UTF-8"]);
    says(&refused("tick", &meshes(LEVEE), &["--log", "nowhere.csv"]), &["nowhere.csv"]);
}

#[test]
fn a_scene_without_time_needs_a_number_of_ticks() {
    let message = refused("tick", &meshes("catalogue/h-tri.toml"), &[]);
    says(&message, &["h-tri.toml: time:", "--ticks"]);
    let table = played("catalogue/h-tri.toml", &["--ticks", "2"]);
    assert_eq!(table.column("t"), ["0.0", "1.0"]);
}

/// The mesh holds u exactly, and rounding of its large values is all that is left.
#[test]
fn ticks_end_where_rounding_is_all_that_is_left() {
    let folder = Folder::new();
    let mesh = meshes("catalogue/square-quad-16.msh");
    let scene = folder.write("a.toml", in_time(&mesh, "1000.3 + x + t", "900", ""));
    for scalar in ["f64", "f32"] {
        folder.run("out", "tick", &scene, &["--ticks", "6", "--scalar", scalar]).succeeds();
        let table = Table::read(folder.path("out/ticks.csv"));
        assert!(table.column("status").iter().all(|status| *status == "settled"));
        assert!(table.numbers("sweeps").iter().all(|sweeps| *sweeps < 5000.0), "{scalar}");
    }
}

/// A scene with this Dirichlet value, this gap and further sections.
fn in_time(mesh: &str, value: &str, gap: &str, more: &str) -> String {
    format!(
        "mesh = {mesh:?}\n[material.default]\nconductivity = 1\n\n[boundary.dirichlet]\n\
         kind = \"dirichlet\"\nvalue = \"{value}\"\n[boundary.contact]\nkind = \"contact\"\n\
         gap = \"{gap}\"\n{more}"
    )
}

/// A Dirichlet value and a gap of a scene, further sections, and parts of the message.
const WRONG_IN_TIME: &[(&str, &str, &str, &[&str])] = &[
    ("1/(2 - t)", "0", "", &["boundary.dirichlet.value", "a.toml:7:", "t = 2"]),
    ("1", "ln(2.5 - t)", "", &["boundary.contact.gap", "t = 3"]),
    ("1", "0", "[time]\nstep = 1e-9\nend = 1e9\n", &["time", "--ticks"]),
];

#[test]
fn data_that_turn_wrong_are_refused_with_their_time() {
    let (folder, mesh) = (Folder::new(), meshes("catalogue/square-tri-16.msh"));
    for (value, gap, more, expected) in WRONG_IN_TIME {
        let scene = folder.write("a.toml", in_time(&mesh, value, gap, more));
        let count: &[&str] = if more.is_empty() { &["--ticks", "4"] } else { &[] };
        says_of(value, &refused("tick", &scene, count), expected);
    }
}

/// u_D falls below the gap for one tick, in t and by an input without a range: that row is empty, and the next ones go on.
#[test]
fn ticks_whose_data_exclude_each_other_have_no_answer() {
    let (folder, mesh) = (Folder::new(), meshes("catalogue/square-tri-16.msh"));
    let checked = |scene: &str, more: &[&str]| {
        let run = folder.run("out", "tick", scene, more);
        assert_eq!(run.status, 3, "{}{}", run.stdout, run.stderr);
        let excluded = "1 of 4 ticks have data that exclude each other";
        says(&run.stderr, &[excluded, "the first at t = 2 (excluded)"]);
        let table = Table::read(folder.path("out/ticks.csv"));
        let is_excluded: Vec<_> =
            table.column("status").iter().map(|&status| status == "excluded").collect();
        assert_eq!(is_excluded, [false, false, true, false], "{more:?}");
        assert!(table.lines[2][3..].iter().all(String::is_empty), "{:?}", table.lines);
        assert!(table.lines[3][3..].iter().all(|field| !field.is_empty()), "{:?}", table.lines);
    };
    let scene = folder.write("t.toml", in_time(&mesh, "abs(t - 2) - 0.5", "0", ""));
    checked(&scene, &["--ticks", "4"]);
    let input = "[input.level]\nof = \"dirichlet\"\nfield = \"value\"\npattern = \"1\"\n";
    let scene = folder.write("level.toml", in_time(&mesh, "1", "0", input));
    let log = folder.write("log.csv", "t,level\n0,1\n1,-0.5\n2,-1.5\n3,0\n");
    for more in [&[][..], &["--baked"], &["--baked", "--scalar", "f64"]] {
        checked(&scene, &[&["--log", &log], more].concat());
    }
    // Ranges within which it can happen are refused at once.
    let ranged = in_time(&mesh, "1", "0", &format!("{input}range = [-1.5, 1]\n"));
    let scene = folder.write("ranged.toml", ranged);
    for command in ["solve", "bake", "tick"] {
        let more: &[&str] = if command == "tick" { &["--ticks", "4"] } else { &[] };
        let expected = "input.level.range: with level = -1.5 u_D = -0.5 of boundary.dirichlet";
        says_of(command, &refused(command, &scene, more), &[expected]);
    }
}

#[test]
fn wrong_arguments_are_refused() {
    let rows: [(&[&str], &str); 5] = [
        (&["--ticks", "0"], "--ticks"),
        (&["--ticks", "1000001"], "--ticks"),
        (&["--budget-sweeps", "0"], "--budget-sweeps"),
        (&["--ticks", "2", "--log", "inputs.csv"], "--log"),
        (&["--input", "snow=1"], "snow"),
    ];
    each_refused(&rows, |arguments| refused("tick", &meshes(LEVEE), arguments));
}

/// A heater whose supply sags: each tick ends where a solve with this limit does, within its bound.
#[test]
fn a_limit_may_change_from_tick_to_tick() {
    let folder = Folder::new();
    let whole = text(meshes("limits/l-tri.toml"));
    let (_, exact) = whole.split_once("[exact]").expect("an exact solution");
    let outputs = "[input.supply]\nof = \"contact\"\nfield = \"limit\"\npattern = \"1\"\n\
                   [output.power]\nkind = \"flux\"\nof = \"contact\"\n\
                   [output.short]\nkind = \"saturated\"\n[output.kept]\nkind = \"length\"\n";
    let changed = [(&*format!("[exact]{exact}"), outputs)];
    let scene = folder.scene("sags.toml", "limits/l-tri.toml", &changed);
    let supply = [0.0, -0.5, -1.2, -1.5, 3.0, 1e6, 0.0];
    let lines = supply.iter().enumerate().map(|(t, supply)| format!("{t},{supply}\n"));
    let log = folder.write("log.csv", format!("t,supply\n{}", lines.collect::<String>()));
    folder.run("out", "tick", &scene, &["--log", &log]).succeeds();
    let table = Table::read(folder.path("out/ticks.csv"));
    let posed = Scene::read(Path::new(&scene)).expect("a scene");
    let mesh = mesh::read(&posed.mesh.value).expect("a mesh");
    let posed = Problem::new(&posed, mesh).expect("a problem");
    for (at, &supply) in supply.iter().enumerate() {
        let now = posed.with_inputs(&[supply]).expect("loads");
        let solved = solve(&now, &Options::default()).expect("a solution");
        let values = outputs_of(&now, &solved).expect("outputs");
        for name in ["power", "short", "kept"] {
            let (ticked, exact) = (table.numbers(name)[at], values[name].expect("a value"));
            let what = format!("{name} at {supply}: {ticked} {exact}");
            LIMIT_OF_TICKS.check(what, ticked - exact);
        }
        assert!(table.numbers("error_bound")[at] >= solved.bound.expect("a bound").total * 0.99);
    }
    let said =
        folder.run("out", "tick", &scene, &["--ticks", "1", "--input", "supply=-2"]).refuses();
    says(&said, &["the limit is -0.5", "less than flux = 0"]);
}

/// The slab with its coefficient as an input, at the value that it had: each tick is the scene's own, and its own baked
/// module's.
#[test]
fn a_coefficient_that_an_input_sets_is_the_one_that_the_scene_states() {
    let folder = Folder::new();
    let stated = "coefficient = \"15\"";
    let input = "[input.h]\nof = \"air\"\nfield = \"coefficient\"\npattern = \"1\"\n\
                 default = 15\nrange = [5, 80]\n[output.power]";
    let own = [(stated, "coefficient = \"0\""), ("[output.power]", input)];
    let scene = folder.scene("slab.toml", "scenes/slab.toml", &own);
    let power = |scene: &str, more: &[&str]| {
        folder.run("out", "tick", scene, &[&["--ticks", "2"], more].concat()).succeeds();
        Table::read(folder.path("out/ticks.csv")).numbers("power")
    };
    let stated = power(&meshes("scenes/slab.toml"), &[]);
    for (name, more) in [("own", &[][..]), ("module", &["--baked", "--scalar", "f64"])] {
        for (own, stated) in power(&scene, more).iter().zip(&stated) {
            STATED.check_relative(name, *own, *stated);
        }
    }
    says(&refused("tick", &scene, &["--input", "h=81"]), &["--input h=81"]);
}

#[test]
fn errors_are_measured_at_the_time_of_the_problem() {
    let scene = standard(MOVING);
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
    assert!(error(&problem) > 10.0 * at_start, "another time's solution is far away");
}

#[test]
fn a_coarser_mesh_saves_sweeps_at_the_first_tick() {
    let scene = standard(MOVING);
    for cells in [Cells::Triangles, Cells::Quads, Cells::Mixed] {
        let on = |n| Problem::new(&scene, grid(n, cells)).expect("a problem");
        let (fine, coarse) = (on(24), on(12));
        let moments = [ScheduledTick { time: 0.3, inputs: Vec::new() }];
        let own = Budget { scalar: ScalarKind::F64, sweeps: 10_000, ..Budget::of(&scene) };
        let budget = Budget { intervals: false, shows_start: false, ..own };
        let first = |coarse: Option<&Problem>| {
            let ticks = play(&fine, coarse, &moments, &budget, |_, _| Ok(())).expect("a tick");
            (ticks[0].sweeps, ticks[0].bound.expect("a bound").total)
        };
        let ((cold, bound), (warm, same)) = (first(None), first(Some(&coarse)));
        assert!(2 * warm <= cold, "{cells:?}: {warm} sweeps, {cold} without");
        COARSE_START.check_relative(format_args!("{cells:?}"), same, bound);
        // In millimetres it is another domain.
        let mut mesh = grid(12, cells);
        mesh.vertices.iter_mut().flatten().for_each(|x| *x *= 1e3);
        let foreign = Problem::new(&scene, mesh).expect("a problem");
        let said = play(&fine, Some(&foreign), &moments, &budget, |_, _| Ok(()));
        let expected = "--coarse: the mesh goes from (-1000, 0) to (1000, 1000)";
        says(&said.expect_err("another domain").to_string(), &[expected]);
    }
}

/// A heater whose supply sags below what it gives at least: the log's line says so, not the scene's.
#[test]
fn ends_that_a_log_turns_round_are_blamed_on_its_line() {
    let folder = Folder::new();
    let ends = "flux = \"-2\"\nlimit = \"0\"\n";
    let cap = "[input.cap]\nof = \"contact\"\nfield = \"limit\"\npattern = \"1\"\ndefault = 1\n";
    let mesh = meshes("catalogue/square-tri-16.msh");
    let scene = folder.write("l.toml", in_time(&mesh, "0", "0", &format!("{ends}{cap}")));
    let log = folder.write("sagging.csv", "t,cap\n0,1\n1,-3\n2,1\n");
    let message = refused("tick", &scene, &["--log", &log]);
    says(&message, &["sagging.csv:3:", "at t = 1", "the limit is -3"]);
    assert!(!message.contains("l.toml"), "{message}");
}

/// Writes the scene of a plate that contact alone holds and an input pushes on.
pub fn pushed(folder: &Folder, more: &str) -> String {
    let mesh = meshes("catalogue/square-tri-16.msh");
    let text = format!(
        "mesh = {mesh:?}
material.default.conductivity = 1
boundary.contact.kind = \"contact\"
boundary.default = {{ kind = \"neumann\", flux = 0 }}
boundary.dirichlet = {{ kind = \"neumann\", flux = -1 }}
input.push.of = \"dirichlet\"
input.push.field = \"flux\"
input.push.pattern = 1
{more}"
    );
    folder.write("free.toml", text)
}

/// A plate that contact alone holds, pushed on, pulled off, in balance, and pushed on as before: rows without a solution are
/// empty, and the last is the first.
#[test]
fn a_log_goes_on_beyond_loads_that_contact_cannot_hold() {
    let folder = Folder::new();
    let outputs = "output.power = { kind = \"force\" }\noutput.wet = { kind = \"length\" }\n";
    let scene = pushed(&folder, &format!("input.push.range = [-3, 3]\n{outputs}"));
    let log = folder.write("log.csv", "t,push\n0,-1\n1,2\n2,1\n3,-1\n");
    let late = folder.write("late.csv", "t,push\n0,2\n1,-1\n");
    let never = folder.write("never.csv", "t,push\n0,2\n5,3\n");
    for more in [&[][..], &["--baked"], &["--baked", "--scalar", "f64"]] {
        let ticked = |log: &str| {
            let run = folder.run("out", "tick", &scene, &[&["--log", log], more].concat());
            assert_eq!(run.status, 3, "{}{}", run.stdout, run.stderr);
            let bounds = Table::read(folder.path("out/output_bounds.csv"));
            (run.stderr, Table::read(folder.path("out/ticks.csv")), bounds)
        };
        let (said, table, bounds) = ticked(&log);
        let status = table.column("status");
        assert_eq!(status[1..3], ["no-solution", "not-unique"], "{more:?}");
        assert_eq!(status[0], status[3], "{more:?}");
        for at in [1, 2] {
            assert!(table.lines[at][3..].iter().all(String::is_empty), "{:?}", table.lines);
            assert!(bounds.lines[at][1..].iter().all(String::is_empty), "{:?}", bounds.lines);
        }
        assert!(table.lines[0][3..].iter().all(|field| !field.is_empty()), "{:?}", table.lines);
        // 1 + 1 is pushed through each unit of a length of 4.
        let force: [f64; 2] = [0, 3].map(|at| table.column("power")[at].parse().expect("a force"));
        assert!(force.iter().all(|force| (force - 8.0).abs() < 1e-4), "{force:?}");
        let warned: Vec<_> = said.lines().filter(|line| line.contains("warning")).collect();
        assert_eq!(warned.len(), 1, "{said}");
        assert!(warned[0].contains("2 of 4 ticks") && warned[0].contains("t = 1"), "{said}");
        let status = |(_, table, _): (String, Table, Table)| table.column("status").join(" ");
        assert!(status(ticked(&late)).starts_with("no-solution "), "{more:?}");
        assert_eq!(status(ticked(&never)), "no-solution no-solution", "{more:?}");
    }
}

/// A plate that stores u and is held above, with outputs of it.
fn storing(more: &str) -> String {
    let mesh = meshes("catalogue/square-tri-16.msh");
    let plate = in_time(&mesh, "1", "0", "")
        .replace("conductivity = 1\n", "conductivity = 1\ncapacity = 2\n");
    format!("{plate}[output.heat]\nkind = \"content\"\n[time]\nstep = 0.1\n{more}")
}

#[test]
fn what_is_stored_has_columns_for_the_evolution() {
    let folder = Folder::new();
    let sure = "[output.sure]\nkind = \"window\"\n";
    let scene = folder.write("plate.toml", storing(&format!("initial = \"y\"\n{sure}")));
    let said = folder.run("out", "tick", &scene, &["--ticks", "3"]).succeeds().stderr;
    let moved = "warning: time.initial is moved to the gap or the given u on";
    assert!(said.starts_with(moved), "{said}");
    says(&said, &["by 9.69e-1 at most"]);
    let ticks = Table::read(folder.path("out/ticks.csv"));
    assert_eq!(ticks.column("sure"), ticks.column("window_energy"));
    let bounds = Table::read(folder.path("out/output_bounds.csv"));
    let heat = ticks.numbers("heat");
    let [least, most] = ["heat_least", "heat_most"].map(|name| bounds.column(name));
    assert_eq!((least[0], most[0]), ("", ""), "the start has none");
    for at in 1..heat.len() {
        let [least, most] = [least[at], most[at]].map(|end| end.parse::<f64>().expect("an end"));
        assert!(least < heat[at] && heat[at] < most, "{least} {} {most}", heat[at]);
    }
    // The steady state has no bound over time, and all else.
    let steady = folder.run("steady", "solve", &scene, &[]).succeeds();
    assert_eq!(steady.stderr.matches("warning: ").count(), 1, "{}", steady.stderr);
    says(&steady.stderr, &["output.sure has no value: the steady state has no bound over time"]);
    let summary = json(folder.path("steady/summary.json"));
    assert!(summary["outputs"]["sure"].is_null(), "{}", summary["outputs"]);
    assert!(summary["outputs"]["heat"].is_number(), "{}", summary["outputs"]);
}

#[test]
fn steps_in_f32_that_are_too_short_are_said() {
    let folder = Folder::new();
    let scene = folder.write("plate.toml", storing(""));
    let short = ["--ticks", "1", "--step", "2e-6", "--no-intervals"];
    let said = |more: &[&str]| {
        folder.run("out", "tick", &scene, &[&short[..], more].concat()).succeeds().stderr
    };
    says(&said(&["--scalar", "f32"]), &["of the time in which u decays: in f32"]);
    assert_eq!(said(&[]), "");
}

#[test]
fn why_there_is_no_bound_over_time_is_said() {
    let folder = Folder::new();
    let plate = storing("initial = \"1/(x^2 + (y - 0.4)^2)\"\n");
    let held_by_contact = storing("initial = \"y\"\n")
        .replace("kind = \"dirichlet\"\nvalue =", "kind = \"neumann\"\nflux =");
    for (text, why) in [
        (plate, "no bound over time: time.initial may be unbounded somewhere"),
        (held_by_contact, "no bound over time: neither a given u nor a transfer law holds"),
    ] {
        let scene = folder.write("plate.toml", text);
        let said = folder.run("out", "tick", &scene, &["--ticks", "2"]).succeeds().stderr;
        assert_eq!(said.matches("no bound over time").count(), 1, "{said}");
        says(&said, &[why]);
        let ticks = Table::read(folder.path("out/ticks.csv"));
        assert_eq!(ticks.column("window_energy"), ["", "", ""]);
        assert!(ticks.column("error_bound")[1..].iter().all(|bound| !bound.is_empty()));
    }
}

#[test]
fn no_output_has_the_name_of_a_column() {
    let scene = |outputs: &str| {
        let text = text(repository("meshes").join(LEVEE));
        text.replace("mesh = \"", &format!("mesh = \"{}/", repository("meshes/scenes").display()))
            + outputs
    };
    let folder = Folder::new();
    let flux = "kind = \"flux\"\nof = \"river\"\n";
    for (outputs, said) in [
        (format!("[output.error_bound]\n{flux}"), "output.error_bound: ticks.csv has a column"),
        (
            format!("[output.q]\nkind = \"probe\"\nat = [1.0, 0.1]\n[output.q_cell]\n{flux}"),
            "output.q_cell: output_bounds.csv has a column",
        ),
    ] {
        let path = folder.write("scene.toml", scene(&outputs));
        let message = refused("tick", &path, &[]);
        assert!(message.contains(said) && message.contains("another name"), "{message}");
    }
}
