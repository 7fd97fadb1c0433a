//! Ways to break what the images promise, one a feature: the checks must catch each of them.

use core::hint::black_box;

use signorini_device::model::Model;
use signorini_kernel::Real;

#[cfg(feature = "broken-alloc")]
extern crate alloc;

/// Does what the features ask for.
#[allow(unused_variables)]
pub fn commit<R: Real>(model: &Model<R, u16>, force: R) {
    #[cfg(feature = "broken-panic")]
    black_box(model.start[black_box(3)]);
    #[cfg(feature = "broken-format")]
    {
        use core::fmt::Write as _;
        let _ = write!(Console, "{force}");
    }
    #[cfg(feature = "broken-double")]
    black_box(black_box(1.5_f64) * black_box(2.5_f64));
    #[cfg(feature = "broken-quads")]
    if let Ok(edges) = black_box(model).edges() {
        let (mut flux, stiffness) = ([[R::ZERO; 4]; 1], black_box(model).stiffness);
        let start = black_box(model.start);
        let done = signorini_kernel::flux::of_quads(&edges, stiffness, &[], start, &mut flux);
        let _ = black_box((done, flux));
    }
    #[cfg(feature = "broken-contact")]
    if let Ok(edges) = black_box(model).edges() {
        use signorini_kernel::rows::{Row, Rows, TRIANGLES};
        let (mut memory, mut u) = ([Row::EMPTY; 4], [R::ZERO; 4]);
        if let Ok(rows) = Rows::<R, u16, TRIANGLES>::new(&edges, black_box(&mut memory)) {
            let done = signorini_kernel::psor::sweep(
                &rows,
                signorini_kernel::law::Law::above(black_box(model.gap)),
                &mut u,
            );
            let _ = black_box((done, u));
        }
    }
    #[cfg(feature = "broken-alloc")]
    black_box(alloc::boxed::Box::new(force));
    black_box(force);
}

#[cfg(feature = "broken-format")]
struct Console;

#[cfg(feature = "broken-format")]
impl core::fmt::Write for Console {
    fn write_str(&mut self, text: &str) -> core::fmt::Result {
        black_box(text);
        Ok(())
    }
}
