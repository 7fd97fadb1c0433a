//! The list of keys, in the order in which the page has them.

use super::Value as V;
use super::{Key, Section};
use crate::scene::control::FIELDS;
use crate::scene::setting::{
    CELLS, ELEMENTS, FINEST, MATHS, MODELS, MOST_STATES, SCALARS, SOLVERS, STARTS,
};

const fn key(
    name: &'static str,
    value: V,
    meaning: &'static str,
    unit: &'static str,
    default: Option<&'static str>,
) -> Key {
    Key { name, value, meaning, unit, default }
}

const fn table(header: &'static str, what: &'static str, keys: &'static [Key]) -> Section {
    Section { header, kind: None, what, about: "", keys }
}

const fn kind(
    header: &'static str,
    kind: &'static str,
    what: &'static str,
    about: &'static str,
    keys: &'static [Key],
) -> Section {
    Section { header, kind: Some(kind), what, about, keys }
}

const BOUNDARY: &str = "boundary.NAME";
const OUTPUT: &str = "output.NAME";

/// The words of choices.
macro_rules! words {
    ($choices:expr) => {
        V::Word(|| $choices.iter().map(|(word, _)| *word).collect())
    };
}

const REQUIRED: Option<&str> = None;
const NONE: Option<&str> = Some("none");

const UNIT: Key = key(
    "unit",
    V::Unit,
    "a text that terminal, pictures and a baked module write beside it, such as \"m2/s\"",
    "",
    NONE,
);
const ALL_CONTACT: Option<&str> = Some("all contact");
const OF_CONTACT: Key =
    key("of", V::Names, "a contact boundary, or a list of such", "", ALL_CONTACT);

/// Every table with its keys.
#[rustfmt::skip] // A table.
pub const SECTIONS: &[Section] = &[
    table("", "the scene", &[
        key("title", V::Text, "what to call the scene", "", Some("the file's name")),
        key("mesh", V::Text, "the mesh file, relative to the scene", "", REQUIRED),
        key("extends", V::Text, "the scene that this fragment changes: it has `title` and `[setting]` alone", "", NONE),
    ]),
    table("material.NAME", "a material", &[
        key("conductivity", V::Tensor, "A, a scalar or [axx, axy, ayy], in x and y", "conductivity", REQUIRED),
        key("capacity", V::Expression, "c ≥ 0, what a unit of u stores per area, in x and y; its mean over each cell counts ([steps in time](time.md))", "conductivity · s/length²", Some("0")),
    ]),
    table("source", "the source", &[
        key("f", V::Expression, "f, what is produced inside, in x, y and t; `[source]` may be left out", "flux per length", REQUIRED),
    ]),
    kind(BOUNDARY, "dirichlet", "a dirichlet boundary", "u is given", &[
        key("value", V::Expression, "u = value, in x, y and t", "u", REQUIRED),
    ]),
    kind(BOUNDARY, "neumann", "a neumann boundary", "the flux is given", &[
        key("flux", V::Expression, "σ·n = flux, outward, in x, y and t", "flux", REQUIRED),
    ]),
    kind(BOUNDARY, "robin", "a robin boundary", "heat passes to what is around", &[
        key("coefficient", V::Expression, "σ·n = coefficient (ambient − u), at least 0, in x and y", "flux per u", REQUIRED),
        key("ambient", V::Expression, "what u relaxes to, in x, y and t", "u", REQUIRED),
    ]),
    kind(BOUNDARY, "contact", "a contact boundary", "u ≥ gap: a heater that only heats, a face that only drains", &[
        key("gap", V::Expression, "u ≥ gap, and σ·n = flux where u > gap; in x, y and t", "u", Some("0")),
        key("flux", V::End, "σ·n ≥ flux, or \"-inf\" for no least flux; in x, y and t", "flux", Some("0")),
        key("limit", V::End, "σ·n ≤ limit, and σ·n = limit where u < gap; in x, y and t", "flux", Some("\"inf\": u ≥ gap")),
    ]),
    table("input.NAME", "an input", &[
        key("of", V::Name, "the boundary that the input acts on, or `source`", "", REQUIRED),
        key("field", words!(FIELDS), "what it adds to", "", REQUIRED),
        key("pattern", V::Expression, "what it adds for the value 1, in x and y", "that of the field", REQUIRED),
        key("default", V::Number, "its value until the controller sets another", "", Some("0")),
        key("range", V::Pair, "`[lo, hi]`: the values that it may take; others are refused ([what ranges buy](firmware.md#ranges)). A coefficient needs one", "", Some("any")),
        key("unit", V::Unit, "a text that a baked module's documentation has for it, such as \"m/s\"", "", NONE),
    ]),
    kind(OUTPUT, "flux", "a flux", "∫σ·n over boundaries: heat that comes in, water that goes out", &[
        key("of", V::Names, "its boundary, or a list of boundaries: the sum over these, with one interval", "", REQUIRED), UNIT,
    ]),
    kind(OUTPUT, "force", "a force", "∫(σ·n − flux) over contact, never below 0", &[OF_CONTACT, UNIT]),
    kind(OUTPUT, "length", "a length", "how much of contact touches", &[OF_CONTACT, UNIT]),
    kind(OUTPUT, "saturated", "a saturated length", "how much of contact is at its limit", &[OF_CONTACT, UNIT]),
    kind(OUTPUT, "probe", "a probe", "u at a point", &[
        key("at", V::Pair, "the point [x, y]", "length", REQUIRED), UNIT,
    ]),
    kind(OUTPUT, "mean", "a mean", "the mean of u over a boundary or a material", &[
        key("of", V::Name, "its boundary or, where none has the name, its material", "", REQUIRED), UNIT,
    ]),
    kind(OUTPUT, "content", "a content", "∫ capacity · u", &[
        key("of", V::Names, "a material, or a list of materials", "", Some("the domain")), UNIT,
    ]),
    kind(OUTPUT, "bound", "a bound", "the error bound", &[UNIT]),
    kind(OUTPUT, "window", "a window", "the error bound over time", &[UNIT]),
    table("target", "the target", &[
        key("ram", V::Bytes, "RAM that the controller may take", "bytes", Some("no limit")),
        key("flash", V::Bytes, "flash that it may take", "bytes", Some("no limit")),
        key("tick", V::Positive, "the time of a tick", "s", Some("no limit")),
        key("clock", V::Positive, "the processor's clock", "Hz", Some("no limit")),
    ]),
    table("time", "the time", &[
        key("step", V::Positive, "time from tick to tick", "s", REQUIRED),
        key("end", V::Positive, "time of the last tick; required where no material has a capacity", "s", NONE),
        key("initial", V::Expression, "u at the start of steps in time: \"steady\", or an expression in x and y", "u", Some("\"steady\"")),
    ]),
    table("exact", "the exact solution", &[
        key("u", V::Expression, "the exact solution, in x, y and t: errors are printed beside it, and a warning where they are above the bound", "u", REQUIRED),
        key("gradient", V::Gradient, "its gradient [∂u/∂x, ∂u/∂y]", "u per length", REQUIRED),
    ]),
    table("setting", "the setting", &[
        key("refine", V::Whole(0, FINEST), "uniform refinements of the mesh, 6 at most", "", Some("0")),
        key("error", V::Goal, "refine the mesh until the error bound is at most this for all inputs ([how](accuracy.md#the-firmware-that-an-error-takes)): an energy norm, or a part of it such as \"5%\"; not beside `refine`", "[`energy_norm`](accuracy.md#two-functions-two-bounds)", NONE),
        key("cells", words!(CELLS), "`triangles` cuts quads, `quads` pairs triangles", "", Some("as in the mesh")),
        key("element", words!(ELEMENTS), "`parametric`, or `nonparametric` for full rates on quads of any shape", "", Some("parametric")),
        key("scalar", words!(SCALARS), "`f32`, `f64`, or `f32+f64`: sweeps in f32 on residuals in f64", "", Some("f64; `bake`: f32")),
        key("math", words!(MATHS), "the square root of the search for ω", "", Some("libm")),
        key("model", words!(MODELS), "`full` or `condensed`", "", Some("full; `bake`: the smaller")),
        key("solver", words!(SOLVERS), "`auto`, `sweeps`, `factor` (full), `exact` (condensed)", "", Some("auto")),
        key("start", words!(STARTS), "`warm` starts a tick from the one before, `cold` starts each anew", "", Some("warm")),
        key("omega", V::Omega, "the relaxation factor, inside (0, 2), or `auto`", "", Some("auto")),
        key("sweeps", V::Whole(1, u32::MAX), "sweep exactly so many times", "", NONE),
        key("share", V::Share, "sweep until this share of the error bound is left to sweeps, inside (0, 1)", "", Some("0.01")),
        key("certificate", V::Boolean, "whether there is an error bound", "", Some("true")),
        key("memory", V::Whole(0, MOST_STATES), "states of a condensed model that steps in time, at most; asks for it ([steps in time](time.md#condensed-controllers))", "", Some("as many as its bound needs")),
    ]),
];
