//! Every key of `[setting]` by every command: followed, or refused by its name.

use signorini_scene::mesh::gmsh::write;
use signorini_scene::mesh::structured::{Cells, grid};

use crate::command::{Folder, Run, run};

/// Small enough to be baked in every way; held, with an input and an output.
const SCENE: &str = r#"
material.default.conductivity = 1
boundary.default = { kind = "dirichlet", value = "0" }
boundary.contact = { kind = "contact", gap = "-1" }
input.heat = { of = "source", field = "f", pattern = "1", default = -20.0 }
output.force = { kind = "force" }
"#;

/// The commands with what follows the scene.
const COMMANDS: [(&str, &[&str]); 6] = [
    ("solve", &[]),
    ("solve", &["--solver", "direct"]),
    ("solve", &["--max-sweeps", "100000"]),
    ("bake", &[]),
    ("tick", &["--ticks", "2", "--baked"]),
    ("tick", &["--ticks", "2"]),
];

/// Keys, and for each command whether it follows them (or says what takes their place).
#[rustfmt::skip] // A table.
const FOLLOWED: &[(&str, [bool; 6])] = &[
    //                                              solve  direct sweeps bake   baked  tick
    ("refine = 1",                                  [true,  true,  true,  true,  true,  true ]),
    ("error = '40%'",                               [true,  true,  true,  true,  true,  true ]),
    ("cells = 'quads'",                             [true,  true,  true,  true,  true,  true ]),
    ("cells = 'quads'\nelement = 'nonparametric'",  [true,  true,  true,  true,  true,  true ]),
    ("scalar = 'f32'",                              [true,  false, true,  true,  true,  true ]),
    ("scalar = 'f64'",                              [true,  true,  true,  true,  true,  true ]),
    ("scalar = 'f32+f64'",                          [true,  false, false, false, false, false]),
    ("math = 'micromath'\nscalar = 'f32'",          [true,  false, true,  true,  true,  false]),
    ("model = 'full'",                              [true,  true,  true,  true,  true,  true ]),
    ("model = 'condensed'",                         [true,  true,  true,  true,  true,  false]),
    ("solver = 'sweeps'",                           [true,  true,  true,  true,  true,  true ]),
    ("solver = 'factor'",                           [true,  true,  true,  true,  true,  false]),
    ("start = 'cold'",                              [true,  true,  true,  true,  true,  false]),
    ("omega = 1.9",                                 [true,  true,  true,  true,  true,  false]),
    ("sweeps = 12",                                 [true,  true,  true,  true,  true,  false]),
    ("share = 0.1",                                 [true,  true,  true,  true,  true,  false]),
    ("certificate = false",                         [true,  true,  true,  true,  true,  false]),
];

/// Keys that the command line takes the place of are named in a warning.
const REPLACED: [&str; 8] =
    ["math", "model", "solver", "start", "omega", "sweeps", "share", "certificate"];

#[test]
fn every_key_is_followed_or_refused_by_its_name() {
    let folder = Folder::new();
    let mesh = folder.write("small.msh", write::text(&grid(4, Cells::Triangles)));
    let (out, file) = (folder.word("out"), folder.word("written"));
    for (lines, expected) in FOLLOWED {
        let text = format!("mesh = {mesh:?}\n{SCENE}[setting]\n{lines}\n");
        let scene = folder.write("scene.toml", text);
        let key = lines.split(' ').next().unwrap_or_default();
        for ((command, more), follows) in COMMANDS.into_iter().zip(expected) {
            let has_folder = matches!(command, "solve" | "tick");
            let to = if has_folder { &["--out", &out][..] } else { &["-o", &file] };
            let Run { status, stderr, .. } = run(&[&[command, &scene], more, to].concat());
            let what = format!("{lines}: {command} {more:?}: {status} {stderr}");
            let expected = if *follows { &[0, 3][..] } else { &[2] };
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
