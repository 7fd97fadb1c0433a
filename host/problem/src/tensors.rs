//! The tensor A of a material; sums of tensors, their moduli, and their sizes as forms.

use signorini_kernel::Tensor;
use signorini_scene::scene::Material;

/// A at a point.
pub fn at(material: &Material, [x, y]: [f64; 2]) -> Tensor<f64> {
    tensor(material.conductivity.each_ref().map(|entry| entry.value.eval(x, y, 0.0)))
}

/// A where it is the same everywhere.
pub fn constant(material: &Material) -> Option<Tensor<f64>> {
    let [xx, xy, yy] = material.conductivity.each_ref().map(|entry| entry.value.is_constant());
    Some(Tensor { xx: xx?, xy: xy?, yy: yy? })
}

/// The tensor of xx, xy and yy.
pub fn tensor([xx, xy, yy]: [f64; 3]) -> Tensor<f64> {
    Tensor { xx, xy, yy }
}

/// The sum of two tensors.
pub fn sum(a: &Tensor<f64>, b: &Tensor<f64>) -> Tensor<f64> {
    Tensor { xx: a.xx + b.xx, xy: a.xy + b.xy, yy: a.yy + b.yy }
}

/// So many times a tensor.
pub fn scaled(a: &Tensor<f64>, by: f64) -> Tensor<f64> {
    Tensor { xx: by * a.xx, xy: by * a.xy, yy: by * a.yy }
}

/// |T|, with the moduli of its eigenvalues: T² + |det T| over their sum, where they have different signs.
pub fn modulus(of: &Tensor<f64>) -> Tensor<f64> {
    let Tensor { xx, xy, yy } = *of;
    let determinant = xx * yy - xy * xy;
    if determinant >= 0.0 {
        return if xx + yy < 0.0 { scaled(of, -1.0) } else { *of };
    }
    let apart = (xx - yy).hypot(2.0 * xy);
    let squares = Tensor { xx: xx * xx + xy * xy, xy: xy * (xx + yy), yy: yy * yy + xy * xy };
    let whole = Tensor { xx: squares.xx - determinant, yy: squares.yy - determinant, ..squares };
    scaled(&whole, 1.0 / apart)
}

/// The largest modulus of an eigenvalue of L⁻¹ T L⁻ᵀ, LLᵀ = `to`.
pub fn size_in(to: &Tensor<f64>, of: &Tensor<f64>) -> f64 {
    let Tensor { xx, xy, yy } = inside(&root(to), of);
    let (half, apart) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
    let size = half.abs() + apart;
    if size.is_nan() { f64::INFINITY } else { size }
}

/// L |L⁻¹ T L⁻ᵀ| Lᵀ, which is above T and −T.
pub fn modulus_in(to: &Tensor<f64>, of: &Tensor<f64>) -> Tensor<f64> {
    let l @ [first, slope, last] = root(to);
    let Tensor { xx, xy, yy } = modulus(&inside(&l, of));
    let (below, beside) = (slope * first, last * xy);
    Tensor {
        xx: first * first * xx,
        xy: first * (below * xx + beside),
        yy: below * (below * xx + 2.0 * beside) + last * last * yy,
    }
}

/// L of LLᵀ: its first entry, the one below over it, and the last.
fn root(of: &Tensor<f64>) -> [f64; 3] {
    let slope = of.xy / of.xx;
    [of.xx.sqrt(), slope, (of.yy - slope * of.xy).sqrt()]
}

/// L⁻¹ T L⁻ᵀ
fn inside([first, slope, last]: &[f64; 3], of: &Tensor<f64>) -> Tensor<f64> {
    Tensor {
        xx: of.xx / first / first,
        xy: (of.xy - slope * of.xx) / first / last,
        yy: (of.yy - 2.0 * slope * of.xy + slope * slope * of.xx) / last / last,
    }
}

/// The weighted mean of tensors.
pub fn average(weighted: impl IntoIterator<Item = (f64, Tensor<f64>)>) -> Tensor<f64> {
    let mut sum = Tensor::<f64>::default();
    let mut area = 0.0;
    for (weight, tensor) in weighted {
        sum.xx += weight * tensor.xx;
        sum.xy += weight * tensor.xy;
        sum.yy += weight * tensor.yy;
        area += weight;
    }
    Tensor { xx: sum.xx / area, xy: sum.xy / area, yy: sum.yy / area }
}
