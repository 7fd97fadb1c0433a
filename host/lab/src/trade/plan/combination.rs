//! Combinations of the full product of knobs that make sense, are in reach, and are measured.

use super::{Combination, Factor, LARGEST_ON_BOARD, SceneFacts, Stop, TOO_LARGE};
use crate::trade::target::Target;
use signorini_scene::setting::{MathKind, Method, ModelKind, Omega, Precision, Setting, Start};

impl Combination {
    /// Why it is left out; `None`: it is measured.
    pub fn reason(&self, ground: &SceneFacts) -> Option<&'static str> {
        self.refused(ground).or_else(|| {
            if self.error.is_some() {
                let reason = "meshes refined for an error are measured with exact methods in f32";
                let usual = self.model == ModelKind::Condensed || self.starts_as_most(ground);
                return (!(usual && self.is_usual())).then_some(reason);
            }
            let measured = match self.model {
                ModelKind::Condensed => self.is_condensed_point(),
                ModelKind::Full if self.stop == Stop::Exact => self.is_factored_point(ground),
                ModelKind::Full => self.is_crossed(ground) || self.is_single(ground),
            };
            (!measured).then_some("knobs that do not act on each other are turned one at a time")
        })
    }

    /// Why it means nothing, or why there is no code for it, or no room.
    fn refused(&self, ground: &SceneFacts) -> Option<&'static str> {
        let condensed = self.model == ModelKind::Condensed;
        let (exact, warm) = (self.stop == Stop::Exact, self.start == Start::Warm);
        let has_omega = self.omega != Factor::Auto;
        let fast = self.math == MathKind::Micromath;
        let mixed = self.scalar == Precision::Mixed;
        let loose = !condensed && ground.is_loose;
        let on_board = ground.target != Target::Host;
        let size = ground.unknowns << (2 * self.level);
        let stop = self.stop;
        let other = !matches!(stop, Stop::Exact | Stop::Sweeps(12));
        let reasons = [
            (condensed && other, "shares and other sweeps than 12 are for full models"),
            (!condensed && stop == Stop::Sweeps(12), "12 sweeps are for condensed models"),
            (exact && !condensed && (has_omega || fast), "a factor has no ω"),
            (condensed && has_omega, "a condensed model has its best ω from the host"),
            (
                matches!(stop, Stop::Sweeps(10 | 40)) && self.level > 0,
                "so few sweeps of a refined mesh never paid: a coarser mesh has the same error for less",
            ),
            (fast && self.scalar != Precision::F32, "micromath is for f32"),
            (fast && (has_omega || condensed), "micromath serves the search for ω alone"),
            (
                matches!(stop, Stop::Share(_)) && !self.certificate,
                "a share of the bound needs the bound",
            ),
            (warm && !ground.has_inputs, "no inputs: nothing changes between ticks"),
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
                loose && matches!(stop, Stop::Share(share) if share != 0.01),
                "contact alone holds the domain: no share of the bound to stop at",
            ),
            (loose && fast, "contact alone holds the domain: solved with libm"),
            (on_board && mixed, "f32+f64 is for the host"),
            (
                self.scalar == Precision::F64 && ground.target == Target::M4f,
                "an M4F computes f64 in software: 45 times the instructions",
            ),
            (on_board && !condensed && size > LARGEST_ON_BOARD, TOO_LARGE),
        ];
        reasons.into_iter().find(|(holds, _)| *holds).map(|(_, reason)| reason)
    }

    /// Whether it starts as most points do.
    fn starts_as_most(&self, ground: &SceneFacts) -> bool {
        (self.start == Start::Warm) == (ground.has_inputs && !ground.is_loose)
    }

    /// Whether it ends with the solution and its bound, in f32.
    fn is_usual(&self) -> bool {
        self.scalar == Precision::F32 && self.certificate && self.stop == Stop::Exact
    }

    /// Whether the mesh is the scene's.
    fn is_own(&self) -> bool {
        self.cells.is_none() && self.level == 0
    }

    /// Whether no knob of the search for ω is turned.
    fn is_plain(&self) -> bool {
        self.math == MathKind::Libm && self.omega == Factor::Auto
    }

    /// Sweeps and shares on every mesh.
    fn is_crossed(&self, ground: &SceneFacts) -> bool {
        let (single, host) = (self.scalar == Precision::F32, ground.target == Target::Host);
        let stop = match self.stop {
            Stop::Share(share) if single => share != 0.3 || host,
            Stop::Share(share) => self.scalar == Precision::F64 && share == 0.01,
            Stop::Sweeps(10 | 40) => !self.certificate && single && (host || self.cells.is_none()),
            _ => false,
        };
        stop && self.is_plain() && self.starts_as_most(ground)
    }

    /// One knob away from the base.
    fn is_single(&self, ground: &SceneFacts) -> bool {
        let (plain, usual) = (self.is_plain(), self.starts_as_most(ground));
        let host = ground.target == Target::Host;
        let at_base = usual && self.stop == Stop::Share(0.1);
        let turned = match self.scalar {
            _ if self.math == MathKind::Micromath => at_base,
            Precision::F32 if plain && !usual => matches!(self.stop, Stop::Share(s) if s < 0.3),
            Precision::F32 if at_base => host || self.omega == Factor::Tuned,
            Precision::F32 => {
                host && plain && self.certificate && matches!(self.stop, Stop::Sweeps(5 | 20 | 80))
            }
            Precision::F64 => host && plain && at_base,
            Precision::Mixed => {
                host && plain && self.start == Start::Cold && self.stop == Stop::Share(0.01)
            }
        };
        self.is_own() && turned
    }

    /// The condensed models: exact on every mesh; on the scene's own also what else there is.
    fn is_condensed_point(&self) -> bool {
        let others = [self.scalar != Precision::F32, !self.certificate, self.stop != Stop::Exact];
        self.is_usual() || self.is_own() && others.into_iter().filter(|other| *other).count() == 1
    }

    /// The factor of the full model: on the scene's cells, of whatever size, and on the others once; on the scene's
    /// own mesh also without its bound.
    fn is_factored_point(&self, ground: &SceneFacts) -> bool {
        let everywhere = self.cells.is_none() || self.level == 0;
        let place = if self.certificate { everywhere } else { self.is_own() };
        self.scalar == Precision::F32 && self.starts_as_most(ground) && place
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
