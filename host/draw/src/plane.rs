//! The domain as a picture: where it lies there, colours with a bar that explains them, the mesh, the boundary by what
//! holds on it, axes.

use super::colormap::color;
use super::scale::{Scale, extent, plain};
use super::svg::{Anchor, Path, Svg};
use super::{BoundaryKind, ContactState, ScenePanel};

/// Finer meshes would cover the colours.
pub const MOST_CELLS_WITH_LINES: usize = 1200;
const MARGIN: f64 = 58.0;
const TOP: f64 = 8.0;
const BOTTOM: f64 = 30.0;
const BAR_GAP: f64 = 20.0;
const BAR: f64 = 14.0;
const BAR_LABELS: f64 = 70.0;
const WIDTH: f64 = 480.0;
const HEIGHT: f64 = 360.0;
/// No side of a picture is shorter: a long levee is stretched until one can see into it.
const SHORTEST: f64 = 120.0;

/// A picture over the domain being drawn.
pub struct Plane {
    /// Where the domain lies in it.
    pub view: View,
    /// Arrows to lie above everything else.
    pub arrows: Path,
    svg: Svg,
}

impl Plane {
    /// An empty picture of `what` of a scene; `None` when its vertices span no area.
    pub fn new(panel: &ScenePanel, what: &str) -> Option<Self> {
        let view = View::new(&panel.vertices, [MARGIN, TOP])?;
        let [width, height] = view.size();
        let total = MARGIN + width + BAR_GAP + BAR + BAR_LABELS;
        let label = format!("{}: {what}", panel.title);
        let svg = Svg::new(total, TOP + height + BOTTOM, &label);
        Some(Self { view, arrows: Path::default(), svg })
    }

    /// Fills the outlines `above` each of equally spaced levels from `low` on, each over the one before,
    /// and draws the bar of `quantity`. A range without a width has one colour.
    pub fn bands(
        &mut self,
        [low, high]: [f64; 2],
        most: u32,
        quantity: &str,
        above: impl Fn(f64) -> Vec<Vec<[f64; 2]>>,
    ) {
        let count = if low < high { most } else { 1 };
        for band in 0..count {
            let fraction = f64::from(band) / f64::from(count);
            let level = low * (1.0 - fraction) + high * fraction;
            let mut path = Path::default();
            above(level.max(low)).iter().for_each(|outline| path.polygon(outline));
            self.svg.fill(&band_color(band, count), &path);
        }
        self.bar([low, high], count, quantity);
    }

    fn bar(&mut self, [low, high]: [f64; 2], count: u32, quantity: &str) {
        let [width, height] = self.view.size();
        let (left, bottom, top) = (MARGIN + width + BAR_GAP, TOP + height, TOP);
        let (svg, right) = (&mut self.svg, left + BAR);
        for band in 0..count {
            let start = bottom + (top - bottom) * f64::from(band) / f64::from(count);
            let path = Path::around(&[[left, start], [right, start], [right, top], [left, top]]);
            svg.fill(&band_color(band, count), &path);
        }
        svg.rectangle("frame", [left, bottom], [right, top]);
        let scale = Scale::linear([low, high], [bottom, top]);
        let ticks = if low < high { scale.ticks(5) } else { vec![(low, plain(low))] };
        for (value, label) in ticks {
            let y = scale.at(value);
            svg.line("axis", [right, y], [right + 4.0, y]);
            svg.text("tick", [right + 8.0, y + 4.0], Anchor::Start, &label);
        }
        svg.text("quantity", [left, bottom + 21.0], Anchor::Start, quantity);
    }

    /// Draws the mesh (unless its cells are too many), boundary, axes and arrows, and ends the picture.
    pub fn finish(mut self, panel: &ScenePanel) -> Svg {
        if panel.cells().count() <= MOST_CELLS_WITH_LINES {
            self.svg.path("mesh", &mesh_lines(panel, &self.view));
        }
        self.boundary(panel);
        self.axes();
        self.svg.path("arrows", &self.arrows);
        self.svg
    }

    /// Draws the rest of the boundary first, so that the contact zone lies on top.
    fn boundary(&mut self, panel: &ScenePanel) {
        for kind in [BoundaryKind::Neumann, BoundaryKind::Robin, BoundaryKind::Dirichlet] {
            let edges = panel.boundary.iter().filter(|edge| edge.kind == kind);
            self.svg.path(kind.look()[0], &self.view.lines(edges.map(|edge| edge.ends)));
        }
        for state in ContactState::ALL {
            let edges = panel.contact.iter().filter(|edge| edge.state == state);
            let path = self.view.lines(edges.map(|edge| edge.ends));
            ["halo", state.look()[0]].iter().for_each(|class| self.svg.path(class, &path));
        }
    }

    /// Draws the coordinates around the domain.
    fn axes(&mut self) {
        let (svg, [x_range, y_range]) = (&mut self.svg, self.view.ranges());
        let [width, height] = self.view.size();
        let (bottom, right) = (TOP + height, MARGIN + width);
        let x = Scale::linear(x_range, [MARGIN, right]);
        for (value, label) in x.ticks(if width > 240.0 { 5 } else { 3 }) {
            svg.line("axis", [x.at(value), bottom + 6.0], [x.at(value), bottom + 10.0]);
            svg.text("tick", [x.at(value), bottom + 23.0], Anchor::Middle, &label);
        }
        let y = Scale::linear(y_range, [bottom, TOP]);
        for (value, label) in y.ticks(if height > 160.0 { 4 } else { 2 }) {
            svg.line("axis", [MARGIN - 10.0, y.at(value)], [MARGIN - 6.0, y.at(value)]);
            svg.text("tick", [MARGIN - 14.0, y.at(value) + 4.0], Anchor::End, &label);
        }
    }
}

fn band_color(band: u32, count: u32) -> String {
    color((f64::from(band) + 0.5) / f64::from(count))
}

/// The sides of all cells, each once.
pub fn mesh_lines(panel: &ScenePanel, view: &View) -> Path {
    let mut edges: Vec<[u32; 2]> = panel
        .cells()
        .flat_map(|cell| cell.iter().zip(cell.iter().cycle().skip(1)))
        .map(|(&a, &b)| [a.min(b), a.max(b)])
        .collect();
    edges.sort_unstable();
    edges.dedup();
    let at = |vertex: u32| panel.vertices.get(vertex as usize).copied();
    view.lines(edges.into_iter().filter_map(|[a, b]| Some([at(a)?, at(b)?])))
}

/// Where the plane lies in a picture, y upwards.
#[derive(Debug, Clone, Copy)]
pub struct View {
    low: [f64; 2],
    high: [f64; 2],
    /// Pixels per unit of length.
    scale: [f64; 2],
    /// The pixel of the upper left corner.
    corner: [f64; 2],
}

impl View {
    /// The view of all vertices, its upper left corner at a pixel; `None` when they span no area.
    pub fn new(vertices: &[[f64; 2]], corner: [f64; 2]) -> Option<Self> {
        let [x0, x1] = extent(vertices.iter().map(|vertex| vertex[0]))?;
        let [y0, y1] = extent(vertices.iter().map(|vertex| vertex[1]))?;
        let size = [x1 - x0, y1 - y0];
        let fit = (WIDTH / size[0]).min(HEIGHT / size[1]);
        let scale = size.map(|side| fit * stretch(SHORTEST / (side * fit)));
        let usable = |value: &f64| value.is_normal();
        (size.iter().all(usable) && scale.iter().all(usable)).then_some(Self {
            low: [x0, y0],
            high: [x1, y1],
            scale,
            corner,
        })
    }

    /// The pixel of a point.
    pub fn at(&self, point: [f64; 2]) -> [f64; 2] {
        [
            self.corner[0] + (point[0] - self.low[0]) * self.scale[0],
            self.corner[1] + (self.high[1] - point[1]) * self.scale[1],
        ]
    }

    /// Lines between such points.
    pub fn lines(&self, ends: impl Iterator<Item = [[f64; 2]; 2]>) -> Path {
        let mut path = Path::default();
        ends.for_each(|ends| path.line(&ends.map(|end| self.at(end))));
        path
    }

    /// The direction, in pixels, that a vector points to: of length 1, or 0 for no vector.
    pub fn direction(&self, vector: [f64; 2]) -> [f64; 2] {
        let largest = vector[0].abs().max(vector[1].abs());
        let unit = vector.map(|part| part / largest);
        let [x, y] = [unit[0] * self.scale[0], -unit[1] * self.scale[1]];
        let length = x.hypot(y);
        if length.is_normal() { [x / length, y / length] } else { [0.0, 0.0] }
    }

    /// The range of x and of y.
    pub fn ranges(&self) -> [[f64; 2]; 2] {
        [[self.low[0], self.high[0]], [self.low[1], self.high[1]]]
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [f64; 2] {
        std::array::from_fn(|axis| (self.high[axis] - self.low[axis]) * self.scale[axis])
    }

    /// A note to the reader where the picture is stretched.
    pub fn note(&self) -> Option<String> {
        let ratio = self.scale[1] / self.scale[0];
        let told = |axis: &str, ratio: f64| Some(format!("{axis} stretched {ratio:.0}×"));
        match ratio {
            ratio if ratio > 1.5 => told("y", ratio),
            ratio if ratio < 0.67 => told("x", 1.0 / ratio),
            _ => None,
        }
    }
}

/// The smallest round factor that is at least `wanted`, or 1.
fn stretch(wanted: f64) -> f64 {
    if wanted <= 1.0 {
        return 1.0;
    }
    let unit = 10_f64.powf(wanted.log10().floor());
    let factor = [1.0, 2.0, 5.0].into_iter().find(|factor| wanted <= factor * unit);
    unit * factor.unwrap_or(10.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plain_rectangle_keeps_its_shape() {
        let view = View::new(&[[-1.0, 0.0], [1.0, 1.0]], [10.0, 20.0]).unwrap();
        assert_eq!(view.size(), [480.0, 240.0]);
        assert_eq!(view.at([-1.0, 1.0]), [10.0, 20.0]);
        assert_eq!(view.at([1.0, 0.0]), [490.0, 260.0]);
        assert_eq!(view.direction([0.0, 3.0]), [0.0, -1.0]);
        assert_eq!(view.note(), None);
    }

    #[test]
    fn a_long_levee_is_stretched_and_says_so() {
        let view = View::new(&[[0.0, 0.0], [100.0, 5.0]], [0.0, 0.0]).unwrap();
        assert_eq!(view.size(), [480.0, 120.0]);
        assert_eq!(view.note().unwrap(), "y stretched 5×");
    }

    #[test]
    fn no_area_no_view() {
        assert!(View::new(&[], [0.0, 0.0]).is_none());
        assert!(View::new(&[[0.0, 1.0], [5.0, 1.0]], [0.0, 0.0]).is_none());
        assert!(View::new(&[[f64::NAN, f64::NAN]], [0.0, 0.0]).is_none());
        assert!(View::new(&[[-1e308, -1e308], [1e308, 1e308]], [0.0, 0.0]).is_none());
    }
}
