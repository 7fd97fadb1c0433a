//! What a scene's `[target]` allows, and what a model takes of it.

use std::fmt;

use super::costs::{CONSTANTS, CYCLES, FEWEST_CYCLES, Footprint};
use super::full::Sizes;
use signorini_scene::scene::Scene;

/// A model's needs of a device, code and stack included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Needs {
    /// Bytes of RAM.
    pub ram: u64,
    /// Bytes of flash.
    pub flash: u64,
    /// Instructions of a warm tick, of the median one of the trial and of the longest; `None` where they were not counted.
    pub ticks: [Option<f64>; 2],
}

/// The device's memory and time; what the scene does not declare is no limit.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Budget {
    /// Bytes.
    pub ram: Option<u64>,
    /// Bytes.
    pub flash: Option<u64>,
    /// Cycles a tick. A median tick that takes more at [`FEWEST_CYCLES`] an instruction does not fit; one that does at
    /// [`CYCLES`] probably does not.
    pub cycles: Option<f64>,
}

/// A shortfall of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct Shortfall {
    /// The key of the scene file.
    pub key: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The model's need.
    pub needed: f64,
    /// The device's supply.
    pub declared: f64,
    /// Where `needed` comes from, if it needs saying.
    pub why: String,
}

impl Needs {
    /// Data of these sizes with code and stack of such a model, as [`Footprint::measured`].
    pub fn with_code(model: &str, data: Sizes, ticks: [Option<f64>; 2]) -> Self {
        let Footprint { code, stack } = Footprint::measured(model);
        Self { ram: data.ram as u64 + stack, flash: data.flash as u64 + code + CONSTANTS, ticks }
    }

    /// Instructions of the median warm tick.
    pub fn instructions(&self) -> Option<f64> {
        self.ticks[0]
    }

    /// The needs of the longest tick.
    pub fn most_instructions(&self) -> Option<f64> {
        self.ticks[1]
    }
}

impl fmt::Display for Shortfall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { key, unit, needed, declared, why } = self;
        write!(
            f,
            "{key}: {needed:.0} {unit} are needed{why}, {declared:.0} declared, {:.0} too many",
            needed - declared
        )
    }
}

impl Budget {
    /// The budget of the scene.
    pub fn of(scene: &Scene) -> Self {
        let Some(target) = scene.target else { return Self::default() };
        let cycles = target.tick.zip(target.clock).map(|(tick, clock)| tick * clock);
        Self { ram: target.ram, flash: target.flash, cycles }
    }

    /// Instructions that a tick may have if each takes the cycles that one takes on average.
    pub fn instructions(&self) -> Option<f64> {
        self.cycles.map(|cycles| cycles / CYCLES)
    }

    /// Everything that `needs` goes beyond.
    pub fn shortfalls(&self, needs: &Needs) -> Vec<Shortfall> {
        let bytes = |key, needed: u64, declared: Option<u64>| {
            (key, "bytes", Some(needed as f64), declared.map(|bytes| bytes as f64), String::new())
        };
        let cycles = needs.instructions().map(|count| (count, count * FEWEST_CYCLES));
        let why = cycles.map_or(String::new(), |(count, _)| {
            format!(" ({count:.0} instructions in the median tick, at least {FEWEST_CYCLES} each)")
        });
        let all = [
            bytes("target.ram", needs.ram, self.ram),
            bytes("target.flash", needs.flash, self.flash),
            ("target.tick", "cycles", cycles.map(|(_, cycles)| cycles), self.cycles, why),
        ];
        let over = |(key, unit, needed, declared, why): (_, _, Option<f64>, Option<f64>, _)| {
            let (needed, declared) = needed.zip(declared)?;
            (needed > declared).then_some(Shortfall { key, unit, needed, declared, why })
        };
        all.into_iter().filter_map(over).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_declared_can_fall_short() {
        let needs = Needs { ram: 100, flash: 200, ticks: [Some(300.0); 2] };
        assert!(Budget::default().shortfalls(&needs).is_empty());
        let budget = Budget { ram: Some(100), flash: Some(150), cycles: Some(419.0) };
        let keys: Vec<_> = budget.shortfalls(&needs).iter().map(|short| short.key).collect();
        assert_eq!(keys, ["target.flash", "target.tick"]);
        // 300 instructions at 1.4 cycles.
        let ample = Budget { flash: None, cycles: Some(421.0), ..budget };
        assert!(ample.shortfalls(&needs).is_empty());
        let unknown = Needs { ticks: [None; 2], ..needs };
        assert_eq!(budget.shortfalls(&unknown).len(), 1);
    }
}
