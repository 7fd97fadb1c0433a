//! A diagram that is wide and low, to be stacked over others along the same horizontal axis.

use super::scale::Scale;
use super::svg::{Anchor, Svg};

/// An axis that shows 0 and a little more than the range.
pub fn vertical([low, high]: [f64; 2], [top, bottom]: [f64; 2]) -> Scale {
    let [low, high] = [low.min(0.0), high.max(0.0)];
    let high = if low == high { 1.0 } else { high };
    let room = 0.06 * (high - low);
    Scale::linear([if low < 0.0 { low - room } else { 0.0 }, high + room], [bottom, top])
}

/// What a diagram shows, above its top.
pub fn heading(svg: &mut Svg, left: f64, top: f64, quantity: &str) {
    svg.text("quantity", [left, top - 8.0], Anchor::Start, quantity);
}

/// Grid lines with their values; 0 is drawn as an axis where it is in sight.
pub fn frame(
    svg: &mut Svg,
    up: &Scale,
    ticks: usize,
    [left, right]: [f64; 2],
    [top, bottom]: [f64; 2],
) {
    let visible = |y: f64| (top - 0.5..=bottom + 0.5).contains(&y);
    for (value, label) in up.ticks(ticks) {
        let y = up.at(value);
        if visible(y) {
            svg.line("grid", [left, y], [right, y]);
            svg.text("tick", [left - 8.0, y + 4.0], Anchor::End, &label);
        }
    }
    if visible(up.at(0.0)) {
        svg.line("axis", [left, up.at(0.0)], [right, up.at(0.0)]);
    }
}

/// The horizontal axis below the lowest diagram, whose lower right corner is given.
pub fn across(svg: &mut Svg, along: &Scale, [right, bottom]: [f64; 2], quantity: &str) {
    for (value, label) in along.ticks(6) {
        let x = along.at(value);
        svg.line("axis", [x, bottom], [x, bottom + 4.0]);
        svg.text("tick", [x, bottom + 18.0], Anchor::Middle, &label);
    }
    svg.text("quantity", [right, bottom + 35.0], Anchor::End, quantity);
}
