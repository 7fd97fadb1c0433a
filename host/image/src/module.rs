//! A scene as a module of firmware, the programs that hold it, and what they say.
//!
//! Every module and every program is kept under a name of its own. Commands that run at the same time do not take each
//! other's: of two that make the same, the second waits until the first has done with its [`Module`], and programs,
//! which cargo puts under one name whatever their scene, are built and taken away in turns. A module builds each of its
//! programs once, and runs each once.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;

use crate::board::{Board, Build};
use crate::cargo::{build, cargo, root, target_dir};
use crate::chosen::Chosen;
use crate::files;
use crate::lock;
use crate::once::Once;
use crate::room::NoResult;
use crate::ticks::Ticks;
use crate::toolchain::output;

const PACKAGE: &str = "signorini-scene";

/// Ticks with drawn inputs that both programs play.
const DRAWN: usize = 101;

/// A module.
#[derive(Debug)]
pub struct Module {
    name: String,
    file: PathBuf,
    /// No other command has module and programs of this name meanwhile.
    _turn: Arc<File>,
    /// Whether builds are out of sight.
    quiet: bool,
    /// Features of its programs.
    more: &'static [&'static str],
    /// The log that its programs play.
    log: Option<PathBuf>,
    /// Programs by machine.
    programs: Once<PathBuf>,
    /// Ticks by machine.
    ticks: Once<Ticks>,
    /// Model and figures that the bake has chosen.
    pub chosen: Chosen,
}

impl Module {
    /// The module of this name, which `write` puts into a file: it stays untouched where it is what it was.
    ///
    /// # Errors
    /// Those of `write`; a file that cannot be written.
    pub fn new<E: From<String>>(
        name: &str,
        write: impl FnOnce(&Path) -> Result<Chosen, E>,
    ) -> Result<Self, E> {
        let folder = folder()?;
        let turn = lock::hold(&folder.join(format!("{name}.lock")))?;
        let fresh = folder.join(format!("{name}.{}.rs", std::process::id()));
        let chosen = write(&fresh).inspect_err(|_| drop(fs::remove_file(&fresh)))?;
        let file = folder.join(format!("{name}.rs"));
        take(&fresh, &file)?;
        let (programs, ticks) = (Once::default(), Once::default());
        let (name, quiet, more, log) = (name.to_owned(), false, &[][..], None);
        Ok(Self { name, file, _turn: Arc::new(turn), quiet, more, log, programs, ticks, chosen })
    }

    /// Puts its builds out of sight.
    #[must_use]
    pub fn quietly(self) -> Self {
        Self { quiet: true, ..self }
    }

    /// With programs whose ticks say where their outputs lie.
    #[must_use]
    pub fn that_locates(&self) -> Self {
        Self { more: &["between"], ..self.with_programs("between") }
    }

    /// With programs that play the log `file` instead of drawn inputs.
    ///
    /// # Errors
    /// There is no such file.
    pub fn that_replays(&self, file: &Path) -> Result<Self, String> {
        let log = files::named(file, file.canonicalize())?;
        let name = log.file_stem().unwrap_or_default().display().to_string();
        Ok(Self { log: Some(log), ..self.with_programs(&name) })
    }

    /// The same module, with programs of its own that `what` tells apart.
    fn with_programs(&self, what: &str) -> Self {
        Self {
            name: format!("{}--{what}", self.name),
            file: self.file.clone(),
            _turn: Arc::clone(&self._turn),
            log: self.log.clone(),
            programs: Once::default(),
            ticks: Once::default(),
            chosen: self.chosen.clone(),
            ..*self
        }
    }

    /// The number of ticks that its programs play.
    ///
    /// # Errors
    /// A log that cannot be read.
    pub fn played(&self) -> Result<usize, String> {
        let Some(log) = &self.log else { return Ok(DRAWN) };
        Ok(files::text(log)?.lines().count().saturating_sub(1))
    }

    /// The file that holds it.
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// The text of its file.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn text(&self) -> Result<String, String> {
        files::text(&self.file)
    }

    /// The image of a board.
    ///
    /// # Errors
    /// No room on the board, a build that fails.
    pub fn image(&self, board: &Board) -> Result<PathBuf, NoResult> {
        let linked = self.linked("scene", board, self.more);
        linked.map_err(|why| {
            NoResult::of(board, why, || self.linked("scene", &board.boundless(), self.more))
        })
    }

    /// The image that looks for the worst tick of a condensed scene.
    ///
    /// # Errors
    /// A build that fails.
    pub fn worst(&self, board: &Board) -> Result<PathBuf, String> {
        let follows = self.chosen.kernel_features.iter().any(|feature| feature == "transfer");
        let bin = match (follows, self.chosen.memory) {
            (true, _) => "worst_modes",
            (false, 0) => "worst",
            (false, _) => "worst_steps",
        };
        self.linked(bin, board, &[bin])
    }

    /// The ticks that a board plays, every instruction counted.
    ///
    /// # Errors
    /// No image; it fails.
    pub fn on_board(&self, board: &Board) -> Result<Ticks, NoResult> {
        let image = self.image(board)?;
        self.ticks.get(board.name, || Ok(Ticks::parse(&board.run(&image, true)?)))
    }

    /// The ticks that this machine plays.
    ///
    /// # Errors
    /// A build that fails; ticks that fail.
    pub fn on_desk(&self) -> Result<Ticks, String> {
        let mut command = Command::new(self.desk()?);
        if !self.quiet {
            // It says why a tick has no answer.
            command.stderr(Stdio::inherit());
        }
        self.ticks.get("desk", || Ok(Ticks::parse(&output(&mut command)?)))
    }

    fn linked(&self, bin: &str, board: &Board, more: &[&str]) -> Result<PathBuf, String> {
        let features = self.of_kernel();
        let features: Vec<&str> =
            features.iter().map(String::as_str).chain(more.iter().copied()).collect();
        // This package reads one scene; the folder of the exported ones is for others.
        let what =
            Build { package: PACKAGE, bins: &[bin], features: &features, scenes: &self.file };
        let (mut command, folder) = board.build(what)?;
        self.name_sources(&mut command);
        let machine = match bin {
            "scene" => board.memory_name(),
            _ => format!("{}.{bin}", board.memory_name()),
        };
        self.made(command, &folder.join(bin), &machine)
    }

    /// The program for the desk.
    ///
    /// # Errors
    /// A build that fails.
    pub fn desk(&self) -> Result<PathBuf, String> {
        let folder = target_dir("desk");
        let mut command = cargo(&["build", "--profile", "desk", "--locked", "-p", PACKAGE]);
        command.args(["--bin", "scene_desk", "--target-dir"]).arg(&folder);
        let own = ["desk"].iter().chain(self.more).map(|&own| own.to_owned()).collect();
        let features = [self.of_kernel(), own].concat();
        command.arg("--features").arg(features.join(","));
        self.name_sources(&mut command);
        command.current_dir(root().join("tests/firmware"));
        self.made(command, &folder.join("desk/scene_desk"), "desk")
    }

    /// Tells the build script of module and log.
    fn name_sources(&self, command: &mut Command) {
        command.env("SIGNORINI_SCENE", &self.file);
        match &self.log {
            Some(log) => command.env("SIGNORINI_LOG", log),
            None => command.env_remove("SIGNORINI_LOG"),
        };
    }

    fn of_kernel(&self) -> Vec<String> {
        let features = self.chosen.kernel_features.iter();
        features.map(|feature| format!("signorini-device/{feature}")).collect()
    }

    /// Builds `program` by `command`, once per machine; a copy that the next scene's does not replace.
    fn made(&self, command: Command, program: &Path, machine: &str) -> Result<PathBuf, String> {
        self.programs.get(machine, || {
            let _turn = lock::hold(&program.with_extension("lock"))?;
            build(command, self.quiet)?;
            let kept = folder()?.join(format!("{}.{machine}", self.name));
            files::named(program, fs::copy(program, &kept)).map(|_| kept)
        })
    }
}

/// Puts `fresh` in the place of `kept`, unless they are equal: images are then not built anew.
///
/// # Errors
/// A file that cannot be moved.
pub fn take(fresh: &Path, kept: &Path) -> Result<(), String> {
    let equal = fs::read(fresh).ok() == fs::read(kept).ok();
    let done = if equal { fs::remove_file(fresh) } else { fs::rename(fresh, kept) };
    files::named(kept, done)
}

fn folder() -> Result<PathBuf, String> {
    files::folder(&target_dir("firmware").join("baked"))
}
