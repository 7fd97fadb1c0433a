//! The worst tick of a condensed scene whose transfer coefficient changes: [`signorini_scene::worst`].
//!
//! In every second tick the coefficient is what it was, and exchanges begin at the sides that are tried; in the others it is
//! a new one, the matrix follows, and they begin where nothing is exchanged.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use signorini_board::run;
use signorini_device::controller::Inputs as _;
use signorini_scene::scene::{Controller, SYSTEM};
use signorini_scene::worst::{exchange, search};

#[entry]
fn main() -> ! {
    static mut CONTROLLER: Controller = Controller::new();
    let is_limited = SYSTEM.model.spans.are_limited();
    let mut begun = 0_u32;
    run(|journal| {
        search(journal, CONTROLLER, is_limited, |controller, inputs, sides| {
            begun += 1;
            if begun.is_multiple_of(2) {
                return Ok(());
            }
            let storage = controller.storage_mut();
            storage.iterate.set(&SYSTEM, &inputs.terms())?;
            let (model, memory) = storage.iterate.at(&SYSTEM);
            exchange(&model, storage.solver.0.two_phases(&model)?, sides)?;
            if is_limited {
                let x = memory.shared.iterate.x;
                x.iter_mut().zip(sides).for_each(|(x, &side)| *x = side);
            }
            Ok(())
        });
    })
}
