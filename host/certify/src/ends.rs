//! ψ and u_D at the ends of edges: the chords that a continuous s follows.

use std::collections::{BTreeMap, HashMap};

use super::energy::CellEnergy;
use signorini_problem::{Problem, Sum, rounding};
use signorini_scene::error::Result;
use signorini_scene::scene::Field;

/// Difference that rounding may leave between two expressions for the same value, relative to the range of all.
const CONTINUOUS: f64 = 1e-9;
/// Roundings of the largest number that it may be in any case.
const ROUNDINGS: f64 = 64.0;

/// Boundary data at the two ends of each edge, in the direction of the edge; the unit is that of u.
#[derive(Debug, Clone, PartialEq)]
pub struct Ends {
    /// ψ, one pair a contact edge.
    pub gap: Vec<[f64; 2]>,
    /// u_D, one pair a Dirichlet edge.
    pub given: Vec<[f64; 2]>,
}

impl Ends {
    /// Evaluates the data, inputs included, at the time of `problem`.
    ///
    /// # Errors
    /// Data that are not finite at the end of an edge.
    pub fn of(problem: &Problem) -> Result<Self> {
        let counts = problem.topology.counts;
        let pairs = |edges: std::ops::Range<usize>, field: Field| -> Result<Vec<_>> {
            let data = |edge| Sum::on_edge(problem, edge, field).map(|sum| (edge, sum));
            let pair = |(edge, sum): (usize, Sum)| {
                let [a, b] = problem.segment(edge);
                Ok([sum.finite_at(a)?, sum.finite_at(b)?])
            };
            edges.filter_map(data).map(pair).collect()
        };
        Ok(Self {
            gap: pairs(counts.free..counts.unknowns(), Field::Gap)?,
            given: pairs(counts.unknowns()..counts.edges(), Field::Value)?,
        })
    }

    /// The first vertex where u_D differs between two edges by more than rounding, with both values.
    pub fn jump(&self, problem: &Problem) -> Option<([f64; 2], [f64; 2])> {
        let mut at_vertex = HashMap::new();
        let edges = problem.topology.counts.unknowns()..problem.topology.counts.edges();
        let ends = edges.zip(&self.given).flat_map(|(edge, values)| {
            problem.ends[edge].map(|of| (edge, of)).into_iter().zip(values)
        });
        let mut range = None;
        ends.into_iter().find_map(|((edge, vertex), &value)| {
            let (other, first) = *at_vertex.entry(vertex).or_insert((edge, value));
            if value == first {
                return None;
            }
            let at = problem.mesh.vertices[vertex as usize];
            let range = *range.get_or_insert_with(|| rounding::range_of(problem));
            let slack = rounding::slack(problem, range, [other, edge], vertex);
            ((value - first).abs() > slack).then_some((at, [first, value]))
        })
    }

    /// ‖A^½∇·‖ of what s misses of these data at vertices where no value meets all: u_D differs between two Dirichlet edges, or
    /// what one edge asks from below lies above what another asks from above ([`Problem::asks`]), by rounding or in two sectors of
    /// a pinch. s takes one value between both there, which moves it by the difference at most in all cells around.
    pub fn moved(&self, problem: &Problem) -> f64 {
        let contact = (problem.topology.counts.free..).zip(&self.gap);
        of_excluded(problem, self.on_dirichlet(problem).chain(contact))
    }

    /// Largest move between Dirichlet edges alone: one term of a sum may have u_D and ψ on any side.
    pub fn moved_on_dirichlet(&self, problem: &Problem) -> f64 {
        of_excluded(problem, self.on_dirichlet(problem))
    }

    /// The Dirichlet edges with their pairs.
    fn on_dirichlet(&self, problem: &Problem) -> impl Iterator<Item = (usize, &[f64; 2])> {
        (problem.topology.counts.unknowns()..).zip(&self.given)
    }

    /// The largest modulus of all these numbers.
    pub fn size(&self) -> f64 {
        let all = self.gap.iter().chain(&self.given).flatten();
        all.fold(0.0, |most: f64, value| most.max(value.abs()))
    }

    /// max − min of all these numbers: a constant added to them changes nothing.
    pub fn range(&self) -> f64 {
        let all = || self.gap.iter().chain(&self.given).flatten().copied();
        let [low, high] = [f64::min, f64::max].map(|of| all().reduce(of).unwrap_or(0.0));
        high - low
    }

    /// The difference that rounding may leave between two expressions for one value.
    pub fn slack(&self, problem: &Problem) -> f64 {
        let rounding = ROUNDINGS * f64::EPSILON * (self.size() + problem.units.level());
        rounding.max(CONTINUOUS * self.range())
    }
}

/// ‖A^½∇·‖ of what s misses where the most that these edges ask from below lies above the least that they ask from above.
fn of_excluded<'e>(problem: &Problem, edges: impl Iterator<Item = (usize, &'e [f64; 2])>) -> f64 {
    let mut asked = BTreeMap::new();
    for (edge, pair) in edges {
        let [below, above] = problem.asks(edge);
        for (vertex, &value) in problem.ends[edge].into_iter().zip(pair) {
            let [most, least] = asked.entry(vertex).or_insert([f64::NEG_INFINITY, f64::INFINITY]);
            if below {
                *most = most.max(value);
            }
            if above {
                *least = least.min(value);
            }
        }
    }
    let excluded = asked.into_iter().filter(|(_, [most, least])| most > least);
    of_moved(problem, &excluded.map(|(vertex, [most, least])| (vertex, most - least)).collect())
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

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_problem::fixtures::{self, SMOOTH};
    use signorini_scene::mesh::structured::{Cells, grid};
    use signorini_tolerances::solve::ENDS;

    #[test]
    fn each_pair_is_the_data_at_its_edges_ends() -> Result<()> {
        let (_, problem) = fixtures::on_grid(SMOOTH, grid(4, Cells::Mixed))?;
        let ends = Ends::of(&problem)?;
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
        let ends = Ends::of(&problem)?;
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
        let error = Ends::of(&problem).expect_err("ψ is infinite at x = 0");
        assert!(error.to_string().contains("boundary.contact.gap"), "{error}");
        Ok(())
    }
}
