//! Runs of the command as users meet it, and the files that they need.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

/// Exit status, standard output and standard error.
#[derive(Debug)]
pub struct Run {
    pub status: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Run {
    fn of(output: Output) -> Self {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let (stdout, stderr) = (text(&output.stdout), text(&output.stderr));
        Self { status: output.status.code().unwrap_or(-1), stdout, stderr }
    }

    /// The run itself where its status is 0.
    #[track_caller]
    pub fn succeeds(self) -> Self {
        assert_eq!(self.status, 0, "{}{}", self.stdout, self.stderr);
        self
    }

    /// The message of wrong input.
    #[track_caller]
    pub fn refuses(self) -> String {
        assert_eq!(self.status, 2, "{}{}", self.stdout, self.stderr);
        assert!(self.stderr.len() < 4000, "{}", self.stderr);
        self.stderr
    }
}

/// The command, to be run with these words.
pub fn signorini(words: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_signorini"));
    command.args(words);
    command
}

/// Runs the command with these words.
#[track_caller]
pub fn run(words: &[&str]) -> Run {
    let run = Run::of(signorini(words).output().expect("the binary runs"));
    assert!(!run.stderr.contains("panicked"), "{}", run.stderr);
    run
}

/// The message of a command that must refuse its scene or what follows it, and leave nothing behind.
#[track_caller]
pub fn refused(verb: &str, scene: &str, more: &[&str]) -> String {
    let folder = Folder::new();
    let to = if matches!(verb, "solve" | "tick") { "--out" } else { "--output" };
    let message = run(&[&[verb, scene], more, &[to, &folder.word("out")]].concat()).refuses();
    assert!(!folder.path("out").exists(), "{verb} {more:?}: {message}");
    message
}

/// Asserts that each part stands in the text.
#[track_caller]
pub fn says(text: &str, parts: &[&str]) {
    says_of("", text, parts);
}

/// Asserts that each part stands in the text, which is that of a case of a table.
#[track_caller]
pub fn says_of(case: &str, text: &str, parts: &[&str]) {
    parts.iter().for_each(|part| assert!(text.contains(part), "{case} {part}: {text}"));
}

/// Asserts that each command is wrong input, and that its message has the words beside it.
#[track_caller]
pub fn each_refused(rows: &[(&[&str], &str)], message: impl Fn(&[&str]) -> String) {
    for (words, expected) in rows {
        let said = message(words);
        assert!(said.contains(expected), "{words:?}, {expected}: {said}");
    }
}

/// A file or a folder of the repository.
pub fn repository(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name)
}

/// The path of a standard mesh or scene, as a word.
pub fn meshes(name: &str) -> String {
    word(&repository("meshes").join(name))
}

/// A path as a word of the command line.
pub fn word(path: &Path) -> String {
    path.to_str().expect("UTF-8").to_owned()
}

/// The text of a file.
#[track_caller]
pub fn text(path: impl AsRef<Path>) -> String {
    let path = path.as_ref();
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The value in a file of JSON.
#[track_caller]
pub fn json(path: impl AsRef<Path>) -> Value {
    serde_json::from_str(&text(path)).expect("JSON")
}

/// Starts the command with these words, interrupts it once there is this file, and waits for its end.
#[cfg(unix)]
pub fn interrupted(words: &[&str], once: impl Fn() -> bool) -> Run {
    use std::process::Stdio;
    let mut command = signorini(words);
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    let child = command.spawn().expect("the binary runs");
    while !once() {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    let stop = Command::new("kill").arg("-INT").arg(child.id().to_string()).status();
    assert!(stop.expect("kill").success());
    Run::of(child.wait_with_output().expect("it ends"))
}

/// A folder that is gone after the test.
pub struct Folder(tempfile::TempDir);

impl Folder {
    pub fn new() -> Self {
        Self(tempfile::tempdir().expect("a folder"))
    }

    /// The path of a file in the folder, as a word.
    pub fn word(&self, name: &str) -> String {
        word(&self.path(name))
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Runs a verb on a scene, into a folder in this one.
    pub fn run(&self, out: &str, verb: &str, scene: &str, more: &[&str]) -> Run {
        run(&[&[verb, scene, "--out", &self.word(out)], more].concat())
    }

    /// Solves a scene, into the folder `out`; the run and its summary.
    #[track_caller]
    pub fn solve(&self, scene: &str, more: &[&str]) -> (Run, Value) {
        let run = self.run("out", "solve", scene, more);
        (run, json(self.path("out/summary.json")))
    }

    /// Writes a file; returns its path.
    pub fn write(&self, name: &str, text: impl AsRef<[u8]>) -> String {
        std::fs::write(self.path(name), text).expect("a file");
        self.word(name)
    }

    /// Writes a standard scene with parts of its text replaced; returns its path.
    pub fn scene(&self, name: &str, standard: &str, changes: &[(&str, &str)]) -> String {
        let path = repository("meshes").join(standard);
        let place = path.parent().expect("a folder").canonicalize().expect("the folder");
        let mut whole = text(&path);
        whole = whole.replace("mesh = \"", &format!("mesh = \"{}/", place.display()));
        for (part, by) in changes {
            assert!(whole.contains(part), "{part}");
            whole = whole.replace(part, by);
        }
        self.write(name, whole)
    }
}
