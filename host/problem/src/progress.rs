//! Progress on a terminal, silence in a pipe.

use std::cell::RefCell;
use std::io::Write;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// Writes a line to standard output; a reader who has gone away is no error.
pub fn say(line: impl std::fmt::Display) {
    let _ = writeln!(std::io::stdout(), "{line}");
}

/// Writes warnings to standard error, a line each.
pub fn warn(warnings: &[String]) {
    for warning in warnings {
        let _ = writeln!(std::io::stderr(), "warning: {warning}");
    }
}

/// Writes to standard error what is no warning.
pub fn note(what: &impl std::fmt::Display) {
    let _ = writeln!(std::io::stderr(), "note: {what}");
}

thread_local! {
    /// The spinner of [`waiting`] on this thread, with its message.
    static SPINNER: RefCell<Option<(ProgressBar, String)>> = const { RefCell::new(None) };
}

/// Shows `message` with a spinner and the time passed while `work` runs.
pub fn waiting<T>(message: &str, work: impl FnOnce() -> T) -> T {
    let bar = ProgressBar::new_spinner().with_message(message.to_owned());
    let style = ProgressStyle::with_template("{spinner} {msg} {elapsed}");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
    bar.enable_steady_tick(Duration::from_millis(120));
    let own = (bar.clone(), message.to_owned());
    let outer = SPINNER.with(|spinner| spinner.replace(Some(own)));
    let result = work();
    SPINNER.with(|spinner| spinner.replace(outer));
    bar.finish_and_clear();
    result
}

/// Says on the spinner of [`waiting`], if this thread has one, what the work is at.
pub fn stage(name: &str) {
    SPINNER.with(|spinner| {
        if let Some((bar, message)) = spinner.borrow().as_ref() {
            bar.set_message(format!("{message}: {name}"));
        }
    });
}

/// A bar over `steps` steps.
pub fn steps(steps: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg} {elapsed}");
    let bar = ProgressBar::new(steps as u64);
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar
}
