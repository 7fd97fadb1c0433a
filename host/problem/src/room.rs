//! Room that inputs leave in the ranges of contact fluxes: hi − lo as forms of the inputs, the same ones for every model of a scene.

use signorini_kernel::flux_range;

/// Parts of its terms by which two forms may differ that are the same but for the rounding of means.
const SAME: f64 = 1e-12;

/// hi − lo per unit of length, of one contact edge or of several; see [`flux_range::Room`].
#[derive(Debug, Clone, PartialEq)]
pub struct Room {
    /// The constant first.
    pub terms: Vec<f64>,
    /// |lo₀| + |hi₀|
    pub size: f64,
}

impl Room {
    /// Room in the kernel's form.
    pub fn view(&self) -> flux_range::Room<'_, f64> {
        flux_range::Room { terms: &self.terms, size: self.size }
    }

    fn is(&self, other: &Self) -> bool {
        let size = self.terms.iter().fold(self.size, |sum, term| sum + term.abs());
        let near = |a: f64, b: f64| (a - b).abs() <= SAME * size;
        near(self.size, other.size)
            && self.terms.iter().zip(&other.terms).all(|(&a, &b)| near(a, b))
    }
}

/// The forms of all contact edges with two finite ends one of which an input moves; `terms` are ∫lo and ∫(hi − lo) of each
/// edge, of what the scene states and then of a unit of each input, `lengths` those of the edges.
pub fn rooms(lengths: &[f64], terms: &[[&[f64]; 2]]) -> Vec<Room> {
    let mut all: Vec<Room> = Vec::new();
    let Some([least, _]) = terms.first() else { return all };
    for (at, length) in lengths.iter().enumerate() {
        let of_edge = |[_, spans]: &[&[f64]; 2]| spans.get(at).map(|span| span / length);
        let Some(terms) = terms.iter().map(of_edge).collect::<Option<Vec<f64>>>() else { break };
        let is_moved = terms.iter().skip(1).any(|&term| term != 0.0);
        if !terms[0].is_finite() || !is_moved {
            continue;
        }
        let least = least.get(at).map_or(0.0, |least| least / length);
        let room = Room { size: least.abs() + (least + terms[0]).abs(), terms };
        if !all.iter().any(|other| other.is(&room)) {
            all.push(room);
        }
    }
    all
}
