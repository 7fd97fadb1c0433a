//! `signorini solve --max-error`: the files of all levels, and how it ends.

use std::path::Path;
use std::process::{Command, Output};

use signorini_tolerances::command::REFINED;

fn solve(scene: &Path, out: &Path, more: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_signorini"));
    command.arg("solve").arg(scene).arg("--out").arg(out).args(more);
    command.output().expect("the binary runs")
}

fn levee() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../meshes/scenes/levee.toml")
}

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// `error_bound.total` and `relative_error_bound` of a summary.
fn bounds(out: &Path) -> [f64; 2] {
    let summary: serde_json::Value =
        serde_json::from_str(&text(&out.join("summary.json"))).expect("JSON");
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    [number(&summary["error_bound"]["total"]), number(&summary["relative_error_bound"])]
}

/// The rows of `levels.csv` below its header.
fn levels(out: &Path) -> Vec<Vec<String>> {
    let table = text(&out.join("levels.csv"));
    let mut lines = table.lines();
    let head = "level,unknowns,sweeps,error_bound,relative,contact_force,seconds";
    assert_eq!(lines.next(), Some(head));
    lines.map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

#[test]
fn the_last_level_meets_the_goal_and_its_mesh_gives_it_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let (out, again) = (folder.path().join("out"), folder.path().join("again"));
    let output = solve(&levee(), &out, &["--max-error", "8%"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let [total, relative] = bounds(&out);
    assert!(relative <= 0.08, "{relative}");
    let rows = levels(&out);
    let last: f64 = rows[rows.len() - 1][3].parse().expect("a number");
    assert!(rows.len() > 3 && last == total, "{rows:?}");
    let series = text(&out.join("levels.pvd"));
    for row in &rows {
        let file = format!("levels/{:0>2}.vtu", row[0]);
        assert!(series.contains(&format!("file=\"{file}\"")) && out.join(&file).exists(), "{file}");
    }
    let mesh = out.join("refined.msh").to_string_lossy().into_owned();
    let output = solve(&levee(), &again, &["--mesh", &mesh, "--solver", "auto"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    REFINED.check_relative("the bound on refined.msh", bounds(&again)[0], total);
}

/// The levee with a setting of its own, in a folder.
fn with_setting(folder: &Path, setting: &str) -> std::path::PathBuf {
    let mesh = levee().with_file_name("levee.msh");
    let scene = text(&levee()).replace("mesh = \"levee.msh\"", &format!("mesh = {mesh:?}"));
    let path = folder.join("scene.toml");
    std::fs::write(&path, format!("{scene}\n[setting]\n{setting}\n")).expect("a scene");
    path
}

#[test]
fn a_promised_error_gives_every_command_the_same_mesh() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = with_setting(folder.path(), "error = \"25%\"");
    let out = folder.path().join("out");
    let commands: [&[&str]; 3] = [
        &["solve", "--out", "OUT"],
        &["bake", "-o", "OUT.rs"],
        &["tick", "--ticks", "2", "--out", "OUT"],
    ];
    let notes = commands.map(|words| {
        let word = |word: &&str| word.replace("OUT", &out.to_string_lossy());
        let mut command = Command::new(env!("CARGO_BIN_EXE_signorini"));
        command.arg(words[0]).arg(&scene).args(words[1..].iter().map(word));
        let output = command.output().expect("the binary runs");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{words:?}: {said}");
        let note = said.lines().find(|line| line.starts_with("note: the mesh was refined to"));
        note.unwrap_or_else(|| panic!("{words:?}: {said}")).to_owned()
    });
    assert!(notes.iter().all(|note| *note == notes[0]), "{notes:?}");
    assert!(notes[0].contains("for all 1005 inputs tried"), "{}", notes[0]);
    let [_, relative] = bounds(&out);
    assert!(relative <= 0.25, "{relative}");
    let more = solve(&scene, &out, &["--max-error", "30%"]);
    let said = String::from_utf8_lossy(&more.stderr).into_owned();
    assert!(said.contains("takes the place of setting.error"), "{said}");
}

#[test]
fn what_is_not_reached_has_status_3_and_all_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = solve(&levee(), folder.path(), &["--max-error", "1%", "--max-unknowns", "2500"]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(
        said.contains("the next mesh has")
            && said.contains("more than the 2500 that are allowed (--max-unknowns)"),
        "{said}"
    );
    let rows = levels(folder.path());
    let unknowns: usize = rows[rows.len() - 1][1].parse().expect("a number");
    assert!(unknowns <= 2500, "{rows:?}");
    let summary = text(&folder.path().join("summary.json"));
    assert!(summary.contains("more than the 2500 that are allowed (--max-unknowns)"), "{summary}");
    for name in ["edges.csv", "summary.json", "solution.vtu", "refined.msh", "levels.pvd"] {
        assert!(folder.path().join(name).exists(), "{name}");
    }
}

/// Ctrl-C ends it after the level at hand, with the files of that.
#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_the_files_of_its_last_level() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path();
    // Levels of an earlier run that went further.
    std::fs::create_dir_all(out.join("levels")).expect("a folder");
    (0..40).for_each(|at| {
        std::fs::write(out.join(format!("levels/{at:02}.vtu")), "").expect("a file")
    });
    let mut command = Command::new(env!("CARGO_BIN_EXE_signorini"));
    command.arg("solve").arg(levee()).arg("--out").arg(out).args(["--max-error", "0.01%"]);
    command.stdout(std::process::Stdio::null()).stderr(std::process::Stdio::piped());
    let child = command.spawn().expect("the binary runs");
    while std::fs::metadata(out.join("levels/02.vtu")).expect("a file").len() == 0 {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    let stop = Command::new("kill").arg("-INT").arg(child.id().to_string()).status();
    assert!(stop.expect("kill").success());
    let output = child.wait_with_output().expect("it ends");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(said.contains("interrupted"), "{said}");
    let (rows, [total, _]) = (levels(out), bounds(out));
    let last: f64 = rows[rows.len() - 1][3].parse().expect("a number");
    assert_eq!(last, total);
    let files = std::fs::read_dir(out.join("levels")).expect("a folder").count();
    assert_eq!(files, rows.len());
}

#[test]
fn goals_that_are_none_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    for goal in ["0", "-5%", "NaN", "much"] {
        let output = solve(&levee(), folder.path(), &["--max-error", goal]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("--max-error") && said.contains("such as 0.01"), "{said}");
    }
    let output = solve(&levee(), folder.path(), &["--max-unknowns", "100"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 0);
}
