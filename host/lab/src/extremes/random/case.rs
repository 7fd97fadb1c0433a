//! A scene drawn at random, and how it is to be solved.

use std::fmt::Write;

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

use super::cut::Line;
use super::feature::{self, Feature};
use super::mesh::{Kind, MeshPlan, Outline, Regions};
use super::posed::{Hold, Posed};
use super::{catalogue, data, made};
use crate::record_file::word;
use signorini_problem::random::Random;
use signorini_scene::Mesh;
use signorini_solve::ScalarKind;

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Yardstick {
    /// A solution of the catalogue, at any scale.
    #[default]
    Catalogue,
    /// A function was chosen, and the data made for it.
    Made,
    /// The data were chosen; the truth is a finer solve with its own bound.
    Finer,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Way {
    /// Sweeps of the kernel, as `solve` has them.
    #[default]
    Sweeps,
    /// The host's factorisation.
    Direct,
    /// The tick of a full controller.
    #[serde(rename = "full tick")]
    Full,
    /// The tick of a condensed one.
    #[serde(rename = "condensed tick")]
    Condensed,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Effort {
    pub way: Way,
    pub scalar: ScalarKind,
    /// A limit on the sweeps that may cut it off.
    pub sweeps: Option<u32>,
    /// Inputs of earlier ticks, whatever became of them.
    pub earlier: Vec<Vec<f64>>,
    pub inputs: Vec<f64>,
}

#[derive(Debug, Clone)]
pub struct RandomCase {
    pub number: u32,
    /// The feature of its data, in seven of ten cases.
    pub feature: Option<Feature>,
    /// Lines along which a finer mesh is cut for that.
    pub lines: Vec<Line>,
    pub truth: Yardstick,
    pub hold: Hold,
    pub kind: Kind,
    /// The scene, whose mesh is `mesh.msh` beside it.
    pub scene: String,
    pub mesh: Mesh,
    pub effort: Effort,
}

impl RandomCase {
    /// Case `number` of the run with this seed: of ten all have a feature but the first, fourth and seventh, each in turn.
    pub fn draw(seed: u64, number: u32) -> Self {
        let (tens, unit) = (number / 10, number % 10);
        let is_plain = unit != 9 && unit.is_multiple_of(3);
        let featured = 7 * tens + unit - unit.div_ceil(3);
        let features = Feature::value_variants();
        let feature = (!is_plain).then(|| features[featured as usize % features.len()]);
        let mut random = match feature {
            None => Random::of_case(seed, 3 * tens + unit / 3),
            Some(_) => Random::of_case(!seed, featured),
        };
        let truth = match (feature, random.below(10)) {
            (Some(Feature::Cancellation), _) | (None, 0..2) => Yardstick::Catalogue,
            (None, 2..5) => Yardstick::Made,
            _ => Yardstick::Finer,
        };
        let way = match random.below(20) {
            0 => Way::Direct,
            1..4 => Way::Full,
            4..7 => Way::Condensed,
            _ => Way::Sweeps,
        };
        let kind = random.pick(&[Kind::Triangles, Kind::Quads, Kind::Both]);
        let plan = plan(&mut random, truth, way, kind);
        let (posed, lines) = match (feature, truth) {
            (Some(feature), _) => feature::draw(&mut random, &plan, feature),
            (_, Yardstick::Catalogue) => (catalogue::draw(&mut random, &plan), Vec::new()),
            (_, Yardstick::Made) => (made::draw(&mut random, &plan), Vec::new()),
            (_, Yardstick::Finer) => (data::draw(&mut random, &plan, ticks(way)), Vec::new()),
        };
        let effort = effort(&mut random, way, &posed.inputs);
        let scene = posed.scene + &setting(&mut random, &effort, kind);
        let Posed { hold, mesh, .. } = posed;
        Self { number, feature, lines, truth, hold, kind, scene, mesh, effort }
    }
}

fn ticks(way: Way) -> bool {
    matches!(way, Way::Full | Way::Condensed)
}

/// Mostly small: the integrals of an exact solution take long, and so do references and fields of contact edges.
fn plan(random: &mut Random, truth: Yardstick, way: Way, kind: Kind) -> MeshPlan {
    let most = match (truth, random.below(40)) {
        (Yardstick::Finer, 0) if !ticks(way) => 5000.0,
        (_, 0..4) => 500.0,
        _ => 100.0,
    };
    let cells = random.log(2.0, most) as u32;
    let outline = match (truth, random.below(12)) {
        (Yardstick::Catalogue, _) => Outline::Whole,
        (_, 0..2) => Outline::Corner,
        (_, 2) => Outline::Apart,
        _ => Outline::Whole,
    };
    MeshPlan {
        cells,
        kind,
        outline,
        regions: random.pick(&[Regions::Halves, Regions::Layers, Regions::Scattered]),
        moved: if random.chance(0.6) { random.between(0.0, 0.25) } else { 0.0 },
        graded: random.chance(0.2),
        split: random.chance(0.4),
        map: [[1.0, 0.0], [0.0, 1.0]],
    }
}

fn effort(random: &mut Random, way: Way, defaults: &[f64]) -> Effort {
    let scalar = match way {
        Way::Direct => ScalarKind::F64,
        _ => random.pick(&[ScalarKind::F64, ScalarKind::F32]),
    };
    let sweeps = match way {
        Way::Direct => None,
        Way::Sweeps if random.chance(0.6) => None,
        Way::Full | Way::Condensed if random.chance(0.5) => None,
        _ => Some(random.log(1.0, 3000.0) as u32),
    };
    let mut values = |size: f64| -> Vec<f64> {
        defaults.iter().map(|_| f64::from(random.signed_log(1e-3 * size, size) as f32)).collect()
    };
    let mut earlier = Vec::new();
    if ticks(way) && !defaults.is_empty() {
        for exponent in [0.0, 10.0, 21.0, 37.0] {
            earlier.push(values(10_f64.powf(exponent)));
        }
    }
    let inputs = values(2.0);
    if !earlier.is_empty() {
        let kept = random.below(1 + earlier.len() as u32) as usize;
        earlier.truncate(kept);
    }
    Effort { way, scalar, sweeps, earlier, inputs }
}

/// The `[setting]` that makes commands do the same.
fn setting(random: &mut Random, effort: &Effort, kind: Kind) -> String {
    let mut text = String::from("[setting]\n");
    let _ = writeln!(text, "scalar = \"{}\"", word(&effort.scalar));
    if kind != Kind::Triangles && random.chance(0.3) {
        text += "element = \"nonparametric\"\n";
    }
    let model = match effort.way {
        Way::Full => "full",
        Way::Condensed => "condensed",
        Way::Sweeps | Way::Direct => return text,
    };
    let _ = writeln!(text, "model = \"{model}\"");
    match effort.sweeps {
        Some(sweeps) => text += &format!("sweeps = {sweeps}\n"),
        None if effort.way == Way::Full && random.chance(0.5) => text += "solver = \"factor\"\n",
        None => {}
    }
    text
}
