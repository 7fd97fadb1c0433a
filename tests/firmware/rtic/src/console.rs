//! Lines on the debugger's console, without `core::fmt`: formatting would bring kilobytes and panics.

use cortex_m_semihosting::debug::{EXIT_FAILURE, EXIT_SUCCESS, exit};
use cortex_m_semihosting::hio;

/// Prints `label` and a number in base `BASE` (2 to 16).
pub fn line<const BASE: u32>(label: &str, number: u32) {
    let mut digits = [b' '; 33];
    let mut rest = number;
    for place in digits.iter_mut().rev() {
        *place = b"0123456789abcdef".get((rest % BASE) as usize).copied().unwrap_or(b'?');
        rest /= BASE;
        if rest == 0 {
            break;
        }
    }
    text(label);
    text(" ");
    for digit in digits.iter().filter(|&&digit| digit != b' ') {
        bytes(core::slice::from_ref(digit));
    }
    text("\n");
}

/// Prints a text.
pub fn text(text: &str) {
    bytes(text.as_bytes());
}

fn bytes(bytes: &[u8]) {
    if let Ok(mut console) = hio::hstdout() {
        // Nobody is left to tell where even the debugger does not listen.
        let _ = console.write_all(bytes);
    }
}

/// Ends the emulation; on a board, the debugger halts here.
pub fn end(success: bool) -> ! {
    exit(if success { EXIT_SUCCESS } else { EXIT_FAILURE });
    loop {
        cortex_m::asm::bkpt();
    }
}
