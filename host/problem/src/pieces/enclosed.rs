//! The entries of A in a region, enclosed, and how it is cut into parts in which they vary less.

use signorini_kernel::Tensor;
use signorini_scene::expression::Expression;
use signorini_scene::expression::enclosure::{Form, Region};
use signorini_scene::scene::{Located, Material};

use crate::tensors::{modulus_in, scaled, sum, tensor};

/// Part of a range that a form has to see in its coefficients.
const SEEN: f64 = 0.25;
/// A in a region, enclosed: its entries, or B + eC for one function e.
pub(super) enum Enclosed {
    Entries([Form; 3]),
    Line(Form, [Tensor<f64>; 2]),
}

impl Enclosed {
    /// A of a material in a region.
    pub fn new(material: &Material, region: &Region) -> Self {
        let form = |entry: &Located<Expression>| entry.value.enclose(region, 0.0);
        match line(material) {
            Some((entry, line)) => Self::Line(form(entry), line),
            None => Self::Entries(material.conductivity.each_ref().map(form)),
        }
    }

    /// The tensor whose entries `of` says, a value of each form.
    pub fn values(&self, of: impl Fn(&Form) -> f64) -> Tensor<f64> {
        match self {
            Self::Entries(_) => self.changes(of),
            Self::Line(_, [constant, _]) => sum(constant, &self.changes(of)),
        }
    }

    /// The tensor whose entries `of` says, a difference of values.
    pub fn changes(&self, of: impl Fn(&Form) -> f64) -> Tensor<f64> {
        match self {
            Self::Entries(forms) => tensor(forms.each_ref().map(of)),
            Self::Line(form, [_, slope]) => scaled(slope, of(form)),
        }
    }

    /// Whether every value is proved to be finite.
    pub fn is_finite(&self) -> bool {
        match self {
            Self::Entries(forms) => forms.iter().all(Form::is_finite),
            Self::Line(form, _) => form.is_finite(),
        }
    }

    /// D ≥ |A − B| where the entries of A are `off` from those of B at most. What is exact is not lowered.
    pub fn distance(&self, off: impl Fn(&Form) -> f64, b: &Tensor<f64>) -> Tensor<f64> {
        let rounding = 16.0 * f64::EPSILON;
        match self {
            Self::Line(form, [constant, slope]) => {
                let off = off(form);
                let of_form = if off == 0.0 { Tensor::default() } else { *b };
                let terms = sum(&of_form, &modulus_in(b, constant));
                sum(&scaled(&modulus_in(b, slope), off), &scaled(&terms, rounding))
            }
            Self::Entries(forms) => {
                let off @ [xx, xy, yy] = forms.each_ref().map(off);
                if off == [0.0; 3] {
                    return Tensor::default();
                }
                // ±2ab ≤ ra² + b²/r
                let ratio = (b.xx / b.yy).sqrt();
                let [xx, yy] =
                    [xx + xy * ratio + rounding * b.xx, yy + xy / ratio + rounding * b.yy];
                Tensor { xx, xy: 0.0, yy }
            }
        }
    }
}

/// B and C of A = B + eC, e being the first entry that varies, where the scene states all entries as numbers and numbers times one
/// product.
fn line(material: &Material) -> Option<(&Located<Expression>, [Tensor<f64>; 2])> {
    let entries = &material.conductivity;
    let first = entries.iter().find(|entry| entry.value.is_constant().is_none())?;
    let [xx, xy, yy] = entries.each_ref().map(|entry| entry.value.linear_in(&first.value));
    let both = [xx?, xy?, yy?];
    Some((first, [0, 1].map(|k| tensor(both.map(|of| of[k])))))
}

/// Parts of a region along a jump or a kink of A, or across the direction in which it varies most.
pub(super) fn parts(material: &Material, region: &Region) -> Vec<Region> {
    let switch = material.conductivity.iter().find_map(|of| of.value.switch(region, 0.0));
    let along = switch.and_then(|zero| region.cut(&zero));
    along.unwrap_or_else(|| region.parts_across(variations(material, region)))
}

/// How much A varies along the directions of a region: by its forms, where they say most of it, or by its slopes.
fn variations(material: &Material, region: &Region) -> [f64; 3] {
    let entries: Vec<_> = match line(material) {
        Some((entry, _)) => vec![entry],
        None => material.conductivity.iter().collect(),
    };
    let most = |of: &dyn Fn(&Located<Expression>) -> f64| {
        entries.iter().map(|at| of(at)).fold(0.0, f64::max)
    };
    let by_form = |of: &Located<Expression>| {
        let form = of.value.enclose(region, 0.0);
        let [_, x, y, xx, xy, yy] = form.coefficients.map(f64::abs);
        let beside = (form.coefficients[1] - form.coefficients[2]).abs();
        ([x + xx, y + yy, beside + xx + xy + yy], form.range().width())
    };
    let told = entries.iter().map(|at| by_form(at)).reduce(|a, b| if a.1 >= b.1 { a } else { b });
    match told {
        Some((along, width)) if along.iter().sum::<f64>() > SEEN * width => along,
        _ => region
            .directions()
            .map(|way| most(&|of| of.value.enclose_slope(region, 0.0, way)[1].range().size())),
    }
}
