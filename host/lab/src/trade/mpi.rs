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
//! what there is, and the failed rank and rank 0 end with its status. A [`Session`] that is dropped on
//! the way, by `?` or by a panic, reports a failure likewise. Who waits sleeps: a core that spins would
//! disturb what others measure.
//!
//! Without the feature `mpi` there is one rank.

use std::thread::panicking;

use super::shard::Shard;
use signorini_scene::Result;

/// This process among the ranks, from the start of MPI to its end.
#[derive(Debug)]
#[must_use = "the other ranks wait for `gather`"]
pub struct Session {
    // `None` once the ranks are gathered.
    ranks: Option<Ranks>,
}

/// Starts MPI: this rank's shard, and the session in which it is measured. A single rank has all cases,
/// and so has a process that no launcher started.
pub fn shard() -> (Session, Shard) {
    let ranks = Ranks::start();
    let shard = Shard::new(ranks.rank + 1, ranks.count).unwrap_or(Shard::WHOLE);
    (Session { ranks: Some(ranks) }, shard)
}

impl Session {
    /// Waits until every rank is done with its shard, has rank 0 `merge`, and waits until it has: a
    /// launcher may kill the job as soon as one rank fails. Journals must be closed before (dropped):
    /// only then another machine reads all of them.
    ///
    /// `done` is what became of this rank's shard. The result is its failure, if it failed; else, on
    /// rank 0, what `merge` returns, or the worst exit status of a shard if that is larger; elsewhere 0.
    /// A single rank that failed does not merge.
    pub fn gather(mut self, done: Result<()>, merge: impl FnOnce() -> Result<u8>) -> Result<u8> {
        let Some(ranks) = self.ranks.take() else { return Ok(0) };
        if ranks.count == 1 {
            done?;
            return merge();
        }
        let worst = ranks.worst(done.as_ref().map_or_else(|error| error.exit_status(), |()| 0));
        let merged = if ranks.rank == 0 { merge().map(|status| status.max(worst)) } else { Ok(0) };
        done.and(merged)
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        let Some(ranks) = self.ranks.take() else { return };
        ranks.worst(if panicking() { 101 } else { 1 });
    }
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
    fn one_process_has_all_cases_and_merges() {
        let (session, shard) = shard();
        assert_eq!(shard, Shard::WHOLE);
        assert!(matches!(session.gather(Ok(()), || Ok(3)), Ok(3)));
    }

    #[test]
    fn one_process_that_failed_does_not_merge() {
        let (session, _) = shard();
        let failed = Err(Error::Check("no room".to_owned()));
        let ended = session.gather(failed, || unreachable!("nothing to merge"));
        assert!(matches!(ended, Err(Error::Check(_))));
    }
}
