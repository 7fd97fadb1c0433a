//! Pictures as SVG text, to stand inside an HTML page.
//!
//! Lengths are pixels, x to the right and y down, rounded to 1/100. Looks (colour, width, font)
//! belong to the style sheet, which the `class` of each element names; so one picture serves a
//! light page, a dark page and paper. A shape with a coordinate that is not finite is left out.

use std::fmt::Write;

use super::lettering::shortened;

/// From the side of a picture of its own to its title and to legends below.
pub const MARGIN: f64 = 18.0;
/// Size of the letters of a title: bold ones of 15 pixels are as wide.
const TITLE: f64 = 17.0;

/// The colours and measures of every page and picture.
pub const STYLE: &str = include_str!("style.css");

/// Where the text of a label lies relative to its anchor point.
#[derive(Debug, Clone, Copy)]
pub enum Anchor {
    /// The text begins there.
    Start,
    /// The text is centred there.
    Middle,
    /// The text ends there.
    End,
}

/// How a picture of its own begins: paths are lines unless they say so, and a narrow window shrinks it.
const ALONE: &str =
    "<svg fill=\"none\" font-family=\"sans-serif\" style=\"max-width:100%;height:auto\" ";

/// A picture being drawn; later shapes cover earlier ones.
#[derive(Debug)]
pub struct Svg {
    /// Width and height.
    pub size: [f64; 2],
    text: String,
}

impl Svg {
    /// An empty picture; `label` says to those who cannot see it what it shows.
    pub fn new(width: f64, height: f64, label: &str) -> Self {
        let size = [width, height];
        let (width, height) = (number(width), number(height));
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"{}\" \
             width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\">\n",
            escape(label)
        );
        Self { size, text }
    }

    /// An empty picture that stands outside of a page: on a sheet, with its looks inside, as every program reads them.
    pub fn alone(width: f64, height: f64, label: &str) -> Self {
        let mut svg = Self::new(width, height, label);
        svg.text = svg.text.replacen("<svg ", ALONE, 1);
        let _ = writeln!(svg.text, "<style><![CDATA[\n{}]]></style>", plain_looks());
        svg.rectangle("sheet", [0.0, 0.0], [width, height]);
        svg
    }

    /// A path in the look of `class`.
    pub fn path(&mut self, class: &str, path: &Path) {
        self.shape("class", class, path, "/>");
    }

    /// A path that says what it is when it is pointed at.
    pub fn explained(&mut self, class: &str, path: &Path, words: &str) {
        self.shape("class", class, path, &format!("><title>{}</title></path>", escape(words)));
    }

    /// A path filled with `color`.
    pub fn fill(&mut self, color: &str, path: &Path) {
        self.shape("fill", color, path, "/>");
    }

    fn shape(&mut self, attribute: &str, value: &str, Path(path): &Path, end: &str) {
        if !path.is_empty() {
            let _ = writeln!(self.text, "<path {attribute}=\"{value}\" d=\"{path}\"{end}");
        }
    }

    /// A line between two points.
    pub fn line(&mut self, class: &str, from: [f64; 2], to: [f64; 2]) {
        self.path(class, &Path::through(&[from, to]));
    }

    /// A rectangle given by two opposite corners.
    pub fn rectangle(&mut self, class: &str, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) {
        self.path(class, &Path::around(&[[x0, y0], [x1, y0], [x1, y1], [x0, y1]]));
    }

    /// A line of text, its baseline at `at`.
    pub fn text(&mut self, class: &str, at: [f64; 2], anchor: Anchor, text: &str) {
        self.abridged(class, at, anchor, text, text);
    }

    /// A line of text that stands for a longer one, which is shown where it is pointed at.
    pub fn abridged(&mut self, class: &str, at: [f64; 2], anchor: Anchor, text: &str, whole: &str) {
        if !at.iter().all(|value| value.is_finite()) {
            return;
        }
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let [x, y] = at.map(number);
        let title =
            if text == whole { String::new() } else { format!("<title>{}</title>", escape(whole)) };
        let text = raised(text);
        let _ = writeln!(
            self.text,
            "<text class=\"{class}\" x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{text}{title}</text>"
        );
    }

    /// The title of a picture of its own, as much of it as there is room for.
    pub fn heading(&mut self, title: &str) {
        let short = shortened(title, TITLE, self.size[0] - 2.0 * MARGIN);
        self.abridged("title", [MARGIN, 28.0], Anchor::Start, &short, title);
    }

    /// A finished picture with its upper left corner at `at`.
    pub fn nest(&mut self, at: [f64; 2], inner: Self) {
        let [x, y] = at.map(number);
        let inner = inner.finish().replacen("<svg ", "<svg overflow=\"visible\" ", 1);
        let _ = write!(self.text, "<g transform=\"translate({x} {y})\">\n{inner}</g>\n");
    }

    /// The finished element.
    pub fn finish(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }
}

/// The looks of pictures, with colours in the place of their names: hardly a program but a browser knows variables.
fn plain_looks() -> String {
    let (_, named) = STYLE.split_once(":root {").unwrap_or_default();
    let (named, _) = named.split_once('}').unwrap_or_default();
    let (_, looks) = STYLE.split_once("/* Pictures: */\n").unwrap_or_default();
    let (looks, _) = looks.split_once("/* Pages: */").unwrap_or_default();
    let lines = looks.lines().filter(|line| !line.starts_with(".legend"));
    let looks: String = lines.flat_map(|line| [line, "\n"]).collect();
    let colours =
        named.split(';').filter_map(|entry| entry.trim().strip_prefix("--")?.split_once(": "));
    colours.fold(looks, |looks, (name, colour)| {
        looks.replace(&format!("var(--{name})"), &plain(colour))
    })
}

/// A colour as older programs read it, of a fill: its last two digits of eight are an opacity.
fn plain(colour: &str) -> String {
    let opacity = colour.get(7..9).and_then(|digits| u8::from_str_radix(digits, 16).ok());
    match opacity {
        Some(of) => format!("{}; fill-opacity: {:.2}", &colour[..7], f64::from(of) / 255.0),
        None => colour.to_owned(),
    }
}

/// The outline of one shape or of many that look alike.
#[derive(Debug, Default)]
pub struct Path(String);

impl Path {
    /// An open line through the points.
    pub fn through(points: &[[f64; 2]]) -> Self {
        let mut path = Self::default();
        path.line(points);
        path
    }

    /// A closed polygon.
    pub fn around(points: &[[f64; 2]]) -> Self {
        let mut path = Self::default();
        path.polygon(points);
        path
    }

    /// Adds an open line through the points.
    pub fn line(&mut self, points: &[[f64; 2]]) {
        if points.len() < 2 || !points.as_flattened().iter().all(|value| value.is_finite()) {
            return;
        }
        for (index, point) in points.iter().enumerate() {
            let [x, y] = point.map(number);
            let _ = write!(self.0, "{}{x} {y}", if index == 0 { "M" } else { " " });
        }
    }

    /// Adds a closed polygon.
    pub fn polygon(&mut self, points: &[[f64; 2]]) {
        let before = self.0.len();
        self.line(points);
        if self.0.len() > before {
            self.0.push('Z');
        }
    }
}

/// A circle as a polygon that looks like one.
pub fn circle([x, y]: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    const CORNERS: u32 = 32;
    let angle = |corner: u32| f64::from(corner) * std::f64::consts::TAU / f64::from(CORNERS);
    let corners = (0..CORNERS).map(|corner| angle(corner).sin_cos());
    corners.map(|(sin, cos)| [x + radius * cos, y + radius * sin]).collect()
}

/// At most two decimals and none that say nothing.
fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Text of a picture, its powers of a half raised.
fn raised(text: &str) -> String {
    text.split_once("^½").map_or_else(
        || escape(text),
        |(base, rest)| {
            let (base, rest) = (escape(base), raised(rest));
            let half = "<tspan dy=\"-.4em\" font-size=\"75%\">½</tspan>";
            format!("{base}{half}<tspan dy=\".3em\">{rest}</tspan>")
        },
    )
}

/// Text in which no character can be mistaken for markup, and none is left that XML 1.0 knows not at all (its section 2.2).
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            control if control.is_control() => escaped.push(' '),
            '\u{fffe}' | '\u{ffff}' => escaped.push(' '),
            other => escaped.push(other),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_well_formed() {
        assert_eq!(escape("<a&\u{1}\u{fffe}\"'"), "&lt;a&amp;  &quot;&#39;");
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!(number(100.0), "100");
        assert_eq!(number(-0.001), "0");
        assert_eq!(number(1.2345), "1.23");
        assert_eq!(number(-2.5), "-2.5");
    }

    #[test]
    fn what_is_not_finite_is_left_out() {
        let mut svg = Svg::new(10.0, 10.0, "<test>");
        let empty = svg.text.len();
        svg.line("axis", [0.0, f64::NAN], [1.0, 1.0]);
        svg.rectangle("axis", [0.0, 0.0], [f64::INFINITY, 1.0]);
        svg.text("tick", [f64::NAN, 0.0], Anchor::Middle, "text");
        assert_eq!(svg.text.len(), empty);
        assert!(svg.finish().contains("&lt;test&gt;"));
    }

    #[test]
    fn a_polygon_is_closed_and_a_line_is_not() {
        let polygon = Path::around(&[[0.0, 0.0], [1.0, 0.0], [0.5, 1.0]]);
        let line = Path::through(&[[0.0, 0.0], [1.0, 0.0]]);
        assert_eq!((polygon.0.as_str(), line.0.as_str()), ("M0 0 1 0 0.5 1Z", "M0 0 1 0"));
    }
}
