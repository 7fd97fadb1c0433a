//! What `signorini bake` states of a scene, against what its image takes.

use signorini_image::chosen::Chosen;
use signorini_image::firmware::Firmware;

/// What the figures may be off by, as a part of what the image takes. RAM is known but for the stack, flash but for the code of this very
/// scene; instructions are counted stages times the work of the same ticks on this machine.
const TOLERANCES: [(&str, f64); 3] = [("RAM", 0.01), ("flash", 0.03), ("instructions", 0.10)];

/// `Ok` where the image takes what was stated, within the tolerances.
pub fn compare(stated: &Chosen, image: &Firmware) -> Result<(), String> {
    let Chosen { ram_bytes, flash_bytes, instructions, .. } = stated;
    let instructions = instructions.ok_or("bake states no instructions")?;
    let takes = [image.ram_bytes, image.flash_bytes, image.instructions_per_tick.median];
    within([*ram_bytes as f64, *flash_bytes as f64, instructions], takes.map(|takes| takes as f64))
}

fn within(stated: [f64; 3], takes: [f64; 3]) -> Result<(), String> {
    let mut wrong = Vec::new();
    for ((&(what, most), stated), takes) in TOLERANCES.iter().zip(stated).zip(takes) {
        let off = stated / takes - 1.0;
        println!("  {what}: {stated:.0} stated, {takes} taken, {:+.1} %", 100.0 * off);
        let is_met = off.abs() <= most;
        if !is_met {
            let allowed = 100.0 * most;
            wrong
                .push(format!("{what}: {stated:.0} stated, {takes} taken, {allowed:.0} % allowed"));
        }
    }
    if wrong.is_empty() { Ok(()) } else { Err(wrong.join("; ")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_compared_within_the_tolerances() {
        let stated = [1104.0, 49720.0, 14238.0];
        assert_eq!(within(stated, [1108.0, 49000.0, 13500.0]), Ok(()));
        let why = within(stated, [1108.0, 52484.0, 9880.0]).unwrap_err();
        assert!(
            why.contains("flash: 49720") && why.contains("instructions") && !why.contains("RAM")
        );
    }
}
