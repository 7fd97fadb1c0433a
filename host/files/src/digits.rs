//! Results with the digits that their bound supports, for a terminal; files keep all of them.

/// Digits of a result down to the second one of its error, 3 at least: fewer would be another number.
pub fn supported(value: f64, error: Option<f64>) -> usize {
    const LEAST: usize = 3;
    const MOST: f64 = 9.0;
    let places = |error: f64| value.abs().log10().floor() - error.log10().floor() + 2.0;
    let known = error.map(places).filter(|digits| !digits.is_nan());
    known.map_or(LEAST, |digits| digits.clamp(LEAST as f64, MOST) as usize)
}

/// `value` rounded to so many digits. What is far below `scale`, the size of what it was summed from, is 0.
pub fn rounded(value: f64, digits: usize, scale: f64) -> String {
    /// A sum whose terms cancel to this part of them is their rounding.
    const ROUNDING: f64 = 1e-12;
    if value.abs() <= ROUNDING * scale || value == 0.0 {
        return "0".to_owned();
    }
    let text = format!("{value:.*e}", digits.saturating_sub(1));
    let exponent = text.split_once('e').and_then(|(_, exponent)| exponent.parse::<i32>().ok());
    match exponent {
        // As many places as digits are left behind the point.
        Some(exponent @ -4..=5) => {
            let rounded: f64 = text.parse().unwrap_or(value);
            let places = (digits as i32 - 1 - exponent).max(0) as usize;
            format!("{rounded:.places$}")
        }
        _ => text,
    }
}

/// A part in per cent, with two digits, rounded up: what it says is never less than what holds.
pub fn percent_above(part: f64) -> String {
    let percent = 100.0 * part;
    if percent <= 0.0 || !percent.is_finite() {
        return format!("{percent}");
    }
    let unit = 10_f64.powf(percent.log10().floor() - 1.0);
    let above = (percent / unit).ceil() * unit;
    match above {
        10.0.. => format!("{above:.0}"),
        1e-3.. => rounded(above, 2, 0.0),
        _ => format!("{above:.1e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_has_the_digits_that_its_error_has_two_of() {
        let of = |value: f64, error: f64| supported(value, Some(error));
        assert_eq!(
            [of(11.6, 3.4), of(11.6, 25.0), of(0.4, 13.2), of(3.2e-5, 1.5e-6)],
            [3, 3, 3, 3]
        );
        assert_eq!([of(1.0, 0.0), of(1.0, 1e-30), supported(1.0, None)], [9, 9, 3]);
        assert_eq!(rounded(11.6123, of(11.6123, 3.4), 0.0), "11.6");
    }

    #[test]
    fn numbers_keep_their_size() {
        let texts = [1234.567, 0.012345, 2.685e-6, -40.767, 9.99, 987654321.0];
        let texts = texts.map(|value| rounded(value, 3, 0.0));
        assert_eq!(texts, ["1230", "0.0123", "2.69e-6", "-40.8", "9.99", "9.88e8"]);
        assert_eq!(rounded(9.0e-14, 3, 40.0), "0");
        assert_eq!(rounded(9.0e-14, 3, 1e-13), "9.00e-14");
        assert_eq!(rounded(9.99, 1, 0.0), "10");
    }

    #[test]
    fn per_cents_are_rounded_up() {
        let texts = [0.7501, 0.05, 0.0123, 1.5, 0.0, 3.21e-9].map(percent_above);
        assert_eq!(texts, ["76", "5.0", "1.3", "150", "0", "3.3e-7"]);
    }
}
