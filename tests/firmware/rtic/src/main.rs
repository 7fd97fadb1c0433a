#![no_std]
#![no_main]
//! The kernel in a control loop under RTIC 2.
//!
//! ```text
//!   SysTick, priority 2, tick     read what holds now, sweep until solved or out of time, publish
//!   SSI0,    priority 1, check    judge what was published; report after the last tick
//! ```
//! A tick never waits for the solver: before each sweep it looks at the clock, and whatever the
//! temperatures are when time is up is feasible, has a bound of its error, can be acted on, and is where
//! the next tick goes on. `cargo xtask boards` runs it in QEMU; with `--features overload` it has
//! to miss its deadlines and fail.
//!
//! The plant is a skin that this program poses itself, or with `--features antiicing` a controller that
//! `signorini bake` has written.

#[cfg_attr(feature = "antiicing", path = "antiicing/mod.rs")]
#[cfg_attr(not(feature = "antiicing"), path = "skin/mod.rs")]
mod plant;

mod clock;
mod costs;
mod log;

#[rtic::app(device = lm3s6965, peripherals = false)]
mod app {
    use cortex_m::peripheral::SYST;
    use signorini_board::journal::Journal;
    use signorini_board::{end, print};

    use crate::clock::{self, elapsed};
    use crate::costs::{Costs, answer};
    use crate::log::Log;
    use crate::plant::{Answer, Judge, Memory, Plant, TICKS};

    #[shared]
    struct Shared {
        log: Log,
        mailbox: Option<Answer>,
    }

    #[local]
    struct Local {
        plant: Plant,
        systick: SYST,
        costs: Costs,
    }

    #[init(local = [memory: Memory = Memory::new()])]
    fn init(cx: init::Context) -> (Shared, Local) {
        let mut systick = cx.core.SYST;
        let built = Plant::new(cx.local.memory).and_then(|mut plant| {
            let costs = Costs::measure(&mut systick, &mut plant)?;
            Ok((plant, costs))
        });
        let Ok((plant, costs)) = built else { end(false) };
        clock::start(&mut systick);
        (Shared { log: Log::EMPTY, mailbox: None }, Local { plant, systick, costs })
    }

    #[task(binds = SysTick, priority = 2, local = [plant, systick], shared = [log, mailbox])]
    fn tick(cx: tick::Context) {
        let tick::LocalResources { plant, systick, .. } = cx.local;
        let answered = plant.advance().and_then(|()| answer(plant));
        // The kernel refuses what is not finite or outside its range.
        let Ok((answer, mut times)) = answered else { end(false) };
        (cx.shared.log, cx.shared.mailbox).lock(|log, mailbox| {
            log.unread += u32::from(mailbox.replace(answer).is_some());
            times.ended = elapsed();
            log.include(&answer, times);
            if log.ticks == TICKS {
                clock::stop(systick);
            }
        });
        rtic::pend(lm3s6965::Interrupt::SSI0);
    }

    #[task(binds = SSI0, priority = 1, local = [costs, wrong: u32 = 0, judge: Judge = Judge::NEW],
           shared = [log, mailbox])]
    fn check(cx: check::Context) {
        // Taken out in a moment and judged with the lock released: the tick does not wait.
        let (answer, log) =
            (cx.shared.mailbox, cx.shared.log).lock(|mailbox, log| (mailbox.take(), *log));
        let Some(answer) = answer else { return };
        let check::LocalResources { costs, wrong, judge, .. } = cx.local;
        *wrong += u32::from(!judge.is_sound(&answer));
        if log.ticks == TICKS {
            let mut print = print;
            let journal = &mut Journal(&mut print);
            let good = log.tell(*wrong, costs, journal);
            end(judge.tell(&answer, journal) && good);
        }
    }
}
