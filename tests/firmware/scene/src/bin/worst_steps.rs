//! The worst tick of a condensed scene that steps in time: [`signorini_scene::worst`]. Every tick begins with a state that is drawn.
#![no_std]
#![no_main]

use cortex_m_rt::entry;
use signorini_board::draw::Draw;
use signorini_board::run;
use signorini_scene::scene::{Controller, SYSTEM, Scalar};
use signorini_scene::worst::{exchange, search};

/// From a hundredth of the unit of states to a hundred of it.
const SIZES: [Scalar; 3] = [0.01, 1.0, 100.0];

#[entry]
fn main() -> ! {
    static mut CONTROLLER: Controller = Controller::new();
    let is_limited = SYSTEM.model.spans.are_limited();
    let (mut draw, mut sizes) = (Draw::new(), SIZES.into_iter().cycle());
    run(|journal| {
        search(journal, CONTROLLER, is_limited, |controller, _, sides| {
            let storage = controller.storage_mut();
            exchange(&SYSTEM.model, storage.solver.0.two_phases(&SYSTEM.model)?, sides)?;
            let memory = storage.iterate.memory(&SYSTEM);
            let first = memory.terms.len().saturating_sub(SYSTEM.begin.len());
            let size = sizes.next().unwrap_or(1.0);
            for term in memory.terms.iter_mut().skip(first) {
                *term = size * draw.uniform() as Scalar;
            }
            if is_limited {
                let x = memory.shared.iterate.x;
                x.iter_mut().zip(sides).for_each(|(x, &side)| *x = side);
            }
            Ok(())
        });
    })
}
