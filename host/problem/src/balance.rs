//! The loads of a part that no given u holds, datum by datum: what has to balance in it.
//!
//! ```text
//!   nothing holds the part    ∫f + ∫g = 0
//!   contact does              ∫f + ∫g + ∫q < 0 at its least flux q: the loads press u onto the gap
//!                             ∫f + ∫g + ∫limit > 0 at its limit, where it has one: contact can press back
//! ```

use signorini_kernel::mesh::components::{Part, Support};

use super::Problem;

/// Integrals over one part of the mesh.
pub(super) struct Balance {
    support: Support,
    /// The problem's unit of fluxes in that of the scene: a solver has units of its own.
    unit: f64,
    /// Each datum by its key, with contact at its least flux and at its limit.
    terms: Vec<(String, [f64; 2])>,
    total: [f64; 2],
}

impl Balance {
    /// The balance of the part that a cell belongs to; `parts` are those of all cells.
    pub fn of(problem: &Problem, parts: &[Part<f64, u32>], cell: usize) -> Self {
        let root = parts[cell].root;
        let is_own = |cell: &usize| parts[*cell].root == root;
        let (support, unit) = (parts[cell].support, problem.units.flux());
        let mut balance = Self { support, unit, terms: Vec::new(), total: [0.0; 2] };
        let cells = (0..problem.cells()).filter(is_own);
        let source: f64 = cells.map(|cell| problem.loads.of_cell(cell)).sum();
        if source != 0.0 {
            balance.add("source.f".to_owned(), [source; 2]);
        }
        let free = problem.topology.counts.free;
        let given = problem.loads.neumann.iter().map(|of| (of.edge as usize, [of.flux; 2]));
        let contact = 0..problem.topology.counts.contact;
        let contact = contact.map(|at| (free + at, problem.loads.flux_range(at).ends()));
        for (edge, fluxes) in given.chain(contact) {
            let boundary = problem.boundary_of(edge);
            if let Some(of) = boundary.filter(|_| is_own(&problem.topology.first_side(edge).0)) {
                balance.add(format!("{}.flux", of.name.key), fluxes);
            }
        }
        balance
    }

    fn add(&mut self, key: String, fluxes: [f64; 2]) {
        let fluxes = fluxes.map(|flux| self.unit * flux);
        let sum = |to: &mut [f64; 2]| (0..2).for_each(|end| to[end] += fluxes[end]);
        sum(&mut self.total);
        match self.terms.iter_mut().find(|(known, _)| *known == key) {
            Some((_, term)) => sum(term),
            None => self.terms.push((key, fluxes)),
        }
    }

    /// The end of contact's fluxes at which the loads fail: 0 at the least flux, 1 at the limit. Between both they would balance.
    fn end(&self) -> usize {
        usize::from(self.total[1].abs() < self.total[0].abs())
    }

    /// The sum and what it should be, with its terms.
    pub fn words(&self) -> String {
        let end = self.end();
        let wanted = match (self.support, end) {
            (Support::None, _) => "not 0",
            (_, 0) => "not less than 0, with contact at its least flux",
            _ => "not more than 0, with contact at its limit",
        };
        let term = |(key, fluxes): &(String, [f64; 2])| format!("{key} {}", short(fluxes[end]));
        let terms: Vec<_> = self.terms.iter().map(term).collect();
        format!("They sum to {}, {wanted}: {}", short(self.total[end]), terms.join(", "))
    }

    /// What to do about it.
    pub fn hint(&self) -> &'static str {
        match (self.support, self.end()) {
            (Support::None, _) => {
                "change a source or a flux until the sum is 0, or give a boundary of this part a value, an ambient or a gap"
            }
            (_, 0) => {
                "lower a source or a flux until the loads press u onto the gap, or give a boundary of this part a value or an ambient"
            }
            _ => "raise the limit, or give a boundary of this part a value or an ambient",
        }
    }
}

/// A number with four digits.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    match rounded.abs() {
        0.001..1e6 | 0.0 => format!("{rounded}"),
        _ => format!("{rounded:e}"),
    }
}
