//! `cargo xtask mutants`: do the tests notice when the kernel is wrong?
//!
//! cargo-mutants lists the mutants, single changes of the kernel; `tests/mutants` compiles all of them at once and
//! judges each by the tests that come past it. What is found of a file is kept in git until the file changes.

mod record;
mod survivors;

use std::path::Path;

use clap::Args;
use serde::Deserialize;

use crate::baked::Failure;
use crate::counted::counted;
use crate::steps::Steps;
use record::{Record, Row, SOURCES, content, sources};
use signorini_image::cargo::{cargo, root, run as run_cargo, run_with_lines, target_dir};
use signorini_image::files;
use signorini_image::toolchain::output;
use survivors::{Key, Survivors};

/// The sources that are mutated.
#[derive(Debug, Args)]
pub struct Options {
    /// Mutates all sources, those too that have not changed
    #[arg(long)]
    force: bool,
    /// Mutates these sources of the kernel alone
    #[arg(value_name = "FILE", value_parser = source)]
    files: Vec<String>,
}

/// The program that judges.
pub const MANIFEST: &str = "tests/mutants/Cargo.toml";
/// Percent of the mutants that compile.
const KILLED: usize = 95;

/// The verb.
pub fn run(options: &Options) -> Result<(), Failure> {
    judge(options)?;
    Ok(check()?)
}

/// The path of a source file of the kernel, as it is.
fn source(path: &str) -> Result<String, String> {
    let is_below = |folder: &&str| Path::new(path).starts_with(folder);
    match SOURCES.iter().any(is_below) && root().join(path).is_file() {
        true => Ok(path.to_owned()),
        false => Err("no source file of the kernel".to_owned()),
    }
}

/// A step of every run: record and list can be read.
pub fn witness(steps: &mut Steps) {
    steps.check("the record of mutants and its list", || {
        let (record, survivors) = (Record::read()?, Survivors::read()?);
        let is_there = !record.0.is_empty() && !survivors.0.is_empty();
        if is_there { Ok(()) } else { Err("one of them is empty".to_owned()) }
    });
}

/// The steps of a whole run: no mutant runs, the record and the list must agree.
pub fn verify(steps: &mut Steps) {
    steps.check("mutants as recorded", check);
    steps.step("switches of mutants", || {
        let target = target_dir("mutants").join("judge").display().to_string();
        Ok(counted(&["test", "--locked", "--manifest-path", MANIFEST, "--target-dir", &target]))
    });
}

/// `Ok` where every file has been judged, enough mutants are killed and the rest has reasons.
fn check() -> Result<(), String> {
    let (record, survivors) = (Record::read()?, Survivors::read()?);
    let mut wrong = Vec::new();
    for file in sources()? {
        let Some(row) = record.0.get(&file) else {
            wrong.push(format!("{file} has not been judged"));
            continue;
        };
        if row.content != content(&file)? {
            println!("{file} has changed since its mutants were judged");
        }
        let listed = survivors.of(&file);
        if listed != row.missed {
            wrong.push(format!("{file}: {} missed, {listed} are listed", row.missed));
        }
    }
    let unread = survivors.0.iter().filter(|known| known.reason.is_empty());
    let unread = unread.map(|known| known.count).sum::<usize>();
    if unread > 0 {
        wrong.push(format!("{unread} mutants live without a reason"));
    }
    let (killed, viable) = record.killed();
    println!("{killed} of {viable} mutants are killed");
    if 100 * killed < KILLED * viable || viable == 0 {
        wrong.push(format!("{KILLED} % are asked for"));
    }
    if wrong.is_empty() { Ok(()) } else { Err(wrong.join("; ") + "; run `cargo xtask mutants`") }
}

fn judge(Options { force, files: named }: &Options) -> Result<(), String> {
    let (mut record, mut survivors) = (Record::read()?, Survivors::read()?);
    let files = sources()?;
    for gone in record.0.keys().filter(|file| !files.contains(file)) {
        survivors.replace(gone, &[]);
    }
    record.0.retain(|file, _| files.contains(file));
    let mut stale = Vec::new();
    for file in files {
        let same =
            record.0.get(&file).is_some_and(|row| Ok(&row.content) == content(&file).as_ref());
        if named.contains(&file) || (named.is_empty() && (*force || !same)) {
            stale.push(file);
        }
    }
    if stale.is_empty() {
        println!("no file has changed since its mutants were judged");
        return Ok(());
    }
    let found = run_all(&stale)?;
    for file in stale {
        let of_file: Vec<_> = found.iter().filter(|found| found.key.file == file).collect();
        let with = |outcome: &str| of_file.iter().filter(|found| found.outcome == outcome).count();
        let (caught, timeout, unviable) = (with("caught"), with("timeout"), with("unviable"));
        let missed: Vec<Key> =
            of_file.iter().filter(|found| found.lives()).map(|found| found.key.clone()).collect();
        survivors.replace(&file, &missed);
        let (content, missed) = (content(&file)?, missed.len());
        record.0.insert(file, Row { content, caught, timeout, missed, unviable });
    }
    record.write()?;
    survivors.write()
}

/// A mutant and what became of it: a line of the judge.
#[derive(Deserialize)]
struct Found {
    outcome: String,
    #[serde(flatten)]
    key: Key,
}

fn run_all(files: &[String]) -> Result<Vec<Found>, String> {
    let work = target_dir("mutants");
    let path = work.join("list.json");
    list(&path)?;
    let words = ["run", "--quiet", "--locked", "--manifest-path", MANIFEST];
    let mut command = cargo(&words);
    command.arg("--target-dir").arg(work.join("judge")).arg("--");
    command.arg(path).arg(root()).arg(&work).args(files);
    let mut found = Vec::new();
    let mut problem = Ok(());
    run_with_lines(command, |line| match serde_json::from_str(line) {
        Ok(one) => found.push(one),
        Err(why) => problem = Err(format!("the judge says `{line}`: {why}")),
    })?;
    problem.map(|()| found)
}

/// Writes all mutants of the kernel, in JSON.
fn list(path: &Path) -> Result<(), String> {
    let mut listing = cargo(&["mutants", "--list", "--json"]);
    let crates = ["kernel", "bound", "contact", "device"].map(|name| format!("signorini-{name}"));
    listing.args(crates.iter().flat_map(|name| ["--package", name]));
    if output(&mut cargo(&["mutants", "--version"])).is_err() {
        println!("installing cargo-mutants");
        run_cargo(cargo(&["install", "--locked", "cargo-mutants"]))?;
    }
    let json = output(&mut listing)?;
    files::write(path, json)
}

impl Found {
    /// Whether no test has told it from the kernel: all passed, none comes past it, or it has no switch.
    fn lives(&self) -> bool {
        !["caught", "timeout", "unviable"].contains(&self.outcome.as_str())
    }
}
