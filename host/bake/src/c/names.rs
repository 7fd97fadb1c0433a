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

/// A field's name: the module's, but where C or C++ keeps the word for itself, or a compiler or a header defines it.
pub fn field(identifier: &str) -> String {
    let is_taken =
        [KEYWORDS_OF_C, KEYWORDS_OF_CPP, MACROS].iter().any(|of| is_among(of, identifier));
    if is_taken { format!("{identifier}_") } else { identifier.to_owned() }
}

/// The headers and libraries of C and of the systems that most are for, what begins the macros of one, and the header of the example.
const HEADERS: &str = "\
    alloca assert board c complex ctype dl errno fe fenv float g gcc inttypes iso646 limits locale \
    m malloc math memory new nosys pthread rdimon rt setjmp signal stdalign stdarg stdatomic \
    stdbool stdckdint stddef stdint stdio stdlib stdnoreturn string tgmath threads time uchar \
    unistd wchar wctype";

/// Keywords of C23 (ISO/IEC 9899:2024, 6.4.1), those with an underscore and a capital aside: no field is called so.
pub(super) const KEYWORDS_OF_C: &str = "\
    alignas alignof auto bool break case char const constexpr continue default do double else enum \
    extern false float for goto if inline int long nullptr register restrict return short signed \
    sizeof static static_assert struct switch thread_local true typedef typeof typeof_unqual union \
    unsigned void volatile while";

/// Keywords and alternative tokens of C++26 (working draft N5008, tables 5 and 6 of [lex]) beyond those of C, and those of its
/// technical specifications of transactional memory and reflection.
pub(super) const KEYWORDS_OF_CPP: &str = "\
    and and_eq asm atomic_cancel atomic_commit atomic_noexcept bitand bitor catch char16_t char32_t \
    char8_t class compl concept consteval constinit const_cast contract_assert co_await co_return \
    co_yield decltype delete dynamic_cast explicit export friend mutable namespace new noexcept not \
    not_eq operator or or_eq private protected public reflexpr reinterpret_cast requires \
    static_cast synchronized template this throw try typeid typename using virtual wchar_t xor \
    xor_eq";

/// Macros without parameters: of C's own headers (9899:2024, clause 7), of compilers, and of what glibc, newlib and the
/// headers of Windows define beside. Those with parameters are none where no parenthesis follows.
pub(super) const MACROS: &str = "\
    complex errno imaginary math_errhandling noreturn stderr stdin stdout \
    arm far fortran hpux i386 interface interrupt linux mips near pascal small sparc sun unix vax \
    fd_set physadr quad signgam strtodf tzname \
    sa_handler sa_sigaction sched_priority sigev_notify_attributes sigev_notify_function si_addr \
    si_addr_lsb si_arch si_band si_call_addr si_fd si_int si_lower si_overrun si_pid si_pkey si_ptr \
    si_status si_stime si_syscall si_timerid si_uid si_upper si_utime si_value st_atime st_ctime \
    st_mtime";

#[cfg(test)]
mod tests {
    use std::io::Write as _;
    use std::process::{Command, Stdio};

    use super::*;

    #[test]
    fn words_of_c_are_no_fields() {
        let of_users = "static_assert static_cast co_await co_return co_yield math_errhandling";
        let others = "int default register class linux void volatile wchar_t xor using typeof_unqual \
                      contract_assert constinit stdin";
        for word in of_users.split_whitespace().chain(others.split_whitespace()) {
            assert_eq!(field(word), format!("{word}_"));
        }
        for word in ["rain", "type_", "alignment", "si"] {
            assert_eq!(field(word), word);
        }
    }

    /// Every header of C that this compiler has.
    const INCLUDES: &str = "\
        assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdalign \
        stdarg stdatomic stdbit stdbool stdckdint stddef stdint stdio stdlib stdnoreturn string tgmath \
        threads time uchar wchar wctype unistd sys/types sys/stat";

    /// Words of `compiler` on a text; nothing where there is no such compiler.
    fn said(compiler: &str, words: &[&str], text: &str) -> Option<String> {
        let mut command = Command::new(compiler);
        command.args(words).arg("-").stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.stderr(Stdio::null()).spawn().ok()?;
        child.stdin.take()?.write_all(text.as_bytes()).ok()?;
        let output = child.wait_with_output().ok()?;
        Some(String::from_utf8_lossy(&output.stdout).into_owned())
    }

    /// The compilers themselves tell which words without capitals and parameters stand for something else.
    #[test]
    fn macros_of_all_headers_are_no_fields() {
        let headers = INCLUDES.split_whitespace();
        let text: String = headers
            .map(|name| format!("#if __has_include(<{name}.h>)\n#include <{name}.h>\n#endif\n"))
            .collect();
        let mut tried = 0;
        for compiler in ["cc", "c++", "arm-none-eabi-gcc", "arm-none-eabi-g++"] {
            let language = if compiler.ends_with("++") { "c++" } else { "c" };
            let Some(macros) = said(compiler, &["-dM", "-E", "-x", language], &text) else {
                continue;
            };
            for line in macros.lines() {
                let mut words = line.split_whitespace().skip(1);
                let (Some(name), meaning) = (words.next(), words.next()) else { continue };
                let is_lower = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
                let may_be_field = name.starts_with(|c: char| c.is_ascii_lowercase())
                    && name.chars().all(is_lower)
                    && !name.contains("__")
                    && !name.ends_with('_');
                if may_be_field && meaning != Some(name) {
                    assert_ne!(field(name), name, "{compiler}: {line}");
                    tried += 1;
                }
            }
        }
        assert!(tried > 20, "{tried}");
    }
}
