//! `cargo xtask installs`: what users install works away from the checkout: the program that `cargo install` makes, or it says with
//! status 2 what it lacks there, and the Python module from its source distribution and its wheel.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::program;
use crate::python;
use crate::steps::Steps;
use signorini_image::cargo::{cargo, root, run as run_cargo, target_dir};
use signorini_image::files;
use signorini_image::toolchain::output;

/// A scene with its mesh.
const GIVEN: [&str; 2] = ["meshes/scenes/levee.toml", "meshes/scenes/levee.msh"];

/// A command, the status it ends with, and a file that it leaves or words that it says.
struct Case {
    words: &'static [&'static str],
    status: i32,
    shows: &'static str,
}

impl Case {
    const fn works(words: &'static [&'static str], file: &'static str) -> Self {
        Self { words, status: 0, shows: file }
    }

    /// A command that needs a checkout.
    const fn refused(words: &'static [&'static str]) -> Self {
        Self { words, status: 2, shows: "no checkout of the sources" }
    }
}

/// What a program says quickly.
const LIGHT: [Case; 3] = [
    Case::works(&["bake", "levee.toml", "-o", "levee.rs", "--explain"], "levee.rs"),
    Case::refused(&[]),
    Case::refused(&["trade"]),
];

/// A library for C, which cargo builds from what the program carries.
const OF_C: &[&str] = &["bake", "levee.toml", "--c", "c", "--board", "host"];

/// The rest.
const OTHERS: [Case; 8] = [
    Case::works(&["new", "levee.msh", "--out", "new.toml"], "new.toml"),
    Case::works(&["check", "levee.toml", "--draw", "plan.svg"], "plan.svg"),
    Case::works(&["solve", "levee.toml"], "out/levee/edges.csv"),
    Case::works(&["tick", "levee.toml", "--ticks", "5"], "out/levee/ticks.csv"),
    Case::works(OF_C, "c/liblevee.a"),
    Case::works(&["trade", "set.toml", "--no-peers"], "out/set/trade.json"),
    Case::works(&["extremes", "--random", "3"], "out/extremes/random.json"),
    Case::refused(&["trade", "levee.toml", "--target", "m4f"]),
];

/// The steps.
pub fn run(steps: &mut Steps) {
    let installed = Away::new("installed");
    let program = installed.as_ref().map(|away| away.0.join("bin/signorini"));
    steps.compile("cargo install --path host", || {
        let mut install = cargo(&["install", "--path", "host", "--locked", "--quiet", "--root"]);
        install.arg(&installed.as_ref().map_err(Clone::clone)?.0);
        install.env("CARGO_TARGET_DIR", target_dir(""));
        run_cargo(install)
    });
    if let (Ok(away), Ok(program)) = (&installed, &program) {
        LIGHT.iter().chain(&OTHERS).for_each(|case| away.step(steps, program, case));
        let lacks = Case { words: OF_C, status: 2, shows: "install Rust's toolchain" };
        steps.check("away from the checkout and from cargo: signorini bake --c", || {
            away.ends(away.command(program).env("PATH", &away.0), &lacks)
        });
        steps.check("the baked module compiles against what it names", || away.compile("levee"));
    }
    python::distributed(steps);
}

/// A few of the commands, by a copy of the program that the other steps have built.
pub fn witness(steps: &mut Steps) {
    let made = Away::new("copied").and_then(|away| {
        let program = away.0.join("signorini");
        let copied = std::fs::copy(program::path()?, &program);
        copied.map(|_| (away, program)).map_err(|error| error.to_string())
    });
    match made {
        Ok((away, program)) => LIGHT.iter().for_each(|case| away.step(steps, &program, case)),
        Err(why) => steps.check("a program away from the checkout", || Err(why)),
    }
}

/// A folder of this process where no folder above is a checkout; removed at its end.
struct Away(PathBuf);

impl Away {
    /// The folder, with a scene.
    fn new(name: &str) -> Result<Self, String> {
        let folder = env::temp_dir().join(format!("signorini-{name}-{}", std::process::id()));
        let away = Self(files::emptied(&folder)?);
        for file in GIVEN {
            let text = files::text(&root().join(file))?;
            let name = Path::new(file).file_name().unwrap_or_default();
            files::write(&away.0.join(name), &text)?;
        }
        // A study measures a scene with a setting of its own in that alone.
        let scene = files::text(&root().join(GIVEN[0]))?;
        files::write(&away.0.join("set.toml"), scene + "\n[setting]\nscalar = \"f32\"\n")?;
        Ok(away)
    }

    fn step(&self, steps: &mut Steps, program: &Path, case: &Case) {
        let name = format!("away from the checkout: signorini {}", case.words.join(" "));
        steps.check(name.trim_end(), || self.ends(&mut self.command(program), case));
    }

    /// `Ok` where the program ends as the case says.
    fn ends(&self, program: &mut Command, case: &Case) -> Result<(), String> {
        let ended = program.args(case.words).output();
        let ended =
            ended.map_err(|error| format!("{}: {error}", program.get_program().display()))?;
        let said = String::from_utf8_lossy(&ended.stderr);
        let is_shown = match case.status {
            0 => self.0.join(case.shows).is_file(),
            // Lines are broken where the terminal ends.
            _ => said.split_whitespace().collect::<Vec<_>>().join(" ").contains(case.shows),
        };
        match ended.status.code() == Some(case.status) && is_shown {
            true => Ok(()),
            false => Err(format!("{}, and not {}: {said}", ended.status, case.shows)),
        }
    }

    /// A command in this folder, which knows of the checkout no more than a user's does.
    fn command(&self, program: &Path) -> Command {
        let mut command = Command::new(program);
        command.current_dir(&self.0).env("XDG_CACHE_HOME", self.0.join("cache"));
        for variable in ["CARGO_MANIFEST_DIR", "CARGO_TARGET_DIR", "CARGO"] {
            command.env_remove(variable);
        }
        command
    }

    /// A program with the module, and the dependency that the module names.
    fn compile(&self, module: &str) -> Result<(), String> {
        let text = files::text(&self.0.join(format!("{module}.rs")))?;
        let dependency = text.lines().find_map(|line| line.split_once("signorini-device = "));
        let (_, dependency) = dependency.ok_or("the module names no dependency")?;
        let manifest = format!(
            "[package]\nname = \"user\"\nedition = \"2024\"\n\n[workspace]\n\n[dependencies]\nsignorini-device = {dependency}\n"
        );
        let main = format!(
            "#[path = \"../../{module}.rs\"]\nmod {module};\nfn main() {{ println!(\"{{}}\", size_of::<{module}::Controller>()) }}\n"
        );
        files::write(&self.0.join("user/Cargo.toml"), manifest)?;
        files::write(&self.0.join("user/src/main.rs"), main)?;
        let mut build = self.command(Path::new("cargo"));
        output(build.arg("run").arg("--quiet").current_dir(self.0.join("user"))).map(drop)
    }
}

impl Drop for Away {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
