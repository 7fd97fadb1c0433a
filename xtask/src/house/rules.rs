//! The rules. Each returns those that break it, by file and name.

use syn::visit_mut::{self, VisitMut};

use super::answers;
use super::sources::{Source, beyond_one, found_in};

/// A rule.
pub struct Rule {
    /// What holds.
    pub name: &'static str,
    /// Those that break it.
    pub broken_by: fn(&[Source]) -> Vec<String>,
}

/// The rules that hold.
pub const RULES: [Rule; 6] = [
    Rule { name: "one struct owns u, flux, status and bound", broken_by: answers::structs },
    Rule { name: "a model has one session", broken_by: answers::sessions },
    Rule { name: "no text in bake holds Rust of a tick", broken_by: ticks_as_text },
    Rule { name: "solve does not know bake", broken_by: solve_with_bake },
    Rule { name: "one function decides what a parallelogram is", broken_by: parallelograms },
    Rule { name: "one function decides what an empty range of fluxes is", broken_by: empty_ranges },
];

/// Functions of a controller that are written once, in the kernel.
const OF_A_TICK: [&str; 5] = ["tick", "tick_within", "reset", "advance", "solve"];

/// Texts of bake with a function of a tick in them.
fn ticks_as_text(sources: &[Source]) -> Vec<String> {
    let bake: Vec<_> =
        sources.iter().filter(|source| source.path.starts_with("host/bake/")).cloned().collect();
    found_in(&bake, |texts: Texts| texts.0)
}

#[derive(Default)]
struct Texts(Vec<String>);

impl VisitMut for Texts {
    fn visit_lit_str_mut(&mut self, text: &mut syn::LitStr) {
        self.look_at(&text.value());
    }

    /// Texts within macros are tokens.
    fn visit_macro_mut(&mut self, of: &mut syn::Macro) {
        let words = of.tokens.to_string();
        words.split('"').skip(1).step_by(2).for_each(|text| self.look_at(text));
    }

    /// Documentation is text, too.
    fn visit_attribute_mut(&mut self, _: &mut syn::Attribute) {}
}

impl Texts {
    fn look_at(&mut self, text: &str) {
        let names = text.split("fn ").skip(1).filter_map(|rest| {
            rest.split(|letter: char| !letter.is_alphanumeric() && letter != '_').next()
        });
        let of_a_tick = names.filter(|name| OF_A_TICK.contains(name));
        self.0.extend(of_a_tick.map(|name| format!("a text has `fn {name}`")));
    }
}

/// Files of the solver, and of its command, that name bake.
fn solve_with_bake(sources: &[Source]) -> Vec<String> {
    let solve: Vec<_> = sources
        .iter()
        .filter(|source| {
            source.path.starts_with("host/solve/") || source.path == "host/src/cli/solve.rs"
        })
        .cloned()
        .collect();
    found_in(&solve, |named: Bake| named.0.into_iter().take(1).collect())
}

#[derive(Default)]
struct Bake(Vec<String>);

impl VisitMut for Bake {
    fn visit_ident_mut(&mut self, name: &mut syn::Ident) {
        if name == "signorini_bake" {
            self.0.push(name.to_string());
        }
    }
}

/// Functions that answer whether a cell is a parallelogram.
fn parallelograms(sources: &[Source]) -> Vec<String> {
    let decides = |function: &Function| function.answers && function.name.contains("parallelogram");
    beyond_one(functions(sources, decides))
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
    /// Whether its answer is yes or no.
    answers: bool,
    /// Whether it refuses an empty range and asks no other function what that is.
    decides: bool,
}

#[derive(Default)]
struct Functions(Vec<Function>);

impl Functions {
    fn add(&mut self, signature: &syn::Signature, block: &syn::Block) {
        let mut body = Body::default();
        body.visit_block_mut(&mut block.clone());
        let is_bool =
            |of: &syn::Type| matches!(of, syn::Type::Path(path) if path.path.is_ident("bool"));
        let answers = matches!(&signature.output, syn::ReturnType::Type(_, of) if is_bool(of));
        self.0.push(Function {
            name: signature.ident.to_string(),
            answers,
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
    fn a_tick_as_text_is_named() {
        let data = r#"/// Writes `fn tick()`.
            const ALIAS: &str = "pub type Controller = X; // a fn";"#;
        assert_eq!(broken(ticks_as_text, &[("host/bake/src/a.rs", data)]), Vec::<String>::new());
        let tick = r#"const TICK: &str = "pub fn tick(&mut self) {";"#;
        let found =
            broken(ticks_as_text, &[("host/bake/src/a.rs", tick), ("host/lab/src/a.rs", tick)]);
        assert_eq!(found, ["host/bake/src/a.rs: a text has `fn tick`"]);
        let written = r#"fn f() { write!(text, "fn {name}() {{}} fn reset<R>(x: R)"); }"#;
        assert_eq!(broken(ticks_as_text, &[("host/bake/src/a.rs", written)]).len(), 1);
    }

    #[test]
    fn a_solver_that_knows_bake_is_named() {
        let bake = "use signorini_bake::asked::solver;";
        let files = [
            ("host/solve/src/a.rs", bake),
            ("host/lab/src/a.rs", bake),
            ("host/src/cli/solve.rs", bake),
        ];
        let found = broken(solve_with_bake, &files);
        assert_eq!(
            found,
            ["host/solve/src/a.rs: signorini_bake", "host/src/cli/solve.rs: signorini_bake"]
        );
    }

    #[test]
    fn a_second_decision_is_named() {
        let one = (
            "kernel/src/a.rs",
            "fn is_parallelogram(c: C) -> bool { true } fn of_parallelogram(c: C) -> T { t }",
        );
        assert_eq!(broken(parallelograms, &[one]), Vec::<String>::new());
        let second = ("host/a.rs", "impl A { fn parallelogram(&self) -> bool { true } }");
        assert_eq!(
            broken(parallelograms, &[one, second]),
            ["kernel/src/a.rs: is_parallelogram", "host/a.rs: parallelogram"]
        );
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
