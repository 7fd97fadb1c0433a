//! The RTIC example of a baked scene: the anti-icing slab on a flight from cold, against the record in git; and the same flight
//! from C.

use crate::c::program::played;
use crate::modules::row;
use crate::record;
use crate::snapshot;
use signorini_image::board::{Build, M4F};
use signorini_image::cargo::{root, run as run_cargo};
use signorini_image::files;

const RECORD: &str = "tests/firmware/antiicing.txt";

/// The inputs that it flew, for other machines to fly after it.
const LOG: &str = "tests/firmware/logs/flight.csv";

/// Bakes the scene, flies, and compares what is said. The image itself fails where a deadline is missed or an answer is wrong.
pub fn check(bless: bool) -> Result<(), String> {
    let module = row("antiicing-warm", "--full")?.module()?;
    let (package, features) = ("signorini-rtic", &["antiicing"]);
    let build = Build { package, bins: &[], features, scenes: module.file() };
    let (mut command, folder) = M4F.build(build)?;
    command.env("SIGNORINI_SCENE", module.file());
    run_cargo(command)?;
    let said = M4F.run(&folder.join("signorini-rtic"), true)?;
    let (flown, said): (Vec<_>, Vec<_>) = said.lines().partition(|line| line.starts_with("@ "));
    let said = said.join("\n") + "\n";
    print!("{said}");
    if bless {
        snapshot::write(LOG, &log(&flown)?)?;
    }
    if !record::compare(RECORD, &record::versions()?, &said, bless)? {
        return Ok(());
    }
    // Less than recorded is another flight, too.
    let recorded = snapshot::read(RECORD)?;
    let (_, figures) = recorded.split_once("\n\n").unwrap_or_default();
    let off = record::differences(figures, &said)?;
    if off.is_empty() { Ok(()) } else { Err(format!("{RECORD}: {}", off.join("; "))) }
}

/// Flies after the RTIC example from C: `Ok` where every tick has the bits of the desk's Rust program.
pub fn from_c() -> Result<(), String> {
    let row = row("antiicing-warm", "--full")?;
    let desk = row.module()?.that_replays(&root().join(LOG))?.on_desk()?;
    let package = row.package("m4")?;
    let log = snapshot::read(LOG)?;
    let inputs = log.lines().skip(1).filter_map(|line| line.split_once(','));
    let inputs: Vec<_> =
        inputs.map(|(_, own)| format!("{{{}f}},\n", own.replace(',', "f, "))).collect();
    files::write(&package.folder.join("flight.h"), inputs.concat())?;
    let defines = [&format!("-DTICKS={}", inputs.len()), "-DLOG=\"flight.h\""];
    let flown = played(&package, &package.library(), &defines, &M4F)?;
    match flown.difference(&desk) {
        None if flown.count() == inputs.len() => Ok(()),
        None => Err(format!("{} of {} ticks", flown.count(), inputs.len())),
        Some(difference) => Err(difference),
    }
}

/// The log of lines like `@ flown 1 41400000 c1200000`: a count, and the bits of each input.
fn log(flown: &[&str]) -> Result<String, String> {
    let mut text = "t,airspeed,ambient,nose_supply,middle_supply,aft_supply\n".to_owned();
    for line in flown {
        let mut words = line.split(' ').skip(2);
        text += words.next().unwrap_or_default();
        for bits in words {
            let bits = u32::from_str_radix(bits, 16).map_err(|_| format!("`{line}`"))?;
            text += &format!(",{:?}", f32::from_bits(bits));
        }
        text += "\n";
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_log_has_a_line_for_each_tick() {
        let text = log(&["@ flown 1 41400000 c1200000", "@ flown 2 3ecccccd 3f8ccccd"]).unwrap();
        let lines: Vec<_> = text.lines().skip(1).collect();
        assert_eq!(lines, ["1,12.0,-10.0", "2,0.4,1.1"]);
        assert!(log(&["@ flown 1 refused"]).is_err());
    }
}
