//! ψ and u_D at the ends of edges: the chords that a continuous s follows.

use std::collections::HashMap;

use crate::error::Result;
use crate::problem::{Problem, Sum};
use crate::scene::{Field, Scene};

/// What rounding may leave between two expressions for the same value, relative to the largest.
const CONTINUOUS: f64 = 1e-9;

/// Boundary data at the two ends of each edge, in the direction of the edge; the unit is that of u.
#[derive(Debug, Clone, PartialEq)]
pub struct Ends {
    /// ψ, one pair a contact edge.
    pub gap: Vec<[f64; 2]>,
    /// u_D, one pair a Dirichlet edge.
    pub given: Vec<[f64; 2]>,
}

impl Ends {
    /// Evaluates the data, inputs included, at time `time`.
    ///
    /// # Errors
    /// Data that are not finite at the end of an edge.
    pub fn at_time(scene: &Scene, problem: &Problem, time: f64) -> Result<Self> {
        let counts = problem.topology.counts;
        let pairs = |edges: std::ops::Range<usize>, field: Field| -> Result<Vec<_>> {
            let data =
                |edge| Sum::on_edge(scene, problem, edge, field, time).map(|sum| (edge, sum));
            edges.filter_map(data).map(|(edge, sum)| pair(&sum, problem.segment(edge))).collect()
        };
        Ok(Self {
            gap: pairs(counts.free..counts.unknowns(), Field::Gap)?,
            given: pairs(counts.unknowns()..counts.edges(), Field::Value)?,
        })
    }

    /// Whether u_D is continuous where its edges meet, up to rounding: otherwise no function of finite
    /// energy has these values.
    pub fn is_continuous(&self, problem: &Problem) -> bool {
        let slack = CONTINUOUS * self.scale();
        let mut at_vertex = HashMap::new();
        let edges = problem.topology.counts.unknowns()..problem.topology.counts.edges();
        let ends = edges
            .zip(&self.given)
            .flat_map(|(edge, values)| problem.ends[edge].into_iter().zip(values.iter().copied()));
        ends.into_iter().all(|(vertex, value)| {
            let first = *at_vertex.entry(vertex).or_insert(value);
            (value - first).abs() <= slack
        })
    }

    /// The largest modulus of all these numbers.
    pub fn scale(&self) -> f64 {
        let all = self.gap.iter().chain(&self.given).flatten();
        all.fold(0.0, |most: f64, value| most.max(value.abs()))
    }
}

fn pair(sum: &Sum, segment: [[f64; 2]; 2]) -> Result<[f64; 2]> {
    let value = |[x, y]: [f64; 2]| sum.finite(sum.at(x, y), [x, y]);
    Ok([value(segment[0])?, value(segment[1])?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certify::fixtures::{self, SMOOTH};
    use crate::mesh::structured::{Cells, grid};

    #[test]
    fn each_pair_is_the_data_at_its_edges_ends() -> Result<()> {
        let (scene, problem) = fixtures::on_grid(SMOOTH, grid(4, Cells::Mixed))?;
        let ends = Ends::at_time(&scene, &problem, 0.0)?;
        let counts = problem.topology.counts;
        assert_eq!((ends.gap.len(), ends.given.len()), (counts.contact, counts.dirichlet));
        for (edge, pair) in (counts.free..).zip(&ends.gap) {
            assert_eq!(*pair, problem.segment(edge).map(|[x, _]| x.powi(3)));
        }
        for (edge, pair) in (counts.unknowns()..).zip(&ends.given) {
            let exact = problem.segment(edge).map(|[x, y]| x * x * y + y * y + x.powi(3));
            assert!((pair[0] - exact[0]).abs() + (pair[1] - exact[1]).abs() < 1e-15);
        }
        Ok(())
    }

    #[test]
    fn an_input_adds_its_pattern_at_the_ends() -> Result<()> {
        let input =
            "[input.lift]\nof = \"contact\"\nfield = \"gap\"\npattern = \"x\"\ndefault = -2.0\n";
        let (scene, problem) =
            fixtures::on_grid(&format!("{SMOOTH}{input}"), grid(2, Cells::Quads))?;
        let ends = Ends::at_time(&scene, &problem, 0.0)?;
        for (at, pair) in ends.gap.iter().enumerate() {
            let edge = problem.topology.counts.free + at;
            assert_eq!(*pair, problem.segment(edge).map(|[x, _]| x.powi(3) - 2.0 * x));
        }
        Ok(())
    }

    #[test]
    fn an_infinite_value_names_its_place_in_the_file() -> Result<()> {
        let scene = fixtures::scene(&SMOOTH.replace("gap = \"x^3\"", "gap = \"-1/abs(x)\""))?;
        let problem = Problem::new(&scene, fixtures::with_four_sides(grid(2, Cells::Triangles)))?;
        let error = Ends::at_time(&scene, &problem, 0.0).expect_err("ψ is infinite at x = 0");
        assert!(error.to_string().contains("boundary.contact.gap"), "{error}");
        Ok(())
    }
}
