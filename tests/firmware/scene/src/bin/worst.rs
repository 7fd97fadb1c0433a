//! The worst tick of a condensed scene: [`signorini_scene::worst`].
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use signorini_board::run;
use signorini_contact::dense::blocks::{count, padded};
use signorini_contact::storage::{ArrayStorage, ArrayTableauStorage};
use signorini_device::ranges::check;
use signorini_kernel::Error;
use signorini_kernel::limits::Deadline;
use signorini_kernel::report::Report;
use signorini_scene::scene::{CONTACT, Inputs, OUTPUTS, SYSTEM, Scalar};
use signorini_scene::worst::{Starts, all, exchange, search};

const PADDED: usize = padded(CONTACT);
const COLUMNS: usize = match &SYSTEM.certificate {
    Some(form) => form.factor.norms.len(),
    None => 0,
};
const SPANS: usize = SYSTEM.spans.buffered(PADDED);

/// What a controller has.
struct Memory {
    storage: ArrayStorage<Scalar, PADDED, COLUMNS, SPANS>,
    tableau: ArrayTableauStorage<Scalar, PADDED, { count(CONTACT) }>,
}

#[entry]
fn main() -> ! {
    static mut MEMORY: Memory =
        Memory { storage: ArrayStorage::zeros(), tableau: ArrayTableauStorage::zeros() };
    run(|journal| search(journal, MEMORY))
}

impl Starts for Memory {
    fn are_limited() -> bool {
        SYSTEM.spans.are_limited()
    }

    fn begin(&mut self, _: Inputs, sides: &[Scalar; CONTACT]) -> Result<(), Error> {
        exchange(&SYSTEM, self.tableau.two_phases(&SYSTEM)?, sides)?;
        if Self::are_limited() {
            let x = self.storage.memory(&SYSTEM).iterate.x;
            x.iter_mut().zip(sides).for_each(|(x, &side)| *x = side);
        }
        Ok(())
    }

    #[inline(never)]
    fn tick(&mut self, inputs: Inputs) -> Result<Report<Scalar>, Error> {
        check(&inputs.to_array(), &Inputs::RANGES)?;
        let all = all(inputs);
        let mut method = self.tableau.two_phases(&SYSTEM)?;
        let mut memory = self.storage.memory(&SYSTEM);
        let report = SYSTEM.tick(&all, &mut method, &mut Deadline::never(), &mut memory)?;
        let mut outputs = [0.0; OUTPUTS];
        for (number, output) in outputs.iter_mut().enumerate() {
            *output = SYSTEM.output(number, &all, &memory, &report)?;
        }
        black_box(outputs);
        Ok(report)
    }
}
