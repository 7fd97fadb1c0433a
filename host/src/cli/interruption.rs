//! Ctrl-C as a wish to end the work at hand, not the program.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use signorini_scene::error::{InputError, Result};

/// Becomes true with Ctrl-C, which ends the work after the level or tick at hand; a second one ends the program.
pub(super) fn interruption() -> Result<&'static AtomicBool> {
    static IS: AtomicBool = AtomicBool::new(false);
    static HANDLER: OnceLock<std::result::Result<(), String>> = OnceLock::new();
    let handler = || {
        let handle = || {
            if IS.swap(true, Ordering::Relaxed) {
                std::process::exit(130);
            }
        };
        ctrlc::set_handler(handle).map_err(|error| error.to_string())
    };
    match HANDLER.get_or_init(handler) {
        Ok(()) => Ok(&IS),
        Err(error) => Err(InputError::new(format!("Ctrl-C cannot be handled: {error}")).into()),
    }
}
