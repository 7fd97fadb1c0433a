//! Numbers as a person reads them.

use signorini_draw::plain;

/// 1 234 567: digits in threes.
pub fn grouped(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::new();
    for (at, digit) in digits.char_indices() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// A cost rounded to a whole number, with its digits in threes.
pub fn whole(value: f64) -> String {
    grouped(value.round_ties_even() as u64)
}

/// A cost with three significant digits: 0.123, 12.3, 1 230 000.
pub fn cost(value: f64) -> String {
    if !value.is_finite() || value.abs() < 1000.0 || value >= 1e15 {
        return plain(value);
    }
    let unit = 10_f64.powf(value.log10().floor() - 2.0).max(1.0);
    grouped(((value / unit).round() * unit) as u64)
}

/// `part` in percent of `whole`, with three significant digits.
pub fn percent(part: f64, whole: f64) -> String {
    plain(100.0 * part / whole.abs())
}

/// A text for what may be missing.
pub fn or_dash<T>(value: Option<T>, text: impl FnOnce(T) -> String) -> String {
    value.map_or("–".to_owned(), text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn costs_have_three_digits_in_groups() {
        let texts = [0.1234, 12.34, 999.6, 1234.0, 1_234_567.0, 999_600.0, 99_960.0].map(cost);
        assert_eq!(texts, ["0.123", "12.3", "1000", "1 230", "1 230 000", "1 000 000", "100 000"]);
        assert_eq!([f64::NAN, f64::INFINITY].map(cost), ["–", "–"]);
        assert_eq!(
            [0, 12, 123, 1234, 1_000_000].map(grouped),
            ["0", "12", "123", "1 234", "1 000 000"]
        );
    }

    #[test]
    fn percents_of_nothing_are_missing() {
        assert_eq!(percent(0.01, 2.0), "0.500");
        assert_eq!(percent(0.01, -2.0), "0.500");
        assert_eq!([percent(0.01, 0.0), percent(f64::NAN, 1.0)], ["–", "–"]);
        assert_eq!(percent(0.0, 1.0), "0");
    }
}
