//! Long work without the interpreter's lock, and Ctrl-C.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// How long Ctrl-C may wait.
const PATIENCE: Duration = Duration::from_millis(50);
/// As large as that of a main thread.
const STACK: usize = 8 << 20;

/// Whether the caller has given up: work that can end earlier looks at it.
pub type GivenUp = Arc<AtomicBool>;

/// Runs `work` on a thread of its own while other Python threads go on. With Ctrl-C this returns with `KeyboardInterrupt`, and the
/// thread goes on to its next look at [`GivenUp`].
pub fn work<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&GivenUp) -> T + Send + 'static,
) -> PyResult<T> {
    let given_up = GivenUp::default();
    let (send, receive) = channel();
    let seen = given_up.clone();
    let started = thread::Builder::new().stack_size(STACK).spawn(move || {
        // Nobody listens after Ctrl-C.
        let _ = send.send(work(&seen));
    });
    started.map_err(|error| PyRuntimeError::new_err(format!("no thread: {error}")))?;
    let receive = Mutex::new(receive);
    loop {
        match py.detach(|| next(&receive)) {
            Ok(found) => return Ok(found),
            Err(RecvTimeoutError::Timeout) => py.check_signals().inspect_err(|_| {
                given_up.store(true, Ordering::Relaxed);
            })?,
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err(
                    "the work has ended without an answer: this is a fault of signorini",
                ));
            }
        }
    }
}

fn next<T>(receive: &Mutex<Receiver<T>>) -> Result<T, RecvTimeoutError> {
    receive.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(PATIENCE)
}
