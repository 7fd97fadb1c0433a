#![no_std]
#![no_main]
//! The kernel in a control loop under RTIC 2.
//!
//! ```text
//!   SysTick, priority 2, tick     read the losses, sweep until solved or out of time, publish
//!   SSI0,    priority 1, check    judge what was published; report after the last tick
//! ```
//! A tick never waits for the solver: before each sweep it looks at the clock, and whatever the
//! temperatures are when time is up is feasible, has a bound of its error, can be acted on, and is where
//! the next tick goes on. `cargo xtask boards` runs it in QEMU; with `--features overload` it has
//! to miss its deadlines and fail.

mod budget;
mod clock;
mod console;
mod judge;
mod log;
mod mesh;
mod plant;
mod sensor;

use signorini_device::tick::Deadline;
use signorini_kernel::Error;

use budget::{BUDGET, CERTIFICATE, SWEEP};
use clock::elapsed;
use log::Times;
use mesh::COLUMNS;
use plant::{Answer, LIMITS, Plant};

const TICKS: u32 = 10_000;

#[rtic::app(device = lm3s6965, peripherals = false)]
mod app {
    use cortex_m::peripheral::SYST;

    use super::*;
    use crate::budget::Costs;
    use crate::judge::Judge;
    use crate::log::Log;
    use crate::plant::Skin;

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

    #[init(local = [skin: Skin = Skin::new()])]
    fn init(cx: init::Context) -> (Shared, Local) {
        let mut systick = cx.core.SYST;
        let built = Plant::new(cx.local.skin).and_then(|mut plant| {
            let costs = Costs::measure(&mut systick, &mut plant)?;
            Ok((plant, costs))
        });
        let Ok((plant, costs)) = built else { console::end(false) };
        clock::start(&mut systick);
        (Shared { log: Log::EMPTY, mailbox: None }, Local { plant, systick, costs })
    }

    #[task(binds = SysTick, priority = 2, local = [plant, systick, seed: u32 = 1],
           shared = [log, mailbox])]
    fn tick(cx: tick::Context) {
        let tick::LocalResources { plant, systick, seed, .. } = cx.local;
        let Ok((answer, mut times)) = answer(plant, &sensor::read(seed)) else {
            // The kernel refuses losses that are not finite.
            console::end(false)
        };
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

    #[task(binds = SSI0, priority = 1, local = [costs, judge: Judge = Judge::NEW],
           shared = [log, mailbox])]
    fn check(cx: check::Context) {
        // Taken out in a moment and judged with the lock released: the tick does not wait.
        let (answer, log) =
            (cx.shared.mailbox, cx.shared.log).lock(|mailbox, log| (mailbox.take(), *log));
        let Some(answer) = answer else { return };
        cx.local.judge.include(&answer);
        if log.ticks == TICKS {
            cx.local.judge.conclude(&log, cx.local.costs, &answer);
        }
    }
}

/// Sweeps until that buys nothing more or the budget does not cover another one.
fn answer(plant: &mut Plant, losses: &[f32; COLUMNS]) -> Result<(Answer, Times), Error> {
    let mut looked = 0;
    let remaining = || {
        looked = elapsed();
        BUDGET.saturating_sub(looked)
    };
    let mut deadline = Deadline { remaining, sweep: SWEEP, certificate: CERTIFICATE };
    plant.set(losses)?;
    let answer = plant.answer(LIMITS, &mut deadline)?;
    let answered = elapsed();
    Ok((answer, Times { looked, answered, ended: answered }))
}

unsafe extern "C" {
    safe fn a_panic_path_is_reachable() -> !;
}

/// Calls what is defined nowhere: the image links only because the optimiser proves that nothing can
/// panic. Without optimisation, or with code that can panic, take `panic-halt` instead.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    a_panic_path_is_reachable()
}
