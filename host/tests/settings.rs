//! Every key of `[setting]` by every command: followed, or refused by its name.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Small enough to be baked in every way; held, with an input and an output.
const SCENE: &str = r#"
[material.default]
conductivity = 1
[boundary.default]
kind = "dirichlet"
value = "0"
[boundary.contact]
kind = "contact"
gap = "-1"
[input.heat]
of = "source"
field = "f"
pattern = "1"
default = -20.0
[output.force]
kind = "force"
"#;

/// The commands with what follows the scene; `OUT` stands for a file to write.
const COMMANDS: [(&str, &[&str]); 8] = [
    ("solve", &[]),
    ("solve", &["--solver", "direct"]),
    ("solve", &["--max-sweeps", "100000"]),
    ("bake", &["-o", "OUT"]),
    ("tick", &["--ticks", "2", "--baked"]),
    ("tick", &["--ticks", "2"]),
    ("export", &["-o", "OUT"]),
    ("condense", &["-o", "OUT"]),
];

/// Keys, and for each command whether it follows them (or says what takes their place).
#[rustfmt::skip] // A table.
const FOLLOWED: &[(&str, [bool; 8])] = &[
    //                                              solve  direct sweeps bake   baked  tick   export condense
    ("refine = 1",                                  [true,  true,  true,  true,  true,  true,  true,  true ]),
    ("error = '40%'",                               [true,  true,  true,  true,  true,  true,  true,  true ]),
    ("cells = 'quads'",                             [true,  true,  true,  true,  true,  true,  true,  true ]),
    ("cells = 'quads'\nelement = 'nonparametric'",  [true,  true,  true,  true,  true,  true,  true,  true ]),
    ("scalar = 'f32'",                              [true,  false, true,  true,  true,  true,  true,  true ]),
    ("scalar = 'f64'",                              [true,  true,  true,  true,  true,  true,  true,  false]),
    ("scalar = 'f32+f64'",                          [true,  false, false, false, false, false, false, false]),
    ("math = 'micromath'\nscalar = 'f32'",          [true,  false, true,  true,  true,  false, false, false]),
    ("model = 'full'",                              [true,  true,  true,  true,  true,  true,  true,  false]),
    ("model = 'condensed'",                         [true,  true,  true,  true,  true,  false, false, true ]),
    ("solver = 'sweeps'",                           [true,  true,  true,  true,  true,  true,  false, false]),
    ("solver = 'factor'",                           [true,  true,  true,  true,  true,  false, false, false]),
    ("start = 'cold'",                              [true,  true,  true,  true,  true,  false, false, false]),
    ("omega = 1.9",                                 [true,  true,  true,  true,  true,  false, false, false]),
    ("sweeps = 12",                                 [true,  true,  true,  true,  true,  false, false, false]),
    ("share = 0.1",                                 [true,  true,  true,  true,  true,  false, false, false]),
    ("certificate = false",                         [true,  true,  true,  true,  true,  false, false, false]),
];

/// Keys that the command line takes the place of are named in a warning.
const REPLACED: [&str; 8] =
    ["math", "model", "solver", "start", "omega", "sweeps", "share", "certificate"];

/// Exit status and standard error.
fn run(command: &str, more: &[&str], scene: &Path, folder: &Path) -> (Option<i32>, String) {
    let (file, out) = (folder.join("written"), folder.join("out"));
    let mut process = Command::new(env!("CARGO_BIN_EXE_signorini"));
    process.arg(command).arg(scene);
    if matches!(command, "solve" | "tick") {
        process.arg("--out").arg(&out);
    }
    for word in more {
        match *word {
            "OUT" => process.arg(&file),
            word => process.arg(word),
        };
    }
    let output = process.output().expect("the binary runs");
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

fn mesh() -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../meshes/catalogue");
    folder.join("square-tri-16.msh").canonicalize().expect("a mesh")
}

#[test]
fn every_key_is_followed_or_refused_by_its_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join("scene.toml");
    for (lines, expected) in FOLLOWED {
        let text = format!("mesh = {:?}\n{SCENE}[setting]\n{lines}\n", mesh());
        std::fs::write(&scene, text).expect("a scene");
        let key = lines.split(' ').next().unwrap_or_default();
        for ((command, more), follows) in COMMANDS.into_iter().zip(expected) {
            let (status, stderr) = run(command, more, &scene, folder.path());
            let what = format!("{lines}: {command} {more:?}: {status:?} {stderr}");
            let expected = if *follows { &[Some(0), Some(3)][..] } else { &[Some(2)] };
            assert!(expected.contains(&status), "{what}");
            let refused = stderr.contains("setting.") && stderr.contains("scene.toml");
            assert!(*follows || refused, "{what}");
            let overridden = command == "solve" && !more.is_empty() && REPLACED.contains(&key);
            if overridden && *follows {
                assert!(stderr.contains("takes the place of") && stderr.contains(key), "{what}");
            }
        }
    }
}
