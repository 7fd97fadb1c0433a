//! Which settings are measured: knobs that act on each other are crossed, the others are turned one at a time.
//!
//! ```text
//!   crossed     cells × level × {share 0.3, 0.1, 0.01 in f32; 0.01 in f64}
//!               cells × {10, 40 sweeps without certificate}
//!               cells × level × condensed
//!               refined to an error bound of 20, 10, 5 % where that asks for it × {condensed, factor}
//!   one at a time, from f32, the scene's cells and mesh, share 0.1:
//!               the other start │ ω tuned, unit │ 5, 20, 80 sweeps with certificate │ share 0.1 in f64
//!               micromath │ f32+f64 │ condensed: f64, without certificate, 12 sweeps
//!               factor: finer meshes, the other cells, without certificate
//! ```
//! Everything else of the full product of knobs is counted with the reason why it is left out.

mod combination;

use std::collections::BTreeMap;

use super::record::Skipped;
use super::target::Target;
use combination::Combination;
use signorini_scene::Goal;
use signorini_scene::setting::{
    CellKind, MathKind, Method, ModelKind, Omega, Precision, Setting, Start,
};

/// The most settings of one scene.
pub const MOST: usize = 60;

/// Error bounds that meshes are refined to, where these ask for it.
const ERRORS: [Goal; 3] = [Goal::Part(0.2), Goal::Part(0.1), Goal::Part(0.05)];

/// Unknowns of the largest mesh that is put on a microcontroller for a study.
pub const LARGEST_ON_BOARD: usize = 4500;
/// Why a larger one is not.
pub const TOO_LARGE: &str = "the full model of so fine a mesh is no model for a microcontroller";

/// When a tick ends: with a share of the bound, after so many sweeps, or, without either, with the solution.
const STOPS: [(Option<f64>, Option<u32>); 10] = [
    (Some(0.3), None),
    (Some(0.1), None),
    (Some(0.01), None),
    (None, Some(5)),
    (None, Some(10)),
    (None, Some(12)),
    (None, Some(20)),
    (None, Some(40)),
    (None, Some(80)),
    (None, None),
];

/// The facts of a scene that decide its plan.
#[derive(Debug, Clone, Copy)]
pub struct SceneFacts {
    pub target: Target,
    /// The cells that the scene's mesh can be brought to beside its own.
    pub other_cells: Option<CellKind>,
    pub finest: u32,
    pub has_inputs: bool,
    pub uses_time: bool,
    /// Whether contact alone or nothing holds a part.
    pub is_loose: bool,
    pub unknowns: usize,
    /// The best fixed ω on the scene's mesh.
    pub tuned: Option<f64>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// In the order of measurement.
    pub settings: Vec<Setting>,
    /// Why the others are not among them.
    pub skipped: Vec<Skipped>,
}

impl Plan {
    pub fn new(ground: &SceneFacts) -> Self {
        let mut settings = Vec::new();
        let mut skipped = BTreeMap::<&str, usize>::new();
        for setting in combinations(ground) {
            match (Combination { setting, ground }).reason() {
                None if settings.len() < MOST => settings.push(setting),
                None => *skipped.entry("more than 60 points").or_default() += 1,
                Some(reason) => *skipped.entry(reason).or_default() += 1,
            }
        }
        let skipped = skipped.into_iter();
        let skipped = skipped.map(|(reason, count)| Skipped { reason: reason.to_owned(), count });
        Self { settings, skipped: skipped.collect() }
    }
}

/// The full product, whose first knob changes most slowly.
fn combinations(ground: &SceneFacts) -> Vec<Setting> {
    let cells = [None].into_iter().chain(ground.other_cells.map(Some));
    let levels = 0..=ground.finest;
    let uniform = cells.flat_map(|cells| levels.clone().map(move |refine| (cells, refine, None)));
    let meshes = uniform.chain(ERRORS.map(|error| (None, 0, Some(error))));
    let mut all: Vec<Setting> = meshes
        .map(|(cells, refine, error)| Setting { cells, refine, error, ..Setting::default() })
        .collect();
    all = crossed(&all, [ModelKind::Full, ModelKind::Condensed], |set, of| set.model = Some(of));
    let scalars = [Precision::F32, Precision::F64, Precision::Mixed];
    all = crossed(&all, scalars, |set, of| set.scalar = Some(of));
    all = crossed(&all, STOPS, |set, (share, sweeps)| {
        let factored = set.model == Some(ModelKind::Full) && (share, sweeps) == (None, None);
        (set.share, set.sweeps) = (share, sweeps);
        set.solver = factored.then_some(Method::Factor);
    });
    all = crossed(&all, [MathKind::Libm, MathKind::Micromath], |set, of| set.math = of);
    all = crossed(&all, [Start::Warm, Start::Cold], |set, of| set.start = of);
    // Without a best ω contact alone holds the domain: no full model with a fixed one is measured there.
    let tuned = ground.tuned.unwrap_or(f64::NAN);
    let factors = [Omega::Auto, Omega::Fixed(tuned), Omega::Fixed(1.0)];
    all = crossed(&all, factors, |set, of| set.omega = of);
    crossed(&all, [true, false], |set, of| set.certificate = of)
}

/// Each setting with each of these values of a knob.
fn crossed<T: Copy, const N: usize>(
    settings: &[Setting],
    values: [T; N],
    turn: impl Fn(&mut Setting, T),
) -> Vec<Setting> {
    let turned = |&setting: &Setting| {
        values.map(|value| {
            let mut setting = setting;
            turn(&mut setting, value);
            setting
        })
    };
    settings.iter().flat_map(turned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const GROUND: SceneFacts = SceneFacts {
        target: Target::Host,
        other_cells: Some(CellKind::Quads),
        finest: 2,
        has_inputs: true,
        uses_time: false,
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
        assert_eq!(product(&plan), (2 * 3 + 3) * 2 * 3 * 10 * 2 * 2 * 3 * 2);
        assert!(plan.settings.len() > 40 && plan.settings.len() <= MOST, "{}", plan.settings.len());
        assert!(
            !plan.skipped.iter().any(|skipped| skipped.reason.contains("more than")),
            "{plan:?}"
        );
    }

    #[test]
    fn no_setting_twice() {
        for target in [Target::Host, Target::M4f, Target::M7] {
            for has_inputs in [true, false] {
                for is_loose in [true, false] {
                    let plan = Plan::new(&SceneFacts { target, has_inputs, is_loose, ..GROUND });
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
        let factored = settings.iter().filter(|s| s.solver == Some(Method::Factor));
        assert!(factored.clone().all(|s| s.sweeps.is_none() && s.share.is_none()));
        // Three levels, the other cells, without the bound, and three meshes refined for an error.
        assert_eq!(factored.count(), 8);
        assert!(has(&|s| s.error.is_some() && s.model == Some(ModelKind::Condensed)));
    }

    #[test]
    fn nothing_moves_without_inputs() {
        let plan = Plan::new(&SceneFacts { has_inputs: false, ..GROUND });
        assert!(plan.settings.iter().all(|setting| setting.start == Start::Cold));
        assert!(plan.settings.iter().all(|setting| setting.model == Some(ModelKind::Full)));
    }
}
