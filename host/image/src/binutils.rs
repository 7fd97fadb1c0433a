//! Programs that take objects apart and put them together, for libraries in C.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::toolchain::output;

/// Constants of the build that the library does not have: their sizes are what they tell.
const SIZES: [&str; 2] = ["size_of_state", "size_of_report"];

/// What every C compiler may call, and every C library has.
const OF_C: [&str; 4] = ["memcpy", "memmove", "memset", "memcmp"];

/// The programs that take objects apart and put them together.
pub(crate) struct Binutils {
    /// Before the name of each: those for a board have one.
    pub prefix: &'static str,
}

impl Binutils {
    fn command(&self, program: &str) -> Command {
        Command::new(format!("{}{program}", self.prefix))
    }

    fn run(&self, command: &mut Command) -> Result<String, String> {
        output(command).map_err(|why| match self.prefix {
            "" => format!("{why}; it belongs to what Debian calls binutils"),
            _ => why,
        })
    }

    /// The archive without LLVM's own copy of the code, which plugins of binutils take for it.
    pub fn without_bitcode(&self, whole: &Path, folder: &Path) -> Result<PathBuf, String> {
        let plain = folder.join("plain.a");
        let mut copy = self.command("objcopy");
        copy.args(["--remove-section=.llvmbc", "--remove-section=.llvmcmd"]).arg(whole).arg(&plain);
        self.run(&mut copy).map(|_| plain)
    }

    /// The symbols that `names` reach in `whole`, as one object.
    fn linked(&self, whole: &Path, names: &[String], object: &Path) -> Result<(), String> {
        let mut link = self.command("ld");
        link.args(["-r", "--gc-sections"]);
        names.iter().for_each(|name| {
            link.arg("-u").arg(name);
        });
        self.run(link.arg(whole).arg("-o").arg(object)).map(drop)
    }

    /// An object that shows these exports alone.
    pub fn object(
        &self,
        whole: &Path,
        name: &str,
        exports: &[&str],
        folder: &Path,
    ) -> Result<PathBuf, String> {
        let last = exports.last().copied().unwrap_or_default();
        let object = folder.join(format!("{name}_{last}.o"));
        let names: Vec<_> = exports.iter().map(|own| format!("{name}_{own}")).collect();
        self.linked(whole, &names, &object)?;
        let mut hide = self.command("objcopy");
        hide.arg("--strip-debug");
        names.iter().for_each(|name| {
            hide.arg(format!("--keep-global-symbol={name}"));
        });
        self.run(hide.arg(&object))?;
        let listing = self.run(self.command("nm").arg("-P").arg(&object))?;
        needs_nothing(&listing).map(|()| object)
    }

    /// The library.
    pub fn archive(
        &self,
        name: &str,
        objects: &[PathBuf],
        folder: &Path,
    ) -> Result<PathBuf, String> {
        let archive = folder.join(format!("lib{name}.a"));
        // `ar` adds to what is there.
        let _ = fs::remove_file(&archive);
        // D: without times and users, so that the same scene gives the same bytes.
        self.run(self.command("ar").arg("rcsD").arg(&archive).args(objects)).map(|_| archive)
    }

    /// Bytes of a state and of a report.
    pub fn sizes(&self, whole: &Path, name: &str, folder: &Path) -> Result<[usize; 2], String> {
        let object = folder.join(format!("{name}.sizes.o"));
        let names = SIZES.map(|own| format!("{name}_{own}"));
        self.linked(whole, &names, &object)?;
        let listing = self.run(self.command("nm").arg("-P").arg(&object))?;
        let size = |name: &String| {
            size_of_symbol(&listing, name)
                .ok_or_else(|| format!("the library does not tell {name}"))
        };
        Ok([size(&names[0])?, size(&names[1])?])
    }
}

/// `Ok` where no symbol is undefined but what every C library has.
fn needs_nothing(listing: &str) -> Result<(), String> {
    let undefined = listing.lines().filter_map(|line| {
        let (name, kind) = line.split_once(' ')?;
        kind.starts_with('U').then_some(name)
    });
    let known = |name: &&str| {
        let plain = name.strip_prefix("__aeabi_").unwrap_or(name).trim_end_matches(['4', '8']);
        OF_C.contains(&plain) || plain == "memclr"
    };
    match undefined.into_iter().find(|name| !known(name)) {
        None => Ok(()),
        Some(name) if name.contains("panic") => {
            Err(format!("the library can panic: it asks for {name}; this is a fault of signorini"))
        }
        Some(name) => Err(format!(
            "the library needs {name}, which no C library has; this is a fault of signorini"
        )),
    }
}

/// The size that `nm -P` tells of a symbol.
fn size_of_symbol(listing: &str, name: &str) -> Option<usize> {
    let line = listing.lines().find(|line| line.split(' ').next() == Some(name))?;
    usize::from_str_radix(line.split_whitespace().nth(3)?, 16).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_library_needs_is_read_from_its_symbols() {
        let listing = "levee_tick T 0 8c\nmemcpy U         \n__aeabi_memclr4 U         \n__aeabi_memcpy8 U \n";
        assert_eq!(needs_nothing(listing), Ok(()));
        let panics = "levee_tick T 0 8c\na_panic_path_is_reachable U         \n";
        assert!(needs_nothing(panics).is_err_and(|why| why.contains("can panic")));
        assert!(needs_nothing("malloc U \n").is_err_and(|why| why.contains("malloc")));
    }

    #[test]
    fn sizes_are_those_of_symbols() {
        let listing = "levee_size_of_report B 0 3c\nlevee_size_of_state R 1c 0278\n";
        assert_eq!(size_of_symbol(listing, "levee_size_of_state"), Some(0x278));
        assert_eq!(size_of_symbol(listing, "levee_size"), None);
    }
}
