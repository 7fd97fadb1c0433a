//! A baked scene on the machine at hand: the lines of the board, and as notes what it is that they show.
//!
//! ```text
//!   @ scalar f32
//!   @ model condensed
//!   @ output 73656570616765       a name, its bytes in hexadecimal digits
//!   @ input 7261696e ranged       the same, and whether it has a range: ranged or free
//!   @ inputs 0.5 -1.0             of a tick
//! ```

use std::sync::{Mutex, PoisonError};

use signorini_board::journal::Journal;
use signorini_scene::play::play;
use signorini_scene::scene::{Controller, Inputs, MODEL, Outputs, Scalar};

/// A static, as on a board: it may be larger than a stack.
static CONTROLLER: Mutex<Controller> = Mutex::new(Controller::new());

fn main() {
    println!("@ scalar {}", std::any::type_name::<Scalar>());
    println!("@ model {MODEL}");
    for name in Outputs::NAMES {
        println!("@ output {}", digits(name));
    }
    for (name, range) in Inputs::NAMES.into_iter().zip(Inputs::RANGES) {
        let word = if range.iter().all(|end| end.is_finite()) { "ranged" } else { "free" };
        println!("@ input {} {word}", digits(name));
    }
    let mut told = false;
    let mut controller = CONTROLLER.lock().unwrap_or_else(PoisonError::into_inner);
    play(&mut controller, &mut Journal(&mut |text| print!("{text}")), |controller, inputs, _| {
        let values: Vec<_> = inputs.to_array().iter().map(|value| format!("{value:?}")).collect();
        println!("@ inputs {}", values.join(" "));
        let answer = controller.tick(inputs);
        if let Err(error) = &answer
            && !told
        {
            eprintln!("{inputs:?}: {error}");
            told = true;
        }
        answer.ok()
    });
}

/// The bytes of a name in hexadecimal digits.
fn digits(name: &str) -> String {
    name.bytes().map(|byte| format!("{byte:02x}")).collect()
}
