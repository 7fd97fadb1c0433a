//! Names in C: of the files and functions of a scene, of fields.

use crate::text::{identifiers, is_among};
use signorini_problem::Problem;

/// The name of a scene's files and functions: that of its file, in lower-case letters, digits and single underscores.
pub fn name_of(problem: &Problem) -> String {
    let stem = problem.scene.file().file_stem().unwrap_or_default().to_string_lossy();
    let name = identifiers(std::iter::once(stem.as_ref())).pop().unwrap_or_default();
    // A header or a library of this name would stand in the way of another one.
    if is_among(HEADERS, &name) { format!("{name}_scene") } else { name }
}

/// A field's name: the module's, but where C or C++ keeps the word for itself, or a compiler defines it.
pub fn field(identifier: &str) -> String {
    if is_among(WORDS, identifier) { format!("{identifier}_") } else { identifier.to_owned() }
}

/// The headers and libraries of C and of the systems that most are for, what begins the macros of one, and the header of the example.
const HEADERS: &str = "\
    alloca assert board c complex ctype dl errno fe fenv float g gcc inttypes iso646 limits locale \
    m malloc math memory new nosys pthread rdimon rt setjmp signal stdalign stdarg stdatomic \
    stdbool stdckdint stddef stdint stdio stdlib stdnoreturn string tgmath threads time uchar \
    unistd wchar wctype";

/// Words of C and C++ that are no words of Rust, and macros of compilers and of C's own headers.
const WORDS: &str = "\
    alignas alignof and and_eq arm asm auto bitand bitor bool case catch char char16_t char32_t \
    char8_t class compl complex concept const_cast consteval constexpr constinit decltype default \
    delete double dynamic_cast errno explicit export far float friend goto i386 imaginary inline \
    int interrupt linux long mutable namespace near new noexcept noreturn not not_eq nullptr \
    operator or or_eq private protected public register reinterpret_cast requires restrict short \
    signed sizeof switch template this thread_local throw typedef typeid typename union unix \
    unsigned using void volatile wchar_t xor xor_eq";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_c_are_no_fields() {
        for word in [
            "int", "default", "register", "class", "linux", "void", "volatile", "wchar_t", "xor",
            "using",
        ] {
            assert_eq!(field(word), format!("{word}_"));
        }
        assert_eq!(field("rain"), "rain");
        assert_eq!(field("type_"), "type_");
    }
}
