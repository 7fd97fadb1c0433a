//! The stage `sweeps` on the board; `cargo xtask firmware-test` compares its lines with the desk's.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use signorini_firmware::{board, stages};

#[entry]
fn main() -> ! {
    board::run(stages::sweeps)
}
