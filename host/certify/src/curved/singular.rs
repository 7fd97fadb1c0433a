//! Places where w is singular: the energy nearer to them than all panels, or that it is infinite.

use super::POINTS;
use super::rise::Rise;
use crate::deviation::Deviation;
use signorini_problem::quadrature::gauss;
use signorini_scene::error::Result;

/// Reason why no function of finite energy follows w, and the place along the edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rough {
    /// w jumps.
    Jump(f64),
    /// ∫w′² is infinite there.
    Steep(f64),
}

/// Shells around a singular place that tell how fast its energy decays, and the first one's distance.
const SHELLS: i32 = 8;
const NEAREST: f64 = 16.0;
/// The most that the energy of a shell may keep from one to the next of half the distance: w like |t − a|^s keeps
/// 2^{1−2s}, and from s = ½ on its energy is infinite. A power between 0.5 and 0.53 can't be told from ½.
const DECAY: f64 = 0.96;

/// How near to an end of parts w is compared on both sides, and how many times that it is from the ends of the edge.
const BESIDE: f64 = 1.0 / (1_u64 << 36) as f64;
const FAR: f64 = 16.0;

/// ∫w′² nearer to a singular place than all panels, or why it is infinite.
///
/// The places are the edge's parts on which w′ is not bounded.
pub(super) fn beyond(rise: &Rise) -> Result<std::result::Result<f64, Rough>> {
    let (mut sum, deviation) = (0.0, rise.deviation);
    // On both sides of a jump w may be smooth, where it is at an end of parts.
    for pair in deviation.parts().windows(2) {
        let place = pair[0].range[1];
        let is_inside = (FAR * BESIDE..=1.0 - FAR * BESIDE).contains(&place);
        let beside = [place - BESIDE, place + BESIDE];
        if is_inside && !deviation.is_steady(beside) && rise.jumps(beside)? {
            return Ok(Err(Rough::Jump(place)));
        }
    }
    let singular = deviation.parts().iter().filter(|part| part.is_singular());
    for [low, high] in clusters(singular.map(|part| part.range)) {
        let place = match (low == 0.0, high == 1.0) {
            (true, _) => 0.0,
            (_, true) => 1.0,
            _ => 0.5 * (low + high),
        };
        let nearest = NEAREST * (high - low);
        let energies =
            (0..=SHELLS).rev().map(|k| shell(deviation, place, nearest * 2.0_f64.powi(k)));
        let energies = energies.collect::<Result<Vec<_>>>()?;
        let (first, last) = (energies[0], energies[SHELLS as usize]);
        let late = energies[SHELLS as usize / 2];
        let kept = (last / first).powf(1.0 / f64::from(SHELLS));
        let kept = kept.max((last / late).powf(2.0 / f64::from(SHELLS)));
        let kept = if last == 0.0 { 0.0 } else { kept };
        if kept > DECAY || kept.is_nan() {
            return Ok(Err(Rough::Steep(place)));
        }
        if rise.jumps([low, high])? {
            return Ok(Err(Rough::Jump(place)));
        }
        sum += last * kept / (1.0 - kept);
    }
    Ok(Ok(sum))
}

/// Neighbouring panels taken together.
fn clusters(open: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let mut found: Vec<[f64; 2]> = Vec::new();
    for [low, high] in open {
        match found.last_mut() {
            Some(last) if last[1] >= low => last[1] = high,
            _ => found.push([low, high]),
        }
    }
    found
}

/// ∫w′² where the distance from `place` is between `nearest` and twice that, as far as it is on the edge.
fn shell(deviation: &Deviation, place: f64, nearest: f64) -> Result<f64> {
    let mut sum = 0.0;
    for side in [-1.0, 1.0] {
        for [t, weight] in gauss(POINTS) {
            let t = place + side * nearest * (1.0 + t);
            if (0.0..=1.0).contains(&t) {
                sum += nearest * weight * deviation.at(t)?[1].powi(2);
            }
        }
    }
    Ok(sum)
}
