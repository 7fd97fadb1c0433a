//! Solutions solve their equations and keep the law of contact.

use super::*;
use signorini_scene::Expression;
use signorini_scene::expression::Variables;
use signorini_tolerances::lab::{CONTACT, DERIVATIVE, DERIVATIVE_SECOND, JUMP};

const ENDS: [f64; 2] = [-0.5, 1.0];
const ALL: [Solution; 13] = [
    Solution::Smooth { grazing: 0.25 },
    Solution::Punch,
    Solution::Jump(1e-3),
    Solution::Jump(1e4),
    Solution::Pressed,
    Solution::Lifted,
    Solution::Switching,
    Solution::Below,
    Solution::ThreeStates(ENDS),
    Solution::Wall { above: 2.0, ends: ENDS, contrast: 1e3 },
    Solution::Wall { above: -0.25, ends: ENDS, contrast: 1.0 },
    Solution::Wall { above: -2.0, ends: ENDS, contrast: 1.0 },
    Solution::MovingWall(ENDS),
];

fn parsed(text: &str) -> Expression {
    Expression::parse(text, Variables::SpaceTime).unwrap_or_else(|e| panic!("{text}: {e}"))
}

/// Differences of u are its gradient, and those of the flux the load.
#[test]
fn solutions_solve_their_equation() {
    let shears = [Shear::NONE, Shear { obliqueness: 0.5, anisotropy: 2.0 }];
    for (solution, shear) in ALL.into_iter().zip(shears.into_iter().cycle()) {
        let shear = if matches!(solution, Solution::Jump(_)) { Shear::NONE } else { shear };
        let Texts { u, gradient, f } = shear.texts(solution, "x", "y");
        let (u, f) = (parsed(&u), parsed(&f));
        let gradient = gradient.map(|text| parsed(&text));
        let [axx, axy, ayy] = shear.tensor();
        for [x, y, t] in [[-0.7, 0.4, 0.0], [0.3, 0.2, 1.0], [0.9, 0.6, 0.0], [-0.2, 0.9, 1.0]] {
            let step = 1e-5;
            let slope = |of: &Expression, [dx, dy]: [f64; 2]| {
                (of.eval(x + dx, y + dy, t) - of.eval(x - dx, y - dy, t)) / (2.0 * step)
            };
            let along = [[step, 0.0], [0.0, step]];
            for (gradient, along) in gradient.iter().zip(along) {
                let error = gradient.eval(x, y, t) - slope(&u, along);
                DERIVATIVE.check(format_args!("{solution:?} at {x}, {y}"), error);
            }
            let second = |at: usize, along| slope(&gradient[at], along);
            let divergence = axx * second(0, along[0])
                + axy * (second(0, along[1]) + second(1, along[0]))
                + ayy * second(1, along[1]);
            let error = divergence + f.eval(x, y, t);
            DERIVATIVE_SECOND.check(format_args!("{solution:?} at {x}, {y}"), error);
        }
    }
}

#[test]
fn contact_holds_on_the_lower_side() {
    for solution in ALL {
        let Texts { u, gradient: [_, slope], .. } = solution.texts("x", "y");
        let (u, slope) = (parsed(&u), parsed(&slope));
        for (x, t) in (-19..20).map(|k| (f64::from(k) / 20.0, f64::from(k & 1))) {
            let k = if x < 0.0 { solution.contrast() } else { 1.0 };
            let (gap, force) = (u.eval(x, 0.0, t), -k * slope.eval(x, 0.0, t));
            let what = format!("{solution:?} at {x}");
            let [least, most] = solution.ends().map(|end| k * end);
            CONTACT.check(&what, (force - least).min(0.0));
            CONTACT.check(&what, (most - force).min(0.0));
            // Above the gap the flux is at its lower end, below it at the upper one.
            for (away, end) in [(gap.max(0.0), least), (gap.min(0.0), most)] {
                // An infinite end admits nothing on its side.
                let off = if end.is_finite() { force - end } else { 1.0 };
                CONTACT.check(&what, away * off);
            }
        }
    }
}

#[test]
fn the_halves_of_a_jump_meet_whatever_its_size() {
    for power in (-12..=12).step_by(3) {
        let k = 10_f64.powi(power);
        let Texts { u, gradient: [slope, _], .. } = Solution::Jump(k).texts("x", "y");
        let (u, slope) = (parsed(&u), parsed(&slope));
        let (left, right) = (u.eval(-1e-300, 0.5, 0.0), u.eval(1e-300, 0.5, 0.0));
        JUMP.check_over(format_args!("k = {k:e}"), left - right, right.abs());
        let (left, right) = (k * slope.eval(-1e-300, 0.5, 0.0), slope.eval(1e-300, 0.5, 0.0));
        JUMP.check_over(format_args!("k = {k:e}"), left - right, right.abs());
    }
}
