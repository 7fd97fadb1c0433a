//! Which mutants compile: the compiler checks all of them at once, and its errors tell which do not.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use serde::Deserialize;

use crate::error::{Result, failed};
use crate::mutant::Mutant;
use crate::suite::PACKAGES;
use crate::tree::Tree;

#[derive(Deserialize)]
struct Message {
    message: Option<Diagnostic>,
}

#[derive(Deserialize)]
struct Diagnostic {
    level: String,
    message: String,
    rendered: Option<String>,
    spans: Vec<Place>,
}

#[derive(Deserialize)]
struct Place {
    file_name: String,
    byte_start: usize,
    is_primary: bool,
}

/// Verdicts on mutants before any test.
#[derive(Default)]
pub struct Viability {
    /// Mutants that do not compile.
    pub unviable: BTreeSet<u32>,
    /// Mutants whose switch does not compile, which tells nothing of the mutant itself.
    pub unswitched: BTreeSet<u32>,
    /// Functions that constants call.
    pub constant: BTreeSet<String>,
}

impl Viability {
    fn size(&self) -> usize {
        self.unviable.len() + self.unswitched.len() + self.constant.len()
    }

    /// Whether it compiles behind its switch, as far as is known.
    pub fn is_open(&self, id: u32) -> bool {
        !self.unviable.contains(&id) && !self.unswitched.contains(&id)
    }
}

/// Writes the tree so that the kernel compiles, with as many mutants as possible.
pub fn make_viable(tree: &Tree, mutants: &[Mutant], target: &Path) -> Result<Viability> {
    let mut known = Viability::default();
    loop {
        tree.write(&tree.checked, mutants, &mut known)?;
        let errors = check(&tree.checked, target)?;
        if errors.is_empty() {
            break;
        }
        let before = known.size();
        for error in &errors {
            blame(tree, error, &mut known)?;
        }
        if known.size() == before {
            let all = errors.iter().filter_map(|error| error.rendered.clone());
            return Err(failed(format!("no mutant is to blame for:\n{}", all.collect::<String>())));
        }
    }
    tree.write(&tree.built, mutants, &mut known)?;
    let unswitched = known.unswitched.clone();
    for mutant in mutants.iter().filter(|mutant| unswitched.contains(&mutant.id)) {
        tree.write_alone(mutant)?;
        if !check(&tree.checked, target)?.is_empty() {
            known.unviable.insert(mutant.id);
        }
        tree.write(&tree.checked, mutants, &mut known)?;
    }
    known.unswitched.retain(|id| !known.unviable.contains(id));
    Ok(known)
}

fn check(folder: &Path, target: &Path) -> Result<Vec<Diagnostic>> {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(["check", "--locked", "--message-format", "json"]);
    command.args(PACKAGES.iter().flat_map(|package| ["--package", package]));
    let output = command.arg("--target-dir").arg(target).current_dir(folder);
    let output = output.stderr(Stdio::null()).output()?;
    let messages = String::from_utf8_lossy(&output.stdout).into_owned();
    let errors = messages.lines().filter_map(|line| serde_json::from_str::<Message>(line).ok());
    let errors = errors.filter_map(|message| message.message);
    let errors = errors.filter(|m| m.level == "error" && !m.message.starts_with("aborting"));
    let errors: Vec<_> = errors.filter(|error| !error.spans.is_empty()).collect();
    if errors.is_empty() && !output.status.success() {
        return Err(failed("the kernel with switches cannot be checked"));
    }
    Ok(errors)
}

/// Finds the mutant whose own text an error is in, or the place of mutants that it is in, or the function that
/// a constant calls.
fn blame(tree: &Tree, error: &Diagnostic, known: &mut Viability) -> Result<()> {
    let kinds = ["non-const function `", "non-const method `", "non-const associated function `"];
    if let Some((_, called)) = kinds.iter().find_map(|kind| error.message.split_once(kind)) {
        let path = called.split(['`', '<']).next().unwrap_or_default().trim_end_matches("::");
        if let Some(name) = path.rsplit("::").next().filter(|name| *name != "on") {
            known.constant.insert(name.to_owned());
            return Ok(());
        }
    }
    let mut places: Vec<_> = error.spans.iter().collect();
    places.sort_by_key(|place| !place.is_primary);
    for place in places {
        let file = tree.checked.join(&place.file_name);
        let Ok(text) = fs::read_to_string(file) else { continue };
        match innermost(&text, place.byte_start) {
            Some(Mark::Mutant(id)) => {
                known.unviable.insert(id);
                return Ok(());
            }
            Some(Mark::Group(ids)) => {
                known.unswitched.extend(ids);
                return Ok(());
            }
            None => {}
        }
    }
    Ok(())
}

enum Mark {
    Mutant(u32),
    /// All mutants of a place.
    Group(Vec<u32>),
}

/// The innermost marks around a byte.
fn innermost(text: &str, byte: usize) -> Option<Mark> {
    let (before, behind) = (text.get(..byte)?, text.get(byte..)?);
    let mut closed = BTreeSet::new();
    for (at, _) in before.rmatch_indices("/*") {
        let Some(name) = before[at + 2..].split("*/").next() else { continue };
        if let Some(name) = name.strip_suffix('>') {
            closed.insert(name);
        } else if let Some(name) = name.strip_prefix('<')
            && !closed.remove(name)
        {
            let id = name.get(1..)?.parse().ok()?;
            if name.starts_with('m') {
                return Some(Mark::Mutant(id));
            }
            let end = byte + behind.find(&format!("/*{name}>*/"))?;
            let mut ids = own(&text[at + 2..end]);
            ids.push(id);
            return Some(Mark::Group(ids));
        }
    }
    None
}

/// The mutants of a place, without those of places within.
fn own(text: &str) -> Vec<u32> {
    let (mut depth, mut ids) = (0, Vec::new());
    for mark in text.split("/*").filter_map(|part| part.split("*/").next()) {
        match mark.get(..2) {
            Some("<g") => depth += 1,
            Some("<m") if depth == 0 => ids.extend(mark[2..].parse::<u32>().ok()),
            _ if mark.starts_with('g') && mark.ends_with('>') => depth -= 1,
            _ => {}
        }
    }
    ids
}
