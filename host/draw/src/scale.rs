//! Axes: from values to pixels, and the round values worth a tick.

/// A linear or logarithmic axis.
#[derive(Debug, Clone, Copy)]
pub struct Scale {
    low: f64,
    high: f64,
    pixels: [f64; 2],
    logarithmic: bool,
}

/// The smallest and the largest finite value; `None` without any.
pub fn extent(values: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    values.into_iter().filter(|value| value.is_finite()).fold(None, |range, value| {
        let [low, high] = range.unwrap_or([value, value]);
        Some([low.min(value), high.max(value)])
    })
}

/// Whether a value has a place on a logarithmic axis.
pub fn has_logarithm(value: f64) -> bool {
    value.is_normal() && value > 0.0
}

impl Scale {
    /// An axis that shows `low` to `high` from the first pixel to the second. A single value is
    /// given some room on both sides.
    pub fn linear([low, high]: [f64; 2], pixels: [f64; 2]) -> Self {
        let room = if low == 0.0 { 0.5 } else { 0.5 * low.abs() };
        let [low, high] = if low < high { [low, high] } else { [low - room, low + room] };
        let [low, high] = [low.max(f64::MIN), high.min(f64::MAX)];
        Self { low, high, pixels, logarithmic: false }
    }

    /// A scale of positive values in decades, with both ends moved out by a tenth of a decade.
    pub fn logarithmic([low, high]: [f64; 2], pixels: [f64; 2]) -> Self {
        let [low, high] = [low.log10() - 0.1, high.log10() + 0.1];
        Self { low, high, pixels, logarithmic: true }
    }

    /// The pixels between which it lies.
    pub fn pixels(&self) -> [f64; 2] {
        self.pixels
    }

    /// Where a value lies; not finite for values the axis cannot show.
    pub fn at(&self, value: f64) -> f64 {
        let value = if self.logarithmic { value.log10() } else { value };
        // Halves, so that a range of ±f64::MAX does not overflow.
        let fraction = (0.5 * value - 0.5 * self.low) / (0.5 * self.high - 0.5 * self.low);
        self.pixels[0] + fraction * (self.pixels[1] - self.pixels[0])
    }

    /// The value that lies at a pixel: the inverse of [`Scale::at`].
    pub fn value(&self, pixel: f64) -> f64 {
        let fraction = (pixel - self.pixels[0]) / (self.pixels[1] - self.pixels[0]);
        let value = self.low + fraction * (self.high - self.low);
        if self.logarithmic { 10_f64.powf(value) } else { value }
    }

    /// About `count` round values with their labels.
    pub fn ticks(&self, count: usize) -> Vec<(f64, String)> {
        if self.logarithmic { self.decades() } else { self.round_values(count) }
    }

    /// Multiples of 1, 2 or 5 times a power of ten.
    fn round_values(&self, count: usize) -> Vec<(f64, String)> {
        let wanted = (self.high - self.low) / count.max(1) as f64;
        let power = wanted.log10().floor();
        let unit = 10_f64.powf(power);
        let leading = wanted / unit;
        let step = unit * [1.0, 2.0, 5.0].into_iter().find(|&s| leading <= s).unwrap_or(10.0);
        let first = (self.low / step).ceil();
        if !step.is_normal() || !first.is_finite() || first.abs() > 1e12 {
            return vec![(self.low, plain(self.low)), (self.high, plain(self.high))];
        }
        let largest = self.low.abs().max(self.high.abs());
        let last = (self.high / step * (1.0 + 1e-12)).floor();
        let steps = (last - first).clamp(0.0, 50.0) as u32;
        (0..=steps)
            .map(|index| (first + f64::from(index)) * step)
            .map(|value| (value, label(value, step, largest)))
            .collect()
    }

    /// Powers of ten; with less than two of them in sight, 2 and 5 times them as well.
    fn decades(&self) -> Vec<(f64, String)> {
        let powers = self.low.floor() as i32..=self.high.ceil() as i32;
        let inside = |value: &f64| (self.low..=self.high).contains(&value.log10());
        let whole = powers.clone().filter(|&power| inside(&10_f64.powi(power))).count();
        let every = whole.div_ceil(8).max(1);
        let factors: &[f64] = if whole < 2 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        powers
            .step_by(every)
            .flat_map(|power| factors.iter().map(move |&factor| (factor, power)))
            .map(|(factor, power)| (factor * 10_f64.powi(power), power))
            .map(|(value, power)| match whole {
                0 | 1 => (value, label(value, 10_f64.powi(power), value)),
                _ => (value, scientific(1.0, 0, power)),
            })
            .filter(|(value, _)| inside(value))
            .collect()
    }
}

/// A tick in plain decimals, or in powers of ten when the axis is far from 1.
fn label(value: f64, step: f64, largest: f64) -> String {
    // The power of ten next to a subnormal number may be 0.
    if !value.is_normal() {
        return "0".to_owned();
    }
    let step_power = (step.log10() + 1e-9).floor() as i32;
    let power = largest.log10().floor() as i32;
    if (-3..5).contains(&power) {
        let decimals = (-step_power).clamp(0, 9) as usize;
        return format!("{value:.decimals$}").replace('-', "−");
    }
    let decimals = (power - step_power).clamp(0, 9) as usize;
    scientific(value / 10_f64.powi(power), decimals, power)
}

/// A number with three digits, whatever its size.
pub fn plain(value: f64) -> String {
    if !value.is_finite() {
        return "–".to_owned();
    }
    label(value, 10_f64.powf(value.abs().log10().floor() - 2.0), value.abs())
}

/// `mantissa · 10^power`, the mantissa left out when it is ±1.
fn scientific(mantissa: f64, decimals: usize, power: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let superscript: String = power
        .to_string()
        .chars()
        .map(|c| c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]))
        .collect();
    match format!("{mantissa:.decimals$}").replace('-', "−").as_str() {
        "1" => format!("10{superscript}"),
        "−1" => format!("−10{superscript}"),
        mantissa => format!("{mantissa}·10{superscript}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use signorini_tolerances::draw::POSITION;

    fn labels(scale: Scale) -> Vec<String> {
        scale.ticks(5).into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn ticks_are_round() {
        let linear = |low, high| labels(Scale::linear([low, high], [0.0, 100.0]));
        assert_eq!(linear(0.0, 1.0), ["0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(linear(-1.0, 1.0), ["−1.0", "−0.5", "0", "0.5", "1.0"]);
        assert_eq!(linear(0.0, 3.2e-6), ["0", "10⁻⁶", "2·10⁻⁶", "3·10⁻⁶"]);
        assert_eq!(linear(-2e7, 0.0), ["−2.0·10⁷", "−1.5·10⁷", "−1.0·10⁷", "−0.5·10⁷", "0"]);
        assert_eq!(linear(3.0, 3.0), ["2", "3", "4"]);
    }

    #[test]
    fn decades_or_finer() {
        let log = |low, high| labels(Scale::logarithmic([low, high], [0.0, 100.0]));
        assert_eq!(log(1e-4, 0.1), ["10⁻⁴", "10⁻³", "10⁻²", "10⁻¹"]);
        assert_eq!(log(0.2, 0.6), ["0.2", "0.5"]);
        assert!((4..=9).contains(&log(1e-300, 1e300).len()));
    }

    #[test]
    fn the_ends_of_the_range_are_the_ends_of_the_axis() {
        let scale = Scale::linear([2.0, 4.0], [100.0, 0.0]);
        assert_eq!((scale.at(2.0), scale.at(3.0), scale.at(4.0)), (100.0, 50.0, 0.0));
        assert_eq!((scale.value(100.0), scale.value(50.0)), (2.0, 3.0));
        let scale = Scale::logarithmic([1e-3, 1e4], [20.0, 300.0]);
        POSITION.check("back and forth", scale.value(scale.at(2.5)) - 2.5);
    }

    #[test]
    fn no_range_is_too_large_or_too_small() {
        let ranges = [
            [-f64::MAX, f64::MAX],
            [0.0, f64::MIN_POSITIVE / 8.0],
            [1e6, 1e6 + 1e-9],
            [1.0, 1.0 + f64::EPSILON],
            [f64::MAX, f64::MAX],
        ];
        for range in ranges {
            let labels = labels(Scale::linear(range, [0.0, 1.0]));
            assert!(!labels.is_empty() && labels.len() < 60, "{range:?}: {labels:?}");
            assert!(labels.iter().all(|label| !label.contains("NaN") && !label.contains("inf")));
        }
        assert_eq!(plain(f64::NAN), "–");
        assert_eq!(plain(0.012345), "0.0123");
        assert_eq!(extent([f64::NAN, 2.0, f64::INFINITY, 1.0]), Some([1.0, 2.0]));
        assert_eq!(extent([f64::NAN]), None);
    }
}
