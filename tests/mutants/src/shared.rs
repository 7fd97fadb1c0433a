//! Work that all processors share.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::error::{Result, failed};

/// What `work` makes of each item, in their order; it is told which of the workers it is.
pub fn each<T: Sync, U: Send>(
    items: &[T],
    workers: usize,
    work: impl Fn(usize, &T) -> Result<U> + Sync,
) -> Result<Vec<U>> {
    let (next, made) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for worker in 0..workers {
            let (next, made, work) = (&next, &made, &work);
            scope.spawn(move || {
                loop {
                    let at = next.fetch_add(1, Ordering::Relaxed);
                    let Some(item) = items.get(at) else { break };
                    let one = work(worker, item).map_err(|error| error.to_string());
                    made.lock().unwrap().push((at, one));
                }
            });
        }
    });
    let mut made = made.into_inner().unwrap();
    made.sort_by_key(|(at, _)| *at);
    made.into_iter().map(|(_, one)| one.map_err(failed)).collect()
}
