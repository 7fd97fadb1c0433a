//! Outputs as a reader is told them: with what they may be off by, and their units.

use std::collections::BTreeMap;

use super::digits::rounded;
use signorini_intervals::{Found, OutputBound};
use signorini_scene::scene::{Output, Quantity};

/// Digits where nobody knows how many hold.
const UNKNOWN: usize = 3;

/// An output with its value, and what is known of it.
#[derive(Debug, Clone, Copy)]
pub struct Stated<'a> {
    /// Which one it is.
    pub output: &'a Output,
    /// Its value for u_h.
    pub value: Option<f64>,
    /// Where it lies for the exact solution; none where nobody has asked.
    pub interval: Option<&'a Found>,
}

impl<'a> Stated<'a> {
    /// The statement of an output among these values and intervals.
    pub fn of(
        output: &'a Output,
        values: &BTreeMap<String, Option<f64>>,
        intervals: &'a BTreeMap<String, Found>,
    ) -> Self {
        let name = &output.name.value;
        let value = values.get(name).copied().flatten().filter(|value| value.is_finite());
        Self { output, value, interval: intervals.get(name) }
    }

    /// One line: name, value, the interval or why there is none, the estimate.
    pub fn line(&self) -> String {
        format!("{} {}", self.output.name.value, self.words())
    }

    /// Its value and interval in words, without the name.
    pub fn words(&self) -> String {
        let unit = self.unit();
        let said =
            |digits| self.value.map_or("no value".to_owned(), |value| rounded(value, digits, 0.0));
        let value = said(UNKNOWN);
        match self.interval {
            Some(Ok(found)) => {
                let value = said(self.value.map_or(UNKNOWN, |value| digits_beside(found, value)));
                let (of, at) = match self.output.quantity {
                    Quantity::Probe { .. } => (" in the mean over its cell", "at the point "),
                    _ => ("", ""),
                };
                let estimate = found.estimate.map_or_else(String::new, |by| {
                    format!(", which moves by {} where it is refined once", rounded(by, 2, 0.0))
                });
                format!(
                    "{}{unit}{of}, guaranteed; {value} {at}on this mesh{estimate}",
                    around(found.center, found.plus_minus)
                )
            }
            Some(Err(why))
                if !matches!(
                    self.output.quantity,
                    Quantity::Length | Quantity::Saturated | Quantity::Window
                ) =>
            {
                format!("{value}{unit}; no interval: {why}")
            }
            _ => format!("{value}{unit}"),
        }
    }

    fn unit(&self) -> String {
        self.output.unit.as_ref().map_or_else(String::new, |unit| format!(" {unit}"))
    }
}

/// A sentence on a scene for engineers: the first force or flux, its error, and over which length, where both are outputs.
pub fn sentence(all: &[Stated]) -> Option<String> {
    let is_flux = |of: &&Stated| matches!(of.output.quantity, Quantity::Force | Quantity::Flux);
    let flux = all.iter().find(|of| is_flux(of) && matches!(of.interval, Some(Ok(_))))?;
    let Some(Ok(found)) = flux.interval else { return None };
    let length = all.iter().find(|of| of.output.quantity == Quantity::Length);
    let told = |(of, value): (&Stated, f64)| {
        format!(", over {}{} of contact on this mesh", rounded(value, UNKNOWN, 0.0), of.unit())
    };
    let length = length.and_then(|of| Some((of, of.value?))).map_or_else(String::new, told);
    let name = flux.output.name.value.replace('_', " ");
    let value = printed_power(&around(found.center, found.plus_minus));
    Some(format!("The {name} is {value}{}, guaranteed{length}.", flux.unit()))
}

/// "(3.31 ± 0.15)·10⁻⁵" for "(3.31 ± 0.15)e-5", as in print.
fn printed_power(number: &str) -> String {
    let Some((head, exponent)) = number.split_once(")e") else { return number.to_owned() };
    let raised = exponent.chars().map(|letter| match letter {
        '-' => '⁻',
        digit => digit.to_digit(10).map_or(letter, |digit| {
            ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize]
        }),
    });
    format!("{head})·10{}", raised.collect::<String>())
}

/// How many digits of `value` have the places of the interval beside it.
fn digits_beside(of: &OutputBound, value: f64) -> usize {
    let digits = value.abs().log10().floor() - of.plus_minus.log10().floor() + 2.0;
    if digits.is_finite() { (digits as usize).clamp(UNKNOWN, 12) } else { UNKNOWN }
}

/// "27.5 ± 3.6", "(3.31 ± 0.15)e-5": both numbers with the same places, the second rounded up so that all of the interval is said.
pub fn around(center: f64, plus_minus: f64) -> String {
    let size = center.abs().max(plus_minus);
    if size == 0.0 || plus_minus == 0.0 || !size.is_finite() || !plus_minus.is_finite() {
        return format!("{center} ± {plus_minus}");
    }
    let exponent = match size.log10().floor() as i32 {
        -3..=5 => 0,
        exponent => exponent,
    };
    let unit = 10_f64.powi(exponent);
    let (center, plus_minus) = (center / unit, plus_minus / unit);
    // Two digits of the error, but no more than 12 of the value.
    let last =
        (plus_minus.log10().floor() as i32 - 1).max((size / unit).log10().floor() as i32 - 11);
    let place = 10_f64.powi(last);
    let shown = (center / place).round() * place;
    let error = ((plus_minus + (shown - center).abs()) / place).ceil() * place;
    let places = (-last).max(0) as usize;
    match exponent {
        0 => format!("{shown:.places$} ± {error:.places$}"),
        _ => format!("({shown:.places$} ± {error:.places$})e{exponent}"),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use signorini_scene::scene::Scene;

    #[test]
    fn powers_are_raised_in_print() {
        assert_eq!(printed_power("(3.31 ± 0.15)e-5"), "(3.31 ± 0.15)·10⁻⁵");
        assert_eq!(printed_power("(1.2 ± 0.3)e12"), "(1.2 ± 0.3)·10¹²");
        assert_eq!(printed_power("27.5 ± 3.6"), "27.5 ± 3.6");
    }

    #[test]
    fn what_is_no_number_is_no_value() {
        let scene = "mesh = 'm'\nmaterial.a.conductivity = 1\nboundary.a = { kind = 'contact' }\n\
                     output.q = { kind = 'force' }";
        let scene = Scene::parse(scene, Path::new("a.toml")).expect("a scene");
        for value in [f64::NAN, f64::INFINITY] {
            let values = BTreeMap::from([("q".to_owned(), Some(value))]);
            let intervals = BTreeMap::new();
            let stated = Stated::of(&scene.outputs[0], &values, &intervals);
            assert_eq!(stated.line(), "q no value");
        }
    }

    #[test]
    fn a_value_has_the_places_of_its_interval() {
        let beside = |plus_minus, value| {
            let (of, center) = (String::new(), 0.0);
            let of =
                OutputBound { center, plus_minus, of, estimate: None, exact: None, doubt: 0.0 };
            rounded(value, digits_beside(&of, value), 0.0)
        };
        assert_eq!(beside(18.0, 1474.48), "1474");
        assert_eq!(beside(0.54, 1490.2295), "1490.23");
        assert_eq!(beside(14.0, 0.4), "0.400");
        assert_eq!(beside(0.0, 0.4), "0.400");
        assert_eq!(beside(1.0, 0.0), "0");
    }

    #[test]
    fn the_error_is_rounded_up_and_holds_what_rounding_took() {
        assert_eq!(around(27.475, 3.554), "27.5 ± 3.6");
        assert_eq!(around(3.3087e-5, 1.4001e-6), "(3.31 ± 0.15)e-5");
        assert_eq!(around(-3.7916, 0.5813), "-3.79 ± 0.59");
        assert_eq!(around(0.4, 13.2), "0 ± 14");
        assert_eq!(around(1.0, 1e-13), "1.00000000000 ± 0.00000000001");
        assert_eq!(around(0.0, 0.0), "0 ± 0");
        assert_eq!(around(0.25, 0.0), "0.25 ± 0");
        assert_eq!(around(123_456.0, 7890.0), "123500 ± 8000");
    }
}
