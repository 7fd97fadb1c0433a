//! The worst case that is proved: no tick exceeds it.

use signorini_bake::condensed::{Baked, Controller};
use signorini_kernel::report::Ended;
use signorini_problem::inputs::{InputSpace, drawn};
use signorini_problem::scalar::Scalar;

use super::Pair;
use super::standard::pairs;
use crate::condensed::scenes::EXACT;

/// Ticks of each controller.
const TICKS: usize = 1_000_000;

/// The most exchanges of so many ticks, half of them at corners of the box; all end with the solution.
fn most<R: Scalar>(pair: &Pair, ticks: usize) -> [u32; 2] {
    let model = &pair.reduced.model;
    let baked = Baked::<R>::new(model, EXACT, false).expect("in range");
    let proved = baked.worst_exchanges().expect("all signs are right");
    let ranges = model.defaults.iter().zip(&model.ranges).skip(1);
    let spaces: Vec<_> = ranges.map(|(&default, &range)| InputSpace { default, range }).collect();
    let mut controller = Controller::new(&baked);
    let mut most = 0;
    for inputs in drawn::<R>(&spaces, ticks) {
        let (_, report) = controller.tick(&inputs).expect("a tick");
        assert_eq!(report.ended, Ended::Exact, "{}: {inputs:?}", pair.what);
        most = most.max(report.exchanges);
    }
    [most, proved]
}

#[test]
fn no_tick_takes_more_exchanges_than_are_proved() {
    for pair in &pairs()[..2] {
        let (name, of_both) =
            (&pair.what, [most::<f32>(pair, TICKS), most::<f64>(pair, TICKS / 10)]);
        for [most, proved] in of_both {
            let n = pair.reduced.model.contact as u32;
            assert!(proved == n + n / 2 && most <= proved, "{name}: {most} of {proved}");
            assert!(4 * most >= proved, "{name}: inputs are easy, {most} of {proved}");
        }
    }
}
