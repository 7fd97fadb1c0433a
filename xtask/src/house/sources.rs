//! Source files as syntax, without their tests.

use std::fs;
use std::path::Path;

use signorini_image::cargo::root;
use syn::visit_mut::VisitMut;

/// Folders that hold the project's programs, and no tests of other programs.
const FOLDERS: [&str; 2] = ["kernel", "host"];
/// Folders of them that no rule is about.
const APART: [&str; 4] = ["tests", "benches", "examples", "target"];

/// A source file.
#[derive(Debug, Clone)]
pub struct Source {
    /// Its path from the root.
    pub path: String,
    /// Its syntax, without items that only tests have.
    pub syntax: syn::File,
}

impl Source {
    /// All source files of kernel and host.
    pub fn all() -> Result<Vec<Self>, String> {
        let mut sources = Vec::new();
        FOLDERS.iter().try_for_each(|folder| read(&root().join(folder), &mut sources))?;
        Ok(sources)
    }

    /// The file of this path with this text.
    pub fn parse(path: &str, text: &str) -> Result<Self, String> {
        let mut syntax = syn::parse_file(text).map_err(|error| format!("{path}: {error}"))?;
        WithoutTests.visit_file_mut(&mut syntax);
        Ok(Self { path: path.to_owned(), syntax })
    }
}

/// Those found, where there are more than one.
pub fn beyond_one(found: Vec<String>) -> Vec<String> {
    if found.len() > 1 { found } else { Vec::new() }
}

/// Looks through all files; `found` takes what a visitor has found in each, by the file's path.
pub fn found_in<V: VisitMut + Default>(
    sources: &[Source],
    found: impl Fn(V) -> Vec<String>,
) -> Vec<String> {
    let of = |source: &Source| {
        let mut visitor = V::default();
        visitor.visit_file_mut(&mut source.syntax.clone());
        let names = found(visitor).into_iter();
        names.map(|name| format!("{}: {name}", source.path)).collect::<Vec<_>>()
    };
    sources.iter().flat_map(of).collect()
}

/// Reads what lies below a folder.
fn read(folder: &Path, sources: &mut Vec<Source>) -> Result<(), String> {
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    for entry in fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        let name = path.file_stem().unwrap_or_default();
        if APART.iter().any(|apart| name == *apart) {
            continue;
        }
        if path.is_dir() {
            read(&path, sources)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(&path).map_err(failed)?;
            let from_root = path.strip_prefix(root()).unwrap_or(&path).display().to_string();
            sources.push(Source::parse(&from_root, &text)?);
        }
    }
    Ok(())
}

/// Removes items that only tests have.
struct WithoutTests;

impl VisitMut for WithoutTests {
    fn visit_file_mut(&mut self, file: &mut syn::File) {
        file.items.retain(|item| !is_test(item));
        syn::visit_mut::visit_file_mut(self, file);
    }

    fn visit_item_mod_mut(&mut self, module: &mut syn::ItemMod) {
        if let Some((_, items)) = &mut module.content {
            items.retain(|item| !is_test(item));
        }
        syn::visit_mut::visit_item_mod_mut(self, module);
    }
}

/// Whether an item stands behind `#[cfg(test)]`.
fn is_test(item: &syn::Item) -> bool {
    let attributes = match item {
        syn::Item::Mod(item) => &item.attrs,
        syn::Item::Fn(item) => &item.attrs,
        syn::Item::Impl(item) => &item.attrs,
        syn::Item::Struct(item) => &item.attrs,
        syn::Item::Const(item) => &item.attrs,
        _ => return false,
    };
    attributes.iter().any(|attribute| {
        let list = attribute.path().is_ident("cfg").then_some(&attribute.meta);
        list.is_some_and(
            |meta| matches!(meta, syn::Meta::List(list) if list.tokens.to_string() == "test"),
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tests_within_a_file_are_left_out() {
        let text =
            "struct A;\n#[cfg(test)]\nstruct B;\nmod c { #[cfg(test)] mod d { } fn e() {} }\n";
        let source = Source::parse("a.rs", text).expect("syntax");
        let [syn::Item::Struct(_), syn::Item::Mod(module)] = &source.syntax.items[..] else {
            panic!("{} items", source.syntax.items.len());
        };
        assert_eq!(module.content.as_ref().map(|(_, items)| items.len()), Some(1));
        assert!(Source::parse("a.rs", "struct").is_err_and(|why| why.starts_with("a.rs: ")));
    }
}
