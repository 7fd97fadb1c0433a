//! Tables of figures in git, as they are written and read: columns are found by their heads, not by their places.

pub mod counts;
pub mod sizes;

/// The fields of a line: two spaces or more lie between them.
fn fields(line: &str) -> Vec<&str> {
    line.split("  ").map(str::trim).filter(|field| !field.is_empty()).collect()
}
