//! Combinations of the full product of knobs that make sense, are in reach, and are measured.

use super::{LARGEST_ON_BOARD, SceneFacts, TOO_LARGE};
use crate::trade::target::Target;
use signorini_scene::Setting;
use signorini_scene::setting::{MathKind, ModelKind, Omega, Precision, Start};

/// A setting of a scene, with what decides whether it is measured.
pub(super) struct Combination<'g> {
    pub setting: Setting,
    pub ground: &'g SceneFacts,
}

impl Combination<'_> {
    /// Why it is left out; `None`: it is measured.
    pub fn reason(&self) -> Option<&'static str> {
        self.refused().or_else(|| {
            if self.setting.error.is_some() {
                let reason = "meshes refined for an error are measured with exact methods in f32";
                let usual = self.is_condensed() || self.starts_as_most();
                return (!(usual && self.is_usual())).then_some(reason);
            }
            let measured = match (self.is_condensed(), self.is_exact()) {
                (true, _) => self.is_condensed_point(),
                (false, true) => self.is_factored_point(),
                (false, false) => self.is_crossed() || self.is_single(),
            };
            (!measured).then_some("knobs that do not act on each other are turned one at a time")
        })
    }

    fn is_condensed(&self) -> bool {
        self.setting.model == Some(ModelKind::Condensed)
    }

    /// Whether a tick ends with the solution: by the exchanges of a condensed model, by the factor of a full one.
    fn is_exact(&self) -> bool {
        self.setting.share.is_none() && self.setting.sweeps.is_none()
    }

    fn is_in(&self, scalar: Precision) -> bool {
        self.setting.scalar == Some(scalar)
    }

    /// Why it means nothing, or why there is no code for it, or no room.
    fn refused(&self) -> Option<&'static str> {
        let Setting { share, sweeps, refine, .. } = self.setting;
        let ground = self.ground;
        let (condensed, exact) = (self.is_condensed(), self.is_exact());
        let warm = self.setting.start == Start::Warm;
        let has_omega = self.setting.omega != Omega::Auto;
        let fast = self.setting.math == MathKind::Micromath;
        let mixed = self.is_in(Precision::Mixed);
        let loose = !condensed && ground.is_loose;
        let on_board = ground.target != Target::Host;
        let size = ground.unknowns << (2 * refine);
        let other = !exact && sweeps != Some(12);
        let reasons = [
            (condensed && other, "shares and other sweeps than 12 are for full models"),
            (!condensed && sweeps == Some(12), "12 sweeps are for condensed models"),
            (exact && !condensed && (has_omega || fast), "a factor has no ω"),
            (condensed && has_omega, "a condensed model has its best ω from the host"),
            (
                matches!(sweeps, Some(10 | 40)) && refine > 0,
                "so few sweeps of a refined mesh never paid: a coarser mesh has the same error for less",
            ),
            (fast && !self.is_in(Precision::F32), "micromath is for f32"),
            (fast && (has_omega || condensed), "micromath serves the search for ω alone"),
            (share.is_some() && !self.setting.certificate, "a share of the bound needs the bound"),
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
                loose && share.is_some_and(|share| share != 0.01),
                "contact alone holds the domain: no share of the bound to stop at",
            ),
            (loose && fast, "contact alone holds the domain: solved with libm"),
            (on_board && mixed, "f32+f64 is for the host"),
            (
                self.is_in(Precision::F64) && ground.target == Target::M4f,
                "an M4F computes f64 in software: 45 times the instructions",
            ),
            (on_board && !condensed && size > LARGEST_ON_BOARD, TOO_LARGE),
        ];
        reasons.into_iter().find(|(holds, _)| *holds).map(|(_, reason)| reason)
    }

    /// Whether it starts as most points do.
    fn starts_as_most(&self) -> bool {
        let is_warm = self.setting.start == Start::Warm;
        is_warm == (self.ground.has_inputs && !self.ground.is_loose)
    }

    /// Whether it ends with the solution and its bound, in f32.
    fn is_usual(&self) -> bool {
        self.is_in(Precision::F32) && self.setting.certificate && self.is_exact()
    }

    /// Whether the mesh is the scene's.
    fn is_own(&self) -> bool {
        self.setting.cells.is_none() && self.setting.refine == 0
    }

    /// Whether no knob of the search for ω is turned.
    fn is_plain(&self) -> bool {
        self.setting.math == MathKind::Libm && self.setting.omega == Omega::Auto
    }

    /// Sweeps and shares on every mesh.
    fn is_crossed(&self) -> bool {
        let Setting { share, sweeps, cells, certificate, .. } = self.setting;
        let (single, host) = (self.is_in(Precision::F32), self.ground.target == Target::Host);
        let stop = match (share, sweeps) {
            (Some(share), _) if single => share != 0.3 || host,
            (Some(share), _) => self.is_in(Precision::F64) && share == 0.01,
            (_, Some(10 | 40)) => !certificate && single && (host || cells.is_none()),
            _ => false,
        };
        stop && self.is_plain() && self.starts_as_most()
    }

    /// One knob away from the base.
    fn is_single(&self) -> bool {
        let Setting { share, sweeps, omega, certificate, start, .. } = self.setting;
        let (plain, usual) = (self.is_plain(), self.starts_as_most());
        let host = self.ground.target == Target::Host;
        let at_base = usual && share == Some(0.1);
        let turned = match self.setting.scalar {
            _ if self.setting.math == MathKind::Micromath => at_base,
            Some(Precision::F64) => host && plain && at_base,
            Some(Precision::Mixed) => host && plain && start == Start::Cold && share == Some(0.01),
            _ if plain && !usual => share.is_some_and(|share| share < 0.3),
            _ if at_base => host || self.ground.tuned.map(Omega::Fixed) == Some(omega),
            _ => host && plain && certificate && matches!(sweeps, Some(5 | 20 | 80)),
        };
        self.is_own() && turned
    }

    /// The condensed models: exact on every mesh; on the scene's own also what else there is.
    fn is_condensed_point(&self) -> bool {
        let others = [!self.is_in(Precision::F32), !self.setting.certificate, !self.is_exact()];
        self.is_usual() || self.is_own() && others.into_iter().filter(|other| *other).count() == 1
    }

    /// The factor of the full model: on the scene's cells, of whatever size, and on the others once; on the scene's
    /// own mesh also without its bound.
    fn is_factored_point(&self) -> bool {
        let everywhere = self.setting.cells.is_none() || self.setting.refine == 0;
        let place = if self.setting.certificate { everywhere } else { self.is_own() };
        self.is_in(Precision::F32) && self.starts_as_most() && place
    }
}
