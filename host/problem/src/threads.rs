//! Independent work on two threads.

use std::ops::Range;
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

/// Items that a thread takes at a time where each is little work.
const PORTION: usize = 4096;

/// Runs `work` on portions of so many items, on two threads where there are more than one. Sums of the results in their order are
/// the same on every machine.
///
/// # Errors
/// The first that `work` returns.
pub fn in_portions<T: Send>(
    items: usize,
    work: impl Fn(Range<usize>) -> Result<T> + Sync,
) -> Result<Vec<T>> {
    if items <= PORTION {
        return Ok(vec![work(0..items)?]);
    }
    let starts: Vec<usize> = (0..items).step_by(PORTION).collect();
    on_two_threads(&starts, |&start| work(start..items.min(start + PORTION)), || ())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn portions_are_in_their_order_and_leave_nothing_out() {
        for items in [0, 1, PORTION, PORTION + 1, 5 * PORTION + 7] {
            let portions = in_portions(items, Ok).unwrap();
            let all: Vec<usize> = portions.into_iter().flatten().collect();
            assert!(all.into_iter().eq(0..items), "{items}");
        }
    }
}
