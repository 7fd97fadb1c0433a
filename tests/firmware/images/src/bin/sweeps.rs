//! The stage `sweeps` on the board; `cargo xtask boards` compares its lines with the desk's.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use signorini_firmware::{board, stages};

#[entry]
fn main() -> ! {
    board::run(stages::sweeps)
}
