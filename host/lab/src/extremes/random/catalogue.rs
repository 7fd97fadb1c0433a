//! Scenes with a solution of the catalogue: jumps, anisotropy, obliqueness and scales of any size.

use super::mesh::{self, MeshPlan, Regions};
use super::posed::{Hold, Posed, span};
use crate::extremes::grid::{Grid, Shape};
use crate::extremes::posed::{Hold as Side, Posed as Known, Scales};
use crate::extremes::solution::{Shear, Solution};
use signorini_problem::random::Random;
use signorini_scene::mesh::structured::Cells;

pub(super) fn draw(random: &mut Random, plan: &MeshPlan) -> Posed {
    let solution = match random.below(12) {
        0..3 => Solution::Jump(random.log(1e-10, 1e10)),
        3 => Solution::Pressed,
        4 => Solution::Lifted,
        5 => Solution::Smooth { grazing: random.pick(&[0.0, 0.25, 1.0]) },
        6..8 => Solution::Punch,
        8 => Solution::Below,
        9 => wall(random),
        _ => {
            let least = random.signed_log(1e-3, 10.0);
            Solution::ThreeStates([least, least + span(random)])
        }
    };
    posed(random, plan, solution)
}

pub(super) fn posed(random: &mut Random, plan: &MeshPlan, solution: Solution) -> Posed {
    let sides = sides(random, solution);
    // Names its sides as the random mesh does; its own mesh is not taken.
    let grid = Grid { n: 1, cells: Cells::Quads, shape: Shape::Square };
    let shear = shear(random, solution);
    let known = Known { shear, scales: scales(random), sides, ..Known::new(solution, grid) };
    let plan = MeshPlan { regions: Regions::Halves, split: false, ..*plan };
    let mesh = known.scales.placed(mesh::draw(random, &plan).mesh);
    let of = |wanted: fn(&Side) -> bool| sides.iter().any(wanted);
    let hold = match () {
        () if of(|side| *side == Side::Dirichlet) => Hold::Dirichlet,
        () if of(|side| matches!(side, Side::Robin(_))) => Hold::Robin,
        () => Hold::Contact,
    };
    Posed { scene: known.scene(), mesh, hold, inputs: Vec::new() }
}

/// A wall in any state: its ends are below, beside or above what it asks for.
fn wall(random: &mut Random) -> Solution {
    let least = random.signed_log(1e-3, 10.0);
    let ends = [least, least + span(random)];
    Solution::Wall { above: random.signed_log(1e-3, 10.0), ends, contrast: random.log(1e-10, 1e10) }
}

fn shear(random: &mut Random, solution: Solution) -> Shear {
    let is_jump = matches!(solution, Solution::Jump(_) | Solution::Wall { .. });
    if random.chance(0.5) {
        return Shear::NONE;
    }
    // Powers of two: A is stored exactly.
    let power = |random: &mut Random, most: f64| random.between(-most, most).round().exp2();
    let most = if random.chance(0.3) { 20.0 } else { 4.0 };
    let anisotropy = power(random, most);
    let oblique = !is_jump && random.chance(0.5);
    let obliqueness = if oblique { power(random, 4.0) } else { 0.0 };
    Shear { obliqueness, anisotropy }
}

fn scales(random: &mut Random) -> Scales {
    if random.chance(0.7) {
        return Scales::ONE;
    }
    let mut factor = |most: f64| random.log(1.0 / most, most);
    let most = 1e10;
    Scales { length: factor(1e4), shift: 0.0, load: factor(most), stiffness: factor(most) }
}

/// Contact below; what holds the rest is drawn.
fn sides(random: &mut Random, solution: Solution) -> [Side; 4] {
    let held = random.below(10);
    let mut side = || match (held, random.below(4)) {
        (0..6, 0..2) => Side::Dirichlet,
        (_, 0..2) if held < 8 => Side::Robin(random.log(1e-6, 1e6)),
        (_, 2) if solution == Solution::Pressed || solution == Solution::Lifted => Side::Pressed,
        _ => Side::Neumann,
    };
    [Side::Contact, side(), side(), side()]
}
