//! A stage on the machine at hand: `desk STAGE` prints what the image of that name must print.

/// What the image of that kind shows.
#[cfg(feature = "desk")]
macro_rules! show {
    ($scene:ident, $scalar:ty, $width:expr, $contact:expr, $journal:expr) => {{
        type Tick = signorini_firmware::tick!($scene, $scalar, $width, $contact);
        Tick::new().show(&signorini_firmware::scenes::$scene::MODEL, $journal)
    }};
}

#[cfg(feature = "desk")]
fn main() -> std::process::ExitCode {
    use signorini_firmware::journal::Journal;
    use signorini_firmware::stages;
    use signorini_kernel::rows::{QUADS, TRIANGLES};

    let mut print = |text: &str| print!("{text}");
    let journal = &mut Journal(&mut print);
    match std::env::args().nth(1).as_deref() {
        Some("elements") => stages::elements(journal),
        Some("assembly") => stages::assembly(journal),
        Some("sweeps") => stages::sweeps(journal),
        Some("flux") => stages::flux(journal),
        Some("scenes") => stages::scenes(journal),
        Some("flushed") => signorini_firmware::tiny::ticks(journal),
        Some("tick_linear") => show!(linear_f32, f32, TRIANGLES, false, journal),
        Some("tick_triangles") => show!(levee_f32, f32, TRIANGLES, true, journal),
        Some("tick_quads") => show!(slab_f32, f32, QUADS, true, journal),
        Some("tick_mixed") => show!(strip_f32, f32, QUADS, true, journal),
        _ => {
            eprintln!("usage: desk elements|assembly|sweeps|flux|scenes|flushed|tick_KIND");
            return std::process::ExitCode::from(2);
        }
    }
    std::process::ExitCode::SUCCESS
}
