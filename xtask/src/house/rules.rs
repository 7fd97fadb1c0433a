//! The rules. Each returns those that break it, by file and name.

use syn::visit_mut::{self, VisitMut};

use super::sources::Source;

/// A rule.
pub struct Rule {
    /// What holds.
    pub name: &'static str,
    /// Those that break it.
    pub broken_by: fn(&[Source]) -> Vec<String>,
}

/// The rules that hold.
pub const RULES: [Rule; 1] = [Rule {
    name: "one function decides what an empty range of fluxes is",
    broken_by: empty_ranges,
}];

/// Looks through all files; `found` takes what a visitor has found in each, by the file's path.
fn found_in<V: VisitMut + Default>(
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

/// Functions that refuse a range of fluxes as empty and do not ask the kernel's `settled`.
fn empty_ranges(sources: &[Source]) -> Vec<String> {
    functions(sources, |function| function.decides)
}

fn functions(sources: &[Source], is_asked: impl Fn(&Function) -> bool) -> Vec<String> {
    found_in(sources, |all: Functions| {
        all.0
            .into_iter()
            .filter(|function| is_asked(function))
            .map(|function| function.name)
            .collect()
    })
}

/// A function and what it does.
struct Function {
    name: String,
    /// Whether it refuses an empty range and asks no other function what that is.
    decides: bool,
}

#[derive(Default)]
struct Functions(Vec<Function>);

impl Functions {
    fn add(&mut self, signature: &syn::Signature, block: &syn::Block) {
        let mut body = Body::default();
        body.visit_block_mut(&mut block.clone());
        self.0.push(Function {
            name: signature.ident.to_string(),
            decides: body.refuses && !body.asks,
        });
    }
}

impl VisitMut for Functions {
    fn visit_item_fn_mut(&mut self, item: &mut syn::ItemFn) {
        self.add(&item.sig, &item.block);
    }

    fn visit_impl_item_fn_mut(&mut self, item: &mut syn::ImplItemFn) {
        self.add(&item.sig, &item.block);
    }
}

/// What a function's body has.
#[derive(Default)]
struct Body {
    /// An error of an empty range that is made.
    refuses: bool,
    /// A call of the function that decides what is one.
    asks: bool,
}

impl VisitMut for Body {
    /// An expression, and no pattern.
    fn visit_expr_struct_mut(&mut self, made: &mut syn::ExprStruct) {
        self.refuses |= made.path.segments.last().is_some_and(|last| last.ident == "EmptyRange");
        visit_mut::visit_expr_struct_mut(self, made);
    }

    fn visit_ident_mut(&mut self, name: &mut syn::Ident) {
        self.asks |= name == "settled";
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn broken(rule: fn(&[Source]) -> Vec<String>, files: &[(&str, &str)]) -> Vec<String> {
        let parse = |(path, text): &(&str, &str)| Source::parse(path, text).expect("syntax");
        rule(&files.iter().map(parse).collect::<Vec<_>>())
    }

    #[test]
    fn a_second_refusal_is_named() {
        let one = "fn hi(a: A) -> R { settled(a).ok_or(Error::EmptyRange { contact }) }";
        let reader = "fn code(e: Error) -> C { match e { Error::EmptyRange { contact } => 8 } }";
        let kernel = [("kernel/src/a.rs", one), ("kernel/src/b.rs", reader)];
        assert_eq!(broken(empty_ranges, &kernel), Vec::<String>::new());
        let second =
            "impl A { fn lo() -> R { if lo > hi { return Err(EmptyRange { contact: 0 }); } } }";
        assert_eq!(broken(empty_ranges, &[kernel[0], ("host/a.rs", second)]), ["host/a.rs: lo"]);
    }
}
