//! Insertions and replacements in a text, one within the other.

use std::ops::Range;

/// `with` in the place of `range`; of those that begin at one place, in this order.
struct Edit {
    range: Range<usize>,
    order: i64,
    with: String,
}

/// The edits of a text.
pub struct Edits<'a> {
    /// The text as it is.
    pub text: &'a str,
    /// How many expressions the next edit is within.
    pub depth: i64,
    list: Vec<Edit>,
}

/// More than any depth.
const DEEP: i64 = 1 << 20;

impl<'a> Edits<'a> {
    /// None.
    pub fn new(text: &'a str) -> Self {
        Self { text, depth: 0, list: Vec::new() }
    }

    /// The text with all of them.
    pub fn apply(mut self) -> String {
        self.list.sort_by_key(|edit| (edit.range.start, edit.order));
        let (mut result, mut from) = (String::new(), 0);
        for edit in &self.list {
            result.push_str(&self.text[from..edit.range.start]);
            result.push_str(&edit.with);
            from = edit.range.end;
        }
        result.push_str(&self.text[from..]);
        result
    }

    /// Before what begins at `at`: the outer first.
    pub fn before(&mut self, at: usize, with: String) {
        self.list.push(Edit { range: at..at, order: self.depth, with });
    }

    /// Behind what ends at `at`: the inner first.
    pub fn behind(&mut self, at: usize, with: String) {
        self.list.push(Edit { range: at..at, order: -self.depth - DEEP, with });
    }

    /// On both sides.
    pub fn around(&mut self, range: Range<usize>, before: String, behind: String) {
        self.before(range.start, before);
        self.behind(range.end, behind);
    }

    /// At `at`, before all else, in the order of the calls.
    pub fn at_start(&mut self, at: usize, with: String) {
        self.list.push(Edit { range: at..at, order: -2 * DEEP, with });
    }

    /// In the place of `range`.
    pub fn replace(&mut self, range: Range<usize>, with: String) {
        self.list.push(Edit { range, order: self.depth, with });
    }

    /// Whether something that begins at `at` is replaced.
    pub fn replaces(&self, at: usize) -> bool {
        self.list.iter().any(|edit| edit.range.start == at && !edit.range.is_empty())
    }
}
