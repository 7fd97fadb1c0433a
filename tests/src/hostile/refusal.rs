//! Requirements of a refusal.

use signorini_scene::error::Error;

/// Wrong input says so in a few words.
pub(super) fn refused(error: &Error) {
    assert_eq!(error.exit_status(), 2, "{error}");
    let message = error.to_string();
    assert!(!message.is_empty() && message.len() < 20_000, "{message}");
}
