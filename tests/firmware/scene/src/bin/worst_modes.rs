//! The worst tick of a condensed scene whose transfer coefficient changes: [`signorini_scene::worst`].
//!
//! In every second tick the coefficient is what it was, and exchanges begin at the sides that are tried; in the others it is
//! a new one, the matrix follows, and they begin where nothing is exchanged.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use signorini_board::run;
use signorini_device::Error;
use signorini_device::controller::Inputs as _;
use signorini_device::kernel::report::Report;
use signorini_scene::scene::{CONTACT, Controller, Inputs, SYSTEM, Scalar};
use signorini_scene::worst::{Starts, exchange, search};

/// The controller whose state is chosen, and how many ticks it has begun.
struct Chosen {
    controller: Controller,
    begun: u32,
}

#[entry]
fn main() -> ! {
    static mut CHOSEN: Chosen = Chosen { controller: Controller::new(), begun: 0 };
    run(|journal| search(journal, CHOSEN))
}

impl Starts for Chosen {
    fn are_limited() -> bool {
        SYSTEM.model.spans.are_limited()
    }

    fn begin(&mut self, inputs: Inputs, sides: &[Scalar; CONTACT]) -> Result<(), Error> {
        self.begun += 1;
        if self.begun.is_multiple_of(2) {
            return Ok(());
        }
        let storage = self.controller.storage_mut();
        storage.iterate.set(&SYSTEM, &inputs.terms())?;
        let (model, memory) = storage.iterate.at(&SYSTEM);
        exchange(&model, storage.solver.0.two_phases(&model)?, sides)?;
        if Self::are_limited() {
            let x = memory.shared.iterate.x;
            x.iter_mut().zip(sides).for_each(|(x, &side)| *x = side);
        }
        Ok(())
    }

    fn tick(&mut self, inputs: Inputs) -> Result<Report<Scalar>, Error> {
        let answer = signorini_scene::tick(&mut self.controller, inputs)?;
        black_box(answer.outputs);
        Ok(answer.report)
    }
}
