//! What a setting costs on a microcontroller: `cargo xtask firmware`, called once a point.

use std::path::Path;
use std::process::{Command, Output};
use std::{env, fs};

use serde_json::Value;

use crate::checkout::root;
use signorini_scene::error::{Error, Result};

/// An emulated board with all the memory one may want.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Board {
    /// Cortex-M4 with a unit for f32.
    M4f,
    /// Cortex-M7 with a unit for f64.
    M7,
}

impl Board {
    /// Its name for `cargo xtask firmware --board`.
    pub fn name(self) -> &'static str {
        match self {
            Self::M4f => "m4",
            Self::M7 => "m7",
        }
    }
}

/// What a scene takes of a board.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Footprint {
    /// Instructions of a tick, the median of 101.
    pub instructions: u64,
    /// Bytes of RAM, the stack included.
    pub ram: u64,
    /// Bytes of flash: code and constants.
    pub flash: u64,
}

/// What came of a measurement.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Measured {
    /// The image ran, with the bits of this machine.
    Runs(Footprint),
    /// There is no image for this scene and board, and why: no model for its setting, or no room.
    Impossible(String),
}

/// Bakes the scene file `fragment`, builds its image, plays it; `firmware.json` goes to the folder `out`.
///
/// # Errors
/// No checkout of the sources; a tool that fails; bits that differ from this machine's.
pub fn measure(fragment: &Path, board: Board, out: &Path) -> Result<Measured> {
    let output = firmware(fragment, board, out)?;
    let said = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        return match impossible(output.status.code(), &said) {
            Some(why) => Ok(Measured::Impossible(why)),
            None => Err(failed(fragment, &said)),
        };
    }
    let file = out.join("firmware.json");
    let text = fs::read_to_string(&file).map_err(Error::io(&file))?;
    footprint(&text).map(Measured::Runs).ok_or_else(|| failed(&file, &text))
}

fn firmware(fragment: &Path, board: Board, out: &Path) -> Result<Output> {
    let absolute = |path: &Path| std::path::absolute(path).map_err(Error::io(path));
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    // There `xtask` is known.
    command.current_dir(root()?).args(["xtask", "firmware"]).arg(absolute(fragment)?);
    command.args(["--board", board.name(), "--out"]).arg(absolute(out)?);
    // This very program bakes: nothing is built for it once more.
    if let Ok(program) = env::current_exe()
        && program.file_stem().is_some_and(|name| name == "signorini")
    {
        command.env("SIGNORINI", program);
    }
    command.output().map_err(Error::io(Path::new("cargo")))
}

/// Why there can be no image, where that is the reason of a failure.
fn impossible(status: Option<i32>, said: &str) -> Option<String> {
    let lines = || said.lines().map(str::trim).filter(|line| !line.is_empty());
    if let Some(line) = lines().find(|line| line.contains("will not fit in region")) {
        let (_, short) = line.split_once("will not fit in region").unwrap_or_default();
        return Some(format!("no room in{short}"));
    }
    if said.contains("beyond-the-counter") {
        return Some("a tick takes longer than the board's counter can count".to_owned());
    }
    if status != Some(2) {
        return None;
    }
    // The message of `bake` begins with a cross; without one it is the command's own.
    let message = lines().find_map(|line| line.strip_prefix("× ")).or_else(|| lines().next());
    Some(without_place(message.unwrap_or("refused")).to_owned())
}

/// `FILE.toml:LINE: KEY: …` or `FILE.toml: KEY: …` from its key on: where a file lies is no reason.
fn without_place(message: &str) -> &str {
    let Some((_, rest)) = message.split_once(".toml:") else { return message };
    rest.trim_start_matches(|c: char| c.is_ascii_digit() || c == ':').trim_start()
}

fn failed(of: &Path, said: &str) -> Error {
    let last = said.lines().map(str::trim).rfind(|line| !line.is_empty()).unwrap_or("no message");
    Error::Check(format!("cargo xtask firmware: {}: {last}", of.display()))
}

/// The figures of a `firmware.json`, where its bits are those of this machine.
fn footprint(text: &str) -> Option<Footprint> {
    let found: Value = serde_json::from_str(text).ok()?;
    let figure = |value: &Value| value.as_u64();
    found.get("bit_identical")?.as_bool().filter(|&identical| identical)?;
    Some(Footprint {
        instructions: figure(found.get("instructions_per_tick")?.get("median")?)?,
        ram: figure(found.get("ram_bytes")?)?,
        flash: figure(found.get("flash_bytes")?)?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const BILL: &str = r#"{"bit_identical": true, "ram_bytes": 9468, "flash_bytes": 70468,
        "instructions_per_tick": {"first": 9, "median": 51234, "max": 60000}}"#;

    #[test]
    fn a_bill_is_read_where_its_bits_are_right() {
        let of = Footprint { instructions: 51234, ram: 9468, flash: 70468 };
        assert_eq!(footprint(BILL), Some(of));
        assert_eq!(footprint(&BILL.replace("true", "false")), None);
        assert_eq!(footprint(&BILL.replace("median", "mean")), None);
        assert_eq!(footprint("{"), None);
    }

    #[test]
    fn no_room_and_wrong_input_are_reasons_and_nothing_else_is() {
        let linker = "error: linking failed\n  = note: rust-lld: error: section '.bss' will not fit in \
                      region 'RAM': overflowed by 77 bytes\n";
        let why = impossible(Some(1), linker).unwrap_or_default();
        assert_eq!(why, "no room in 'RAM': overflowed by 77 bytes");
        let refused = "\n  × a.toml: setting.omega: 3 is not inside (0, 2)\n  help: 1.9\n";
        let why = impossible(Some(2), refused).unwrap_or_default();
        assert_eq!(why, "setting.omega: 3 is not inside (0, 2)");
        let refused = "  × some/where/a.toml:12: input.load: not on this board\n";
        assert_eq!(impossible(Some(2), refused).as_deref(), Some("input.load: not on this board"));
        assert_eq!(impossible(Some(1), "error: QEMU: status 3\n"), None);
        assert_eq!(impossible(None, ""), None);
    }
}
