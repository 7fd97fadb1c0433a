//! The rules. Each returns those that break it, by file and name.

use super::sources::{Function, Source};

/// A rule.
pub struct Rule {
    /// The rule in words.
    pub name: &'static str,
    /// The places that break it.
    pub broken_by: fn(&[Source]) -> Vec<String>,
}

/// The rules that hold.
pub const RULES: [Rule; 6] = [
    Rule { name: "one struct owns u, flux, status and bound", broken_by: answers },
    Rule { name: "a model has one session", broken_by: sessions },
    Rule { name: "no text in bake holds Rust of a tick", broken_by: ticks_as_text },
    Rule { name: "solve does not know bake", broken_by: solve_with_bake },
    Rule { name: "one function decides what a parallelogram is", broken_by: parallelograms },
    Rule { name: "one function decides what an empty range of fluxes is", broken_by: empty_ranges },
];

/// The findings of all files, by the file's path.
fn found<'a>(
    sources: impl IntoIterator<Item = &'a Source>,
    of: impl Fn(&'a Source) -> Vec<String>,
) -> Vec<String> {
    let named = |source| of(source).into_iter().map(move |name| format!("{}: {name}", source.path));
    sources.into_iter().flat_map(named).collect()
}

/// The findings, where there are more than one.
fn beyond_one(found: Vec<String>) -> Vec<String> {
    if found.len() > 1 { found } else { Vec::new() }
}

/// The parts of an answer, by the names that a field of it may have.
const OF_AN_ANSWER: [&[&str]; 4] = [
    &["u"],
    &["flux", "fluxes", "tau"],
    &["status", "ended"],
    &["bound", "certificate", "verdict"],
];

/// Structs that own u, flux, status and bound, where there are more than one.
fn answers(sources: &[Source]) -> Vec<String> {
    let is_answer = |fields: &[String]| {
        let has = |kind: &&[&str]| fields.iter().any(|name| kind.contains(&name.as_str()));
        OF_AN_ANSWER.iter().all(has)
    };
    beyond_one(found(sources, |source| {
        let own = source.structs.iter().filter(|(_, fields)| is_answer(fields));
        own.map(|(name, _)| name.clone()).collect()
    }))
}

/// The models, by the type that plays each over time.
const SESSIONS: [&str; 4] = ["Condensed", "Full", "KernelTick", "Solves"];

/// Sessions beside the one that each model has.
fn sessions(sources: &[Source]) -> Vec<String> {
    let found = found(sources, |source| {
        let own = source.traits.iter().filter(|(of, _)| of == "Session");
        own.map(|(_, name)| format!("Session for {name}")).collect()
    });
    let mut known = SESSIONS.to_vec();
    let is_beside = |found: &String| {
        let at = known.iter().position(|one| found.rsplit(' ').next() == Some(one));
        at.map(|at| known.swap_remove(at)).is_none()
    };
    found.into_iter().filter(is_beside).collect()
}

/// Functions of a controller that are written once, in the kernel.
const OF_A_TICK: [&str; 5] = ["tick", "tick_within", "reset", "advance", "solve"];

/// Texts of bake with a function of a tick in them.
fn ticks_as_text(sources: &[Source]) -> Vec<String> {
    let bake = sources.iter().filter(|source| source.path.starts_with("host/bake/"));
    found(bake, |source| {
        let names = source.texts.iter().flat_map(|text| text.split("fn ").skip(1));
        let names = names.filter_map(|rest| {
            rest.split(|letter: char| !letter.is_alphanumeric() && letter != '_').next()
        });
        let of_a_tick = names.filter(|name| OF_A_TICK.contains(name));
        of_a_tick.map(|name| format!("a text has `fn {name}`")).collect()
    })
}

/// Files of the solver, and of its command, that name bake.
fn solve_with_bake(sources: &[Source]) -> Vec<String> {
    let solve = sources.iter().filter(|source| {
        source.path.starts_with("host/solve/") || source.path == "host/src/cli/solve.rs"
    });
    found(solve, |source| source.names.get("signorini_bake").cloned().into_iter().collect())
}

/// Functions that answer whether a cell is a parallelogram.
fn parallelograms(sources: &[Source]) -> Vec<String> {
    beyond_one(functions(sources, |function| {
        function.is_predicate && function.name.contains("parallelogram")
    }))
}

/// Functions that refuse a range of fluxes as empty and do not ask the kernel's `settled`.
fn empty_ranges(sources: &[Source]) -> Vec<String> {
    functions(sources, |Function { body, .. }| {
        body.made.contains("EmptyRange") && !body.names.contains("settled")
    })
}

fn functions(sources: &[Source], is_asked: impl Fn(&Function) -> bool) -> Vec<String> {
    found(sources, |source| {
        let asked = source.functions.iter().filter(|function| is_asked(function));
        asked.map(|function| function.name.clone()).collect()
    })
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
        let one = "fn hi(a: A) -> R { settled(a).ok_or(Error::EmptyRange { input }) }";
        let reader = "fn code(e: Error) -> C { match e { Error::EmptyRange { input } => 8 } }";
        let kernel = [("kernel/src/a.rs", one), ("kernel/src/b.rs", reader)];
        assert_eq!(broken(empty_ranges, &kernel), Vec::<String>::new());
        let second =
            "impl A { fn lo() -> R { if lo > hi { return Err(EmptyRange { input: 0 }); } } }";
        assert_eq!(broken(empty_ranges, &[kernel[0], ("host/a.rs", second)]), ["host/a.rs: lo"]);
    }

    #[test]
    fn a_second_answer_is_named() {
        let one = ("host/a.rs", "struct A { u: V, flux: V, status: S, bound: B, sweeps: u32 }");
        let part = ("host/b.rs", "struct B { u: V, flux: V, bound: B }");
        assert_eq!(broken(answers, &[one, part]), Vec::<String>::new());
        let second = ("kernel/c.rs", "mod a { struct C { ended: E, tau: V, u: V, verdict: B } }");
        assert_eq!(broken(answers, &[one, part, second]), ["host/a.rs: A", "kernel/c.rs: C"]);
    }

    #[test]
    fn a_second_session_is_named() {
        let one = ("host/a.rs", "impl<R> Session for Full<R> {} impl Other for Full<u8> {}");
        assert_eq!(broken(sessions, &[one]), Vec::<String>::new());
        let second = ("host/b.rs", "impl crate::Session for Full<f32> {} impl Session for Fast {}");
        assert_eq!(
            broken(sessions, &[one, second]),
            ["host/b.rs: Session for Full", "host/b.rs: Session for Fast"]
        );
    }
}
