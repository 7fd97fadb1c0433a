//! Combinations of the full product of knobs that make sense, are in reach, and are measured.

use super::{Combination, Factor, LARGEST_ON_BOARD, SceneFacts, Stop, TOO_LARGE};
use crate::trade::target::Target;
use signorini_scene::setting::{MathKind, Method, ModelKind, Omega, Precision, Setting, Start};

impl Combination {
    /// Why it is left out; `None`: it is measured.
    pub fn reason(&self, ground: &SceneFacts) -> Option<&'static str> {
        self.senseless(ground).or_else(|| self.out_of_reach(ground)).or_else(|| {
            if self.error.is_some() {
                let reason = "meshes refined for an error are measured with exact methods in f32";
                return (!self.is_exact(ground)).then_some(reason);
            }
            let measured = match self.model {
                ModelKind::Condensed => self.is_condensed_point(),
                ModelKind::Full if self.stop == Stop::Exact => self.is_factored_point(ground),
                ModelKind::Full => self.is_crossed(ground) || self.is_single(ground),
            };
            (!measured).then_some("knobs that do not act on each other are turned one at a time")
        })
    }

    /// Why it means nothing.
    fn senseless(&self, ground: &SceneFacts) -> Option<&'static str> {
        let condensed = self.model == ModelKind::Condensed;
        let exact = self.stop == Stop::Exact;
        let has_omega = self.omega != Factor::Auto;
        let fast = self.math == MathKind::Micromath;
        first(&[
            (
                condensed && !matches!(self.stop, Stop::Exact | Stop::Sweeps(12)),
                "shares and other sweeps than 12 are for full models",
            ),
            (!condensed && self.stop == Stop::Sweeps(12), "12 sweeps are for condensed models"),
            (exact && !condensed && (has_omega || fast), "a factor has no ω"),
            (condensed && has_omega, "a condensed model has its best ω from the host"),
            (
                matches!(self.stop, Stop::Sweeps(10 | 40)) && self.level > 0,
                "so few sweeps of a refined mesh never paid: a coarser mesh has the same error for less",
            ),
            (fast && self.scalar != Precision::F32, "micromath is for f32"),
            (fast && (has_omega || condensed), "micromath serves the search for ω alone"),
            (
                matches!(self.stop, Stop::Share(_)) && !self.certificate,
                "a share of the bound needs the bound",
            ),
            (
                self.start == Start::Warm && !ground.has_inputs,
                "no inputs: nothing changes between ticks",
            ),
        ])
    }

    /// Why there is no code for it, or no room.
    fn out_of_reach(&self, ground: &SceneFacts) -> Option<&'static str> {
        let condensed = self.model == ModelKind::Condensed;
        let mixed = self.scalar == Precision::Mixed;
        let exact = self.stop == Stop::Exact;
        let warm = self.start == Start::Warm;
        let loose = !condensed && ground.is_loose;
        let on_board = ground.target != Target::Host;
        first(&[
            (ground.uses_time && on_board, "the data change with t, which firmware does not know"),
            (condensed && !ground.has_inputs, "no inputs: a condensed answer is a constant"),
            (condensed && !warm, "a condensed model starts at its default inputs"),
            (mixed && warm, "f32+f64 is for single solves on the host"),
            (condensed && mixed, "f32+f64 is for the full model on the host"),
            (mixed && exact, "f32+f64 is for sweeps"),
            (loose && exact, "contact alone holds the domain: no factor"),
            (loose && on_board, "contact alone holds the domain: the full model needs shifts"),
            (
                loose && (warm || mixed),
                "contact alone holds the domain: every full solve starts cold",
            ),
            (
                loose && matches!(self.stop, Stop::Share(share) if share != 0.01),
                "contact alone holds the domain: no share of the bound to stop at",
            ),
            (
                loose && self.math == MathKind::Micromath,
                "contact alone holds the domain: solved with libm",
            ),
            (on_board && mixed, "f32+f64 is for the host"),
            (
                self.scalar == Precision::F64 && ground.target == Target::M4f,
                "an M4F computes f64 in software: 45 times the instructions",
            ),
            (
                on_board && !condensed && ground.unknowns << (2 * self.level) > LARGEST_ON_BOARD,
                TOO_LARGE,
            ),
        ])
    }

    /// With the solution and its bound at the end of a usual tick.
    fn is_exact(&self, ground: &SceneFacts) -> bool {
        let usual = self.scalar == Precision::F32 && self.certificate && self.stop == Stop::Exact;
        usual && (self.model == ModelKind::Condensed || self.start == main_start(ground))
    }

    /// Sweeps and shares on every mesh.
    fn is_crossed(&self, ground: &SceneFacts) -> bool {
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
    fn is_single(&self, ground: &SceneFacts) -> bool {
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

    /// The factor of the full model: on the scene's cells, of whatever size, and on the others once; on the scene's
    /// own mesh also without its bound.
    fn is_factored_point(&self, ground: &SceneFacts) -> bool {
        let usual = self.scalar == Precision::F32 && self.start == main_start(ground);
        let own = self.cells.is_none() && self.level == 0;
        let everywhere = self.cells.is_none() || self.level == 0;
        usual && if self.certificate { everywhere } else { own }
    }

    pub fn setting(&self, ground: &SceneFacts) -> Setting {
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
        let factored = self.model == ModelKind::Full && self.stop == Stop::Exact;
        Setting {
            refine: self.level,
            error: self.error,
            cells: self.cells,
            scalar: Some(self.scalar),
            math: self.math,
            model: Some(self.model),
            solver: factored.then_some(Method::Factor),
            start: self.start,
            omega,
            sweeps,
            share,
            certificate: self.certificate,
            ..Setting::default()
        }
    }
}

/// The first reason that holds.
fn first(reasons: &[(bool, &'static str)]) -> Option<&'static str> {
    reasons.iter().find(|(holds, _)| *holds).map(|&(_, reason)| reason)
}

/// The start of most points.
fn main_start(ground: &SceneFacts) -> Start {
    if ground.has_inputs && !ground.is_loose { Start::Warm } else { Start::Cold }
}
