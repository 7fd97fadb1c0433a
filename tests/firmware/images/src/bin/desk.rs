//! A stage on the machine at hand: `desk STAGE` prints what the image of that name must print.

#[cfg(feature = "desk")]
fn main() -> std::process::ExitCode {
    use signorini_firmware::journal::Journal;
    use signorini_firmware::stages;

    let mut print = |text: &str| print!("{text}");
    let journal = &mut Journal(&mut print);
    match std::env::args().nth(1).as_deref() {
        Some("elements") => stages::elements(journal),
        Some("assembly") => stages::assembly(journal),
        Some("sweeps") => stages::sweeps(journal),
        Some("flux") => stages::flux(journal),
        Some("scenes") => stages::scenes(journal),
        _ => {
            eprintln!("usage: desk elements|assembly|sweeps|flux|scenes");
            return std::process::ExitCode::from(2);
        }
    }
    std::process::ExitCode::SUCCESS
}
