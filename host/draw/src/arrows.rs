//! The flux as arrows on a regular grid in the picture.

use std::collections::BTreeMap;

use super::ScenePanel;
use super::plane::View;
use super::scale::extent;
use super::svg::Path;

/// Pixels from one arrow to the next.
const SPACING: f64 = 30.0;
/// The longest arrow.
const LONGEST: f64 = 0.86 * SPACING;
/// Shorter ones are not drawn: their direction could not be seen.
const SHORTEST: f64 = 3.0;

/// Arrows, and the |σ| from which on they have full length.
///
/// Their length is proportional to |σ| up to the 95th percentile of what is sampled, so that one
/// singular corner does not shrink all others to dots.
pub fn arrows(panel: &ScenePanel, view: &View) -> Option<(Path, f64)> {
    let origin = origin(view);
    let samples = samples(panel, view, origin);
    let mut sizes: Vec<f64> = samples.values().map(|flux| flux[0].hypot(flux[1])).collect();
    sizes.sort_by(f64::total_cmp);
    let full = *sizes.get(sizes.len() * 95 / 100)?;
    if !full.is_normal() {
        return None;
    }
    let mut path = Path::default();
    for (&at, &flux) in &samples {
        let length = LONGEST * (flux[0].hypot(flux[1]) / full).min(1.0);
        if length >= SHORTEST {
            let centre = sample_point(origin, at);
            path.polygon(&arrow(centre, view.direction(flux), length));
        }
    }
    Some((path, full))
}

/// The corner of the grid: whole squares of it, centred in the picture.
fn origin(view: &View) -> [f64; 2] {
    let [x_range, y_range] = view.ranges();
    let corner = view.at([x_range[0], y_range[1]]);
    let size = view.size();
    std::array::from_fn(|axis| corner[axis] + 0.5 * (size[axis] % SPACING))
}

fn sample_point(origin: [f64; 2], at: [i32; 2]) -> [f64; 2] {
    std::array::from_fn(|axis| origin[axis] + (f64::from(at[axis]) + 0.5) * SPACING)
}

/// The flux at each grid point inside a cell, by column and row.
fn samples(panel: &ScenePanel, view: &View, origin: [f64; 2]) -> BTreeMap<[i32; 2], [f64; 2]> {
    let mut samples = BTreeMap::new();
    for (cell, &flux) in panel.cells().zip(&panel.cell_flux) {
        let corners: Option<Vec<[f64; 2]>> =
            cell.iter().map(|&v| panel.vertices.get(v as usize).map(|&p| view.at(p))).collect();
        let corners = corners.unwrap_or_default();
        let mut numbers = corners.as_flattened().iter().chain(&flux);
        if numbers.all(|number| number.is_finite()) {
            for at in inside(&corners, origin) {
                samples.entry(at).or_insert(flux);
            }
        }
    }
    samples
}

/// The grid points in a convex cell.
fn inside(corners: &[[f64; 2]], origin: [f64; 2]) -> Vec<[i32; 2]> {
    let range = |axis: usize| {
        let ends = extent(corners.iter().map(|point| point[axis]));
        let [low, high] = ends.unwrap_or([f64::INFINITY, f64::NEG_INFINITY]);
        let position = |pixel: f64| (pixel - origin[axis]) / SPACING - 0.5;
        position(low).ceil() as i32..=position(high).floor() as i32
    };
    let covers = |point: [f64; 2]| {
        let sides = corners.iter().zip(corners.iter().cycle().skip(1));
        let turns = sides
            .map(|(a, b)| (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]));
        let (mut left, mut right) = (true, true);
        turns.for_each(|turn| (left, right) = (left && turn >= 0.0, right && turn <= 0.0));
        left || right
    };
    range(0)
        .flat_map(|column| range(1).map(move |row| [column, row]))
        .filter(|&at| covers(sample_point(origin, at)))
        .collect()
}

/// An arrow of a given direction and length around `centre`.
fn arrow(centre: [f64; 2], direction: [f64; 2], length: f64) -> [[f64; 2]; 7] {
    let head = (0.45 * length).min(6.5);
    let neck = 0.5 * length - head;
    let (wing, shaft) = (0.42 * head, 0.7);
    // Along and across: tail, neck, wing, tip and back.
    [
        [-0.5 * length, -shaft],
        [neck, -shaft],
        [neck, -wing.max(shaft)],
        [0.5 * length, 0.0],
        [neck, wing.max(shaft)],
        [neck, shaft],
        [-0.5 * length, shaft],
    ]
    .map(|[along, across]| {
        [
            centre[0] + along * direction[0] - across * direction[1],
            centre[1] + along * direction[1] + across * direction[0],
        ]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(flux: [f64; 2]) -> ScenePanel {
        ScenePanel {
            vertices: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
            triangles: vec![[0, 1, 2]],
            cell_flux: vec![flux],
            ..ScenePanel::default()
        }
    }

    #[test]
    fn arrows_stand_inside_the_cells() {
        let panel = triangle([2.0, 0.0]);
        let view = View::new(&panel.vertices, [0.0, 0.0]).unwrap();
        // 360 pixels a side: 12 × 12 grid points, the half of them below the diagonal.
        assert_eq!(samples(&panel, &view, origin(&view)).len(), 12 * 13 / 2);
        assert_eq!(arrows(&panel, &view).unwrap().1, 2.0);
    }

    #[test]
    fn no_flux_no_arrows() {
        for flux in [[0.0, 0.0], [f64::NAN, 1.0]] {
            let panel = triangle(flux);
            let view = View::new(&panel.vertices, [0.0, 0.0]).unwrap();
            assert!(arrows(&panel, &view).is_none());
        }
    }

    #[test]
    fn an_arrow_points_where_it_should() {
        let shape = arrow([10.0, 10.0], [0.0, -1.0], 20.0);
        assert_eq!(shape[3], [10.0, 0.0]);
    }
}
