//! A field of the scene at one time: its own expression plus, for every `[input.…]` that refers to
//! it, the input's value times its pattern.

use super::Problem;
use crate::cell::Cell;
use crate::quadrature::enclosed::{self, Integral};
use crate::quadrature::mean_on_edge;
use signorini_scene::error::Result;
use signorini_scene::expression::Expression;
use signorini_scene::expression::enclosure::{Form, Growth, Region};
use signorini_scene::scene::{Field, Input, Located, Scene};

/// A field with its inputs: Σ weight · expression.
pub struct Sum<'s> {
    scene: &'s Scene,
    /// Whether its means are loads: fluxes and sources.
    is_load: bool,
    base: &'s Located<Expression>,
    inputs: Vec<(f64, &'s Located<Expression>)>,
    time: f64,
}

impl<'s> Sum<'s> {
    /// `field` of the boundary `of`, or of the source.
    pub fn new(
        scene: &'s Scene,
        of: &str,
        field: Field,
        base: &'s Located<Expression>,
        time: f64,
    ) -> Self {
        let refers = |input: &&'s Input| {
            input.of.value == of && input.field.value == field && input.default != 0.0
        };
        let inputs = scene.inputs.iter().filter(refers);
        let inputs = inputs.map(|input| (input.default, &input.pattern)).collect();
        let is_load = matches!(field, Field::Flux | Field::Limit | Field::Source);
        Self { scene, is_load, base, inputs, time }
    }

    /// An expression to which no input adds.
    pub fn alone(scene: &'s Scene, base: &'s Located<Expression>, time: f64) -> Self {
        Self { scene, is_load: false, base, inputs: Vec::new(), time }
    }

    /// The load f.
    pub fn source(scene: &'s Scene, time: f64) -> Self {
        Self::new(scene, "source", Field::Source, &scene.source, time)
    }

    /// `field` of the boundary that an edge lies on, where its condition has such a field, at the time of the problem.
    pub fn on_edge(problem: &'s Problem, edge: usize, field: Field) -> Option<Self> {
        let boundary = problem.boundary_of(edge)?;
        let base = boundary.condition.datum(field)?;
        Some(Self::new(&problem.scene, &boundary.name.value, field, base, problem.time))
    }

    /// The transfer coefficient of the boundary that an edge lies on, where its condition has one, at the time of the problem.
    pub fn transfer(problem: &'s Problem, edge: usize) -> Option<Self> {
        let boundary = problem.boundary_of(edge)?;
        let (name, base) = (&boundary.name.value, boundary.condition.transfer()?);
        Some(Self::new(&problem.scene, name, Field::Coefficient, base, problem.time))
    }

    /// The transfer coefficient and the ambient value of an edge with a transfer law.
    pub fn of_law(problem: &'s Problem, edge: usize) -> Option<[Self; 2]> {
        Some([Self::transfer(problem, edge)?, Self::on_edge(problem, edge, Field::Ambient)?])
    }

    /// Where the field stands in the scene file.
    pub fn key(&self) -> &'s Located<Expression> {
        self.base
    }

    /// Whether it is 0 everywhere, whatever the inputs.
    pub fn is_zero(&self) -> bool {
        self.base.value.is_zero() && self.inputs.is_empty()
    }

    /// Its terms: the field's own expression, once, and the pattern of each input, times its value.
    fn terms(&self) -> impl Iterator<Item = (f64, &'s Expression)> {
        let inputs = self.inputs.iter().map(|(weight, pattern)| (*weight, &pattern.value));
        std::iter::once((1.0, &self.base.value)).chain(inputs)
    }

    /// The sum of what `of` makes of each weight and expression.
    fn total(&self, of: impl Fn(f64, &Expression) -> f64) -> f64 {
        self.terms().map(|(weight, term)| of(weight, term)).reduce(|a, b| a + b).unwrap_or(0.0)
    }

    /// The value, if it is the same everywhere.
    pub fn constant(&self) -> Option<f64> {
        let terms = self.terms().map(|(weight, term)| Some(weight * term.is_constant()?));
        terms.reduce(|sum, term| Some(sum? + term?)).flatten()
    }

    /// Whether no term has a kink, a jump or a pole.
    pub fn is_smooth(&self) -> bool {
        self.terms().all(|(_, term)| term.is_smooth())
    }

    /// The value at a point.
    pub fn at(&self, x: f64, y: f64) -> f64 {
        self.total(|weight, term| weight * term.eval(x, y, self.time))
    }

    /// The value at a point, which has to be finite.
    ///
    /// # Errors
    /// A value that is not, with the point and the field's place in the file.
    pub fn finite_at(&self, point @ [x, y]: [f64; 2]) -> Result<f64> {
        self.finite(self.at(x, y), point)
    }

    /// The values at many points.
    pub fn at_all(&self, points: &[[f64; 2]]) -> Vec<f64> {
        let mut sums = self.base.value.eval_all(points, self.time);
        for (weight, pattern) in &self.inputs {
            let values = pattern.value.eval_all(points, self.time);
            sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
        }
        sums
    }

    /// All values in a region.
    pub fn enclose(&self, region: &Region) -> Form {
        let base = self.base.value.enclose(region, self.time);
        self.inputs.iter().fold(base, |sum, (weight, pattern)| {
            sum.combined(1.0, &pattern.value.enclose(region, self.time), *weight)
        })
    }

    /// The largest modulus of its analytic continuation around a region, see [`Region::missed`].
    pub fn modulus(&self, region: &Region, rho: f64) -> f64 {
        self.total(|weight, term| weight.abs() * term.modulus(region, rho, self.time))
    }

    /// The sum less some function that is linear along the region.
    pub fn bend(&self, region: &Region, rho: f64) -> f64 {
        self.total(|weight, term| weight.abs() * term.bend(region, rho, self.time))
    }

    /// All values in a region, and all derivatives along `direction`.
    pub fn enclose_slope(&self, region: &Region, direction: [f64; 2]) -> [Form; 2] {
        let of = |expression: &Expression| expression.enclose_slope(region, self.time, direction);
        self.inputs.iter().fold(of(&self.base.value), |sum, (weight, pattern)| {
            let added = of(&pattern.value);
            [0, 1].map(|k| sum[k].combined(1.0, &added[k], *weight))
        })
    }

    /// Parts of a region along the first kink or jump in it.
    pub fn cut(&self, region: &Region) -> Option<Vec<Region>> {
        if self.is_smooth() {
            return None;
        }
        region.cut(&self.terms().find_map(|(_, term)| term.switch(region, self.time))?)
    }

    /// How it grows in a region where it is not bounded, if that is known: an input's pattern may be unbounded where the rest is not.
    pub fn growth(&self, region: &Region) -> Option<Growth> {
        let of = |weight: f64, expression: &Expression| {
            expression.times(weight).growth(region, self.time)
        };
        match &self.inputs[..] {
            [] => self.base.value.growth(region, self.time),
            [(weight, pattern)] if self.base.value.is_zero() => of(*weight, &pattern.value),
            _ => None,
        }
    }

    /// Its degree as a polynomial in x and y, infinite where it may be none.
    pub fn degree(&self) -> f64 {
        self.terms().map(|(_, term)| term.degree(self.time)).reduce(f64::max).unwrap_or(0.0)
    }

    /// The sum of the sizes of its terms there, of which rounding is a part.
    pub fn terms_at(&self, x: f64, y: f64) -> f64 {
        self.total(|weight, term| (weight * term.eval(x, y, self.time)).abs())
    }

    /// How far the value at a point may be off where its coordinates are by `off`, through that and the rounding of operations.
    pub fn rounding_at(&self, point: [f64; 2], off: f64) -> f64 {
        self.total(|weight, term| weight.abs() * term.rounding(point, off, self.time))
    }

    /// (∂/∂x, ∂/∂y)
    pub fn gradient_at(&self, x: f64, y: f64) -> [f64; 2] {
        let slopes = self.terms().map(|(weight, term)| {
            let (_, slope) = term.gradient(x, y, self.time);
            slope.map(|slope| weight * slope)
        });
        slopes.reduce(|sum, of| [sum[0] + of[0], sum[1] + of[1]]).unwrap_or_default()
    }

    /// The derivative along `direction`. Across a line on which the field does not change, it may be infinite: √x on x = 0.
    pub fn slope_at(&self, [x, y]: [f64; 2], direction: [f64; 2]) -> f64 {
        self.total(|weight, term| weight * term.slope(x, y, self.time, direction))
    }

    /// The mean over a segment, by the rule for edge data; that of a load on parts of it where it is not resolved.
    pub fn mean(&self, segment: [[f64; 2]; 2]) -> Result<f64> {
        if self.is_load {
            return Ok(self.mean_and_missed(segment)?.value);
        }
        if let Some(constant) = self.stated() {
            return self.finite(constant, segment[0]);
        }
        self.finite(mean_on_edge(segment, |x, y| self.at(x, y)), middle(segment))
    }

    /// The mean over a segment, and what is missed of it.
    pub fn mean_and_missed(&self, segment: [[f64; 2]; 2]) -> Result<Integral> {
        let mean = match self.stated() {
            Some(value) => Integral { value, missed: 0.0 },
            None => enclosed::mean_on_edge(self, segment),
        };
        self.finite(mean.value, middle(segment))?;
        self.integrable(&mean, &Region::segment(segment))?;
        Ok(mean)
    }

    /// Refuses a datum that is proved to have no finite integral.
    fn integrable(&self, integral: &Integral, region: &Region) -> Result<()> {
        let pole = || enclosed::pole(self, region, 1.0);
        match if integral.missed.is_finite() { None } else { pole() } {
            Some(([x, y], true)) => {
                let message = format!("{} has no finite integral near ({x}, {y})", self.base.value);
                let hint =
                    "a load must be integrable: |x − a|^p for p > −1, a distance^p for p > −2";
                Err(self.scene.error(self.base, message).hint(hint).into())
            }
            _ => Ok(()),
        }
    }

    /// The constant that the scene states, without inputs.
    fn stated(&self) -> Option<f64> {
        self.base.value.is_constant().filter(|_| self.inputs.is_empty())
    }

    /// Integrals over cells, and what is missed of them.
    pub fn over(&self, cells: &[Cell]) -> Result<Vec<Integral>> {
        let all = enclosed::over_cells(self, cells);
        for (integral, cell) in all.iter().zip(cells) {
            self.finite(integral.value, cell.corners()[0])?;
            self.integrable(integral, &enclosed::region(*cell))?;
        }
        Ok(all)
    }

    /// `value`, found near a point; an error at the field's place in the file if it is not finite.
    pub fn finite(&self, value: f64, [x, y]: [f64; 2]) -> Result<f64> {
        if value.is_finite() {
            return Ok(value);
        }
        let message = format!("{} is not finite near ({x}, {y})", self.base.value);
        let hint = "the expression must be finite wherever it is used";
        Err(self.scene.error(self.base, message).hint(hint).into())
    }
}

fn middle([a, b]: [[f64; 2]; 2]) -> [f64; 2] {
    [0, 1].map(|k| 0.5 * (a[k] + b[k]))
}
