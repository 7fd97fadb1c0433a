//! The colour map viridis (public domain, CC0): equal steps of a value look equally large, it grows
//! from dark to light and so survives a grey printer, and the colour-blind can read it.

/// Viridis at 0, 1/16, …, 1 in sRGB; straight lines between differ from it by 5/255 at most.
const VIRIDIS: [[u8; 3]; 17] = [
    [68, 1, 84],
    [71, 24, 106],
    [71, 44, 123],
    [66, 64, 133],
    [58, 82, 139],
    [50, 98, 141],
    [44, 114, 142],
    [38, 129, 142],
    [32, 144, 140],
    [30, 159, 136],
    [40, 174, 127],
    [62, 188, 115],
    [94, 201, 97],
    [131, 211, 75],
    [173, 220, 48],
    [215, 226, 25],
    [253, 231, 36],
];

/// The colour of `fraction` in [0, 1] (clamped) as `#rrggbb`.
pub fn color(fraction: f64) -> String {
    let position = fraction.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let below = (position as usize).min(VIRIDIS.len() - 2);
    let weight = position - below as f64;
    let [r, g, b] = std::array::from_fn(|channel| {
        let (low, high) = (VIRIDIS[below][channel], VIRIDIS[below + 1][channel]);
        (f64::from(low) + weight * (f64::from(high) - f64::from(low))).round() as u8
    });
    format!("#{r:02x}{g:02x}{b:02x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_strays() {
        assert_eq!(color(0.0), "#440154");
        assert_eq!(color(1.0), "#fde724");
        assert_eq!(color(7.0), color(1.0));
        assert_eq!(color(-1.0), color(0.0));
    }

    #[test]
    fn it_grows_lighter_all_the_way() {
        let luma = |step: u32| {
            let text = color(f64::from(step) / 64.0);
            let channel = |at| f64::from(u8::from_str_radix(&text[at..at + 2], 16).unwrap());
            0.2126 * channel(1) + 0.7152 * channel(3) + 0.0722 * channel(5)
        };
        assert!((0..64).all(|step| luma(step) < luma(step + 1)));
    }
}
