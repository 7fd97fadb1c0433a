//! Polynomials in x and y: solutions from which all data can be derived exactly.

use std::collections::BTreeMap;

use crate::random::Random;

/// Coefficients by the exponents of x and y.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polynomial(BTreeMap<[u32; 2], f64>);

impl Polynomial {
    /// The sum of these terms.
    pub fn new(terms: impl IntoIterator<Item = ([u32; 2], f64)>) -> Self {
        let mut sum = Self::default();
        terms.into_iter().for_each(|(exponents, factor)| sum.add(exponents, factor));
        sum
    }

    /// Every term up to `degree`, coefficients of at most `size`.
    pub fn random(random: &mut Random, degree: u32, size: f64) -> Self {
        let powers = (0..=degree).flat_map(|i| (0..=degree - i).map(move |j| [i, j]));
        Self::new(powers.map(|exponents| (exponents, random.between(-size, size))))
    }

    fn add(&mut self, exponents: [u32; 2], factor: f64) {
        *self.0.entry(exponents).or_default() += factor;
    }

    fn terms(&self) -> impl Iterator<Item = ([u32; 2], f64)> {
        self.0.iter().map(|(&exponents, &factor)| (exponents, factor))
    }

    /// Their sum.
    pub fn plus(&self, other: &Self) -> Self {
        Self::new(self.terms().chain(other.terms()))
    }

    /// Their product.
    pub fn times(&self, other: &Self) -> Self {
        let pairs = self.terms().flat_map(|a| other.terms().map(move |b| (a, b)));
        Self::new(pairs.map(|(([i, j], a), ([k, l], b))| ([i + k, j + l], a * b)))
    }

    /// A multiple.
    pub fn scaled(&self, factor: f64) -> Self {
        Self::new(self.terms().map(|(exponents, term)| (exponents, factor * term)))
    }

    /// ∂/∂x and ∂/∂y.
    pub fn gradient(&self) -> [Self; 2] {
        [0, 1].map(|k| {
            let lowered = self.terms().filter(|(exponents, _)| exponents[k] > 0);
            Self::new(lowered.map(|(mut exponents, factor)| {
                let factor = factor * f64::from(exponents[k]);
                exponents[k] -= 1;
                (exponents, factor)
            }))
        })
    }

    /// ∂²/∂x² + ∂²/∂y²
    pub fn laplacian(&self) -> Self {
        let [[xx, _], [_, yy]] = self.gradient().map(|slope| slope.gradient());
        xx.plus(&yy)
    }

    /// An expression of the scene format in X and Y, whatever these stand for.
    pub fn text(&self) -> String {
        let power = |of: &str, exponent: u32| match exponent {
            0 => String::new(),
            1 => format!("*{of}"),
            _ => format!("*{of}^{exponent}"),
        };
        let term = |([i, j], factor): ([u32; 2], f64)| {
            format!("({factor}){}{}", power("X", i), power("Y", j))
        };
        let terms: Vec<_> = self.terms().map(term).collect();
        if terms.is_empty() { "0".to_owned() } else { terms.join(" + ") }
    }
}

#[cfg(test)]
mod tests {
    use super::Polynomial;

    #[test]
    fn derivatives_of_a_product() {
        // (x² + y)(x − 3y²) = x³ − 3x²y² + xy − 3y³
        let product = Polynomial::new([([2, 0], 1.0), ([0, 1], 1.0)])
            .times(&Polynomial::new([([1, 0], 1.0), ([0, 2], -3.0)]));
        let [along_x, along_y] = product.gradient();
        assert_eq!(along_x, Polynomial::new([([2, 0], 3.0), ([1, 2], -6.0), ([0, 1], 1.0)]));
        assert_eq!(along_y, Polynomial::new([([2, 1], -6.0), ([1, 0], 1.0), ([0, 2], -9.0)]));
        let expected =
            Polynomial::new([([1, 0], 6.0), ([0, 2], -6.0), ([2, 0], -6.0), ([0, 1], -18.0)]);
        assert_eq!(product.laplacian(), expected);
        assert_eq!(Polynomial::new([([1, 2], -0.5)]).text(), "(-0.5)*X*Y^2");
    }
}
