//! The entries of A in a region, enclosed, and how it is cut into parts in which they vary less.

use signorini_kernel::Tensor;
use signorini_scene::expression::Expression;
use signorini_scene::expression::enclosure::{Form, Region};
use signorini_scene::scene::{Located, Material};

use super::tensors::{scaled, tensor};

/// Part of a range that a form has to see in its coefficients.
const SEEN: f64 = 0.25;
/// A in a region, enclosed: its entries, or one function times a tensor.
pub(super) enum Enclosed {
    Entries([Form; 3]),
    Product(Form, Tensor<f64>),
}

impl Enclosed {
    /// A of a material in a region.
    pub fn new(material: &Material, region: &Region) -> Self {
        let form = |entry: &Located<Expression>| entry.value.enclose(region, 0.0);
        let [xx, xy, yy] = &material.conductivity;
        match proportions(material) {
            Some(tensor) => Self::Product(form(xx), tensor),
            None => Self::Entries([form(xx), form(xy), form(yy)]),
        }
    }

    /// The tensor of what `of` says of each form.
    pub fn tensor(&self, of: impl Fn(&Form) -> f64) -> Tensor<f64> {
        match self {
            Self::Entries(forms) => tensor(forms.each_ref().map(of)),
            Self::Product(form, tensor) => scaled(tensor, of(form)),
        }
    }

    /// Whether every value is proved to be finite.
    pub fn is_finite(&self) -> bool {
        match self {
            Self::Entries(forms) => forms.iter().all(Form::is_finite),
            Self::Product(form, _) => form.is_finite(),
        }
    }

    /// D ≥ |A − B| where the entries of A are `off` from those of B at most. What is exact is not lowered.
    pub fn distance(&self, off: impl Fn(&Form) -> f64, b: &Tensor<f64>) -> Tensor<f64> {
        let rounding = 16.0 * f64::EPSILON;
        match self {
            Self::Product(form, tensor) => match off(form) {
                0.0 => Tensor::default(),
                off => scaled(tensor, off + rounding * b.xx / tensor.xx),
            },
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

/// C of A = kC, k being the first entry, where the scene states all entries as numbers times one expression.
fn proportions(material: &Material) -> Option<Tensor<f64>> {
    let [first, xy, yy] = material.conductivity.each_ref().map(|entry| &entry.value);
    let tensor = Tensor { xx: 1.0, xy: xy.ratio(first)?, yy: yy.ratio(first)? };
    Some(tensor).filter(Tensor::is_positive_definite)
}

/// Parts of a region along a jump or a kink of A, or across the direction in which it varies most.
pub(super) fn parts(material: &Material, region: &Region) -> Vec<Region> {
    let switch = material.conductivity.iter().find_map(|of| of.value.switch(region, 0.0));
    let along = switch.and_then(|zero| region.cut(&zero));
    along.unwrap_or_else(|| region.parts_across(variations(material, region)))
}

/// How much A varies along the directions of a region: by its forms, where they say most of it, or by its slopes.
fn variations(material: &Material, region: &Region) -> [f64; 3] {
    let entries = &material.conductivity[..proportions(material).map_or(3, |_| 1)];
    let most =
        |of: &dyn Fn(&Located<Expression>) -> f64| entries.iter().map(of).fold(0.0, f64::max);
    let by_form = |of: &Located<Expression>| {
        let form = of.value.enclose(region, 0.0);
        let [_, x, y, xx, xy, yy] = form.coefficients.map(f64::abs);
        let beside = (form.coefficients[1] - form.coefficients[2]).abs();
        ([x + xx, y + yy, beside + xx + xy + yy], form.range().width())
    };
    let told = entries.iter().map(by_form).reduce(|a, b| if a.1 >= b.1 { a } else { b });
    match told {
        Some((along, width)) if along.iter().sum::<f64>() > SEEN * width => along,
        _ => region
            .directions()
            .map(|way| most(&|of| of.value.enclose_slope(region, 0.0, way)[1].range().size())),
    }
}
