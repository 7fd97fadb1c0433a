//! A map of outcomes over one axis or two: a coloured square a case, with its sweeps written in.
//!
//! Colours do not tell alone: what is poor has a corner cut, what is wrong a cross.

use super::lettering::width;
use super::svg::{Anchor, Path, Svg};

/// Outcomes over columns and rows, the first row at the bottom.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OutcomeMap {
    /// A description for readers who cannot see the map.
    pub label: String,
    /// The quantity that changes from left to right.
    pub across: String,
    /// The places there.
    pub columns: Vec<String>,
    /// The quantity that changes from bottom to top; may be empty.
    pub up: String,
    /// The places there.
    pub rows: Vec<String>,
    /// The cases.
    pub squares: Vec<Square>,
}

/// A case.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Square {
    /// Column and row.
    pub at: [usize; 2],
    /// `correct`, `certified-poor`, `typed-error`, `wrong`.
    pub outcome: String,
    /// Text in the square.
    pub text: String,
    /// Text shown when the square is pointed at.
    pub words: String,
}

const WIDTH: f64 = 54.0;
const HEIGHT: f64 = 26.0;
const GAP: f64 = 1.5;
const LETTERS: f64 = 11.5;
const TOP: f64 = 20.0;

/// The picture.
pub fn outcome_map(map: &OutcomeMap) -> String {
    let labels = map.rows.iter().map(|row| width(row, LETTERS)).fold(0.0, f64::max);
    let (left, rows) = (labels + 14.0, map.rows.len() as f64);
    let top = if map.up.is_empty() { GAP } else { TOP };
    let bottom = top + rows * HEIGHT;
    let total = left + map.columns.len() as f64 * WIDTH;
    let wide = total.max(left + width(&map.across, LETTERS));
    let mut svg = Svg::new(wide + 8.0, bottom + 42.0, &map.label);
    svg.text("quantity", [0.0, 12.0], Anchor::Start, &map.up);
    for (row, label) in map.rows.iter().enumerate() {
        let y = bottom - (row as f64 + 0.5) * HEIGHT + 4.0;
        svg.text("tick", [left - 8.0, y], Anchor::End, label);
    }
    for (column, label) in map.columns.iter().enumerate() {
        let x = left + (column as f64 + 0.5) * WIDTH;
        svg.text("tick", [x, bottom + 16.0], Anchor::Middle, label);
    }
    svg.text("quantity", [left, bottom + 35.0], Anchor::Start, &map.across);
    for square in &map.squares {
        let [column, row] = square.at.map(|at| at as f64);
        draw(&mut svg, square, [left + column * WIDTH, bottom - (row + 1.0) * HEIGHT]);
    }
    svg.finish()
}

/// A key of the legend: a square without a place.
pub fn key(outcome: &str) -> String {
    let mut svg = Svg::new(WIDTH, HEIGHT, outcome);
    draw(&mut svg, &Square { outcome: outcome.to_owned(), ..Square::default() }, [0.0, 0.0]);
    svg.finish()
}

fn draw(svg: &mut Svg, square: &Square, [x, y]: [f64; 2]) {
    let [x0, y0, x1, y1] = [x + GAP, y + GAP, x + WIDTH - GAP, y + HEIGHT - GAP];
    let corners = match square.outcome.as_str() {
        "certified-poor" => vec![[x0, y0], [x1 - 9.0, y0], [x1, y0 + 9.0], [x1, y1], [x0, y1]],
        _ => vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]],
    };
    let class = format!("outcome {}", square.outcome);
    svg.explained(&class, &Path::around(&corners), &square.words);
    if square.outcome == "wrong" {
        let mut cross = Path::through(&[[x1 - 8.0, y0 + 2.0], [x1 - 2.0, y0 + 8.0]]);
        cross.line(&[[x1 - 8.0, y0 + 8.0], [x1 - 2.0, y0 + 2.0]]);
        svg.path("outcome-cross", &cross);
    }
    if !square.text.is_empty() {
        let middle = [0.5 * (x0 + x1), 0.5 * (y0 + y1) + 4.0];
        svg.text("outcome-text", middle, Anchor::Middle, &square.text);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_a_case_with_its_words() {
        let square = |at, outcome: &str| Square {
            at,
            outcome: outcome.to_owned(),
            text: "1.2k".to_owned(),
            words: "k < 1 & more".to_owned(),
        };
        let map = OutcomeMap {
            columns: vec!["1".to_owned(), "10³".to_owned()],
            rows: vec!["f64".to_owned(), "f32".to_owned()],
            squares: vec![
                square([0, 0], "correct"),
                square([1, 1], "wrong"),
                square([0, 1], "certified-poor"),
            ],
            ..OutcomeMap::default()
        };
        let picture = outcome_map(&map);
        assert_eq!(picture.matches("class=\"outcome ").count(), 3);
        assert_eq!(picture.matches("<title>k &lt; 1 &amp; more</title>").count(), 3);
        assert_eq!(picture.matches("outcome-cross").count(), 1);
        assert!(picture.contains(">10³</text>") && !picture.contains("NaN"));
        assert!(key("wrong").contains("outcome wrong"));
    }
}
