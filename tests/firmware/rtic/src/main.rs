#![no_std]
#![no_main]
//! The kernel in a control loop under RTIC 2.
//!
//! ```text
//!   SysTick, priority 2, tick     read the loads, sweep until solved or out of time, publish
//!   SSI0,    priority 1, check    judge what was published; report after the last tick
//! ```
//! A tick never waits for the solver: between blocks of sweeps it looks at the clock, and whatever the
//! temperatures are then is feasible, can be acted on, and is where the next tick goes on.
//! `cargo xtask boards` runs it in QEMU; with `--features overload` it has to miss its
//! deadlines and fail.

mod clock;
mod console;
mod log;
mod plant;
mod sensor;

use clock::{PERIOD, elapsed};
use plant::{COLUMNS, Plant};

/// Counts that the solver may use; the rest is for publishing and for the task below.
const BUDGET: u32 = if cfg!(feature = "overload") { PERIOD / 2 * 3 } else { PERIOD / 4 * 3 };
/// Most blocks of sweeps a tick, should the clock ever stand still.
const BLOCKS: u32 = 16;
const TICKS: u32 = 1000;

#[rtic::app(device = lm3s6965, peripherals = false)]
mod app {
    use cortex_m::peripheral::SYST;

    use super::*;
    use crate::log::{Answer, Log};
    use crate::plant::Memory;

    #[shared]
    struct Shared {
        log: Log,
        mailbox: Option<Answer>,
    }

    #[local]
    struct Local {
        plant: Plant,
        systick: SYST,
    }

    #[init(local = [memory: Memory = Memory::new()])]
    fn init(cx: init::Context) -> (Shared, Local) {
        let Ok(plant) = Plant::new(cx.local.memory) else { console::end(false) };
        let mut systick = cx.core.SYST;
        clock::start(&mut systick);
        (Shared { log: Log::default(), mailbox: None }, Local { plant, systick })
    }

    #[task(binds = SysTick, priority = 2, local = [plant, systick, seed: u32 = 1],
           shared = [log, mailbox])]
    fn tick(cx: tick::Context) {
        let tick::LocalResources { plant, systick, seed, .. } = cx.local;
        let (sweeps, solved) = solve(plant, &sensor::read(seed));
        let answer = Answer { force: plant.force(), surface: plant.surface() };
        (cx.shared.log, cx.shared.mailbox).lock(|log, mailbox| {
            log.unread += u32::from(mailbox.replace(answer).is_some());
            log.sweeps += sweeps;
            log.cut += u32::from(!solved);
            log.ticks += 1;
            let time = elapsed();
            log.longest = log.longest.max(time);
            log.misses += u32::from(time >= PERIOD);
            if log.ticks == TICKS {
                clock::stop(systick);
            }
        });
        rtic::pend(lm3s6965::Interrupt::SSI0);
    }

    #[task(binds = SSI0, priority = 1, local = [wrong: u32 = 0], shared = [log, mailbox])]
    fn check(cx: check::Context) {
        // Taken out in a moment and judged with the lock released: the tick does not wait.
        let (answer, log) =
            (cx.shared.mailbox, cx.shared.log).lock(|mailbox, log| (mailbox.take(), *log));
        let Some(answer) = answer else { return };
        *cx.local.wrong += u32::from(!answer.is_usable());
        if log.ticks == TICKS {
            log.report(&answer, *cx.local.wrong);
        }
    }
}

/// Sweeps until the solve has ended or another block could exceed the budget: how many sweeps, and
/// whether it has ended. Loads that the kernel refuses leave a solve without an end.
fn solve(plant: &mut Plant, losses: &[f32; COLUMNS]) -> (u32, bool) {
    if plant.set_losses(losses).is_err() {
        return (0, false);
    }
    let (mut sweeps, mut longest, mut now) = (0, 0, elapsed());
    for _ in 0..BLOCKS {
        if now + longest > BUDGET {
            break;
        }
        let Ok(block) = plant.advance() else { break };
        sweeps += block.sweeps;
        if block.solved {
            return (sweeps, true);
        }
        let before = core::mem::replace(&mut now, elapsed());
        longest = longest.max(now - before);
    }
    (sweeps, false)
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
