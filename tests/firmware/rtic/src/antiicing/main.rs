#![no_std]
#![no_main]
//! A baked controller under RTIC 2: the anti-icing slab `meshes/scenes/antiicing.toml` on a flight.
//!
//! ```text
//!   SysTick, priority 2, tick     read air and supplies, sweep until solved or out of time, publish
//!   SSI0,    priority 1, check    judge what was published; report after the last tick
//! ```
//! `signorini bake --full` has written all of the model: this program knows names of inputs and outputs, and how long a
//! sweep takes. `cargo xtask boards` runs it in QEMU and compares what it says with `tests/firmware/antiicing.txt`.

mod budget;
#[path = "../clock.rs"]
mod clock;
#[path = "../console.rs"]
mod console;
mod flight;
mod judge;

// What `mod scene;` is to a user's own module.
include!(concat!(env!("OUT_DIR"), "/module.rs"));

use signorini_device::tick::Deadline;
use signorini_kernel::Error;

use budget::{BUDGET, CERTIFICATE, SWEEP};
use clock::elapsed;
use judge::Record;
use scene::{Controller, Inputs, LIMITS};

#[rtic::app(device = lm3s6965, peripherals = false)]
mod app {
    use cortex_m::peripheral::SYST;

    use super::*;
    use crate::budget::Costs;
    use crate::flight::{Flight, TICKS};
    use crate::judge::Judge;

    #[shared]
    struct Shared {
        mailbox: Option<Record>,
    }

    #[local]
    struct Local {
        controller: &'static mut Controller,
        flight: Flight,
        systick: SYST,
        judge: Judge,
    }

    #[init(local = [memory: Controller = Controller::new()])]
    fn init(cx: init::Context) -> (Shared, Local) {
        let (mut systick, controller) = (cx.core.SYST, cx.local.memory);
        let Ok(costs) = Costs::measure(&mut systick, controller) else { console::end(false) };
        clock::start(&mut systick);
        let local = Local { controller, flight: Flight::START, systick, judge: Judge::new(costs) };
        (Shared { mailbox: None }, local)
    }

    #[task(binds = SysTick, priority = 2, local = [controller, flight, systick], shared = [mailbox])]
    fn tick(cx: tick::Context) {
        let tick::LocalResources { controller, flight, systick, .. } = cx.local;
        let inputs = flight.next();
        // Inputs outside their ranges are refused; those of the flight are clamped to them.
        let Ok(mut record) = answer(controller, inputs) else { console::end(false) };
        let mut mailbox = cx.shared.mailbox;
        mailbox.lock(|mailbox| {
            let unread = mailbox.take().map_or(0, |earlier| earlier.unread + 1);
            record.ended = elapsed();
            *mailbox = Some(Record { unread, ..record });
        });
        if flight.ticks() == TICKS {
            clock::stop(systick);
        }
        rtic::pend(lm3s6965::Interrupt::SSI0);
    }

    #[task(binds = SSI0, priority = 1, local = [judge], shared = [mailbox])]
    fn check(cx: check::Context) {
        // Taken out in a moment and judged with the lock released: the tick does not wait.
        let mut mailbox = cx.shared.mailbox;
        let Some(record) = mailbox.lock(Option::take) else { return };
        cx.local.judge.include(&record);
        if cx.local.judge.ticks() == TICKS {
            cx.local.judge.conclude(&record);
        }
    }
}

/// Sweeps until that buys nothing more or the budget does not cover another one.
fn answer(controller: &mut Controller, inputs: Inputs) -> Result<Record, Error> {
    let mut looked = 0;
    let remaining = || {
        looked = elapsed();
        BUDGET.saturating_sub(looked)
    };
    let mut deadline = Deadline { remaining, sweep: SWEEP, certificate: CERTIFICATE };
    let answer = controller.tick_within(inputs, LIMITS, &mut deadline)?;
    let answered = elapsed();
    let unwatched = answered.saturating_sub(looked);
    Ok(Record { inputs, answer, unwatched, answered, ended: answered, unread: 0 })
}

unsafe extern "C" {
    safe fn a_panic_path_is_reachable() -> !;
}

/// Calls what is defined nowhere: the image links only because the optimiser proves that nothing can panic.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    a_panic_path_is_reachable()
}
