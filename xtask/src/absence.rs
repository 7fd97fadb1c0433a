//! What an image shall not contain, by the names of functions.

use crate::symbols::allocates;

/// Something that an image shall not contain.
#[derive(Debug)]
pub struct Absence {
    /// For a person.
    pub what: &'static str,
    /// By the mangled name of a function.
    pub is: fn(&str) -> bool,
}

/// Text of values.
pub const FORMATTING: Absence = Absence { what: "formatting", is: |name| name.contains("3fmt") };
/// A heap.
pub const ALLOCATOR: Absence = Absence { what: "allocator", is: allocates };
/// Ways out that the kernel has no need of.
pub const PANIC: Absence = Absence { what: "panic", is: |name| name.contains("panic") };
/// The compiler's helpers for f64, by the run-time ABI's names and by their own.
pub const DOUBLE: Absence = Absence {
    what: "f64 helper",
    is: |name| {
        let abi = name.strip_prefix("__aeabi_").is_some_and(|rest| {
            rest.starts_with('d') || rest.starts_with("cd") || rest.ends_with("2d")
        });
        abi || ["df3", "df2", "dfsf2", "dfsi", "dfdi", "sidf", "didf"]
            .iter()
            .any(|end| name.ends_with(end))
    },
};
