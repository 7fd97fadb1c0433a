//! All ticks, line by line: outputs in their order, how far each may be off, then what the controller reports. With the feature
//! `between` also where each lies, which takes flash of its own.

use signorini_board::journal::Journal;

use crate::figures::Figures as _;
use crate::loads::played;
use crate::scene::{Answer, Controller, Inputs};

/// Plays the ticks from a cold start. `tick` runs one, and may tell of it in notes, lines with an `@` that
/// are the machine's own.
pub fn play(
    controller: &mut Controller,
    journal: &mut Journal,
    mut tick: impl FnMut(&mut Controller, Inputs, &mut Journal) -> Option<Answer>,
) {
    for (at, inputs) in (1..).zip(played()) {
        journal.count("tick", at);
        let Some(answer) = tick(controller, inputs, journal) else {
            journal.text("refused");
            continue;
        };
        // One call, so that images have its code once.
        #[cfg(not(feature = "between"))]
        let told = [("output", answer.outputs), ("plus-minus", answer.plus_minus())];
        #[cfg(feature = "between")]
        let [least, most] = controller.between(&answer);
        #[cfg(feature = "between")]
        let told = [
            ("output", answer.outputs),
            ("plus-minus", answer.plus_minus()),
            ("least", least),
            ("most", most),
        ];
        for (name, values) in told {
            for value in values.to_array() {
                journal.scalar(name, value);
            }
        }
        answer.report.tell(journal);
        if let Some(window) = controller.window() {
            journal.scalar("window", window.energy);
        }
    }
}
