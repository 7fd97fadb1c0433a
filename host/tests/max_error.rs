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

#[test]
fn what_is_not_reached_has_status_3_and_all_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = solve(&levee(), folder.path(), &["--max-error", "1%", "--max-unknowns", "2500"]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(said.contains("more than 2500 unknowns") && said.contains("--max-unknowns"), "{said}");
    let rows = levels(folder.path());
    let unknowns: usize = rows[rows.len() - 1][1].parse().expect("a number");
    assert!(unknowns <= 2500, "{rows:?}");
    for name in ["edges.csv", "summary.json", "solution.vtu", "refined.msh", "levels.pvd"] {
        assert!(folder.path().join(name).exists(), "{name}");
    }
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
