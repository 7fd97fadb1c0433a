//! Integrals of powers of the distance to a point or a line over a region, in closed form.

use super::growth::{Growth, Place};
use super::interval::Interval;
use super::polynomial::Shape;
use super::region::{Region, cross, dot, from, norm};

impl Region {
    /// ∫|f|ᵏ over the region, f as it grows.
    pub fn grown(&self, growth: &Growth, k: f64) -> Interval {
        let exponent = k * growth.exponent;
        let power = match growth.place {
            Some(Place::Point(point)) => self.around_point(point, exponent),
            Some(Place::Line(normal, offset)) => self.beside_line(normal, offset, exponent),
            None => Interval::point(self.measure()),
        };
        let slack = 1e-12;
        let end = |factor: f64, power: f64, slack: f64| {
            if power == 0.0 || factor == 0.0 { 0.0 } else { factor.powf(k) * power * (1.0 + slack) }
        };
        Interval::new(end(growth.low, power.low, -slack), end(growth.high, power.high, slack))
    }

    /// The largest distance from a place.
    pub fn farthest(&self, place: Place) -> f64 {
        let distance = |corner: &[f64; 2]| match place {
            Place::Point(point) => norm(from(point, *corner)),
            Place::Line(normal, offset) => (dot(normal, *corner) - offset).abs(),
        };
        self.corners().iter().map(distance).fold(0.0, f64::max)
    }

    /// The point of a place next to the centre.
    pub fn nearest(&self, place: Place) -> [f64; 2] {
        match place {
            Place::Point(point) => point,
            Place::Line(normal, offset) => {
                let off = dot(normal, self.centre) - offset;
                [0, 1].map(|k| self.centre[k] - off * normal[k])
            }
        }
    }

    /// The slope of an affine function with these factors of x, y and 1, and where it is 0: on a segment a point, and the slope along it.
    pub(super) fn zero(&self, [a, b, c]: [f64; 3]) -> Option<(f64, Place)> {
        let slope = norm([a, b]);
        if self.shape != Shape::Segment {
            return (slope > 0.0).then(|| (slope, Place::Line([a / slope, b / slope], -c / slope)));
        }
        let along = self.along[0];
        let rise = dot([a, b], along);
        if rise.abs() < 1e-9 * slope * norm(along) || rise == 0.0 {
            return None;
        }
        let xi = -(dot([a, b], self.centre) + c) / rise;
        Some((rise.abs() / norm(along), Place::Point(self.place([xi, 0.0]))))
    }

    /// ∫ρᵉ, ρ the distance to a point, as a sum over the triangles between the point and the sides: of each, with the angle θ there and a side
    /// from d to D away, between θ dᵉ⁺²/(e + 2) and θ Dᵉ⁺²/(e + 2).
    fn around_point(&self, point: [f64; 2], e: f64) -> Interval {
        let corners = self.corners();
        if self.shape == Shape::Segment {
            let [a, b] = [corners[0], corners[1]].map(|corner| norm(from(point, corner)));
            let length = self.measure();
            let is_inside = a.max(b) <= length * (1.0 + 1e-9);
            let power = |a: f64| a.powf(e + 1.0) / (e + 1.0);
            let sum = if is_inside { power(a) + power(b) } else { (power(a) - power(b)).abs() };
            return if e > -1.0 { Interval::point(sum) } else { infinite(is_inside) };
        }
        let sector = |at: usize| {
            let [a, b] = [at, (at + 1) % corners.len()].map(|at| from(point, corners[at]));
            let (turn, along) = (cross(a, b), from(a, b));
            if turn.abs() <= 1e-14 * norm(a) * norm(b) || norm(a) * norm(b) == 0.0 {
                return Interval::ZERO;
            }
            let foot = (-dot(a, along) / dot(along, along)).clamp(0.0, 1.0);
            let near = norm([0, 1].map(|k| a[k] + foot * along[k]));
            let power = |d: f64| d.powf(e + 2.0) / (e + 2.0);
            turn.atan2(dot(a, b)) * Interval::new(power(near), power(norm(a).max(norm(b))))
        };
        let sum = |sectors: Interval, at: usize| sectors + sector(at);
        let is_inside = (0..corners.len()).all(|at| {
            let [a, b] = [at, (at + 1) % corners.len()].map(|at| from(point, corners[at]));
            cross(a, b) >= -1e-9 * self.measure()
        });
        if e <= -2.0 {
            return infinite(is_inside);
        }
        (0..corners.len())
            .fold(Interval::ZERO, sum)
            .meet(Interval { low: 0.0, high: f64::INFINITY })
    }

    /// ∫ρᵉ, ρ the distance to a line: at most the width along it times the integral across.
    fn beside_line(&self, normal: [f64; 2], offset: f64, e: f64) -> Interval {
        let across = Interval::hull(&self.corners.map(|corner| dot(normal, corner) - offset));
        let along = Interval::hull(&self.corners.map(|corner| cross(normal, corner)));
        if e <= -1.0 {
            return infinite(across.low < 0.0 && across.high > 0.0);
        }
        let power = |d: f64| d.abs().powf(e + 1.0) / (e + 1.0);
        let is_crossed = across.holds(0.0);
        let sum = if is_crossed {
            power(across.low) + power(across.high)
        } else {
            (power(across.high) - power(across.low)).abs()
        };
        Interval { low: 0.0, high: along.width() * sum }
    }
}

/// ∞ where a pole is proved to lie in the region, else anything.
fn infinite(is_proved: bool) -> Interval {
    Interval { low: if is_proved { f64::INFINITY } else { 0.0 }, high: f64::INFINITY }
}
