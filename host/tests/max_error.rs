//! `signorini solve --max-error`: the files of all levels, and how it ends.

use std::path::Path;

use signorini_tolerances::command::REFINED;

use crate::command::{self, Folder, json, meshes, run, says, text};
use crate::tick::Table;

fn levee() -> String {
    meshes("scenes/levee.toml")
}

/// `error_bound.total` and `relative_error_bound` of a summary.
fn bounds(out: &Path) -> [f64; 2] {
    let summary = json(out.join("summary.json"));
    let of = [&summary["error_bound"]["total"], &summary["relative_error_bound"]];
    of.map(|value| value.as_f64().expect("a number"))
}

/// `levels.csv`, and the bound of its last level.
fn levels(out: &Path) -> (Table, f64) {
    let table = Table::read(out.join("levels.csv"));
    let head = "level,unknowns,sweeps,error_bound,relative,contact_force,seconds";
    assert_eq!(table.header.join(","), head);
    let last = *table.numbers("error_bound").last().expect("a level");
    (table, last)
}

#[test]
fn the_last_level_meets_the_goal_and_its_mesh_gives_it_again() {
    let (folder, again) = (Folder::new(), Folder::new());
    let out = folder.path("out");
    folder.run("out", "solve", &levee(), &["--max-error", "8%"]).succeeds();
    let [total, relative] = bounds(&out);
    assert!(relative <= 0.08, "{relative}");
    let (table, last) = levels(&out);
    assert!(table.lines.len() > 3 && last == total, "{:?}", table.lines);
    let series = text(out.join("levels.pvd"));
    for level in table.column("level") {
        let file = format!("levels/{level:0>2}.vtu");
        assert!(series.contains(&format!("file=\"{file}\"")) && out.join(&file).exists(), "{file}");
    }
    let mesh = folder.word("out/refined.msh");
    again.run("out", "solve", &levee(), &["--mesh", &mesh, "--solver", "auto"]).succeeds();
    let found = bounds(&again.path("out"))[0];
    REFINED.check_relative("the bound on refined.msh", found, total);
}

#[test]
fn a_promised_error_gives_every_command_the_same_mesh() {
    let folder = Folder::new();
    let setting = [("[target]", "[setting]\nerror = \"25%\"\n[target]")];
    let scene = folder.scene("scene.toml", "scenes/levee.toml", &setting);
    let out = folder.path("out");
    let tick = ["tick", "--ticks", "2", "--out", "out"];
    let commands: [&[&str]; 3] = [&["solve", "--out", "out"], &["bake", "-o", "out.rs"], &tick];
    let notes = commands.map(|words| {
        let (last, rest) = words.split_last().expect("words");
        let said = run(&[&[rest[0], &scene], &rest[1..], &[&folder.word(last)]].concat());
        let said = said.succeeds().stderr;
        let note = said.lines().find(|line| line.starts_with("note: the mesh was refined to"));
        note.unwrap_or_else(|| panic!("{words:?}: {said}")).to_owned()
    });
    assert!(notes.iter().all(|note| *note == notes[0]), "{notes:?}");
    assert!(notes[0].contains("for all 1005 inputs tried"), "{}", notes[0]);
    let [_, relative] = bounds(&out);
    assert!(relative <= 0.25, "{relative}");
    let said = folder.run("out", "solve", &scene, &["--max-error", "30%"]).stderr;
    says(&said, &["takes the place of setting.error"]);
}

#[test]
fn what_is_not_reached_has_status_3_and_all_files() {
    let folder = Folder::new();
    let run =
        folder.run("out", "solve", &levee(), &["--max-error", "1%", "--max-unknowns", "2500"]);
    let said = run.stderr;
    assert_eq!(run.status, 3, "{said}");
    let more = "more than the 2500 that are allowed (--max-unknowns)";
    assert!(said.contains("the next mesh has") && said.contains(more), "{said}");
    let out = folder.path("out");
    let (table, _) = levels(&out);
    assert!(table.numbers("unknowns").iter().all(|unknowns| *unknowns <= 2500.0));
    let summary = text(out.join("summary.json"));
    assert!(summary.contains(more), "{summary}");
    for name in ["edges.csv", "summary.json", "solution.vtu", "refined.msh", "levels.pvd"] {
        assert!(out.join(name).exists(), "{name}");
    }
}

/// A folder tells of one run; files that the program has not written stay, and the mesh, which a scene may name.
#[test]
fn levels_of_an_earlier_run_do_not_stay() {
    let folder = Folder::new();
    let run = folder.run("out", "solve", &levee(), &["--max-error", "12%"]).succeeds();
    assert!(!run.stdout.contains("--max-error"), "{}", run.stdout);
    folder.write("out/levels/mine.txt", "mine");
    let (run, _) = folder.solve(&levee(), &[]);
    says(&run.stdout, &["for a smaller error: --max-error 5%"]);
    says(&run.succeeds().stderr, &["levels of an earlier --max-error are removed"]);
    let exists = |name: &&str| folder.path("out").join(name).exists();
    assert!(["levels/mine.txt", "refined.msh", "edges.csv"].iter().all(exists));
    assert!(!["levels.csv", "levels.pvd", "levels/00.vtu", "levels/01.vtu"].iter().any(exists));
    assert!(!folder.solve(&levee(), &[]).0.stderr.contains("removed"));
}

/// Whoever means 3 % and writes 3 is told what 3 is.
#[test]
fn an_absolute_goal_is_told_as_a_part() {
    let folder = Folder::new();
    let said = folder.run("out", "solve", &levee(), &["--max-error", "3"]).succeeds().stdout;
    let words =
        "--max-error 3 is an error in the unit of the energy norm, 33000 % of this solution's";
    says(&said, &[words, "--max-error 3% asks for a part"]);
}

/// Ctrl-C ends it after the level at hand, with the files of that.
#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_the_files_of_its_last_level() {
    let folder = Folder::new();
    let out = &folder.path("out");
    // Levels of an earlier run that went further.
    std::fs::create_dir_all(out.join("levels")).expect("a folder");
    (0..40).for_each(|at| drop(folder.write(&format!("out/levels/{at:02}.vtu"), "")));
    let words = ["solve", &levee(), "--out", &folder.word("out"), "--max-error", "0.01%"];
    let third = out.join("levels/02.vtu");
    let run = command::interrupted(&words, || std::fs::metadata(&third).expect("a file").len() > 0);
    assert_eq!(run.status, 3, "{}", run.stderr);
    says(&run.stderr, &["interrupted"]);
    let ((table, last), [total, _]) = (levels(out), bounds(out));
    assert_eq!(last, total);
    let files = std::fs::read_dir(out.join("levels")).expect("a folder").count();
    assert_eq!(files, table.lines.len());
}

#[test]
fn goals_that_are_none_are_refused() {
    let folder = Folder::new();
    for goal in ["0", "-5%", "NaN", "much"] {
        let said = folder.run("out", "solve", &levee(), &["--max-error", goal]).refuses();
        assert!(said.contains("--max-error") && said.contains("such as 0.01"), "{said}");
    }
    folder.run("out", "solve", &levee(), &["--max-unknowns", "100"]).refuses();
    assert!(!folder.path("out").exists());
}
