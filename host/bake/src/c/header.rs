//! The header of a controller: C99 and C++, whatever warnings are on.

use std::fmt::Write as _;

use signorini_device::codes::Refusal;
use signorini_kernel::Verdict;
use signorini_kernel::codes::Code;
use signorini_kernel::report::Ended;

use super::comment::{MARK, as_is, comment, wrapped};
use super::names::field;
use super::words::{
    ASSERT, CLOSING, FUNCTIONS, INPUT_VALUES, PLUS_MINUS, REPORT, STATE, SYMBOLS, USE,
};
use crate::item::Item;
use crate::module_api::{ModuleApi, UNITS};
use signorini_image::chosen::Chosen;
use signorini_image::library::{Library, Machine};

/// The subject of the header.
pub(super) struct Header<'a> {
    pub name: &'a str,
    pub api: &'a ModuleApi,
    pub chosen: &'a Chosen,
    pub library: &'a Library,
    pub on: &'a Machine,
}

impl Header<'_> {
    /// The whole header.
    pub fn text(&self) -> String {
        let parts = [
            self.opening(),
            self.target(),
            self.constants(),
            self.inputs_and_outputs(),
            self.codes(),
            self.report(),
            self.state(),
            self.functions(),
        ];
        let text = parts.concat() + CLOSING;
        let named = text
            .replace("NAME", &self.name.to_uppercase())
            .replace("name_", &format!("{}_", self.name));
        named.replace(MARK, "")
    }

    fn opening(&self) -> String {
        let Chosen { model, scalar, ram_bytes, flash_bytes, .. } = self.chosen;
        let about = format!(
            "The {model} model in {scalar}, built for {}. From {}, scene hash {:016x}. Written by signorini bake {}; do not edit. \
             Estimated: {flash_bytes} bytes of flash, {ram_bytes} bytes of RAM with the stack of a tick.",
            self.on.word,
            as_is(&self.api.file),
            self.api.hash,
            env!("CARGO_PKG_VERSION"),
        );
        let title = as_is(&self.api.title);
        let paragraphs = [title.as_str(), &about, UNITS, SYMBOLS, USE];
        format!(
            "/*\n{}\n */\n#ifndef NAME_H\n#define NAME_H\n\n#include <stddef.h>\n#include <stdint.h>\n\n",
            paragraphs.map(|text| wrapped(text, " * ")).join("\n *\n")
        )
    }

    /// What stops a build for another processor or another way of passing floating-point numbers.
    fn target(&self) -> String {
        let wrong = match self.on.word {
            "m4" => "!defined(__ARM_ARCH_7EM__) || !defined(__ARM_PCS_VFP)",
            "m4-soft" => "!defined(__ARM_ARCH_7EM__) || defined(__ARM_PCS_VFP)",
            "m33" => "!defined(__ARM_ARCH_8M_MAIN__) || !defined(__ARM_PCS_VFP)",
            "m7" => "!defined(__ARM_ARCH_7EM__) || !defined(__ARM_PCS_VFP) || !(__ARM_FP & 8)",
            _ if cfg!(target_arch = "x86_64") => "!defined(__x86_64__) && !defined(_M_X64)",
            _ if cfg!(target_arch = "aarch64") => "!defined(__aarch64__) && !defined(_M_ARM64)",
            _ => "0",
        };
        let flags = match self.on.flags {
            [] => format!("this kind of machine, {}", std::env::consts::ARCH),
            flags => flags.join(" "),
        };
        format!(
            "#if {wrong}\n#error \"lib{}.a is built for: {flags}\"\n#endif\n{ASSERT}",
            self.name
        )
    }

    fn constants(&self) -> String {
        let mut text = format!(
            "/* What it was made of: a state or a log of another scene has another one. */\n\
             #define NAME_SCENE_HASH \"{:016x}\"\n\
             #define NAME_INPUTS {}\n#define NAME_OUTPUTS {}\n",
            self.api.hash,
            self.api.inputs.len(),
            self.api.outputs.len()
        );
        let worst = &self.chosen.worst_case;
        if let (true, Some(exchanges)) = (worst.proven, worst.exchanges) {
            let _ = writeln!(
                text,
                "\n/* What no tick exceeds, for all inputs within their ranges and every state: proved. */\n\
                 #define NAME_WORST_EXCHANGES {exchanges}u"
            );
            if let Some(instructions) = worst.instructions {
                let _ = writeln!(
                    text,
                    "/* Instructions of a Cortex-M4F, counted stage by stage; those of these functions not included. */\n\
                     #define NAME_WORST_INSTRUCTIONS {instructions}u"
                );
            }
        }
        let scalar = if self.chosen.scalar == "f64" { "double" } else { "float" };
        text + &format!("\n/* Every number of a controller. */\ntypedef {scalar} name_scalar;\n")
    }

    fn inputs_and_outputs(&self) -> String {
        let ranges = self.api.given_ranges.iter();
        let ends = ranges.map(|[lo, hi]| match (lo.is_finite(), hi.is_finite()) {
            (false, false) => " Any finite value.".to_owned(),
            _ => format!(" Range {lo} to {hi}: a tick refuses what lies outside."),
        });
        let inputs = structure("name_inputs", "What the controller sets.", &self.api.inputs, ends);
        let why = self.chosen.without_interval.iter().map(|why| match why {
            Some(why) => format!(" Its plus_minus is infinite: {}.", as_is(why)),
            None => String::new(),
        });
        inputs + &structure("name_outputs", "What the controller reads.", &self.api.outputs, why)
    }

    fn codes(&self) -> String {
        let refused = "Why a call has no answer. The last answer stays what it was.";
        let bounded = "Whether there is an error bound.";
        enumeration("name_error", refused, Refusal::CODES, Refusal::MEANINGS)
            + &enumeration("name_status", "What ended a tick.", Ended::CODES, Ended::MEANINGS)
            + &enumeration("name_bounded", bounded, Verdict::<f32>::CODES, Verdict::<f32>::MEANINGS)
    }

    fn report(&self) -> String {
        let has_outputs = !self.api.outputs.is_empty();
        let plus_minus = if has_outputs { PLUS_MINUS } else { "" };
        let size = self.library.report;
        format!(
            "{REPORT}{plus_minus}}} name_report;\n\nNAME_ASSERT(sizeof(name_report) == {size}, report_has_the_size_of_the_library);\n"
        )
    }

    fn state(&self) -> String {
        let bytes = self.library.state;
        format!(
            "{STATE}typedef struct name_state {{\n    uint64_t words[{}];\n}} name_state;\n\n#define NAME_STATE_BYTES {bytes}u\n\
             NAME_ASSERT(sizeof(name_state) == NAME_STATE_BYTES, state_has_the_size_of_the_library);\n\
             struct name_aligned {{\n    char byte;\n    name_state state;\n}};\n\
             NAME_ASSERT(offsetof(struct name_aligned, state) == 8, state_has_the_alignment_of_the_library);\n",
            bytes / 8
        )
    }

    fn functions(&self) -> String {
        let empty = self.api.inputs.is_empty();
        let inputs = if empty { "" } else { INPUT_VALUES };
        format!("{FUNCTIONS}{inputs}")
    }
}

/// A struct with a field per item; C has none without fields.
fn structure(name: &str, doc: &str, items: &[Item], more: impl Iterator<Item = String>) -> String {
    let mut text = format!("\n/* {doc} */\ntypedef struct {name} {{\n");
    if items.is_empty() {
        text += "    char none; /* There are none; nobody reads this. */\n";
    }
    for (item, more) in items.iter().zip(more) {
        let doc = as_is(&item.doc.replace('`', "'")) + &more;
        let _ = writeln!(text, "{}", comment(&doc, "    "));
        let _ = writeln!(text, "    name_scalar {};", as_is(&field(&item.identifier)));
    }
    text + &format!("}} {name};\n")
}

/// An enumeration in 32 bits, whatever -fshort-enums says.
fn enumeration(name: &str, doc: &str, codes: &[Code], meanings: &[&str]) -> String {
    let value = |(Code { number, word }, meaning): (&Code, &&str)| {
        let word = word.to_string_lossy();
        format!("{}\n    NAME_{word} = {number}", comment(meaning.trim(), "    "))
    };
    let values: Vec<_> = codes.iter().zip(meanings).map(value).collect();
    format!("\n/* {doc} */\ntypedef int32_t {name};\nenum {{\n{}\n}};\n", values.join(",\n"))
}

#[cfg(test)]
mod tests {
    use std::process::Command;

    use super::super::names::{KEYWORDS_OF_C, KEYWORDS_OF_CPP, MACROS};
    use super::*;
    use crate::choice::{Choice, Wanted};
    use crate::emit::emit;
    use crate::item::items;
    use crate::tests::standard;
    use signorini_image::library::MACHINES;

    /// The header of a standard scene for this machine, with the sizes of a state and a report; `outputs` stand in it instead of
    /// the scene's own, where there are any.
    fn header_with(name: &str, state: usize, report: usize, outputs: &[&str]) -> String {
        let problem = standard(name, |_| ());
        let chosen = Choice::<f32>::new(&problem, Wanted::default()).expect("a model");
        let mut chosen = emit(&problem, &chosen).chosen;
        let (mut api, on) = (ModuleApi::new(&problem), &MACHINES[MACHINES.len() - 1]);
        if !outputs.is_empty() {
            let docs = outputs.iter().map(|_| "One of many.".to_owned());
            api.outputs = items(outputs.iter().copied(), docs);
            chosen.without_interval = vec![None; outputs.len()];
        }
        let library = Library { archive: Vec::new(), state, report };
        Header { name, api: &api, chosen: &chosen, library: &library, on }.text()
    }

    fn header(name: &str, state: usize, report: usize) -> String {
        header_with(name, state, report, &[])
    }

    fn compiled(header: &str) -> Result<(), String> {
        compiled_by("cc", "-std=c99", header)
    }

    /// What a compiler of the desk says of a text.
    fn compiled_by(compiler: &str, age: &str, text: &str) -> Result<(), String> {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("main"), text).expect("a file");
        let language = if compiler == "c++" { "c++" } else { "c" };
        let said = Command::new(compiler)
            .args([
                age,
                "-Wall",
                "-Wextra",
                "-Wpedantic",
                "-Werror",
                "-fsyntax-only",
                "-x",
                language,
                "main",
            ])
            .current_dir(folder.path())
            .output()
            .expect("a C compiler");
        match said.status.success() {
            true => Ok(()),
            false => Err(String::from_utf8_lossy(&said.stderr).into_owned()),
        }
    }

    /// The header behind all headers of C: no field is called as a keyword or a macro.
    #[test]
    fn it_holds_every_word_of_c_and_cpp() {
        let words = [KEYWORDS_OF_C, KEYWORDS_OF_CPP, MACROS].map(str::split_whitespace);
        let words: Vec<_> = words.into_iter().flatten().collect();
        assert!(words.len() > 150 && words.contains(&"co_await"), "{words:?}");
        // 12 numbers and words, and an interval for each output.
        let text = header_with("levee", 624, 48 + 4 * words.len(), &words);
        let before: String = [
            "assert", "complex", "errno", "math", "signal", "stdalign", "stdio", "stdlib",
            "threads", "time",
        ]
        .iter()
        .map(|name| format!("#if __has_include(<{name}.h>)\n#include <{name}.h>\n#endif\n"))
        .collect();
        for age in ["-std=gnu99", "-std=gnu17", "-std=gnu2x"] {
            assert_eq!(compiled_by("cc", age, &(before.clone() + &text)), Ok(()), "{age}");
        }
        let before = before.replace("complex.h", "iso646.h").replace("threads.h", "wchar.h");
        for age in ["-std=gnu++11", "-std=gnu++20", "-std=gnu++23"] {
            assert_eq!(compiled_by("c++", age, &(before.clone() + &text)), Ok(()), "{age}");
        }
    }

    #[test]
    fn it_is_c_and_asserts_the_sizes_of_the_library() {
        // Three outputs: 12 numbers and words of 4 bytes, and three intervals.
        let levee = header("levee", 624, 60);
        assert_eq!(compiled(&levee), Ok(()));
        assert!(compiled(&header("levee", 624, 64)).is_err_and(|why| why.contains("report_has")));
        assert!(
            compiled(&levee.replace("words[78]", "words[77]"))
                .is_err_and(|why| why.contains("state_has"))
        );
        for line in [
            "levee_error levee_init(levee_state *state);",
            "extern const levee_inputs levee_default_inputs;",
            "    LEVEE_INPUT_OUT_OF_RANGE = 5,",
            "     * contact set has none. */",
            "#define LEVEE_WORST_EXCHANGES 10u",
        ] {
            assert!(levee.lines().any(|of| of == line), "{line}");
        }
        assert!(!levee.contains("name_") && !levee.contains(MARK));
        assert_eq!(compiled(&header("slab", 8, 60)), Ok(()));
    }
}
