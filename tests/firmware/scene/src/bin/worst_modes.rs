//! The worst tick of a condensed scene whose transfer coefficient changes: [`signorini_scene::worst`].
//!
//! In every second tick the coefficient is what it was, and exchanges begin at the sides that are tried; in the others it is
//! a new one, the matrix follows, and they begin where nothing is exchanged.
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use signorini_board::run;
use signorini_contact::dense::blocks::{count, padded};
use signorini_contact::modes::ArrayModalStorage;
use signorini_contact::storage::ArrayTableauStorage;
use signorini_device::ranges::check;
use signorini_kernel::Error;
use signorini_kernel::limits::Deadline;
use signorini_kernel::report::Report;
use signorini_scene::scene::{CONTACT, INPUTS, Inputs, OUTPUTS, SYSTEM, Scalar};
use signorini_scene::worst::{Starts, all, exchange, search};

const PADDED: usize = padded(CONTACT);
const BLOCKS: usize = count(CONTACT);
const TERMS: usize = INPUTS + 1 + SYSTEM.compliance.len();
const COLUMNS: usize = match &SYSTEM.model.certificate {
    Some(form) => form.factor.norms.len(),
    None => 0,
};
const SPANS: usize = SYSTEM.model.spans.buffered(PADDED);

/// What a controller has, and how many ticks it has begun.
struct Memory {
    storage: ArrayModalStorage<Scalar, PADDED, COLUMNS, BLOCKS, TERMS, SPANS>,
    tableau: ArrayTableauStorage<Scalar, PADDED, BLOCKS>,
    begun: u32,
}

#[entry]
fn main() -> ! {
    static mut MEMORY: Memory = Memory {
        storage: ArrayModalStorage::zeros(),
        tableau: ArrayTableauStorage::zeros(),
        begun: 0,
    };
    run(|journal| search(journal, MEMORY))
}

impl Starts for Memory {
    fn are_limited() -> bool {
        SYSTEM.model.spans.are_limited()
    }

    fn begin(&mut self, inputs: Inputs, sides: &[Scalar; CONTACT]) -> Result<(), Error> {
        self.begun += 1;
        if self.begun.is_multiple_of(2) {
            return Ok(());
        }
        self.storage.set(&SYSTEM, &all(inputs))?;
        let (model, memory) = self.storage.at(&SYSTEM);
        exchange(&model, self.tableau.two_phases(&model)?, sides)?;
        if Self::are_limited() {
            let x = memory.shared.iterate.x;
            x.iter_mut().zip(sides).for_each(|(x, &side)| *x = side);
        }
        Ok(())
    }

    #[inline(never)]
    fn tick(&mut self, inputs: Inputs) -> Result<Report<Scalar>, Error> {
        check(&inputs.to_array(), &Inputs::RANGES)?;
        if self.storage.set(&SYSTEM, &all(inputs))? {
            self.tableau.reset();
        }
        let (model, mut memory) = self.storage.at(&SYSTEM);
        let mut method = self.tableau.two_phases(&model)?;
        let report = SYSTEM.tick(&model, &mut method, &mut Deadline::never(), &mut memory)?;
        let mut outputs = [0.0; OUTPUTS];
        for (number, output) in outputs.iter_mut().enumerate() {
            *output = model.output(number, memory.inputs, &memory.shared, &report)?;
        }
        black_box(outputs);
        Ok(report)
    }
}
