//! Work that may panic or never end, without taking the caller with it.

use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::time::Duration;

/// Runs `work` on a thread of its own, for at most `limit`.
///
/// # Errors
/// `Disconnected` after a panic; `Timeout` where there is no result in time: the thread is left to itself.
pub fn watched<T: Send + 'static>(
    limit: Duration,
    work: impl FnOnce() -> T + Send + 'static,
) -> Result<T, RecvTimeoutError> {
    let (sender, receiver) = sync_channel(1);
    std::thread::spawn(move || {
        // A caller that waits no longer takes no result.
        let _ = sender.send(work());
    });
    receiver.recv_timeout(limit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_panics_and_hangs() {
        let long = Duration::from_secs(600);
        assert_eq!(watched(long, || 7), Ok(7));
        assert_eq!(
            watched(long, || -> u32 { panic!("asked for by a test") }),
            Err(RecvTimeoutError::Disconnected)
        );
        let (_keep, never) = sync_channel::<u32>(1);
        let hang = move || never.recv().unwrap_or(0);
        assert_eq!(watched(Duration::from_millis(20), hang), Err(RecvTimeoutError::Timeout));
    }
}
