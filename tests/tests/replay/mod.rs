//! Exact solves of the small awkward problems that the device's tests replay, bit for bit as recorded in `expected`.

#[path = "../../../kernel/device/tests/replay/arrays.rs"]
#[allow(dead_code, reason = "the tests of the device need the rest")]
mod arrays;
mod factor;
#[path = "../../../kernel/device/tests/replay/journal.rs"]
#[allow(dead_code, reason = "the tests of the device need the rest")]
mod journal;
#[path = "../../../kernel/device/tests/replay/scene.rs"]
mod scene;

#[test]
fn exact_solves() {
    journal::replay("factor", factor::run::<f32>, factor::run::<f64>);
}
