//! The header of a controller: C99 and C++, whatever warnings are on.

use std::fmt::Write as _;

use signorini_device::codes::Refusal;
use signorini_kernel::Verdict;
use signorini_kernel::codes::Code;
use signorini_kernel::report::Ended;

use super::comment::{MARK, as_is, comment, wrapped};
use super::names::field;
use super::words::{
    ASSERT, CLOSING, FUNCTIONS, IN_TIME, INPUT_VALUES, MARKS, PLUS_MINUS, REPORT, SAVED, STATE,
    SYMBOLS, USE,
};
use crate::item::Item;
use crate::module_api::{ModuleApi, STEPS, UNITS};
use signorini_image::chosen::Chosen;
use signorini_image::library::{Library, Machine, exports};

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
        let steps = STEPS.replace("STEP", "NAME_STEP").replace("`window`", "name_window");
        let steps = self.api.step.map(|_| steps);
        let paragraphs = [title.as_str(), &about, UNITS].into_iter().chain(steps.as_deref());
        let paragraphs: Vec<_> = paragraphs.chain([SYMBOLS, USE]).collect();
        format!(
            "/*\n{}\n */\n#ifndef NAME_H\n#define NAME_H\n\n#include <stddef.h>\n#include <stdint.h>\n\n",
            paragraphs.iter().map(|text| wrapped(text, " * ")).collect::<Vec<_>>().join("\n *\n")
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
        if let Some(step) = self.api.step {
            let _ = writeln!(
                text,
                "/* The length of a step: each tick is one. */\n#define NAME_STEP {step:?}"
            );
        }
        let worst = &self.chosen.worst_case;
        if let (true, Some(exchanges)) = (worst.proven, worst.exchanges) {
            let all = if self.chosen.memory > 0 { "inputs" } else { "inputs within their ranges" };
            let _ = writeln!(
                text,
                "\n/* What no tick exceeds, for all {all} and every state: proved. */\n\
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
        let saved = self.library.saved.map(|bytes| memory("saved", SAVED, bytes));
        memory("state", STATE, self.library.state) + &saved.unwrap_or_default()
    }

    /// Definitions by which a header and the library of another bake do not link.
    fn marks(&self) -> String {
        let mark = &self.library.mark;
        let define =
            |own: &str| format!("#define name_{own} name_{}\n", as_is(&format!("{own}{mark}")));
        let names: String = exports(self.library.saved.is_some()).into_iter().map(define).collect();
        format!("{MARKS}{names}")
    }

    fn functions(&self) -> String {
        let empty = self.api.inputs.is_empty();
        let inputs = if empty { "" } else { INPUT_VALUES };
        let in_time = if self.library.saved.is_some() { IN_TIME } else { "" };
        format!("{}{FUNCTIONS}{in_time}{inputs}", self.marks())
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

/// An array of words with the size and the alignment of a struct of the library.
fn memory(name: &str, doc: &str, bytes: usize) -> String {
    let (words, constant) = (bytes / 8, format!("NAME_{}_BYTES", name.to_uppercase()));
    format!(
        "{doc}typedef struct name_{name} {{\n    uint64_t words[{words}];\n}} name_{name};\n\n#define {constant} {bytes}u\n\
         NAME_ASSERT(sizeof(name_{name}) == {constant}, {name}_has_the_size_of_the_library);\n\
         struct name_aligned_{name} {{\n    char byte;\n    name_{name} words;\n}};\n\
         NAME_ASSERT(offsetof(struct name_aligned_{name}, words) == 8, {name}_has_the_alignment_of_the_library);\n"
    )
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
mod tests;
