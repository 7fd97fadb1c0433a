//! Which settings are measured: knobs that act on each other are crossed, the others are turned one at a time.
//!
//! ```text
//!   crossed     cells × level × {share 0.3, 0.1, 0.01 in f32; 0.01 in f64; 10, 40 sweeps without certificate}
//!               cells × level × condensed
//!   one at a time, from f32, the scene's cells and mesh, share 0.1:
//!               the other start │ ω tuned, unit │ 5, 20, 80 sweeps with certificate │ share 0.1 in f64
//!               micromath │ f32+f64 │ condensed: f64, without certificate, 12 sweeps
//! ```
//! Everything else of the full product of knobs is counted with the reason why it is left out.

use std::collections::BTreeMap;

use super::record::Skipped;
use super::target::Target;
use crate::setting::{CellKind, MathKind, ModelKind, Omega, Precision, Setting, Start};

/// The most settings of one scene.
pub const MOST: usize = 60;

/// ω as a knob; what `Tuned` is has to be found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Factor {
    Auto,
    Tuned,
    Unit,
}

/// When a tick ends.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Stop {
    Share(f64),
    Sweeps(u32),
    Exact,
}

const STOPS: [Stop; 10] = [
    Stop::Share(0.3),
    Stop::Share(0.1),
    Stop::Share(0.01),
    Stop::Sweeps(5),
    Stop::Sweeps(10),
    Stop::Sweeps(12),
    Stop::Sweeps(20),
    Stop::Sweeps(40),
    Stop::Sweeps(80),
    Stop::Exact,
];

/// What a scene allows for.
#[derive(Debug, Clone, Copy)]
pub struct Ground {
    /// Whose cost decides.
    pub target: Target,
    /// The cells that the scene's mesh can be brought to beside its own.
    pub other_cells: Option<CellKind>,
    /// The finest refinement.
    pub finest: u32,
    /// Whether inputs change from tick to tick.
    pub has_inputs: bool,
    /// Whether contact alone or nothing holds a part.
    pub is_loose: bool,
    /// Unknowns of the scene's mesh.
    pub unknowns: usize,
    /// The best fixed ω on the scene's mesh.
    pub tuned: Option<f64>,
}

/// The settings to measure, and what is left out.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// In the order of measurement.
    pub settings: Vec<Setting>,
    /// Why the others are not among them.
    pub skipped: Vec<Skipped>,
}

/// One combination of all knobs.
#[derive(Debug, Clone, Copy)]
struct Combination {
    cells: Option<CellKind>,
    level: u32,
    scalar: Precision,
    math: MathKind,
    model: ModelKind,
    start: Start,
    omega: Factor,
    stop: Stop,
    certificate: bool,
}

impl Plan {
    /// The plan for a scene.
    pub fn new(ground: &Ground) -> Self {
        let mut settings = Vec::new();
        let mut skipped = BTreeMap::<&str, usize>::new();
        for combination in combinations(ground) {
            match combination.reason(ground) {
                None if settings.len() < MOST => settings.push(combination.setting(ground)),
                None => *skipped.entry("more than 60 points").or_default() += 1,
                Some(reason) => *skipped.entry(reason).or_default() += 1,
            }
        }
        let skipped = skipped.into_iter();
        let skipped = skipped.map(|(reason, count)| Skipped { reason: reason.to_owned(), count });
        Self { settings, skipped: skipped.collect() }
    }
}

/// The full product.
fn combinations(ground: &Ground) -> impl Iterator<Item = Combination> {
    let cells = [None, ground.other_cells];
    let cells = cells.into_iter().take(if ground.other_cells.is_some() { 2 } else { 1 });
    let finest = ground.finest;
    let meshes = cells.flat_map(move |cells| (0..=finest).map(move |level| (cells, level)));
    let models = [ModelKind::Full, ModelKind::Condensed];
    let meshes = meshes.flat_map(move |mesh| models.map(|model| (mesh, model)));
    let formats = meshes.flat_map(|of| {
        [Precision::F32, Precision::F64, Precision::Mixed].map(|scalar| (of, scalar))
    });
    let stops = formats.flat_map(|of| STOPS.map(|stop| (of, stop)));
    let maths = stops.flat_map(|of| [MathKind::Libm, MathKind::Micromath].map(|math| (of, math)));
    let starts = maths.flat_map(|of| [Start::Warm, Start::Cold].map(|start| (of, start)));
    let factors =
        starts.flat_map(|of| [Factor::Auto, Factor::Tuned, Factor::Unit].map(|omega| (of, omega)));
    let all = factors.flat_map(|of| [true, false].map(|certificate| (of, certificate)));
    all.map(|((((((((cells, level), model), scalar), stop), math), start), omega), certificate)| {
        Combination { cells, level, scalar, math, model, start, omega, stop, certificate }
    })
}

impl Combination {
    /// Why it is left out; `None`: it is measured.
    fn reason(&self, ground: &Ground) -> Option<&'static str> {
        self.senseless(ground).or_else(|| self.out_of_reach(ground)).or_else(|| {
            let measured = match self.model {
                ModelKind::Condensed => self.is_condensed_point(),
                ModelKind::Full => self.is_crossed(ground) || self.is_single(ground),
            };
            (!measured).then_some("knobs that do not act on each other are turned one at a time")
        })
    }

    /// What means nothing.
    fn senseless(&self, ground: &Ground) -> Option<&'static str> {
        let condensed = self.model == ModelKind::Condensed;
        if condensed != (self.stop == Stop::Exact) && !(condensed && self.stop == Stop::Sweeps(12))
        {
            return Some(
                "the exact method and 12 sweeps are for condensed models, shares for full ones",
            );
        }
        if condensed && self.omega != Factor::Auto {
            return Some("a condensed model has its best ω from the host");
        }
        if self.math == MathKind::Micromath && self.scalar != Precision::F32 {
            return Some("micromath is for f32");
        }
        if self.math == MathKind::Micromath && (self.omega != Factor::Auto || condensed) {
            return Some("micromath serves the search for ω alone");
        }
        if matches!(self.stop, Stop::Share(_)) && !self.certificate {
            return Some("a share of the bound needs the bound");
        }
        if self.start == Start::Warm && !ground.has_inputs {
            return Some("no inputs: nothing changes between ticks");
        }
        None
    }

    /// What there is no code for, or no room.
    fn out_of_reach(&self, ground: &Ground) -> Option<&'static str> {
        /// Unknowns of the largest mesh that is put on a microcontroller for a study.
        const LARGEST: usize = 4500;
        let condensed = self.model == ModelKind::Condensed;
        if condensed && !ground.has_inputs {
            return Some("no inputs: a condensed answer is a constant");
        }
        if condensed && self.start == Start::Cold {
            return Some("a condensed model starts at its default inputs");
        }
        if self.scalar == Precision::Mixed && self.start == Start::Warm {
            return Some("f32+f64 is for single solves on the host");
        }
        if condensed && self.scalar == Precision::Mixed {
            return Some("f32+f64 is for the full model on the host");
        }
        if !condensed && ground.is_loose {
            if ground.target != Target::Host {
                return Some("contact alone holds the domain: the full model needs shifts");
            }
            if self.start == Start::Warm || self.scalar == Precision::Mixed {
                return Some("contact alone holds the domain: every full solve starts cold");
            }
            if matches!(self.stop, Stop::Share(share) if share != 0.01) {
                return Some("contact alone holds the domain: no share of the bound to stop at");
            }
            if self.math == MathKind::Micromath {
                return Some("contact alone holds the domain: solved with libm");
            }
        }
        if ground.target != Target::Host {
            if self.scalar == Precision::Mixed {
                return Some("f32+f64 is for the host");
            }
            if self.scalar == Precision::F64 && ground.target == Target::M4f {
                return Some("an M4F computes f64 in software: 45 times the instructions");
            }
            if !condensed && ground.unknowns << (2 * self.level) > LARGEST {
                return Some("the full model of so fine a mesh is no model for a microcontroller");
            }
        }
        None
    }

    /// Sweeps and shares on every mesh.
    fn is_crossed(&self, ground: &Ground) -> bool {
        let stop = match self.stop {
            Stop::Share(share) => {
                self.scalar == Precision::F32 && (share != 0.3 || ground.target == Target::Host)
                    || self.scalar == Precision::F64 && share == 0.01
            }
            Stop::Sweeps(10 | 40) => {
                !self.certificate
                    && self.scalar == Precision::F32
                    && (ground.target == Target::Host || self.cells.is_none())
            }
            _ => false,
        };
        stop && self.math == MathKind::Libm
            && self.omega == Factor::Auto
            && self.start == main_start(ground)
    }

    /// One knob away from the base.
    fn is_single(&self, ground: &Ground) -> bool {
        if self.cells.is_some() || self.level > 0 {
            return false;
        }
        let plain = self.math == MathKind::Libm && self.omega == Factor::Auto;
        let base = self.stop == Stop::Share(0.1);
        let single = self.scalar == Precision::F32;
        let usual = self.start == main_start(ground);
        let other_start =
            plain && single && !usual && matches!(self.stop, Stop::Share(s) if s < 0.3);
        let other_omega = self.math == MathKind::Libm && single && usual && base;
        let swept = plain
            && single
            && usual
            && self.certificate
            && matches!(self.stop, Stop::Sweeps(5 | 20 | 80));
        let double = plain && usual && base && self.scalar == Precision::F64;
        let cold = self.start == Start::Cold;
        let mixed =
            plain && cold && self.scalar == Precision::Mixed && self.stop == Stop::Share(0.01);
        let fast = self.math == MathKind::Micromath && usual && base;
        let host = ground.target == Target::Host;
        other_start
            || other_omega && (host || self.omega == Factor::Tuned)
            || host && (swept || double || mixed)
            || fast
    }

    /// The condensed models: exact on every mesh; on the scene's own also what else there is.
    fn is_condensed_point(&self) -> bool {
        let usual = self.scalar == Precision::F32 && self.certificate && self.stop == Stop::Exact;
        let own = self.cells.is_none() && self.level == 0;
        let others = [self.scalar != Precision::F32, !self.certificate, self.stop != Stop::Exact];
        usual || own && others.into_iter().filter(|other| *other).count() == 1
    }

    fn setting(&self, ground: &Ground) -> Setting {
        let omega = match self.omega {
            Factor::Auto => Omega::Auto,
            Factor::Tuned => ground.tuned.map_or(Omega::Auto, Omega::Fixed),
            Factor::Unit => Omega::Fixed(1.0),
        };
        let (share, sweeps) = match self.stop {
            Stop::Share(share) => (Some(share), None),
            Stop::Sweeps(sweeps) => (None, Some(sweeps)),
            Stop::Exact => (None, None),
        };
        Setting {
            refine: self.level,
            cells: self.cells,
            scalar: Some(self.scalar),
            math: self.math,
            model: Some(self.model),
            start: self.start,
            omega,
            sweeps,
            share,
            certificate: self.certificate,
        }
    }
}

/// What most points start from.
fn main_start(ground: &Ground) -> Start {
    if ground.has_inputs && !ground.is_loose { Start::Warm } else { Start::Cold }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GROUND: Ground = Ground {
        target: Target::Host,
        other_cells: Some(CellKind::Quads),
        finest: 2,
        has_inputs: true,
        is_loose: false,
        unknowns: 900,
        tuned: Some(1.9),
    };

    fn product(plan: &Plan) -> usize {
        plan.settings.len() + plan.skipped.iter().map(|skipped| skipped.count).sum::<usize>()
    }

    #[test]
    fn every_combination_is_measured_or_counted() {
        let plan = Plan::new(&GROUND);
        assert_eq!(product(&plan), 2 * 3 * 2 * 3 * 10 * 2 * 2 * 3 * 2);
        assert!(plan.settings.len() > 40 && plan.settings.len() <= MOST, "{}", plan.settings.len());
        assert!(!plan.skipped.iter().any(|skipped| skipped.reason.contains("60")), "{plan:?}");
    }

    #[test]
    fn no_setting_twice() {
        for target in [Target::Host, Target::M4f, Target::M7] {
            for has_inputs in [true, false] {
                for is_loose in [true, false] {
                    let plan = Plan::new(&Ground { target, has_inputs, is_loose, ..GROUND });
                    let settings = &plan.settings;
                    let twice =
                        (1..settings.len()).find(|&at| settings[..at].contains(&settings[at]));
                    assert_eq!(twice, None, "{target:?}");
                }
            }
        }
    }

    #[test]
    fn every_knob_is_turned() {
        let settings = Plan::new(&GROUND).settings;
        let has = |what: &dyn Fn(&Setting) -> bool| settings.iter().any(what);
        assert!(has(&|s| s.scalar == Some(Precision::Mixed)));
        assert!(has(&|s| s.scalar == Some(Precision::F64)));
        assert!(has(&|s| s.math == MathKind::Micromath));
        assert!(has(&|s| s.refine == 2 && s.cells == Some(CellKind::Quads)));
        assert!(has(&|s| s.omega == Omega::Fixed(1.0)) && has(&|s| s.omega == Omega::Fixed(1.9)));
        assert!(has(&|s| s.start == Start::Cold) && has(&|s| s.start == Start::Warm));
        assert!(has(&|s| s.model == Some(ModelKind::Condensed)) && has(&|s| !s.certificate));
    }

    #[test]
    fn nothing_moves_without_inputs() {
        let plan = Plan::new(&Ground { has_inputs: false, ..GROUND });
        assert!(plan.settings.iter().all(|setting| setting.start == Start::Cold));
        assert!(plan.settings.iter().all(|setting| setting.model == Some(ModelKind::Full)));
    }
}
