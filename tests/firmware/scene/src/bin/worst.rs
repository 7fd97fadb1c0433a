//! The worst tick of a condensed scene: [`signorini_scene::worst`].
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use signorini_board::run;
use signorini_device::Error;
use signorini_device::kernel::report::Report;
use signorini_scene::scene::{CONTACT, Controller, Inputs, SYSTEM, Scalar};
use signorini_scene::worst::{Starts, exchange, search};

/// The controller whose state is chosen.
struct Chosen(Controller);

#[entry]
fn main() -> ! {
    static mut CONTROLLER: Chosen = Chosen(Controller::new());
    run(|journal| search(journal, CONTROLLER))
}

impl Starts for Chosen {
    fn are_limited() -> bool {
        SYSTEM.spans.are_limited()
    }

    fn begin(&mut self, _: Inputs, sides: &[Scalar; CONTACT]) -> Result<(), Error> {
        let storage = self.0.storage_mut();
        exchange(&SYSTEM, storage.solver.0.two_phases(&SYSTEM)?, sides)?;
        if Self::are_limited() {
            let x = storage.iterate.memory(&SYSTEM).iterate.x;
            x.iter_mut().zip(sides).for_each(|(x, &side)| *x = side);
        }
        Ok(())
    }

    fn tick(&mut self, inputs: Inputs) -> Result<Report<Scalar>, Error> {
        let answer = signorini_scene::tick(&mut self.0, inputs)?;
        black_box(answer.outputs);
        Ok(answer.report)
    }
}
