//! A campaign on the ranks of MPI: rank r of n measures shard (r + 1)/n, then rank 0 merges.
//!
//! ```text
//!   rank 0: shard 1/n ─┐                                 ┌─ merge ─┐
//!   rank 1: shard 2/n ─┼─ wait ─ worst status of all ─┼─ wait ────┼─ end
//!   …                  ─┘                                 └─ wait ──┘
//! ```
//!
//! The journals on a file system that all ranks see carry what was found; MPI carries one number, so
//! that a failure on one rank hangs none: it waits for the others like a rank that is done, rank 0 merges
//! what there is, and the failed rank and rank 0 end with its status. A panic is such a failure. Who waits
//! sleeps: a core that spins would disturb what others measure.
//!
//! Without the feature `mpi` there is one rank.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

use super::shard::Shard;
use signorini_scene::Result;

/// Starts MPI and has each rank `work` on its shard. Once all are done rank 0 works on the whole, which is to merge their
/// parts. The others wait until it has: a launcher may kill the job as soon as one rank fails. A single rank has all
/// cases at once, and so has a process that no launcher started. Journals must be closed (dropped) when `work` returns:
/// only then another machine reads all of them.
///
/// The result is the failure of this rank's shard, if it failed; else, on rank 0, the failure of the merging, or the
/// worst exit status of a shard; elsewhere 0.
pub fn on_ranks(mut work: impl FnMut(Shard) -> Result<()>) -> Result<u8> {
    let ranks = Ranks::start();
    let shard = Shard::new(ranks.rank + 1, ranks.count).unwrap_or(Shard::WHOLE);
    if shard.is_whole() {
        return work(shard).map(|()| 0);
    }
    let done = catch_unwind(AssertUnwindSafe(|| work(shard)));
    let worst = ranks.worst(match &done {
        Ok(Ok(())) => 0,
        Ok(Err(error)) => error.exit_status(),
        Err(_) => 101,
    });
    let done = done.unwrap_or_else(|panic| resume_unwind(panic));
    let merged = if ranks.rank == 0 { work(Shard::WHOLE).map(|()| worst) } else { Ok(0) };
    done.and(merged)
}

#[cfg(feature = "mpi")]
use ranks::Ranks;

#[cfg(feature = "mpi")]
mod ranks {
    use std::fmt;
    use std::thread::sleep;
    use std::time::Duration;

    use mpi::collective::SystemOperation;
    use mpi::environment::Universe;
    use mpi::topology::SimpleCommunicator;
    use mpi::traits::{Communicator, CommunicatorCollectives};

    /// How long a rank that waits sleeps at a time.
    const NAP: Duration = Duration::from_millis(20);

    /// All ranks of the job. When dropped, by a panic too, it waits until it is on every rank: the end of
    /// Open MPI waits likewise, but the standard does not promise it.
    pub(super) struct Ranks {
        pub(super) rank: usize,
        pub(super) count: usize,
        world: SimpleCommunicator,
        // Declared last: dropped, it ends MPI.
        _universe: Option<Universe>,
    }

    impl Ranks {
        pub(super) fn start() -> Self {
            let (universe, world) = (mpi::initialize(), SimpleCommunicator::world());
            let rank = usize::try_from(world.rank()).unwrap_or(0);
            let count = usize::try_from(world.size()).unwrap_or(1);
            Self { rank, count, world, _universe: universe }
        }

        /// Returns on no rank before all have called it.
        fn wait(&self) {
            let mut request = self.world.immediate_barrier();
            while let Err(pending) = request.test() {
                request = pending;
                sleep(NAP);
            }
        }

        /// The largest status of all ranks, once all have one.
        pub(super) fn worst(&self, status: u8) -> u8 {
            self.wait();
            let mut worst = status;
            self.world.all_reduce_into(&status, &mut worst, SystemOperation::max());
            worst
        }
    }

    impl Drop for Ranks {
        fn drop(&mut self) {
            self.wait();
        }
    }

    impl fmt::Debug for Ranks {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            write!(f, "rank {} of {}", self.rank, self.count)
        }
    }
}

/// The only rank.
#[cfg(not(feature = "mpi"))]
#[derive(Debug)]
struct Ranks {
    rank: usize,
    count: usize,
}

#[cfg(not(feature = "mpi"))]
impl Ranks {
    fn start() -> Self {
        Self { rank: 0, count: 1 }
    }

    fn worst(&self, status: u8) -> u8 {
        status
    }
}

// MPI starts once in a process: its ranks are tested in `tests/ranks.rs`.
#[cfg(all(test, not(feature = "mpi")))]
mod tests {
    use super::*;
    use signorini_scene::Error;

    #[test]
    fn one_process_has_all_cases_at_once() {
        for (found, status) in [(Ok(()), Some(0)), (Err(Error::Check("no room".to_owned())), None)]
        {
            let mut found = Some(found);
            let ended = on_ranks(|shard| {
                assert_eq!(shard, Shard::WHOLE);
                found.take().expect("called once")
            });
            assert_eq!(ended.ok(), status);
        }
    }
}
