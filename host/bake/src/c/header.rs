//! The header of a controller: C99 and C++, whatever warnings are on.

use std::fmt::Write as _;

use signorini_kernel::device::codes::{Bounded, EndedCode, Refusal};

use super::names::field;
use crate::item::Item;
use crate::module_api::{ModuleApi, UNITS};
use signorini_image::chosen::Chosen;
use signorini_image::library::{Library, Machine};

/// What the header is of.
pub(super) struct Header<'a> {
    pub name: &'a str,
    pub api: &'a ModuleApi,
    pub chosen: &'a Chosen,
    pub library: &'a Library,
    pub on: &'a Machine,
}

impl Header<'_> {
    /// All of it.
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
            as_is(self.api.file()),
            self.api.hash(),
            env!("CARGO_PKG_VERSION"),
        );
        let title = as_is(self.api.title());
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
            self.api.hash(),
            self.api.input_items().len(),
            self.api.output_items().len()
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
        let ranges = self.api.given_ranges().iter();
        let ends = ranges.map(|[lo, hi]| match (lo.is_finite(), hi.is_finite()) {
            (false, false) => " Any finite value.".to_owned(),
            _ => format!(" Range {lo} to {hi}: a tick refuses what lies outside."),
        });
        let inputs =
            structure("name_inputs", "What the controller sets.", self.api.input_items(), ends);
        let none = std::iter::repeat_with(String::new);
        inputs
            + &structure(
                "name_outputs",
                "What the controller reads.",
                self.api.output_items(),
                none,
            )
    }

    fn codes(&self) -> String {
        let refusals = Refusal::ALL.iter().map(|of| (of.word(), *of as i32, of.meaning()));
        let ended = EndedCode::ALL.iter().map(|of| (of.word(), *of as i32, of.meaning()));
        let bounded = Bounded::ALL.iter().map(|of| (of.word(), *of as i32, of.meaning()));
        enumeration(
            "name_error",
            "Why a call has no answer. The last answer stays what it was.",
            refusals,
        ) + &enumeration("name_status", "What ended a tick.", ended)
            + &enumeration("name_bounded", "Whether there is an error bound.", bounded)
    }

    fn report(&self) -> String {
        let has_outputs = !self.api.output_items().is_empty();
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
        let empty = self.api.input_items().is_empty();
        let inputs = if empty { "" } else { INPUT_VALUES };
        format!("{FUNCTIONS}{inputs}")
    }
}

/// The scene's own words, in which nothing is replaced by its name.
fn as_is(text: &str) -> String {
    text.replace("NAME", &format!("N{MARK}AME")).replace("name_", &format!("n{MARK}ame_"))
}

/// What keeps the scene's words apart from the header's; it is taken out at the end.
const MARK: &str = "\u{0}";

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
fn enumeration<'w>(
    name: &str,
    doc: &str,
    values: impl Iterator<Item = (&'w std::ffi::CStr, i32, &'static str)>,
) -> String {
    let values: Vec<_> = values
        .map(|(word, code, meaning)| {
            let word = word.to_string_lossy();
            format!("{}\n    NAME_{word} = {code}", comment(meaning.trim(), "    "))
        })
        .collect();
    format!("\n/* {doc} */\ntypedef int32_t {name};\nenum {{\n{}\n}};\n", values.join(",\n"))
}

/// A comment in lines.
fn comment(text: &str, indent: &str) -> String {
    let lines = wrapped(text, &format!("{indent} * "));
    let first = lines.trim_start().trim_start_matches("* ");
    format!("{indent}/* {first} */")
}

/// Text in lines with a margin, and nothing in it that ends a comment, begins another, or is a trigraph.
fn wrapped(text: &str, margin: &str) -> String {
    let safe = text.replace("*/", "* /").replace("/*", "/ *").replace("??", "? ?");
    let (mut lines, mut line) = (Vec::new(), String::new());
    for word in safe.split_whitespace() {
        if !line.is_empty() && line.chars().count() + word.chars().count() > WIDTH {
            lines.push(format!("{margin}{}", line.trim_end()));
            line.clear();
        }
        line += word;
        line.push(' ');
    }
    lines.push(format!("{margin}{}", line.trim_end()));
    lines.join("\n")
}

const WIDTH: usize = 110;

const SYMBOLS: &str = "On contact edges u is at least the gap ψ and the flux σ·n is at least q; one of both holds as an equation. Where the flux \
                       has a limit u may fall below ψ. The error bound is in the energy norm, in which the errors of u and σ are \
                       weighed together; plus_minus is in the unit of each output.";

const USE: &str = "Memory is the caller's: one name_state for each controller of this kind that runs, however many. Nothing is \
                   allocated, nothing is static, and no function blocks. Calls with different states may run at the same time; \
                   two calls with one state may not, so that an interrupt must not tick a state in the middle of its tick.";

/// An assertion of the compiler, with whatever the language has for it.
const ASSERT: &str = "
#if defined(__cplusplus) && __cplusplus >= 201103L
#define NAME_ASSERT(what, why) static_assert(what, #why)
#elif !defined(__cplusplus) && defined(__STDC_VERSION__) && __STDC_VERSION__ >= 201112L
#define NAME_ASSERT(what, why) _Static_assert(what, #why)
#else
#define NAME_ASSERT(what, why) typedef char name_##why[(what) ? 1 : -1]
#endif

#ifdef __cplusplus
extern \"C\" {
#endif

";

const REPORT: &str = "
/* What a tick came to. Where there is no bound, all numbers below `pulled` are infinite. */
typedef struct name_report {
    /* What ended the tick. */
    name_status status;
    /* Whether there is a bound, or why there is none. */
    name_bounded bounded;
    /* Edges that changed sides, one by one, on the way to the exact solution. */
    uint32_t exchanges;
    /* Sweeps; 0 where the exact method came to its end. */
    uint32_t sweeps;
    /* Contact edges that touch. */
    uint32_t active;
    /* The edge that would be pulled at, where `bounded` says so; else 0. */
    uint32_t pulled;
    /* The error in the energy norm is at most this. */
    name_scalar bound;
    /* Parts of it: the duality gap (no gap of the scene), what more sweeps would remove, data between the points, rounding. */
    name_scalar gap;
    name_scalar algebraic;
    name_scalar oscillation;
    name_scalar rounding;
    /* A bound on the error of the edge means, in the energy norm cell by cell. */
    name_scalar of_u;
";

const PLUS_MINUS: &str = "    /* How far each output may be from its value for the exact solution, in its own unit; infinite where nothing is
     * guaranteed. */
    name_outputs plus_minus;
";

const STATE: &str = "
/* The memory of one controller. It depends on no address: it may be copied, kept over a reset, put elsewhere, or written to a file.
 * Bytes between its fields may be any, so that two states that are alike may differ in them.
 * To keep one: name_seal_state, then take its bytes. To go on with it: put the bytes back, name_check_state, tick.
 * A tick trusts its state. Where memory may have been damaged, check first: a tick on damaged bytes may read anywhere. */
";

const FUNCTIONS: &str = "
/* Makes a state: before the first tick, and sealed. */
name_error name_init(name_state *state);

/* Answers for these inputs, from where the last tick ended. `outputs` and `report` may be null. Where a tick is refused neither
 * changes and the next one begins where the last answer did; name_culprit tells which input it was for. A state that is refused
 * an input stays sealed. NAME_OK says that there is an
 * answer; how good it is, say `status` and `bounded` of the report. */
name_error name_tick(name_state *state, const name_inputs *inputs, name_outputs *outputs, name_report *report);

/* When a tick ends, where it has sweeps: the exact method of a condensed model needs no limits. */
typedef struct name_limits {
    /* The error bound that is small enough; 0 leaves it to the others. */
    name_scalar error;
    /* What the algebraic part may be of the whole; 0 leaves it to the others. */
    name_scalar share;
    /* Most sweeps. */
    uint32_t sweeps;
} name_limits;

/* Time left, in a unit of the caller's. A step is begun only while there is time for it and a certificate after it. */
typedef struct name_deadline {
    /* Time left now; called with `context`. Null: there is no deadline. */
    uint32_t (*remaining)(void *context);
    void *context;
    /* Most that a sweep or an exchange takes, and most that the certificate takes. */
    uint32_t sweep;
    uint32_t certificate;
} name_deadline;

/* The same with limits and until a deadline; null is: the library's own limits, no deadline. Whatever ends the tick, the answer
 * is feasible and the report says how wrong it can be. It has code and constants of its own: a program that calls this tick alone,
 * or the other alone, has them in flash once. */
name_error name_tick_within(name_state *state, const name_inputs *inputs, const name_limits *limits,
                            const name_deadline *deadline, name_outputs *outputs, name_report *report);

/* Forgets all ticks: the next one is the first again. The state is sealed. */
name_error name_reset(name_state *state);

/* Puts the checksum into a state, so that name_check_state can tell it from any other bytes. A tick breaks the seal. */
name_error name_seal_state(name_state *state);

/* NAME_OK where the bytes are those of a state that was sealed, by a library of this scene, model and version: else
 * NAME_FOREIGN_STATE, NAME_UNSEALED_STATE or NAME_DAMAGED_STATE. It may be asked of any bytes. */
name_error name_check_state(const name_state *state);

/* The number of what the last refused tick was refused for, as the error says; inputs count from 0 in the order of their struct. */
uint32_t name_culprit(const name_state *state);

/* Moves inputs to the nearest values within their ranges, for a caller who wants no refusal. What is not a number
 * stays so, and is refused. */
void name_clamp(name_inputs *inputs);

/* The words behind NAME_ above. */
const char *name_error_name(name_error error);
const char *name_status_name(name_status status);
const char *name_bounded_name(name_bounded bounded);
";

const INPUT_VALUES: &str = "
/* The values that the scene gives, and the ends of the ranges, infinite where there are none. */
extern const name_inputs name_default_inputs;
extern const name_inputs name_least_inputs;
extern const name_inputs name_most_inputs;
";

const CLOSING: &str = "
#ifdef __cplusplus
}
#endif

#endif
";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_text_ends_a_comment() {
        let text = comment("u = 2*/x and /* more ??/", "    ");
        assert_eq!(text, "    /* u = 2* /x and / * more ? ?/ */");
    }

    #[test]
    fn long_comments_have_a_margin() {
        let text = comment(&"word ".repeat(40), "");
        let lines: Vec<_> = text.lines().collect();
        assert!(
            lines.len() == 2 && lines[0].starts_with("/* word") && lines[1].starts_with(" * word"),
            "{text}"
        );
        assert!(lines.iter().all(|line| line.len() < 120));
    }
}
