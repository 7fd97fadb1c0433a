//! Runs that are killed: what stands under a final name is whole, and what stood there before is not lost.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Instant;

use signorini_tolerances::is_whole;

use crate::command::{Folder, meshes, signorini, word};

/// A run of `signorini` that writes into `out`.
fn start(words: &[&str], scene: &str, out: &Path) -> Child {
    let mut command = signorini(&[&[words[0], scene, "--out", &word(out)], &words[1..]].concat());
    command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("the binary runs")
}

fn finish(mut child: Child) {
    let status = child.wait().expect("it ends");
    assert!(status.code().is_some(), "{status}");
}

/// The files under names that users know, not the temporary ones beside them.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let known = paths.filter(|path| !name(path).starts_with(".tmp"));
    let mut files: Vec<_> =
        known.map(|path| (name(&path), std::fs::read(&path).expect("a file"))).collect();
    files.sort();
    files
}

/// The file as it is in every complete run, without what the clock says.
fn timeless((name, bytes): &(String, Vec<u8>)) -> (String, String) {
    let text = String::from_utf8(bytes.clone()).expect("text");
    let whole = match name.as_str() {
        "summary.json" => {
            let mut value: serde_json::Value = serde_json::from_str(&text).expect("whole JSON");
            value.as_object_mut().expect("an object").remove("seconds");
            value.to_string()
        }
        _ => text,
    };
    (name.clone(), whole)
}

/// Ends a run again and again, a little later each time, with these signals in turn.
fn killed(words: &[&str], scene: &str, signals: &[&str]) {
    let folder = Folder::new();
    let (complete, out) = (folder.path("complete"), folder.path("out"));
    let begin = Instant::now();
    finish(start(words, &meshes(scene), &complete));
    let takes = begin.elapsed();
    let expected: Vec<_> = files(&complete).iter().map(timeless).collect();
    assert!(expected.len() > 1, "{expected:?}");
    let (mut seen, steps) = (0, if is_whole() { 8 } else { 4 });
    for step in 0..steps {
        let mut child = start(words, &meshes(scene), &out);
        // The files come last: most of the kills fall there.
        sleep(takes.mul_f64(0.6 + 0.8 * f64::from(step) / f64::from(steps)));
        let signal = signals[step as usize % signals.len()];
        let kill = Command::new("kill").args([signal, &child.id().to_string()]).output();
        kill.expect("kill runs");
        child.wait().expect("it ends");
        let found = files(&out);
        assert!(found.len() >= seen, "a file is lost");
        seen = found.len();
        for file in found.iter().map(timeless) {
            assert!(expected.contains(&file), "a part of {}", file.0);
        }
    }
    // Whatever was left behind, the next run completes.
    finish(start(words, &meshes(scene), &out));
    let found: Vec<_> = files(&out).iter().map(timeless).collect();
    assert_eq!(found, expected);
}

#[test]
fn a_solve_that_is_killed_or_interrupted_leaves_whole_files() {
    killed(&["solve"], "catalogue/h-mixed.toml", &["-KILL", "-INT"]);
}

#[test]
fn ticks_that_are_killed_leave_whole_files() {
    killed(&["tick", "--ticks", "4"], "scenes/levee.toml", &["-KILL"]);
}
