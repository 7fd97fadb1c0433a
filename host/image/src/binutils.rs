//! Programs that take objects apart and put them together, for libraries in C.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::objects::{Symbol, run, symbols};

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
        run(self.prefix, command)
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

    /// An object that shows these exports alone, each with what its name is to end with.
    pub fn object(
        &self,
        whole: &Path,
        name: &str,
        exports: &[(&str, &str)],
        folder: &Path,
    ) -> Result<PathBuf, String> {
        let last = exports.last().map_or("", |(own, _)| own);
        let object = folder.join(format!("{name}_{last}.o"));
        let names: Vec<_> = exports.iter().map(|(own, _)| format!("{name}_{own}")).collect();
        self.linked(whole, &names, &object)?;
        let mut hide = self.command("objcopy");
        hide.arg("--strip-debug");
        names.iter().for_each(|name| {
            hide.arg(format!("--keep-global-symbol={name}"));
        });
        self.run(hide.arg(&object))?;
        let mut mark = self.command("objcopy");
        names.iter().zip(exports).for_each(|(name, (_, end))| {
            mark.arg(format!("--redefine-sym={name}={name}{end}"));
        });
        self.run(mark.arg(&object))?;
        needs_nothing(&symbols(self.prefix, &object)?).map(|()| object)
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

    /// Bytes of the constant `name` of `whole`, which the library does not have: its size is what it tells.
    pub fn size(&self, whole: &Path, name: &str, folder: &Path) -> Result<usize, String> {
        let object = folder.join(format!("{name}.o"));
        self.linked(whole, &[name.to_owned()], &object)?;
        let found = symbols(self.prefix, &object)?;
        let symbol = found.iter().find(|symbol| symbol.name == name && symbol.size > 0);
        let missing = || format!("the library does not tell {name}");
        symbol.map(|symbol| symbol.size as usize).ok_or_else(missing)
    }
}

/// `Ok` where no symbol is undefined but what every C library has.
fn needs_nothing(symbols: &[Symbol]) -> Result<(), String> {
    let mut undefined = symbols.iter().filter(|symbol| symbol.is_asked() && !symbol.is_of_c());
    let Some(Symbol { name, .. }) = undefined.next() else { return Ok(()) };
    let fault = "this is a fault of signorini";
    Err(match name.contains("panic") {
        true => format!("the library can panic: it asks for {name}; {fault}"),
        false => format!("the library needs {name}, which no C library has; {fault}"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_library_needs_is_read_from_its_symbols() {
        let needs = |asked: &[&str]| {
            let symbol = |&name: &&str| Symbol { name: name.to_owned(), kind: 'U', size: 0 };
            let shown = Symbol { name: "levee_tick".to_owned(), kind: 'T', size: 0x8c };
            needs_nothing(&asked.iter().map(symbol).chain([shown]).collect::<Vec<_>>())
        };
        assert_eq!(needs(&["memcpy", "__aeabi_memclr4", "__aeabi_memcpy8"]), Ok(()));
        let panics = needs(&["a_panic_path_is_reachable"]);
        assert!(panics.is_err_and(|why| why.contains("can panic")));
        assert!(needs(&["malloc"]).is_err_and(|why| why.contains("malloc")));
    }
}
