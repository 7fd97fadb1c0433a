//! Transfer edges whose points do not see h, in the bound: what the kernel makes of them is said at
//! [`signorini_bound::certificate::TransferForms`].

use signorini_problem::Problem;
use signorini_problem::scalar::Scalar;
use signorini_problem::triangular::{norm, triangular};
use signorini_scene::error::Result;

use super::transfer_points::{EdgePoint, unseen};

/// Part of ∫1/H⁻ that the 8 points of a part miss: η⁸ of a parabola that varies by η = 0.05.
const MISSED_OF_COMPLIANCE: f64 = 1e-10;

/// Transfer laws whose points do not see h, as the kernel has them.
#[derive(Debug, Clone, Default)]
pub struct Forms<R> {
    /// Which laws, in their order.
    pub laws: Vec<u32>,
    /// The factors of each.
    pub factors: Vec<R>,
    /// An edge along which h is not proved to be positive: it has no form.
    pub vanishing: Option<usize>,
}

impl Forms<f64> {
    /// The forms for a u_ext that is the sum of these terms, the first one as it is and each other one times an input.
    ///
    /// # Errors
    /// Data that are not finite.
    pub fn new(terms: &[&Problem]) -> Result<Self> {
        let mut forms = Self::default();
        let laws = terms.first().map_or(&[][..], |problem| &problem.loads.robin);
        for (law, record) in laws.iter().enumerate() {
            let edge = record.edge as usize;
            let points = terms.iter().map(|term| unseen(term, edge)).collect::<Result<Vec<_>>>()?;
            let Some(points) = points.into_iter().collect::<Option<Vec<_>>>() else { continue };
            if points[0].iter().all(|at| at.between[0] > 0.0) {
                forms.laws.push(law as u32);
                forms.factors.extend(factors(&points));
            } else {
                forms.vanishing = forms.vanishing.or(Some(edge));
            }
        }
        Ok(forms)
    }

    /// These forms in another scalar.
    pub fn narrowed<R: Scalar>(&self) -> Forms<R> {
        let factors = self.factors.iter().map(|&x| R::narrow(x)).collect();
        Forms { laws: self.laws.clone(), factors, vanishing: self.vanishing }
    }
}

/// Both factors of an edge, from its points for each term.
fn factors(terms: &[Vec<EdgePoint>]) -> Vec<f64> {
    let points = &terms[0];
    let column = |weight: fn(&EdgePoint) -> f64, value: &dyn Fn(usize) -> f64| -> Vec<f64> {
        let all = points.iter().enumerate();
        all.map(|(place, at)| (at.weight * weight(at)).sqrt() * value(place)).collect()
    };
    let of_s = |weight| {
        let t = |place: usize| points[place].t;
        let own = [
            column(weight, &|at| 1.0 - t(at)),
            column(weight, &t),
            column(weight, &|at| 4.0 * t(at) * (1.0 - t(at))),
        ];
        let outside = terms.iter().map(move |term| column(weight, &|at| term[at].ambient));
        own.into_iter().chain(outside).collect::<Vec<_>>()
    };
    let low: fn(&EdgePoint) -> f64 = |at| at.between[0];
    let compliance = column(low, &|at| 1.0 / points[at].between[0]);
    let mut below: Vec<_> = std::iter::once(compliance).chain(of_s(low)).collect();
    // What points miss of ∫1/H⁻.
    let missed = MISSED_OF_COMPLIANCE.sqrt() * norm(&below[0]);
    below.iter_mut().for_each(|column| column.push(0.0));
    below[0].extend([missed]);
    [below, of_s(EdgePoint::above)].into_iter().flat_map(packed).collect()
}

/// The triangular factor of these columns by rows, each from its diagonal on.
fn packed(columns: Vec<Vec<f64>>) -> Vec<f64> {
    let width = columns.len();
    let mut rows = triangular(columns).into_iter().peekable();
    let of = |first: usize| {
        let row = rows.next_if(|row| row[first] != 0.0 && row[..first].iter().all(|&x| x == 0.0));
        row.unwrap_or_else(|| vec![0.0; width]).split_off(first)
    };
    (0..width).flat_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_problem::fixtures::{SMOOTH as SCENE, on_grid};
    use signorini_scene::mesh::structured::{Cells, grid};

    /// ∫1/H and ∫H of a step over a quarter of an edge: H is 100 on 0.004 of it and 1 elsewhere, times |E| = ¼.
    #[test]
    fn a_step_is_integrated() -> Result<()> {
        let h = "1 + 99*(0.5 + 0.5*sign(0.0005 - abs(y - 0.07)))";
        let text = SCENE.replace("coefficient = \"2+y\"", &format!("coefficient = \"{h}\""));
        let (_, problem) = on_grid(&text, grid(4, Cells::Triangles))?;
        let forms = Forms::new(&[&problem])?;
        assert_eq!((forms.laws.len(), forms.factors.len()), (1, 25));
        // Of τ = 1 alone, and of s = 1 alone.
        let square = |x: [f64; 5]| {
            let mut factors = forms.factors.iter();
            let row = |first: usize| (first..5).map(|at| factors.next().unwrap() * x[at]).sum();
            (0..5).map(row).map(|sum: f64| sum * sum).sum::<f64>()
        };
        let found = [square([1.0, 0.0, 0.0, 0.0, 0.0]), square([0.0, 1.0, 1.0, 0.0, 0.0])];
        let exact = [4.0 * (0.996 + 0.004 / 100.0), 0.25 * (0.996 + 0.4)];
        for (found, exact) in found.iter().zip(exact) {
            assert!((found / exact - 1.0).abs() < 1e-4, "{found:?} {exact:?}");
        }
        assert!(found[0] >= exact[0] && found[1] <= exact[1]);
        Ok(())
    }
}
