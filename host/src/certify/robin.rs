//! Robin data at the points of edges: ∫_R (τ·n + h(s − u_ext))²/h is not a function of their means.

use signorini_kernel::Real;

use crate::error::Result;
use crate::problem::{Problem, Sum};
use crate::quadrature::DATA_POINTS;
use crate::scene::{Condition, Field, Scene};

/// \[h |E|, u_ext\] at the 8 Gauss points of an edge, in its direction.
pub type RobinPoints = [[f64; 2]; DATA_POINTS];

/// Evaluates the data of each record of `problem.loads.robin`, in that order, at time `time`.
///
/// # Errors
/// Data that are not finite at a point.
pub fn robin(scene: &Scene, problem: &Problem, time: f64) -> Result<Vec<RobinPoints>> {
    let records = problem.loads.robin.iter();
    let edges = records.filter_map(|record| {
        let edge = record.edge as usize;
        let boundary = problem.binding.boundary(problem.ends[edge])?;
        let Condition::Robin { coefficient, .. } = &scene.boundaries[boundary].condition else {
            return None;
        };
        let ambient = Sum::on_edge(scene, problem, edge, Field::Ambient, time)?;
        Some((edge, Sum::alone(scene, coefficient, time), ambient))
    });
    edges.map(|(edge, h, ambient)| points(problem, edge, &h, &ambient)).collect()
}

fn points(problem: &Problem, edge: usize, h: &Sum, ambient: &Sum) -> Result<RobinPoints> {
    let [a, b] = problem.segment(edge);
    let mut values = RobinPoints::default();
    for (value, &[t, _]) in values.iter_mut().zip(f64::GAUSS[DATA_POINTS - 1]) {
        let [x, y] = [0, 1].map(|k| a[k] + t * (b[k] - a[k]));
        let coefficient = h.finite(h.at(x, y), [x, y])?;
        *value = [problem.lengths[edge] * coefficient, ambient.finite(ambient.at(x, y), [x, y])?];
    }
    Ok(values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certify::fixtures::{self, SMOOTH};
    use crate::mesh::structured::{Cells, grid};

    #[test]
    fn the_points_add_up_to_the_loads() -> Result<()> {
        let (scene, problem) = fixtures::on_grid(SMOOTH, grid(4, Cells::Mixed))?;
        let data = robin(&scene, &problem, 0.0)?;
        assert_eq!(data.len(), 4);
        for (record, points) in problem.loads.robin.iter().zip(&data) {
            let rule = f64::GAUSS[DATA_POINTS - 1];
            let weighted = || points.iter().zip(rule).map(|(point, gauss)| (point, gauss[1]));
            let h: f64 = weighted().map(|([h, _], weight)| weight * h).sum();
            let both: f64 = weighted().map(|([h, u], weight)| weight * h * u).sum();
            assert!((h - record.coefficient).abs() < 1e-14, "{h} {}", record.coefficient);
            assert!((both - record.ambient).abs() < 1e-13, "{both} {}", record.ambient);
        }
        Ok(())
    }

    #[test]
    fn the_points_run_in_the_direction_of_the_edge() -> Result<()> {
        let (scene, problem) = fixtures::on_grid(SMOOTH, grid(4, Cells::Mixed))?;
        for (record, points) in problem.loads.robin.iter().zip(robin(&scene, &problem, 0.0)?) {
            let [[_, start], [_, end]] = problem.segment(record.edge as usize);
            for ([h, ambient], [t, _]) in points.into_iter().zip(f64::GAUSS[DATA_POINTS - 1]) {
                let y = start + t * (end - start);
                let outside = y + y * y - 1.0 + (3.0 * y - 6.5) / (2.0 + y);
                assert!((h - 0.25 * (2.0 + y)).abs() < 1e-15);
                assert!((ambient - outside).abs() < 1e-14);
            }
        }
        Ok(())
    }
}
