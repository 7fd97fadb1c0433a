//! ψ and u_D at the ends of edges: the chords that a continuous s follows.

use std::collections::{BTreeMap, HashMap};

use super::energy::CellEnergy;
use signorini_problem::{Problem, Sum};
use signorini_scene::error::Result;
use signorini_scene::scene::Field;

/// Difference that rounding may leave between two expressions for the same value, relative to the largest.
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
    pub fn at_time(problem: &Problem, time: f64) -> Result<Self> {
        let counts = problem.topology.counts;
        let pairs = |edges: std::ops::Range<usize>, field: Field| -> Result<Vec<_>> {
            let data = |edge| Sum::on_edge(problem, edge, field, time).map(|sum| (edge, sum));
            edges.filter_map(data).map(|(edge, sum)| pair(&sum, problem.segment(edge))).collect()
        };
        Ok(Self {
            gap: pairs(counts.free..counts.unknowns(), Field::Gap)?,
            given: pairs(counts.unknowns()..counts.edges(), Field::Value)?,
        })
    }

    /// The first vertex where u_D differs between two edges by more than rounding, with both values.
    pub fn jump(&self, problem: &Problem) -> Option<([f64; 2], [f64; 2])> {
        let slack = CONTINUOUS * self.scale();
        let mut at_vertex = HashMap::new();
        let edges = problem.topology.counts.unknowns()..problem.topology.counts.edges();
        let ends = edges
            .zip(&self.given)
            .flat_map(|(edge, values)| problem.ends[edge].into_iter().zip(values.iter().copied()));
        ends.into_iter().find_map(|(vertex, value)| {
            let first = *at_vertex.entry(vertex).or_insert(value);
            let at = problem.mesh.vertices[vertex as usize];
            let differ = (value - first).abs() > slack;
            differ.then_some((at, [first, value]))
        })
    }

    /// ‖A^½∇·‖ of what s misses of these data at vertices where they differ by rounding: u_D between two Dirichlet edges,
    /// or u_D on a side of ψ that there is not. s takes one value there, which moves it by the difference in all cells around.
    pub fn moved(&self, problem: &Problem) -> f64 {
        let counts = problem.topology.counts;
        let mut values = self.values(problem);
        for (edge, pair) in (counts.free..).zip(&self.gap) {
            let span = problem.loads.flux_range(edge - counts.free).span().length();
            for (vertex, &psi) in problem.ends[edge].into_iter().zip(pair) {
                let Some([low, high]) = values.get_mut(&vertex) else { continue };
                // Where both ends of the flux are finite, u_D may be on either side.
                match span {
                    f64::INFINITY => *high = high.max(psi),
                    f64::NEG_INFINITY => *low = low.min(psi),
                    _ => {}
                }
            }
        }
        of_spread(problem, values)
    }

    /// Largest move of the first kind alone: one term of a sum may have u_D on any side of ψ.
    pub fn moved_on_dirichlet(&self, problem: &Problem) -> f64 {
        of_spread(problem, self.values(problem))
    }

    /// The least and the largest u_D at each vertex.
    fn values(&self, problem: &Problem) -> BTreeMap<u32, [f64; 2]> {
        let mut values = BTreeMap::<u32, [f64; 2]>::new();
        for (edge, pair) in (problem.topology.counts.unknowns()..).zip(&self.given) {
            for (vertex, &value) in problem.ends[edge].into_iter().zip(pair) {
                let [low, high] = values.entry(vertex).or_insert([value; 2]);
                (*low, *high) = (low.min(value), high.max(value));
            }
        }
        values
    }

    /// The largest modulus of all these numbers.
    pub fn scale(&self) -> f64 {
        let all = self.gap.iter().chain(&self.given).flatten();
        all.fold(0.0, |most: f64, value| most.max(value.abs()))
    }
}

/// ‖A^½∇·‖ of what s misses where values at vertices lie between these.
fn of_spread(problem: &Problem, values: BTreeMap<u32, [f64; 2]>) -> f64 {
    let spread = values.into_iter().map(|(vertex, [low, high])| (vertex, high - low));
    of_moved(problem, &spread.collect())
}

/// ‖A^½∇·‖ of the continuous function that is at most these numbers at these vertices, and 0 at the others.
pub fn of_moved(problem: &Problem, moved: &BTreeMap<u32, f64>) -> f64 {
    if moved.values().all(|&by| by == 0.0) {
        return 0.0;
    }
    let of_cell = |at: usize| {
        let here = problem.vertices_of(at).iter().filter_map(|vertex| moved.get(vertex));
        let most = here.fold(0.0_f64, |most, by| most.max(by.abs()));
        if most > 0.0 { most * CellEnergy::of(problem, at).of_vertices() } else { 0.0 }
    };
    // Of up to four vertices: (Σ|x|)² ≤ 4Σx².
    2.0 * (0..problem.cells()).map(of_cell).fold(0.0_f64, f64::hypot)
}

fn pair(sum: &Sum, segment: [[f64; 2]; 2]) -> Result<[f64; 2]> {
    let value = |[x, y]: [f64; 2]| sum.finite(sum.at(x, y), [x, y]);
    Ok([value(segment[0])?, value(segment[1])?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_problem::fixtures::{self, SMOOTH};
    use signorini_scene::mesh::structured::{Cells, grid};
    use signorini_tolerances::solve::ENDS;

    #[test]
    fn each_pair_is_the_data_at_its_edges_ends() -> Result<()> {
        let (_, problem) = fixtures::on_grid(SMOOTH, grid(4, Cells::Mixed))?;
        let ends = Ends::at_time(&problem, 0.0)?;
        let counts = problem.topology.counts;
        assert_eq!((ends.gap.len(), ends.given.len()), (counts.contact, counts.dirichlet));
        for (edge, pair) in (counts.free..).zip(&ends.gap) {
            assert_eq!(*pair, problem.segment(edge).map(|[x, _]| x.powi(3)));
        }
        for (edge, pair) in (counts.unknowns()..).zip(&ends.given) {
            let exact = problem.segment(edge).map(|[x, y]| x * x * y + y * y + x.powi(3));
            ENDS.check_each("both ends", pair, &exact);
        }
        Ok(())
    }

    #[test]
    fn an_input_adds_its_pattern_at_the_ends() -> Result<()> {
        let input =
            "[input.lift]\nof = \"contact\"\nfield = \"gap\"\npattern = \"x\"\ndefault = -2.0\n";
        let (_, problem) = fixtures::on_grid(&format!("{SMOOTH}{input}"), grid(2, Cells::Quads))?;
        let ends = Ends::at_time(&problem, 0.0)?;
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
        let error = Ends::at_time(&problem, 0.0).expect_err("ψ is infinite at x = 0");
        assert!(error.to_string().contains("boundary.contact.gap"), "{error}");
        Ok(())
    }
}
