//! The symbols of an archive or an image, by `nm` of binutils.

use std::path::Path;
use std::process::Command;

use signorini_image::toolchain::output;

/// The names that the members of `archive` define or ask for.
pub fn symbols(archive: &Path) -> Result<Vec<String>, String> {
    let output = Command::new("nm").arg("-P").arg(archive).output();
    let output = output.map_err(|error| format!("nm: {error}; run `apt-get install binutils`"))?;
    if !output.status.success() {
        return Err(format!("nm: {}", String::from_utf8_lossy(&output.stderr)));
    }
    let listing = String::from_utf8_lossy(&output.stdout);
    Ok(listing.lines().filter_map(name).collect())
}

/// The symbols of an ARM image, with their sizes in bytes.
pub fn sized(image: &Path) -> Result<Vec<(String, u64)>, String> {
    let listing = output(Command::new("arm-none-eabi-nm").arg("-P").arg(image))?;
    let size = |line: &str| {
        let size = line.split(' ').nth(3)?;
        u64::from_str_radix(size, 16).ok()
    };
    Ok(listing.lines().filter_map(|line| Some((name(line)?, size(line).unwrap_or(0)))).collect())
}

/// The symbols of an ARM archive, by whom they are for.
#[derive(Debug, Default, PartialEq)]
pub struct Shown {
    /// What others may call.
    pub shown: Vec<String>,
    /// What it asks of others.
    pub asked: Vec<String>,
    /// What it keeps for itself.
    pub own: Vec<String>,
}

impl Shown {
    /// Of this archive.
    pub fn of(archive: &Path) -> Result<Self, String> {
        Ok(Self::parse(&output(Command::new("arm-none-eabi-nm").arg("-P").arg(archive))?))
    }

    fn parse(listing: &str) -> Self {
        let mut symbols = Self::default();
        for line in listing.lines() {
            let Some(name) = name(line) else { continue };
            let kind = line.split(' ').nth(1).and_then(|kind| kind.chars().next());
            match kind {
                Some('U') => symbols.asked.push(name),
                Some(kind) if kind.is_uppercase() => symbols.shown.push(name),
                _ => symbols.own.push(name),
            }
        }
        symbols
    }
}

/// The functions that the debug information of an ARM image names: what was inlined, too.
pub fn inlined(image: &Path) -> Result<Vec<String>, String> {
    let listing = output(Command::new("arm-none-eabi-objdump").arg("--dwarf=info").arg(image))?;
    let names = listing.lines().filter(|line| line.contains("DW_AT_linkage_name"));
    Ok(names
        .filter_map(|line| line.rsplit(": ").next())
        .map(|name| name.trim().to_owned())
        .collect())
}

/// A line is `NAME TYPE …`; what is not, names a member.
fn name(line: &str) -> Option<String> {
    let (name, rest) = line.split_once(' ')?;
    (!rest.is_empty()).then(|| name.to_owned())
}

/// Whether a symbol belongs to an allocator: Rust's, mangled or not, or C's.
pub fn allocates(symbol: &str) -> bool {
    let rust = ["__rust_alloc", "__rust_realloc", "__rust_dealloc"];
    let c = ["malloc", "calloc", "realloc", "free"];
    rust.iter().any(|name| symbol.contains(name)) || c.contains(&symbol.trim_start_matches('_'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_are_not_symbols() {
        assert_eq!(name("libkernel.a[bar.o]:"), None);
        assert_eq!(name("memcpy U         "), Some("memcpy".to_owned()));
        assert_eq!(name("force_f32_u16 T 0 8"), Some("force_f32_u16".to_owned()));
    }

    #[test]
    fn symbols_are_told_apart() {
        let symbols =
            Shown::parse("lib.a[levee.o]:\nlevee_tick T 0 8c\nmemcpy U         \ntold t 8 4\n");
        let one = |name: &str| vec![name.to_owned()];
        let expected = Shown { shown: one("levee_tick"), asked: one("memcpy"), own: one("told") };
        assert_eq!(symbols, expected);
    }

    #[test]
    fn allocators_are_known_by_name() {
        for symbol in ["_RNvCsfLfy6EI15iL_7___rustc12___rust_alloc", "__rust_dealloc", "_malloc"] {
            assert!(allocates(symbol), "{symbol}");
        }
        for symbol in ["memcpy", "force_f32_u16", "_ZN4core5alloc6layout"] {
            assert!(!allocates(symbol), "{symbol}");
        }
    }
}
