//! All ticks, line by line: outputs in their order, how far each may be off, then what the controller reports.

use signorini_board::journal::Journal;

use crate::figures::Figures as _;
use crate::loads::{TICKS, loads};
use crate::scene::{Answer, Controller, Inputs};

/// Plays the ticks from a cold start. `tick` runs one, and may tell of it in notes, lines with an `@` that
/// are the machine's own.
pub fn play(
    controller: &mut Controller,
    journal: &mut Journal,
    mut tick: impl FnMut(&mut Controller, Inputs, &mut Journal) -> Option<Answer>,
) {
    for (at, inputs) in (1..).zip(loads().take(TICKS)) {
        journal.count("tick", at);
        let Some(answer) = tick(controller, inputs, journal) else {
            journal.text("refused");
            continue;
        };
        for output in answer.outputs.to_array() {
            journal.scalar("output", output);
        }
        for by in answer.plus_minus().to_array() {
            journal.scalar("plus-minus", by);
        }
        answer.report.tell(journal);
    }
}
