//! A condensed model as numbers: matrix, loads, outputs, and the form of its error bound.

use signorini_problem::Room;

/// A condensed model, in f64.
#[derive(Debug, Clone)]
pub struct CondensedModel {
    /// n, the number of contact edges; may be 0.
    pub contact: usize,
    /// The contact edge of each unknown, counted from the first contact edge of the mesh: they follow each other
    /// along the boundary.
    pub edges: Vec<usize>,
    /// m, the number of inputs with the constant 1, which comes first.
    pub inputs: usize,
    /// Ŝ, n × n, row by row: symmetric with a unit diagonal.
    pub matrix: Vec<f64>,
    /// d_i: the opening of edge i is d_i x_i, in the unit of u.
    pub opening: Vec<f64>,
    /// ∫_E (σ·n − q) of edge i is this times r̂_i.
    pub multiplier: Vec<f64>,
    /// The m columns of B̂, n numbers each.
    pub load: Vec<Vec<f64>>,
    /// From the end of the flux's range that the load contains, its base, to the other one, in the unit of r̂: m columns of n
    /// numbers as those of `load`. At least 0 from the lower end up, less than 0 from the upper end down. An infinite one
    /// stands in the constant column, with 0 in the others. Nothing at all where every flux goes up without an end.
    pub spans: Vec<Vec<f64>>,
    /// A tick keeps x_i within these; empty where nothing was taken out of the model.
    pub limits: Vec<[f64; 2]>,
    /// The inputs' default values, the constant 1 first.
    pub defaults: Vec<f64>,
    /// The values that each input may have, the least and the largest: \[1, 1\] of the constant, and all numbers where the
    /// scene declares no range.
    pub ranges: Vec<[f64; 2]>,
    /// The outputs in the order of the scene; without any declared, contact force and length.
    pub outputs: Vec<Measure>,
    /// The error bound, or a sentence why there is none.
    pub certificate: Result<Form, String>,
    /// U, in the unit of ‖A^½∇u‖.
    pub energy_unit: f64,
    /// The unknowns of each part that nothing else holds: Ŝ is singular there.
    pub held_by_contact: Vec<Vec<usize>>,
    /// Room that inputs leave in the ranges of fluxes.
    pub rooms: Vec<Room>,
    /// Loads that the fluxes of each such part have to balance.
    pub balances: Vec<Balance>,
}

/// Sums of the loads on the mesh over a part that contact alone holds, as m factors of p.
#[derive(Debug, Clone, PartialEq)]
pub struct Balance {
    /// A cell of the part.
    pub cell: usize,
    /// With all contact fluxes at their least; empty where one has no end there.
    pub least: Vec<f64>,
    /// With all of them at their greatest; empty where one has no end there.
    pub greatest: Vec<f64>,
    /// The sizes of all terms, edge by edge.
    pub size: Vec<f64>,
}

/// How an output follows from p, x and r̂, in the columns of the model.
pub type Measure = signorini_contact::outputs::Output<Vec<f64>, f64>;

/// The factors of p, x and r̂ in an output that is a sum.
pub(super) fn sum(measure: &mut Measure) -> Option<(&mut Vec<f64>, &mut Vec<f64>, &mut [f64])> {
    match measure {
        Measure::Linear { of_inputs, of_contact } => Some((of_inputs, of_contact, &mut [])),
        Measure::Flux { of_inputs, of_contact, of_reaction } => {
            Some((of_inputs, of_contact, of_reaction))
        }
        Measure::Length { .. } | Measure::Saturated { .. } | Measure::Bound => None,
    }
}

impl CondensedModel {
    /// Leaves so many inputs, and no bound, for this reason.
    pub(super) fn keep_inputs(&mut self, inputs: usize, no_bound: &str) {
        self.load.truncate(inputs);
        self.spans.truncate(inputs);
        self.defaults.truncate(inputs);
        self.ranges.truncate(inputs);
        for (of_inputs, ..) in self.outputs.iter_mut().filter_map(sum) {
            of_inputs.truncate(inputs);
        }
        self.inputs = inputs;
        self.certificate = Err(no_bound.to_owned());
    }
}

/// The certificate: all but `vertices` and `corners` in the unit U.
#[derive(Debug, Clone)]
pub struct Form {
    /// F by columns, column j with its j + 1 entries: m columns of p, n of x, one of d a vertex.
    pub factor: Vec<f64>,
    /// Rounding in f64 that each column of F and J may hide, those of d included.
    pub lost: Vec<f64>,
    /// J by columns in the same way, ‖A^½∇_h(s − u_h)‖ = U |J(p, x, d)|; nothing where F is never less.
    pub jump: Option<Vec<f64>>,
    /// The contact vertices that are not on D.
    pub vertices: Vec<Vertex>,
    /// Cost of mending: ‖A^{−½} Σδ_i w_i‖ ≤ U stability |δ|.
    pub stability: f64,
    /// Where u_D lies above ψ beside contact.
    pub corners: Vec<Corner>,
    /// osc_j of each input alone, over U.
    pub oscillation: Vec<f64>,
    /// The unknowns of the one part that contact alone holds: what is mended there must leave through another edge of it.
    pub floating: Vec<usize>,
    /// Where s − ψ at both ends of each unknown's edge comes from: `vertices[k]` is k, corner c is the number of vertices
    /// plus c, and [`Form::NOTHING`] is 0. Nothing at all where the model has no spans.
    pub ends: Vec<[usize; 2]>,
    /// By how much the span of an edge may exceed its mean somewhere along it, in the unit of r̂, at most; 0 where it is
    /// constant along each edge.
    pub span_excess: f64,
}

impl Form {
    /// An end of an edge where s = ψ.
    pub const NOTHING: usize = usize::MAX;
}

/// A contact vertex, e = U Σ weights · x\[edges\] there.
pub type Vertex = signorini_contact::certificate::Vertex<f64, usize>;

/// A contact edge whose end is on D: it adds excess·r̂ to (gap/U)² where it is active.
#[derive(Debug, Clone, PartialEq)]
pub struct Corner {
    /// The unknown of that edge.
    pub edge: usize,
    /// (u_D − ψ)/d at that end as m factors of p.
    pub excess: Vec<f64>,
    /// Largest cost of moving u_D there by d, in the unit of ‖A^½∇u‖ where that of U is 1.
    pub energy: f64,
}
