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

/// Their names, and their values from an array and as one; `count` is the constant that tells how many they are.
pub(super) fn arrays(count: &str, items: &[Item]) -> String {
    let names: Vec<_> = items.iter().map(|item| item.name.as_str()).collect();
    let names = array(&names, 4);
    let identifiers: Vec<_> = items.iter().map(|item| item.identifier.as_str()).collect();
    let values = format!("[{}]", identifiers.join(", "));
    let fields = fields(items);
    format!(
        "    /// Their names in the scene.
    pub const NAMES: [&str; {count}] = {names};

    /// From values in the order of the scene.
    pub fn from_array({values}: [Scalar; {count}]) -> Self {{
        {fields}
    }}

    /// The values in the order of the scene.
    pub fn to_array(self) -> [Scalar; {count}] {{
        let {fields} = self;
        {values}
    }}
"
    )
}

/// The factors of a model's columns: the constant 1, and the inputs.
pub(super) fn terms(items: &[Item]) -> String {
    let terms = items.iter().map(|item| format!(", {}", item.identifier)).collect::<String>();
    format!(
        "
impl controller::Inputs<Scalar> for Inputs {{
    type Terms = [Scalar; INPUTS + 1];

    fn terms(self) -> Self::Terms {{
        let {} = self;
        [1.0{terms}]
    }}
}}
",
        fields(items)
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
        braced(values)
    )
}

/// All fields by their names.
fn fields(items: &[Item]) -> String {
    braced(items.iter().map(|item| item.identifier.clone()))
}

/// A record or pattern in braces.
pub(super) fn braced(fields: impl Iterator<Item = String>) -> String {
    match fields.collect::<Vec<_>>().join(", ").as_str() {
        "" => "Self {}".to_owned(),
        fields => format!("Self {{ {fields} }}"),
    }
}
