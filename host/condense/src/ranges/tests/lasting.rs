//! Boxes for all times against trajectories, and against what steady boxes say.

use signorini_problem::fixtures::on_grid;
use signorini_scene::error::Result;
use signorini_scene::mesh::structured::{Cells, grid};
use signorini_tolerances::solve::{LAGS, LASTING_KNOWN};

use super::super::history::History;
use super::super::lags::backward;
use super::super::lasting::{Unproved, lasting};
use super::super::sides::{EdgeSide, Sides};
use super::{is_there, model, scatter};
use crate::{Memory, Settled, SteppedModel, stepped};

/// Roundings of this machine.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Between a held top and contact, with what a test adds.
pub(super) fn scene(more: &str, step: f64) -> String {
    format!(
        "
mesh = \"grid\"
material.default = {{ conductivity = \"1\", capacity = \"1\" }}
boundary.dirichlet = {{ kind = \"dirichlet\", value = \"0\" }}
boundary.left = {{ kind = \"neumann\", flux = \"0\" }}
time.step = {step}
{more}"
    )
}

/// Oblique A, which makes positive entries on triangles.
fn oblique(more: &str, step: f64) -> String {
    let own = "conductivity = \"1\"";
    scene(more, step).replace(own, "conductivity = [\"1\", \"-0.9\", \"1\"]")
}

/// A flux on one side, a source, and contact below.
const PUSHED: &str = "
boundary.right = { kind = \"neumann\", flux = \"0\" }
boundary.contact = { kind = \"contact\", gap = \"-0.1 - 0.5*x\" }
input.flux = { of = \"right\", field = \"flux\", pattern = \"1\", range = [-0.3, 0.2] }
input.heat = { of = \"source\", field = \"f\", pattern = \"1 + x\", default = -0.2, range = [-0.3, 0.1] }
";

/// A gap that moves, a top that does, and air.
const MOVING: &str = "
boundary.right = { kind = \"robin\", coefficient = \"2\", ambient = \"0\" }
boundary.contact = { kind = \"contact\", gap = \"-0.3 - 0.2*x\" }
input.depth = { of = \"contact\", field = \"gap\", pattern = \"1 + x\", range = [-0.4, 0.2] }
input.top = { of = \"dirichlet\", field = \"value\", pattern = \"1\", range = [-0.3, 0.1] }
input.air = { of = \"right\", field = \"ambient\", pattern = \"1\", range = [-0.5, 0.2] }
";

/// Fluxes with limits, one of which an input moves.
const LIMITED: &str = "
boundary.right = { kind = \"robin\", coefficient = \"5\", ambient = \"0\" }
boundary.contact = { kind = \"contact\", gap = \"0.3*x + 0.1\", flux = \"0\", limit = \"0.1\" }
input.air = { of = \"right\", field = \"ambient\", pattern = \"1\", range = [-0.6, 0.4] }
input.supply = { of = \"contact\", field = \"limit\", pattern = \"1 - x\", range = [0.0, 0.05] }
";

fn of(text: &str, cells: Cells, memory: usize) -> Result<SteppedModel> {
    let (_, problem) = on_grid(text, grid(4, cells))?;
    Ok(stepped(&problem, Some(memory))?.0)
}

pub(super) fn proved(of: &SteppedModel, memory: &Memory) -> Sides {
    lasting(of, memory, ROUNDING).expect("finite loads").expect("a box")
}

/// Openings of ticks whose inputs go from corner to corner, or anywhere, every few ticks.
pub(super) fn trajectory(of: &SteppedModel, ticks: usize, seed: u64) -> Vec<Vec<f64>> {
    let (mut random, mut past) = (scatter(seed), of.start().to_vec());
    let mut p = of.model.defaults[..of.inputs].to_vec();
    let tick = |_| {
        for (p, &[lo, hi]) in p.iter_mut().zip(&of.model.ranges).skip(1) {
            *p = match (8.0 * random()) as u32 {
                0 => lo + random() * (hi - lo),
                1 | 2 => lo,
                3 | 4 => hi,
                _ => *p,
            };
        }
        let x = of.model.solve(&[&p[..], &past].concat()).expect("a solution");
        of.advance(&mut past, &p, &x);
        x
    };
    (0..ticks).map(tick).collect()
}

/// Asserts that openings are where they are proved to be, but for `room`; the largest part of a width that was reached from below.
pub(super) fn check(sides: &Sides, ticks: &[Vec<f64>], room: f64) -> f64 {
    let of = sides.enclosure.as_ref().expect("an enclosure");
    let mut reached = 0.0_f64;
    for (at, x) in ticks.iter().flat_map(|x| x.iter().enumerate()) {
        let (lo, hi) = (of.lo[at], of.hi[at]);
        assert!(lo - room <= *x && *x <= hi + room, "{at}: {x} in {lo} to {hi}");
        assert!(is_there(sides.of[at], *x), "{at}: {:?} {x}", sides.of[at]);
        reached = reached.max((x - lo) / (hi - lo));
    }
    reached
}

/// S_k = 1, H = ½, ω = ½, C_x = ½, C_p = ½, loads p − p⁻: B = 1, −1 − ¼ and then ¼ in all, H_1 = ¼ and then ¼ in all.
fn by_hand() -> SteppedModel {
    let load = [0.0, 1.0, -1.0, 0.5, 0.5].map(|b| vec![b]).to_vec();
    let ranges = [[1.0, 1.0], [0.0, 1.0]];
    let mut model = model(vec![1.0], load, &ranges, Vec::new());
    model.ranges.resize(5, [f64::NEG_INFINITY, f64::INFINITY]);
    model.defaults = vec![1.0, 0.0, 0.0, 0.0, 0.0];
    let full = Memory {
        fading: vec![0.5],
        of_contact: vec![vec![0.5]],
        of_inputs: vec![vec![0.5]],
        begin: vec![0.0],
    };
    let (fading, of_inputs) = (full.fading.clone(), full.of_inputs.clone());
    let gaps = vec![vec![0.0]];
    SteppedModel {
        model,
        inputs: 2,
        fading,
        of_inputs,
        modes: 1,
        corrections: 0,
        evolution: None,
        gaps,
        full,
        settled: Settled::default(),
    }
}

/// N = ½ and b ≤ 1 + ¼, though every steady load is 0.
#[test]
fn an_edge_and_a_mode_are_known_on_paper() {
    let of = by_hand();
    assert_eq!(of.memory(), of.full);
    let sides = proved(&of, &of.full);
    let enclosure = sides.enclosure.as_ref().expect("an enclosure");
    LASTING_KNOWN.check("hi", enclosure.hi[0] - 2.5);
    assert_eq!((enclosure.lo[0], sides.of[0]), (0.0, EdgeSide::MayChange));
    let ticks = trajectory(&of, 300, 1);
    assert!(check(&sides, &ticks, 0.0) > 0.5);
    // Pressed by 2, it always touches: −½·hi + 2 − 1¼ is left of the reaction without hi, which is 0 then.
    let mut pressed = of;
    pressed.model.load[0][0] = -1.3;
    assert_eq!(proved(&pressed, &pressed.full).of[0], EdgeSide::Touching);
    pressed.model.load[0][0] = -1.2;
    assert_eq!(proved(&pressed, &pressed.full).of[0], EdgeSide::MayChange);
    // Pulled by 2, it is always open: (2 − 1¼)/½.
    pressed.model.load[0][0] = 2.0;
    pressed.model.defaults[3] = 4.0;
    let sides = proved(&pressed, &pressed.full);
    LASTING_KNOWN.check("lo", sides.enclosure.expect("an enclosure").lo[0] - 1.5);
    assert_eq!(sides.of[0], EdgeSide::Open);
}

/// Lags that a fraction of makes up for another, by adding up many.
#[test]
fn negative_lags_are_those_of_long_sums() {
    assert_eq!(backward(&[], &[]), 0.0);
    let known = backward(&[-1.0, 1.0], &[0.5, 0.25]);
    LASTING_KNOWN.check("a known sum", known - 2.0 / 3.0);
    assert!(backward(&[1.0, -1.0], &[0.5, 0.25]) < 1e-13);
    let mut random = scatter(3);
    for case in 0..200 {
        let count = 1 + case % 9;
        let mut fading: Vec<f64> = (0..count).map(|_| 1.0 - 0.3 * random() * random()).collect();
        fading[0] = fading[0].min(0.9997);
        fading.sort_by(|a, b| b.total_cmp(a));
        fading.iter_mut().for_each(|rho| *rho = rho.min(0.9997));
        let weights: Vec<f64> =
            fading.iter().map(|rho| (1.0 - rho) * (2.0 * random() - 1.0)).collect();
        let mut left = weights.clone();
        let mut sum = 0.0;
        for _ in 0..200_000 {
            sum += (-left.iter().sum::<f64>()).max(0.0);
            left.iter_mut().zip(&fading).for_each(|(c, rho)| *c *= rho);
        }
        let found = backward(&weights, &fading);
        assert!(found >= sum - 1e-14, "{case}: {found} {sum}");
        LAGS.check(format_args!("case {case}"), found - sum);
    }
}

/// A unit of one opening or input in one tick, and what it loads later ones by: the lags themselves.
#[test]
fn sums_over_lags_are_those_of_responses() -> Result<()> {
    let of = of(&oblique(PUSHED, 0.02), Cells::Triangles, usize::MAX)?;
    let (n, m) = (of.model.contact, of.inputs);
    let (history, mut most) = (History::new(&of, &of.full), 0.0_f64);
    for at in 0..n {
        let mut past = vec![0.0; of.start().len()];
        let p = &mut vec![0.0; m][..];
        let mut sums = vec![[0.0; 2]; n];
        for tick in 0..3000 {
            let mut x = vec![0.0; n];
            x[at] = f64::from(u8::from(tick == 0));
            let load = of.model.load_of(&[&*p, &past].concat());
            for (sum, b) in sums.iter_mut().zip(load) {
                *sum = [sum[0] + b.max(0.0), sum[1] + (-b).max(0.0)];
            }
            of.advance(&mut past, p, &x);
        }
        for (row, [forward, back]) in sums.into_iter().enumerate() {
            LAGS.check("forward", history.forward[row * n + at] - forward);
            LAGS.check("backward", history.backward[row * n + at] - back);
            most = most.max(back);
        }
    }
    assert!(most > 1e-3, "{most}");
    Ok(())
}

/// The memory of all modes is what the loads of as many states say.
#[test]
fn the_full_memory_is_that_of_all_states() -> Result<()> {
    for initial in ["", "time.initial = \"0.1*x*y\"\n"] {
        let text = scene(MOVING, 0.1) + initial;
        let of = of(&text, Cells::Mixed, usize::MAX)?;
        let own = of.memory();
        assert_eq!(own.begin.iter().all(|&y| y == 0.0), initial.is_empty());
        let pairs = own.of_contact.iter().zip(&of.full.of_contact);
        let pairs = pairs.chain(own.of_inputs.iter().zip(&of.full.of_inputs));
        let pairs = pairs.flat_map(|(a, b)| a.iter().zip(b));
        for (own, full) in pairs.chain(own.begin.iter().zip(&of.full.begin)) {
            LAGS.check("an entry", own - full);
        }
        assert_eq!(own.fading, of.full.fading);
    }
    Ok(())
}

/// 300 ticks of jumps on three scenes, of exact steps and of those with few states, each within its own box.
#[test]
fn no_trajectory_leaves_its_box() -> Result<()> {
    let mut counts = [0; 4];
    for (more, step) in [(PUSHED, 0.5), (MOVING, 0.3), (LIMITED, 0.3)] {
        for memory in [usize::MAX, 12] {
            let of = of(&scene(more, step), Cells::Triangles, memory)?;
            let sides = proved(&of, &of.memory());
            assert!(sides.kept.iter().all(|&kept| kept));
            super::ALL.iter().zip(&mut counts).for_each(|(side, sum)| *sum += sides.count(*side));
            let reached = (0..4).map(|seed| check(&sides, &trajectory(&of, 300, seed), 1e-12));
            let reached = reached.fold(0.0, f64::max);
            assert!(reached > 0.5, "{more}: {reached}");
        }
    }
    assert!(counts.iter().all(|&count| count > 0), "{counts:?}");
    Ok(())
}

/// A start outside of the box is told, as is a step that is too short, and an input without a range.
#[test]
fn what_is_not_proved_is_told() -> Result<()> {
    let why = |text: &str, cells| -> Result<Option<Unproved>> {
        let of = of(text, cells, 4)?;
        Ok(lasting(&of, &of.full, ROUNDING).expect("finite loads").err())
    };
    let cold = scene(PUSHED, 0.5) + "time.initial = \"5*(1 - y)\"\n";
    assert_eq!(why(&cold, Cells::Triangles)?, Some(Unproved::Start));
    let warm = scene(PUSHED, 0.5) + "time.initial = \"0.01*(1 - y)\"\n";
    assert_eq!(why(&warm, Cells::Triangles)?, None);
    let limited = Some(Unproved::IndefiniteWithLimits);
    assert_eq!(why(&oblique(PUSHED, 0.03), Cells::Triangles)?, Some(Unproved::Indefinite));
    assert_eq!(why(&oblique(LIMITED, 0.3), Cells::Triangles)?, limited);
    let free = scene(&PUSHED.replace(", range = [-0.3, 0.2]", ""), 0.5);
    assert_eq!(why(&free, Cells::Triangles)?, Some(Unproved::NoRange));
    Ok(())
}
