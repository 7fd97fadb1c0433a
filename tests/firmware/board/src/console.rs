//! What an image says, how it ends, and that it cannot panic.

use cortex_m_semihosting::debug::{EXIT_FAILURE, EXIT_SUCCESS, exit};
use cortex_m_semihosting::hio;

use crate::journal::Journal;

/// Runs a stage with the debugger's console as its journal, and ends.
pub fn run(stage: impl FnOnce(&mut Journal)) -> ! {
    stage(&mut Journal(&mut print));
    end(true)
}

/// Prints on the debugger's console.
pub fn print(text: &str) {
    if let Ok(mut console) = hio::hstdout() {
        // Nobody is left to tell where even the debugger does not listen.
        let _ = console.write_all(text.as_bytes());
    }
}

/// Ends the emulation with a status; on a real board, the debugger halts here.
pub fn end(success: bool) -> ! {
    exit(if success { EXIT_SUCCESS } else { EXIT_FAILURE });
    loop {
        cortex_m::asm::bkpt();
    }
}

unsafe extern "C" {
    safe fn a_panic_path_is_reachable() -> !;
}

/// Calls what is defined nowhere: an image links only where the optimiser proves that nothing panics.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    a_panic_path_is_reachable()
}
