//! Source files as rules see them: structs, traits, functions, texts and names, without those of tests.

use std::collections::BTreeSet;

use signorini_image::cargo::root;
use signorini_image::files;
use syn::visit_mut::{self, VisitMut};

/// Folders that hold the project's programs, and no tests of other programs.
const FOLDERS: [&str; 2] = ["kernel", "host"];
/// Folders and files of them that no rule is about.
const APART: [&str; 6] = ["tests", "tests.rs", "benches", "examples", "target", "carried"];

/// A source file.
#[derive(Debug, Default)]
pub struct Source {
    /// Its path from the root.
    pub path: String,
    /// Structs, with the names of their fields.
    pub structs: Vec<(String, Vec<String>)>,
    /// Traits, each with a type that has it.
    pub traits: Vec<(String, String)>,
    /// All functions.
    pub functions: Vec<Function>,
    /// Texts, those within macros among them; documentation is none.
    pub texts: Vec<String>,
    /// All names.
    pub names: BTreeSet<String>,
}

/// A function.
#[derive(Debug)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// Whether its answer is yes or no.
    pub is_predicate: bool,
    /// Its body.
    pub body: Body,
}

/// The names in a function's body.
#[derive(Debug, Default)]
pub struct Body {
    /// Structs and variants with fields that it makes.
    pub made: BTreeSet<String>,
    /// All names.
    pub names: BTreeSet<String>,
}

impl Source {
    /// All source files of kernel and host.
    pub fn all() -> Result<Vec<Self>, String> {
        let mut sources = Vec::new();
        for folder in FOLDERS {
            for path in files::below(&root().join(folder), &APART)? {
                if path.extension().is_some_and(|extension| extension == "rs") {
                    let from_root = path.strip_prefix(root()).unwrap_or(&path).display();
                    sources.push(Self::parse(&from_root.to_string(), &files::text(&path)?)?);
                }
            }
        }
        Ok(sources)
    }

    /// The file of this path with this text.
    pub fn parse(path: &str, text: &str) -> Result<Self, String> {
        let mut source = Self { path: path.to_owned(), ..Self::default() };
        let mut syntax = syn::parse_file(text).map_err(|error| format!("{path}: {error}"))?;
        source.visit_file_mut(&mut syntax);
        Ok(source)
    }

    fn add(&mut self, signature: &syn::Signature, block: &mut syn::Block) {
        let mut body = Body::default();
        body.visit_block_mut(block);
        let is_bool =
            |of: &syn::Type| matches!(of, syn::Type::Path(path) if path.path.is_ident("bool"));
        let is_predicate = matches!(&signature.output, syn::ReturnType::Type(_, of) if is_bool(of));
        self.functions.push(Function { name: signature.ident.to_string(), is_predicate, body });
    }
}

impl VisitMut for Source {
    fn visit_file_mut(&mut self, file: &mut syn::File) {
        file.items.retain(|item| !is_test(item));
        visit_mut::visit_file_mut(self, file);
    }

    fn visit_item_mod_mut(&mut self, module: &mut syn::ItemMod) {
        if let Some((_, items)) = &mut module.content {
            items.retain(|item| !is_test(item));
        }
        visit_mut::visit_item_mod_mut(self, module);
    }

    fn visit_item_struct_mut(&mut self, item: &mut syn::ItemStruct) {
        let fields = item.fields.iter().filter_map(|field| Some(field.ident.as_ref()?.to_string()));
        self.structs.push((item.ident.to_string(), fields.collect()));
        visit_mut::visit_item_struct_mut(self, item);
    }

    fn visit_item_impl_mut(&mut self, item: &mut syn::ItemImpl) {
        if let Some((_, of, _)) = &item.trait_ {
            let name = match &*item.self_ty {
                syn::Type::Path(own) => last(&own.path),
                _ => String::new(),
            };
            self.traits.push((last(of), name));
        }
        visit_mut::visit_item_impl_mut(self, item);
    }

    fn visit_item_fn_mut(&mut self, item: &mut syn::ItemFn) {
        self.add(&item.sig, &mut item.block);
        visit_mut::visit_item_fn_mut(self, item);
    }

    fn visit_impl_item_fn_mut(&mut self, item: &mut syn::ImplItemFn) {
        self.add(&item.sig, &mut item.block);
        visit_mut::visit_impl_item_fn_mut(self, item);
    }

    fn visit_lit_str_mut(&mut self, text: &mut syn::LitStr) {
        self.texts.push(text.value());
    }

    /// Texts within macros are tokens.
    fn visit_macro_mut(&mut self, of: &mut syn::Macro) {
        let words = of.tokens.to_string();
        self.texts.extend(words.split('"').skip(1).step_by(2).map(str::to_owned));
    }

    /// Documentation is text, too.
    fn visit_attribute_mut(&mut self, _: &mut syn::Attribute) {}

    fn visit_ident_mut(&mut self, name: &mut syn::Ident) {
        self.names.insert(name.to_string());
    }
}

impl VisitMut for Body {
    /// An expression, and no pattern.
    fn visit_expr_struct_mut(&mut self, made: &mut syn::ExprStruct) {
        self.made.insert(last(&made.path));
        visit_mut::visit_expr_struct_mut(self, made);
    }

    fn visit_ident_mut(&mut self, name: &mut syn::Ident) {
        self.names.insert(name.to_string());
    }
}

fn last(path: &syn::Path) -> String {
    path.segments.last().map(|last| last.ident.to_string()).unwrap_or_default()
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
        assert_eq!(source.names.into_iter().collect::<Vec<_>>(), ["A", "c", "e"]);
        assert!(Source::parse("a.rs", "struct").is_err_and(|why| why.starts_with("a.rs: ")));
    }
}
