//! The RTIC example of a baked scene: the anti-icing slab on a flight, against the record in git.

use crate::modules::FLOWN;
use crate::record;
use crate::snapshot;
use signorini_image::board::{Build, M4F};
use signorini_image::cargo::run as run_cargo;

const RECORD: &str = "tests/firmware/antiicing.txt";

/// Bakes the scene, flies, and compares what is said. The image itself fails where a deadline is missed or an answer is wrong.
pub fn check(bless: bool) -> Result<(), String> {
    let module = FLOWN.module()?;
    let (package, features) = ("signorini-rtic", &["antiicing"]);
    let build = Build { package, bins: &[], features, scenes: module.file() };
    let (mut command, folder) = M4F.build(build)?;
    command.env("SIGNORINI_SCENE", module.file());
    run_cargo(command)?;
    let said = M4F.run(&folder.join("signorini-rtic"), true)?;
    print!("{said}");
    if said.contains("\ncut 0\n") {
        return Err("no deadline was ever tight".to_owned());
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
