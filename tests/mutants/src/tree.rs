//! A copy of the project with switches in the kernel.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{fs, io};

use crate::error::{Result, failed};
use crate::mutant::{Mutant, SourcePosition};
use crate::switch::switch;
use crate::viable::Viability;

/// What stands at the end of each `lib.rs` of the kernel in the copy.
const RUNTIME: &str = include_str!("runtime.txt");
/// The root modules of the kernel's crates.
const ROOTS: [&str; 4] = [
    "kernel/src/lib.rs",
    "kernel/bound/src/lib.rs",
    "kernel/contact/src/lib.rs",
    "kernel/device/src/lib.rs",
];
/// Mutants may do what no person would write.
const ALLOWED: &str =
    "#![allow(warnings, arithmetic_overflow, unconditional_panic, unused_comparisons)] ";

/// The copy, twice: in one the compiler looks for mutants that do not compile, the other is built, and what does
/// not change in it is not built anew.
pub struct Tree {
    /// The root of the one to build.
    pub built: PathBuf,
    /// The root of the one to check.
    pub checked: PathBuf,
    /// The kernel's sources as they are, by path.
    sources: BTreeMap<String, String>,
}

impl Tree {
    /// Copies what git knows of the project at `root`.
    pub fn new(root: &Path, work: &Path) -> Result<Self> {
        let (built, checked) = (work.join("tree"), work.join("check"));
        let mut list = Command::new("git");
        list.args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"]);
        let list = list.current_dir(root).output()?;
        let list = String::from_utf8_lossy(&list.stdout).into_owned();
        let paths: BTreeSet<&str> = list.split('\0').filter(|path| !path.is_empty()).collect();
        for copy in [&built, &checked] {
            remove_others(copy, Path::new("kernel"), &paths)?;
        }
        let mut sources = BTreeMap::new();
        for path in paths {
            let Some(bytes) = present(fs::read(root.join(path)))? else { continue };
            if is_source(path) {
                let text =
                    String::from_utf8(bytes).map_err(|_| failed(format!("{path}: not UTF-8")))?;
                sources.insert(path.to_owned(), text);
            } else {
                write(&built.join(path), &bytes)?;
                write(&checked.join(path), &bytes)?;
            }
        }
        Ok(Self { built, checked, sources })
    }

    /// Writes the kernel to one of the roots, with switches for all mutants of which nothing is known yet, and
    /// learns which cannot have one.
    pub fn write(&self, folder: &Path, mutants: &[Mutant], known: &mut Viability) -> Result<()> {
        for (path, text) in &self.sources {
            let own = mutants.iter().filter(|m| m.file == *path && known.is_open(m.id));
            let switched = switch(text, &own.collect::<Vec<_>>(), &known.constant)
                .map_err(|error| failed(format!("{path}: {error}")))?;
            known.unswitched.extend(switched.without);
            known.unviable.extend(switched.barred);
            let text = if ROOTS.contains(&path.as_str()) {
                ALLOWED.to_owned() + &switched.text + RUNTIME
            } else {
                switched.text
            };
            write(&folder.join(path), text.as_bytes())?;
        }
        Ok(())
    }

    /// Writes the file of a mutant to the root for checks, with nothing but this mutant in it.
    pub fn write_alone(&self, mutant: &Mutant) -> Result<()> {
        let text = self.sources.get(&mutant.file).ok_or_else(|| failed("no such file"))?;
        let byte = |place: SourcePosition| {
            let lines = text.split_inclusive('\n').take(place.line - 1);
            let column = text.lines().nth(place.line - 1).unwrap_or_default();
            let before = column.chars().take(place.column - 1).map(char::len_utf8);
            lines.map(str::len).sum::<usize>() + before.sum::<usize>()
        };
        let (start, end) = (byte(mutant.span.start), byte(mutant.span.end));
        let text = format!("{}{}{}", &text[..start], mutant.replacement, &text[end..]);
        write(&self.checked.join(&mutant.file), text.as_bytes())
    }
}

/// Whether a path is one of the kernel's own sources.
fn is_source(path: &str) -> bool {
    let folders = ROOTS.iter().filter_map(|root| root.strip_suffix("lib.rs"));
    path.ends_with(".rs") && folders.into_iter().any(|folder| path.starts_with(folder))
}

/// Removes what an earlier copy had below `folder` and git knows no more: cargo would find it.
fn remove_others(copy: &Path, folder: &Path, known: &BTreeSet<&str>) -> Result<()> {
    let Some(entries) = present(fs::read_dir(copy.join(folder)))? else { return Ok(()) };
    for entry in entries {
        let entry = entry?;
        let path = folder.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            remove_others(copy, &path, known)?;
        } else if !known.contains(path.to_string_lossy().as_ref()) {
            fs::remove_file(entry.path())?;
        }
    }
    Ok(())
}

/// A file that git knows may be gone.
fn present<T>(read: io::Result<T>) -> Result<Option<T>> {
    match read {
        Ok(found) => Ok(Some(found)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error.into()),
    }
}

/// Leaves a file that is the same alone, so that nothing is built anew for it.
fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    if fs::read(path).is_ok_and(|old| old == bytes) {
        return Ok(());
    }
    fs::create_dir_all(path.parent().unwrap_or(path))?;
    Ok(fs::write(path, bytes)?)
}
