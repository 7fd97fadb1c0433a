//! Runs of the command as users meet it, and the files that they need.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// Exit status, standard output and standard error.
#[derive(Debug)]
pub struct Run {
    pub status: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Run {
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
    let output = signorini(words).output().expect("the binary runs");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let (status, stderr) = (output.status.code().unwrap_or(-1), text(&output.stderr));
    assert!(!stderr.contains("panicked"), "{stderr}");
    Run { status, stdout: text(&output.stdout), stderr }
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
