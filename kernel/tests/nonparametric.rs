//! The nonparametric quad against what defines it, and against the parametric one on parallelograms.

use signorini_kernel::element::{QuadElement, crouzeix_raviart, nonparametric, rannacher_turek};
use signorini_kernel::mesh::Mesh;
use signorini_kernel::stiffness::{Coefficient, fill_with};
use signorini_kernel::{Error, Real, Tensor};
use signorini_tolerances::kernel::{BASIS, GRADIENT, LINEAR, LINEAR_FLUX, STIFFNESS};

type Quad = [[f64; 2]; 4];

const A: Tensor<f64> = Tensor { xx: 3.0, xy: -0.7, yy: 0.4 };

/// A kite, trapezoids either way, the moved square of a grid, nearly a triangle.
const QUADS: [Quad; 6] = [
    [[0.0, -1.0], [1.0, 0.5], [0.0, 1.0], [-1.0, 0.5]],
    [[0.0, -0.25], [1.0, 0.25], [1.0, 0.75], [0.0, 1.25]],
    [[0.0, 0.0], [3.0, 0.0], [1.0, 1.0], [0.5, 1.0]],
    [[0.1, -0.2], [1.2, 0.15], [0.9, 1.1], [-0.1, 0.8]],
    [[0.0, 0.0], [1.0, 0.0], [0.501, 0.501], [0.0, 1.0]],
    [[5.0, 7.0], [5.002, 7.001], [5.003, 7.004], [4.9995, 7.002]],
];

const PARALLELOGRAMS: [Quad; 3] = [
    [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
    [[0.0, 0.0], [4.0, 0.5], [4.0, 1.0], [0.0, 0.5]],
    [[1.0, 2.0], [1.5, -0.25], [2.75, -0.5], [2.25, 1.75]],
];

/// The reference coordinates of t ∈ \[0, 1\] along each side.
fn along(t: f64) -> [[f64; 2]; 4] {
    [[t, 0.0], [1.0, t], [1.0 - t, 1.0], [0.0, 1.0 - t]]
}

fn size(k: &[f64; 6]) -> f64 {
    k.iter().fold(0.0, |most, entry| entry.abs().max(most))
}

#[test]
fn a_basis_function_has_mean_1_over_its_side_and_0_over_the_others() {
    for quad in QUADS {
        let axes = nonparametric::axes(quad);
        for side in 0..4 {
            let mut means = [0.0; 4];
            for &[t, weight] in f64::GAUSS[2] {
                let values = axes.basis(along(t)[side]);
                (0..4).for_each(|i| means[i] += weight * values[i]);
            }
            for (i, mean) in means.into_iter().enumerate() {
                let expected = f64::from(u8::from(i == side));
                BASIS.check(format_args!("{quad:?}: φ_{i} on {side}"), mean - expected);
            }
        }
    }
}

/// u = 2 − 3x + 5y: its value, its gradient and the fluxes of A∇u, on any quad.
#[test]
fn linear_functions_are_exact() {
    let u = |[x, y]: [f64; 2]| 2.0 - 3.0 * x + 5.0 * y;
    let flux = [5.0 * A.xy - 3.0 * A.xx, 5.0 * A.yy - 3.0 * A.xy];
    for quad in QUADS.into_iter().chain(PARALLELOGRAMS) {
        let axes = nonparametric::axes(quad);
        let means: [f64; 4] = std::array::from_fn(|i| 0.5 * (u(quad[i]) + u(quad[(i + 1) % 4])));
        let at_vertices = nonparametric::at_vertices(axes.distortion(), &means);
        (0..4).for_each(|i| LINEAR.check(format_args!("{quad:?}"), at_vertices[i] - u(quad[i])));
        for reference in [[0.0, 0.0], [0.3, 0.9], [1.0, 0.5]] {
            let place = rannacher_turek::place(quad, reference);
            let values = axes.basis(reference);
            let value: f64 = values.iter().zip(means).map(|(v, mean)| v * mean).sum();
            LINEAR.check(format_args!("{quad:?}"), value - u(place.x));
            let gradient = axes.gradient(reference, means);
            let off = (gradient.x + 3.0).abs().max((gradient.y - 5.0).abs());
            GRADIENT.check(format_args!("{quad:?}: {gradient}"), off);
        }
        let k = nonparametric::stiffness(quad, f64::GAUSS[1], |_, _| A);
        let out = rannacher_turek::product(&k, &means);
        for (i, out) in out.into_iter().enumerate() {
            let ([ax, ay], [bx, by]) = (quad[i], quad[(i + 1) % 4]);
            let expected = flux[0] * (by - ay) + flux[1] * (ax - bx);
            LINEAR_FLUX.check_over(format_args!("{quad:?}"), out - expected, size(&k));
        }
    }
}

/// The parametric element fails where this one does not: what the test above is worth.
#[test]
fn the_parametric_element_is_not_exact_on_trapezoids() {
    let [_, trapezoid, ..] = QUADS;
    let means = std::array::from_fn(|i| 0.5 * (trapezoid[i][1] + trapezoid[(i + 1) % 4][1]));
    let gradient = QuadElement::Parametric.gradient(trapezoid, [0.0, 0.5], means);
    assert!((gradient.y - 1.0).abs() > 0.1, "y has the gradient {gradient}");
}

#[test]
fn two_points_a_direction_are_exact_where_a_is_constant() {
    for quad in QUADS {
        let [few, many] = [1, 7].map(|n| nonparametric::stiffness(quad, f64::GAUSS[n], |_, _| A));
        let apart = few.iter().zip(many).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        STIFFNESS.check_over(format_args!("{quad:?}"), apart, size(&many));
    }
}

/// K v·v = ∫|A^½∇v|²: the matrix belongs to the gradients.
#[test]
fn the_matrix_is_the_energy_of_the_gradients() {
    let v = [0.3, -1.0, 2.0, 0.7];
    for quad in QUADS {
        let axes = nonparametric::axes(quad);
        let k = nonparametric::stiffness(quad, f64::GAUSS[1], |_, _| A);
        let product = rannacher_turek::product(&k, &v);
        let form: f64 = product.iter().zip(v).map(|(kv, v)| kv * v).sum();
        let mut energy = 0.0;
        for &[y, weight_y] in f64::GAUSS[3] {
            for &[x, weight_x] in f64::GAUSS[3] {
                let gradient = axes.gradient([x, y], v);
                let element = rannacher_turek::place(quad, [x, y]).determinant;
                energy += weight_x * weight_y * element * A.apply(gradient).dot(&gradient);
            }
        }
        STIFFNESS.check_relative(format_args!("{quad:?}"), form, energy);
    }
}

#[test]
fn both_elements_are_the_same_on_parallelograms() {
    let means = [0.3, -1.0, 2.0, 0.7];
    for quad in PARALLELOGRAMS {
        let [one, other] = [QuadElement::Parametric, QuadElement::Nonparametric];
        let [k, same] = [one, other].map(|e| e.stiffness(quad, f64::GAUSS[1], |_, _| A));
        let apart = k.iter().zip(same).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        STIFFNESS.check_over(format_args!("{quad:?}"), apart, size(&k));
        for reference in [[0.0, 0.0], [0.3, 0.9], [1.0, 0.5]] {
            let [values, same] = [one, other].map(|e| e.basis(quad, reference));
            BASIS.check_each(format_args!("{quad:?}"), &values, &same);
            let [slope, same] = [one, other].map(|e| e.gradient(quad, reference, means));
            BASIS.check_over(format_args!("{quad:?}"), (slope - same).norm(), slope.norm());
        }
        let distortion = nonparametric::axes(quad).distortion();
        let values = nonparametric::at_vertices(distortion, &means);
        let same = rannacher_turek::at_vertices(&means);
        BASIS.check_each(format_args!("{quad:?}, at vertices"), &values, &same);
    }
}

/// The pass over a mesh gives each quad its matrix, and triangles theirs.
#[test]
fn a_mesh_is_filled_with_the_element_asked_for() -> Result<(), Error> {
    let vertices = [[0.0, -0.25], [1.0, 0.25], [1.0, 0.75], [0.0, 1.25], [2.0, 0.5]];
    let (triangles, quads) = ([[1_u16, 4, 2]], [[0_u16, 1, 2, 3]]);
    let mesh = Mesh::new(&vertices, &triangles, &quads)?;
    for element in [QuadElement::Parametric, QuadElement::Nonparametric] {
        let (mut of_triangles, mut of_quads) = ([[0.0; 3]], [[0.0; 6]]);
        let a = Coefficient::Uniform(A);
        fill_with(element, &mesh, a, 2, &mut of_triangles, &mut of_quads)?;
        assert_eq!(of_quads[0], element.stiffness(QUADS[1], f64::GAUSS[1], |_, _| A));
        let corners = [vertices[1], vertices[4], vertices[2]];
        assert_eq!(of_triangles[0], crouzeix_raviart::stiffness(corners, A));
    }
    Ok(())
}

/// Σφ = 1, so that what flows out of a cell adds up to nothing for any u.
#[test]
fn the_basis_adds_up_to_one() {
    for quad in QUADS {
        for reference in [[0.1, 0.8], [0.5, 0.5]] {
            let sum: f64 = nonparametric::axes(quad).basis(reference).iter().sum();
            BASIS.check(format_args!("{quad:?}"), sum - 1.0);
        }
    }
}
