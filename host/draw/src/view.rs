//! From the coordinates of a scene to the pixels of its picture.

use super::scale::extent;

const WIDTH: f64 = 480.0;
const HEIGHT: f64 = 360.0;
/// No side of a picture is shorter: a long levee is stretched until one can see into it.
const SHORTEST: f64 = 120.0;

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
