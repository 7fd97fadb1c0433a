//! Polynomial solutions under a full tensor that varies, in contact everywhere or nowhere.

use super::Written;
use crate::polynomial::Polynomial;
use crate::random::Random;

/// The condition at the bottom.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contact {
    /// u = ψ and λ > 0.
    Closed,
    /// u > ψ and λ = 0, over a gap that is no polynomial.
    Open,
}

/// u and A.
#[derive(Clone, Debug)]
pub struct Smooth {
    /// u.
    pub u: Polynomial,
    /// a_xx, a_xy, a_yy.
    pub tensor: [Polynomial; 3],
    /// Which.
    pub contact: Contact,
    /// λ/(1 + x²) where closed.
    pub pressure: f64,
}

impl Smooth {
    /// A cubic u, linear entries of A (or constant ones), eigenvalues within a factor of 10.
    pub fn random(random: &mut Random) -> Self {
        let size = 10f64.powf(random.between(-2.0, 2.0));
        let slope = if random.below(4) == 0 { 0.0 } else { 0.25 };
        let mut entry = |constant: f64| {
            let linear = Polynomial::random(random, 1, slope);
            linear.plus(&Polynomial::new([([0, 0], constant)])).scaled(size)
        };
        // |linear| ≤ ¾ on the domain: a_xx ≥ 1.75, |a_xy| ≤ 1, a_yy ≥ 1.25.
        let tensor = [entry(2.5), entry(0.25), entry(2.0)];
        let contact = if random.below(2) == 0 { Contact::Closed } else { Contact::Open };
        let pressure = size * random.between(0.1, 2.0);
        Self { u: Polynomial::random(random, 3, 1.0), tensor, contact, pressure }
    }

    /// A∇u
    fn flux(&self) -> [Polynomial; 2] {
        let ([xx, xy, yy], [gx, gy]) = (&self.tensor, self.u.gradient());
        [xx.times(&gx).plus(&xy.times(&gy)), xy.times(&gx).plus(&yy.times(&gy))]
    }

    /// With its data.
    pub fn written(&self) -> Written {
        let [along_x, along_y] = self.flux();
        let divergence = along_x.gradient()[0].plus(&along_y.gradient()[1]);
        let pressure = Polynomial::new([([0, 0], -self.pressure), ([2, 0], -self.pressure)]);
        let downward = along_y.scaled(-1.0);
        let tensor = self.tensor.each_ref().map(Polynomial::text);
        let (gap, flux) = match self.contact {
            Contact::Closed => (self.u.text(), downward.plus(&pressure).text()),
            Contact::Open => (format!("{} - 0.3 - 0.2*sin(3*X)^2", self.u.text()), downward.text()),
        };
        Written {
            u: self.u.text(),
            gradient: self.u.gradient().each_ref().map(Polynomial::text),
            source: divergence.scaled(-1.0).text(),
            regions: [tensor.clone(), tensor.clone()],
            tensor,
            gap,
            flux,
        }
    }
}
