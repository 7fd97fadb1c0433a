//! How wide a line of text comes out. Whoever looks at a picture may have any font, so widths are those
//! of a wide one: text takes at most the room that was kept for it.

/// The width of a text in pixels, with letters of `size` pixels.
pub fn width(text: &str, size: f64) -> f64 {
    size * text.chars().map(relative_width).sum::<f64>()
}

/// Letter by letter, in units of the size.
fn relative_width(letter: char) -> f64 {
    match letter {
        ' ' | '.' | ',' | ':' | ';' | 'i' | 'j' | 'l' | 'I' | '\'' | '|' | '!' => 0.36,
        'f' | 't' | 'r' | '(' | ')' | '[' | ']' | '/' | '-' => 0.42,
        'm' | 'w' | 'M' | 'W' | '%' | '@' | '…' => 1.0,
        upper if upper.is_uppercase() => 0.74,
        narrow if narrow.is_ascii() => 0.64,
        '·' | '’' => 0.36,
        _ => 0.9,
    }
}

/// The text, or as much of it as is no wider than `room` together with an ellipsis.
pub fn shortened(text: &str, size: f64, room: f64) -> String {
    if width(text, size) <= room {
        return text.to_owned();
    }
    let room = room - width("…", size);
    let mut used = 0.0;
    let fits = |letter: &char| {
        used += size * relative_width(*letter);
        used <= room
    };
    let start: String = text.chars().take_while(fits).collect();
    format!("{}…", start.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shortened_text_fits() {
        let text = "quads, level 1, f32+f64, warm";
        let whole = width(text, 12.0);
        assert_eq!(shortened(text, 12.0, whole), text);
        for room in [0.3, 0.5, 0.9].map(|part| part * whole) {
            let short = shortened(text, 12.0, room);
            assert!(short.ends_with('…') && width(&short, 12.0) <= room, "{short}");
            assert!(text.starts_with(short.trim_end_matches('…')));
        }
        assert_eq!(shortened(text, 12.0, 0.0), "…");
    }
}
