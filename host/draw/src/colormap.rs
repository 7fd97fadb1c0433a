//! The colour map viridis (public domain, CC0): equal steps of a value look equally large, it grows
//! from dark to light and so survives a grey printer, and the colour-blind can read it.

/// Viridis at 0, 1/16, …, 1 in sRGB, red first; straight lines between differ from it by 5/255 at most.
const VIRIDIS: [u32; 17] = [
    0x440154, 0x47186a, 0x472c7b, 0x424085, 0x3a528b, 0x32628d, 0x2c728e, 0x26818e, 0x20908c,
    0x1e9f88, 0x28ae7f, 0x3ebc73, 0x5ec961, 0x83d34b, 0xaddc30, 0xd7e219, 0xfde724,
];

/// The colour of `fraction` in [0, 1] (clamped) as `#rrggbb`.
pub fn color(fraction: f64) -> String {
    let position = fraction.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let below = (position as usize).min(VIRIDIS.len() - 2);
    let weight = position - below as f64;
    let [r, g, b] = std::array::from_fn(|channel| {
        let of = |at: usize| f64::from(VIRIDIS[at].to_be_bytes()[1 + channel]);
        (of(below) + weight * (of(below + 1) - of(below))).round() as u8
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
