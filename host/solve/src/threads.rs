//! Independent work on two threads.

use std::sync::Mutex;

use signorini_scene::error::Result;

/// Runs `work` on every plan; calls `done` after each. The results are in the order of the plans.
///
/// # Errors
/// The first that `work` returns.
pub fn on_two_threads<P: Sync, T: Send>(
    plans: &[P],
    work: impl Fn(&P) -> Result<T> + Sync,
    done: impl Fn() + Sync,
) -> Result<Vec<T>> {
    let next = Mutex::new(0..plans.len());
    let results: Vec<Mutex<Option<Result<T>>>> = plans.iter().map(|_| Mutex::default()).collect();
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                while let Some(at) = next.lock().ok().and_then(|mut next| next.next()) {
                    let result = work(&plans[at]);
                    if let Ok(mut slot) = results[at].lock() {
                        *slot = Some(result);
                    }
                    done();
                }
            });
        }
    });
    results.into_iter().filter_map(|slot| slot.into_inner().ok().flatten()).collect()
}
