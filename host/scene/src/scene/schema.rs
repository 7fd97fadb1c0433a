//! The JSON Schema of scene files, for editors that complete keys and underline mistakes.
//!
//! It is made of the list of [keys](super::keys) and of what excludes each other in a setting. Names of groups and the
//! variables of expressions it does not see; `signorini check` does.

use serde_json::{Map, Value as Json, json};

use super::exclusions;
use super::keys::{Key, SECTIONS, Section, Value};
use super::read::MOST_TABLES;

/// The name of its file beside a scene.
pub const FILE: &str = "signorini.schema.json";

/// The schema as text.
pub fn text() -> String {
    format!("{:#}\n", schema())
}

/// The schema: a scene that stands on its own, or a fragment.
pub fn schema() -> Json {
    let (top, fragment): (Vec<_>, Vec<_>) =
        top_keys().partition(|(name, _)| !["extends", "setting"].contains(&name.as_str()));
    let title = top.iter().filter(|(name, _)| name == "title").cloned();
    let setting = tables().filter(|(name, _)| name == "setting");
    let fragment: Map<_, _> = fragment.into_iter().chain(title).chain(setting).collect();
    let scene: Map<_, _> = top.into_iter().chain(tables()).collect();
    json!({
        "$schema": "http://json-schema.org/draft-07/schema#",
        "$id": format!("signorini-scene-{}", env!("CARGO_PKG_VERSION")),
        "title": "a scene of signorini",
        "description": "docs/scene.md describes it; `signorini check SCENE` tells all that is wrong with one",
        "oneOf": [
            with_rules(object(scene, &["mesh", "material", "boundary"]), json!([ended()])),
            object(fragment, &["extends"]),
        ],
    })
}

/// What stands above all tables.
fn top_keys() -> impl Iterator<Item = (String, Json)> {
    Section::all("").flat_map(properties)
}

/// The tables: those with names of the user's hold a table per name.
fn tables() -> impl Iterator<Item = (String, Json)> {
    super::keys::tables().into_iter().map(|table| {
        let own: Vec<_> = SECTIONS.iter().filter(|section| section.table() == table).collect();
        let kinds = own.iter().map(|section| of_section(section));
        let one = match &kinds.collect::<Vec<_>>()[..] {
            [one] => one.clone(),
            kinds => json!({ "oneOf": kinds }),
        };
        let one = match table {
            "setting" => with_rules(one, exclusions::in_schema()),
            "input" => with_rules(one, json!([ranged()])),
            _ => one,
        };
        let is_named = own.iter().any(|section| section.is_named());
        (table.to_owned(), if is_named { named(one) } else { one })
    })
}

/// What else holds of a table.
fn with_rules(mut table: Json, rules: Json) -> Json {
    table["allOf"] = rules;
    table
}

/// An input of a coefficient has a range.
fn ranged() -> Json {
    let acts = json!({ "properties": { "field": { "const": "coefficient" } } });
    json!({ "anyOf": [{ "not": acts }, { "required": ["range"] }] })
}

/// The time has an end, where no material has a capacity.
fn ended() -> Json {
    let stores = json!({ "required": ["capacity"] });
    let materials = json!({ "not": { "additionalProperties": { "not": stores } } });
    json!({ "anyOf": [
        { "properties": { "time": { "required": ["end"] } } },
        { "properties": { "material": materials } },
    ] })
}

fn named(one: Json) -> Json {
    json!({ "type": "object", "additionalProperties": one, "minProperties": 1, "maxProperties": MOST_TABLES })
}

fn of_section(section: &Section) -> Json {
    let required = section.keys.iter().filter(|key| key.default.is_none()).map(|key| key.name);
    let required: Vec<_> = section.kind.map(|_| "kind").into_iter().chain(required).collect();
    let kind = section.kind.map(|kind| ("kind".to_owned(), json!({ "const": kind })));
    object(kind.into_iter().chain(properties(section)).collect(), &required)
}

fn object(properties: Map<String, Json>, required: &[&str]) -> Json {
    json!({
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": false,
    })
}

fn properties(section: &Section) -> impl Iterator<Item = (String, Json)> {
    section.keys.iter().map(|key| (key.name.to_owned(), described(key)))
}

/// The values that a key may have, with what it means.
fn described(key: &Key) -> Json {
    let mut values = values(key.value);
    values["description"] = key.described().into();
    values
}

fn values(value: Value) -> Json {
    let expression = || json!({ "type": ["number", "string"], "not": { "const": "?" } });
    let text = || json!({ "type": "string", "minLength": 1, "not": { "const": "?" } });
    let pair =
        |items: Json| json!({ "type": "array", "items": items, "minItems": 2, "maxItems": 2 });
    match value {
        Value::Text | Value::Name => text(),
        Value::Unit => {
            json!({ "type": "string", "minLength": 1, "maxLength": 24, "not": { "const": "?" } })
        }
        Value::Word(words) => json!({ "enum": words() }),
        Value::Expression | Value::End => expression(),
        Value::Tensor => json!({ "anyOf": [
            expression(),
            { "type": "array", "items": expression(), "minItems": 1, "maxItems": 1 },
            { "type": "array", "items": expression(), "minItems": 3, "maxItems": 3 },
        ] }),
        Value::Gradient => pair(expression()),
        Value::Pair => pair(json!({ "type": "number" })),
        Value::Number => json!({ "type": "number" }),
        Value::Positive => json!({ "type": "number", "exclusiveMinimum": 0 }),
        Value::Share => json!({ "type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 1 }),
        Value::Whole(low, high) => json!({ "type": "integer", "minimum": low, "maximum": high }),
        Value::Bytes => json!({ "type": "integer", "minimum": 1 }),
        Value::Boolean => json!({ "type": "boolean" }),
        Value::Names => json!({ "anyOf": [
            text(),
            { "type": "array", "items": text(), "minItems": 1, "uniqueItems": true },
        ] }),
        Value::Omega => json!({ "anyOf": [
            { "const": "auto" },
            { "type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 2 },
        ] }),
        Value::Goal => json!({ "anyOf": [
            { "type": "number", "exclusiveMinimum": 0 },
            { "type": "string", "pattern": "^[0-9.eE+-]+ *%?$" },
        ] }),
    }
}
