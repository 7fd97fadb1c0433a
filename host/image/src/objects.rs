//! Sections and symbols of objects, archives and images, by `size` and `nm` of binutils.

use std::path::Path;
use std::process::Command;

use crate::toolchain::output;

/// Before the names of programs for boards.
pub const ARM: &str = "arm-none-eabi-";

/// Functions that every C compiler may call, and every C library has.
const OF_C: [&str; 5] = ["memcpy", "memmove", "memset", "memcmp", "memclr"];

/// A symbol.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Symbol {
    /// Its name, mangled.
    pub name: String,
    /// `U` where others have it; else a capital where others may have it.
    pub kind: char,
    /// Bytes; 0 where nobody tells.
    pub size: u64,
}

impl Symbol {
    /// Whether others must have it.
    pub fn is_asked(&self) -> bool {
        self.kind == 'U'
    }

    /// Whether others may call it.
    pub fn is_shown(&self) -> bool {
        self.kind.is_uppercase() && !self.is_asked()
    }

    /// Whether it is a function of every C library, by its own name or by the run-time ABI's.
    pub fn is_of_c(&self) -> bool {
        let plain = self.name.strip_prefix("__aeabi_").unwrap_or(&self.name);
        OF_C.contains(&plain.trim_end_matches(['4', '8']))
    }
}

/// Runs a program of binutils, [`ARM`] or nothing before its name.
///
/// # Errors
/// It does not start, or fails: what it said.
pub fn run(prefix: &str, command: &mut Command) -> Result<String, String> {
    output(command).map_err(|why| match prefix {
        "" => format!("{why}; it belongs to what Debian calls binutils"),
        _ => why,
    })
}

/// All symbols of a file, those of an archive's members in their order.
///
/// # Errors
/// Those of [`run`].
pub fn symbols(prefix: &str, file: &Path) -> Result<Vec<Symbol>, String> {
    let listing = run(prefix, Command::new(format!("{prefix}nm")).arg("-P").arg(file))?;
    Ok(listing.lines().filter_map(symbol).collect())
}

/// A line is `NAME KIND [PLACE [SIZE]]`; what is not, names a member.
fn symbol(line: &str) -> Option<Symbol> {
    let mut words = line.split_whitespace();
    let (name, kind) = (words.next()?.to_owned(), words.next()?.chars().next()?);
    let size = words.nth(1).and_then(|size| u64::from_str_radix(size, 16).ok());
    Some(Symbol { name, kind, size: size.unwrap_or(0) })
}

/// The sections of an ARM object or image: names and bytes.
///
/// # Errors
/// Those of [`run`].
pub fn sections(file: &Path) -> Result<Vec<(String, u64)>, String> {
    let table = run(ARM, Command::new(format!("{ARM}size")).arg("-A").arg(file))?;
    let section = |line: &str| {
        let mut words = line.split_whitespace();
        Some((words.next()?.to_owned(), words.next()?.parse().ok()?))
    };
    Ok(table.lines().filter_map(section).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(line: &str) -> Option<(String, char, u64)> {
        symbol(line).map(|symbol| (symbol.name, symbol.kind, symbol.size))
    }

    #[test]
    fn symbols_are_told_apart() {
        assert_eq!(read("libkernel.a[bar.o]:"), None);
        assert_eq!(read("memcpy U         "), Some(("memcpy".to_owned(), 'U', 0)));
        assert_eq!(read("force_f32_u16 T 0 8c"), Some(("force_f32_u16".to_owned(), 'T', 0x8c)));
        let [shown, asked, own] = ["levee_tick T 0 8c", "memcpy U         ", "told t 8 4"]
            .map(|line| symbol(line).expect("a symbol"));
        assert!(shown.is_shown() && !shown.is_asked());
        assert!(asked.is_asked() && !asked.is_shown());
        assert!(!own.is_asked() && !own.is_shown());
    }

    #[test]
    fn functions_of_c_are_known() {
        let is_of_c = |name: &str| Symbol { name: name.to_owned(), kind: 'U', size: 0 }.is_of_c();
        for name in ["memcpy", "__aeabi_memcpy8", "__aeabi_memclr", "__aeabi_memmove4"] {
            assert!(is_of_c(name), "{name}");
        }
        for name in ["__aeabi_dmul", "malloc", "abort", "a_panic_path_is_reachable", "sqrtf"] {
            assert!(!is_of_c(name), "{name}");
        }
    }
}
