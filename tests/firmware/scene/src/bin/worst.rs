//! The worst tick of a condensed scene: [`signorini_scene::worst`].
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use signorini_board::run;
use signorini_scene::scene::{Controller, SYSTEM};
use signorini_scene::worst::{exchange, search};

#[entry]
fn main() -> ! {
    static mut CONTROLLER: Controller = Controller::new();
    let is_limited = SYSTEM.spans.are_limited();
    run(|journal| {
        search(journal, CONTROLLER, is_limited, |controller, _, sides| {
            let storage = controller.storage_mut();
            exchange(&SYSTEM, storage.solver.0.two_phases(&SYSTEM)?, sides)?;
            if is_limited {
                let x = storage.iterate.memory(&SYSTEM).iterate.x;
                x.iter_mut().zip(sides).for_each(|(x, &side)| *x = side);
            }
            Ok(())
        });
    })
}
