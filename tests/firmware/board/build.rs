//! Puts the memory map of the board where the linker looks for it, and tells the code its name.

use std::path::PathBuf;
use std::{env, fs, io};

/// Flash and RAM of the boards, as cortex-m-rt wants them.
fn memory(board: &str) -> Option<&'static str> {
    match board {
        // QEMU's mps2-an386 (Cortex-M4) and mps2-an500 (Cortex-M7).
        "mps2" => {
            Some("FLASH : ORIGIN = 0x00000000, LENGTH = 4M\nRAM : ORIGIN = 0x20000000, LENGTH = 4M")
        }
        // QEMU's mps2-an505 (Cortex-M33), by the addresses of its secure state.
        "mps2-an505" => {
            Some("FLASH : ORIGIN = 0x10000000, LENGTH = 4M\nRAM : ORIGIN = 0x38000000, LENGTH = 4M")
        }
        // QEMU's netduinoplus2 and any STM32F405/407: 128 KiB of its 192 are contiguous.
        "netduinoplus2" | "stm32f407" => Some(
            "FLASH : ORIGIN = 0x08000000, LENGTH = 1M\nRAM : ORIGIN = 0x20000000, LENGTH = 128K",
        ),
        // To see how much an image lacks that no board has room for.
        "boundless" => Some(
            "FLASH : ORIGIN = 0x00000000, LENGTH = 512M\nRAM : ORIGIN = 0x20000000, LENGTH = 512M",
        ),
        _ => None,
    }
}

fn main() -> io::Result<()> {
    println!("cargo:rerun-if-env-changed=SIGNORINI_BOARD");
    println!("cargo:rustc-check-cfg=cfg(board, values(any()))");
    if env::var_os("CARGO_CFG_TARGET_OS").is_none_or(|os| os != "none") {
        return Ok(());
    }
    let board = env::var("SIGNORINI_BOARD").unwrap_or_else(|_| "mps2".to_owned());
    let Some(memory) = memory(&board) else {
        return Err(io::Error::other(format!("SIGNORINI_BOARD={board}: no such board")));
    };
    println!("cargo:rustc-cfg=board={board:?}");
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    fs::write(out.join("memory.x"), format!("MEMORY\n{{\n{memory}\n}}\n"))?;
    println!("cargo:rustc-link-search={}", out.display());
    Ok(())
}
