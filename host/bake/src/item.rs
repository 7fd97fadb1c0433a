//! The fields of `Inputs` and `Outputs` in a baked module: types, names, arrays.

use super::text::{array, identifiers};

/// A field of `Inputs` or `Outputs`.
#[derive(Debug, Clone)]
pub(crate) struct Item {
    pub name: String,
    pub identifier: String,
    pub doc: String,
}

/// Items of these names, each with its doc comment.
pub(super) fn items<'n>(
    names: impl Iterator<Item = &'n str> + Clone,
    docs: impl Iterator<Item = String>,
) -> Vec<Item> {
    let identifiers = identifiers(names.clone()).into_iter();
    names
        .zip(identifiers)
        .zip(docs)
        .map(|((name, identifier), doc)| Item { name: name.to_owned(), identifier, doc })
        .collect()
}

/// The type `name` with a field per item, laid out as C does it.
pub(super) fn structure(name: &str, doc: &str, items: &[Item]) -> String {
    let fields = items
        .iter()
        .map(|item| format!("    /// {}\n    pub {}: Scalar,\n", item.doc, item.identifier));
    let fields: String = fields.collect();
    let body = if fields.is_empty() { "{}".to_owned() } else { format!("{{\n{fields}}}") };
    format!(
        "\n/// {doc}\n#[derive(Debug, Clone, Copy, PartialEq)]\n#[repr(C)]\npub struct {name} {body}\n"
    )
}

/// The constant with the items' names; `count` is the constant that tells how many they are.
pub(super) fn names(count: &str, items: &[Item]) -> String {
    let names: Vec<_> = items.iter().map(|item| item.name.as_str()).collect();
    let doc = "    /// Their names in the scene.\n";
    format!("{doc}    pub const NAMES: [&str; {count}] = {};\n", array(&names, 4))
}

/// Their values from an array.
pub(super) fn from_array(count: &str, items: &[Item]) -> String {
    let pattern = list(items);
    let fields = braced("Self", items.iter().map(|item| item.identifier.clone()));
    format!(
        "
    /// From values in the order of the scene.
    pub fn from_array({pattern}: [Scalar; {count}]) -> Self {{
        {fields}
    }}
"
    )
}

/// Their values as an array.
pub(super) fn to_array(count: &str, items: &[Item]) -> String {
    let (bound, values) =
        (braced("Self", items.iter().map(|item| item.identifier.clone())), list(items));
    format!(
        "
    /// The values in the order of the scene.
    pub fn to_array(self) -> [Scalar; {count}] {{
        let {bound} = self;
        {values}
    }}
"
    )
}

/// The factors of a model's columns: the constant 1, and the inputs.
pub(super) fn terms(items: &[Item]) -> String {
    let fields = || items.iter().map(|item| item.identifier.clone());
    let terms: Vec<_> = std::iter::once("1.0".to_owned()).chain(fields()).collect();
    format!(
        "
impl controller::Inputs<Scalar> for Inputs {{
    type Terms = [Scalar; INPUTS + 1];

    fn terms(self) -> Self::Terms {{
        let {} = self;
        [{}]
    }}
}}
",
        braced("Self", fields()),
        terms.join(", ")
    )
}

/// Outputs read off an answer, each by a number that is a constant.
pub(super) fn read(items: &[Item]) -> String {
    let numbered = items.iter().enumerate();
    let values = numbered.map(|(at, item)| format!("{}: of.value({at})?", item.identifier));
    format!(
        "
impl controller::Outputs<Scalar> for Outputs {{
    #[inline(always)]
    fn read({}: &impl controller::Reading<Scalar>) -> Result<Self, Error> {{
        Ok({})
    }}
}}
",
        if items.is_empty() { "_" } else { "of" },
        braced("Self", values)
    )
}

fn list(items: &[Item]) -> String {
    let all: Vec<_> = items.iter().map(|item| item.identifier.as_str()).collect();
    format!("[{}]", all.join(", "))
}

/// A record or pattern in braces.
pub(super) fn braced(name: &str, fields: impl Iterator<Item = String>) -> String {
    let fields: Vec<_> = fields.collect();
    if fields.is_empty() {
        format!("{name} {{}}")
    } else {
        format!("{name} {{ {} }}", fields.join(", "))
    }
}
