//! Ticks with tiny loads while subnormal numbers are flushed to zero; `cargo xtask boards` compares the verdicts
//! with those of the desk, which flushes nothing.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use signorini_firmware::{board, tiny};

#[entry]
fn main() -> ! {
    #[cfg(target_abi = "eabihf")]
    if !board::flush::subnormals() {
        board::end(false);
    }
    board::run(tiny::ticks)
}
