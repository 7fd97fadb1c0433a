//! Ways to break what the images promise, one a feature: the checks must catch each of them.

use core::hint::black_box;

use signorini_kernel::{Model, Real};

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
    if let Ok(edges) = model.edges() {
        let flux = black_box(&mut [[R::ZERO; 4]; 1]);
        let _ = signorini_kernel::flux::of_quads(&edges, model.stiffness, &[], model.start, flux);
    }
    #[cfg(feature = "broken-contact")]
    if let Ok(edges) = model.edges() {
        use signorini_kernel::rows::{Row, Rows, TRIANGLES};
        let rows = Rows::<R, u16, TRIANGLES>::new(&edges, black_box(&mut [Row::EMPTY; 1]));
        if let Ok(rows) = rows {
            let _ = signorini_kernel::psor::sweep_contact(&rows, &[], &mut []);
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
