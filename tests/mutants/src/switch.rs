//! Rewrites a source file so that each of its mutants is switched on at run time.
//!
//! ```text
//!   a + b        ({ let (l, r) = (a, b); if on(7) { l - r } else if on(8) { l * r } else { l + r } })
//!   a < b        the same with references, since comparing moves nothing
//!   a += b       ({ let r = b; let l = &mut a; if on(7) { *l -= r } else { *l += r } })
//!   a && b       ({ match (a, on(7)) { (true, false) | (false, true) => b, (l, _) => l } })
//!   -a           ({ let l = a; if on(7) { l } else { -l } })
//!   { body }     { if on(7) { return replacement; } body }
//!   p => e       p if !on(7) => e          deleted
//!   p if g => e  p if on(7) || !on(8) && (g) => e          true, false
//! ```
//! No operand is written twice, and no line is added. Comments mark what belongs to a mutant and what to
//! a place, so that an error of the compiler tells which mutant does not compile.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use proc_macro2::{LineColumn, Span as Tokens};
use syn::spanned::Spanned as _;
use syn::visit::{self, Visit};
use syn::{
    Arm, BinOp, Block, Expr, ExprBinary, ExprStruct, ExprUnary, ImplItemFn, ItemFn, Signature,
    TraitItemFn, UnOp,
};

use crate::edits::Edits;
use crate::mutant::{Mutant, SourcePosition, Span};

/// The text of a file with its mutants behind switches, those for which there is no switch, and those that
/// the grammar forbids.
pub struct Switched {
    pub text: String,
    pub without: BTreeSet<u32>,
    pub barred: BTreeSet<u32>,
}

/// Rewrites `text`. `mutants` are those of the file that shall get a switch; `constant` names the functions that
/// constants call, which can have none.
pub fn switch(
    text: &str,
    mutants: &[&Mutant],
    constant: &BTreeSet<String>,
) -> syn::Result<Switched> {
    let file = syn::parse_file(text)?;
    let mut at = BTreeMap::<Span, Vec<&Mutant>>::new();
    for mutant in mutants {
        at.entry(mutant.span).or_default().push(mutant);
    }
    let mut switches = Switches {
        edits: Edits::new(text),
        at,
        done: BTreeSet::new(),
        barred: BTreeSet::new(),
        constant: constant.clone(),
    };
    switches.visit_file(&file);
    let without = mutants.iter().map(|m| m.id).filter(|id| !switches.done.contains(id)).collect();
    Ok(Switched { text: switches.edits.apply(), without, barred: switches.barred })
}

struct Switches<'a> {
    edits: Edits<'a>,
    at: BTreeMap<Span, Vec<&'a Mutant>>,
    done: BTreeSet<u32>,
    barred: BTreeSet<u32>,
    constant: BTreeSet<String>,
}

const ON: &str = "crate::mutants::on";

fn place(LineColumn { line, column }: LineColumn) -> SourcePosition {
    SourcePosition { line, column: column + 1 }
}

impl<'a> Switches<'a> {
    /// The mutants of exactly these tokens.
    fn of(&mut self, tokens: Tokens, genre: &str) -> Vec<&'a Mutant> {
        let span = Span { start: place(tokens.start()), end: place(tokens.end()) };
        let of_genre = |mutant: &&Mutant| mutant.genre == genre;
        let found: Vec<_> =
            self.at.get(&span).into_iter().flatten().copied().filter(of_genre).collect();
        self.done.extend(found.iter().map(|mutant| mutant.id));
        found
    }

    fn binary(&mut self, node: &ExprBinary) {
        let operator = node.op.span();
        let found = self.of(operator, "BinaryOperator");
        let Some(first) = found.first() else { return };
        let group = first.id;
        let (left, right) = (node.left.span().byte_range(), node.right.span().byte_range());
        let own = &self.edits.text[operator.byte_range()];
        let (opening, between, closing) = match node.op {
            BinOp::And(_) | BinOp::Or(_) => {
                if has_let(&node.left) || has_let(&node.right) {
                    self.barred.insert(group);
                    return;
                }
                let changed = matches!(node.op, BinOp::Or(_));
                let cases = format!("(true, {changed}) | (false, {}) => ", !changed);
                let on = format!(", {ON}({group})) {{");
                ("match (".to_owned(), format!("{on} {cases}"), ", (l, _) => l }".to_owned())
            }
            _ if own.ends_with('=') && !["==", "!=", "<=", ">="].contains(&own) => {
                let choice = choice(&found, |op| format!("*l {op} r"), own);
                if self.has_mutants(left.clone()) {
                    let closing = format!("; {choice}");
                    ("let l = &mut ".to_owned(), "; let r = ".to_owned(), closing)
                } else {
                    // The right side first: it may read what the left side is.
                    let left = &self.edits.text[left];
                    let lines = "\n".repeat(left.matches('\n').count());
                    let start = node.left.span().byte_range().start;
                    self.edits.replace(start..operator.byte_range().end, lines);
                    let behind = format!("; let l = &mut {left}; {choice} /*g{group}>*/}})");
                    self.edits.around(right, format!("({{/*<g{group}*/ let r = "), behind);
                    return;
                }
            }
            BinOp::Eq(_)
            | BinOp::Ne(_)
            | BinOp::Lt(_)
            | BinOp::Le(_)
            | BinOp::Gt(_)
            | BinOp::Ge(_) => {
                let choice = choice(&found, |op| format!("*l {op} *r"), own);
                ("let (l, r) = (&(".to_owned(), "), &(".to_owned(), format!(")); {choice}"))
            }
            _ => {
                let choice = choice(&found, |op| format!("l {op} r"), own);
                ("let (l, r) = (".to_owned(), ", ".to_owned(), format!("); {choice}"))
            }
        };
        self.edits.replace(operator.byte_range(), between);
        let opening = format!("({{/*<g{group}*/ {opening}");
        self.edits.around(left.start..right.end, opening, format!("{closing} /*g{group}>*/}})"));
    }

    /// Whether there are mutants within these bytes.
    fn has_mutants(&self, range: Range<usize>) -> bool {
        let place = |at: usize| {
            let text = &self.edits.text[..at];
            let column = text.rsplit('\n').next().unwrap_or_default().chars().count();
            SourcePosition { line: 1 + text.matches('\n').count(), column: 1 + column }
        };
        let (start, end) = (place(range.start), place(range.end));
        self.at.keys().any(|span| start <= span.start && span.start < end)
    }

    /// Whether the left side is written behind the right side.
    fn moved(&self, node: &ExprBinary) -> bool {
        let start = node.left.span().byte_range().start;
        self.edits.replaces(start)
    }

    fn unary(&mut self, node: &ExprUnary) {
        let found = self.of(node.op.span(), "UnaryOperator");
        let Some(first) = found.first() else { return };
        let (group, operator) = (first.id, node.op.span().byte_range());
        let own = if matches!(node.op, UnOp::Neg(_)) { "-" } else { "!" };
        let end = node.expr.span().byte_range().end;
        let choice = format!("if {ON}({group}) {{ {} }} else {{ {own}l }}", mark(group, "l"));
        self.edits.replace(operator, format!("({{/*<g{group}*/ let l = "));
        self.edits.behind(end, format!("; {choice} /*g{group}>*/}})"));
    }

    fn fields(&mut self, node: &ExprStruct) {
        let Some(rest) = &node.rest else { return };
        let base = &self.edits.text[rest.span().byte_range()];
        for field in &node.fields {
            let start = place(field.span().start());
            let mut of_field = self.at.iter().filter(|(span, _)| span.start == start);
            let mutants = of_field.by_ref().flat_map(|(_, mutants)| mutants);
            let Some(group) = mutants.filter(|m| m.genre == "StructField").map(|m| m.id).next()
            else {
                continue;
            };
            self.done.insert(group);
            let (member, range) = (&field.member, field.expr.span().byte_range());
            let name = match member {
                syn::Member::Named(name) => name.to_string(),
                syn::Member::Unnamed(index) => index.index.to_string(),
            };
            let label =
                if field.colon_token.is_none() { format!("{name}: ") } else { String::new() };
            let other = mark(group, &format!("({base}).{name}"));
            let before = format!("{label}{{/*<g{group}*/ if {ON}({group}) {{ {other} }} else {{ ");
            self.edits.around(range, before, format!(" }} /*g{group}>*/}}"));
        }
    }

    /// Whether switches fit into a function; a switch is read at run time, so what has one is no longer constant.
    fn switchable(&mut self, sig: &Signature, block: &Block) -> bool {
        let Some(constness) = &sig.constness else { return true };
        if self.constant.contains(&sig.ident.to_string()) {
            return false;
        }
        if self.has_mutants(block.span().byte_range()) {
            self.edits.replace(constness.span().byte_range(), String::new());
        }
        true
    }

    fn body(&mut self, block: &Block) {
        let inside = block.brace_token.span.join();
        let mut found = self.of(inside, "FnValue");
        if let (Some(first), Some(last)) = (block.stmts.first(), block.stmts.last()) {
            let start = place(first.span().start());
            let end = place(last.span().end());
            let span = Span { start, end };
            let more = self.at.get(&span).into_iter().flatten().copied();
            let more: Vec<_> = more.filter(|mutant| mutant.genre == "FnValue").collect();
            self.done.extend(more.iter().map(|mutant| mutant.id));
            found.extend(more);
        }
        let start = inside.byte_range().start + 1;
        for mutant in found {
            let returned = mark(mutant.id, &format!("return {};", mutant.replacement));
            let group = mutant.id;
            let text = format!(" /*<g{group}*/ if {ON}({group}) {{ {returned} }} /*g{group}>*/");
            self.edits.at_start(start, text);
        }
    }

    fn arm(&mut self, node: &Arm) {
        let deleted = self.of(node.span(), "MatchArm");
        let guard = node.guard.as_ref().map(|(_, guard)| &**guard);
        let guards = guard.map_or(Vec::new(), |guard| self.of(guard.span(), "MatchArmGuard"));
        let of = |mutants: &[&Mutant], with: &str| {
            mutants.iter().filter(|m| m.replacement == with).map(|m| m.id).next()
        };
        let deleted = deleted.first().map(|mutant| mutant.id);
        let (always, never) = (of(&guards, "true"), of(&guards, "false"));
        let Some(group) = deleted.or(always).or(never) else { return };
        let on = |id: Option<u32>| id.map_or("false".to_owned(), |id| format!("{ON}({id})"));
        let before = format!(
            "/*<g{group}*/ !({}) && (({}) || !({}) && (",
            on(deleted),
            on(always),
            on(never)
        );
        let behind = format!(")) /*g{group}>*/");
        match guard {
            Some(Expr::Let(_)) => {
                self.done.retain(|id| ![deleted, always, never].contains(&Some(*id)));
            }
            Some(guard) => self.edits.around(guard.span().byte_range(), before, behind),
            None => self
                .edits
                .behind(node.pat.span().byte_range().end, format!(" if {before} true {behind}")),
        }
    }
}

/// The parts that a mutant alone brings.
fn mark(id: u32, text: &str) -> String {
    format!("/*<m{id}*/ {text} /*m{id}>*/")
}

fn choice(mutants: &[&Mutant], with: impl Fn(&str) -> String, own: &str) -> String {
    let case = |mutant: &&Mutant| {
        let id = mutant.id;
        format!("if {ON}({id}) {{ {} }} else ", mark(id, &with(&mutant.replacement)))
    };
    let cases: String = mutants.iter().map(case).collect();
    format!("{cases}{{ {} }}", with(own))
}

/// Whether a chain of conditions binds something.
fn has_let(node: &Expr) -> bool {
    match node {
        Expr::Let(_) => true,
        Expr::Binary(ExprBinary { left, op: BinOp::And(_), right, .. }) => {
            has_let(left) || has_let(right)
        }
        _ => false,
    }
}

impl<'ast> Visit<'ast> for Switches<'_> {
    fn visit_expr(&mut self, node: &'ast Expr) {
        self.edits.depth += 1;
        match node {
            Expr::Binary(binary) => self.binary(binary),
            Expr::Unary(unary) => self.unary(unary),
            Expr::Struct(fields) => self.fields(fields),
            _ => {}
        }
        match node {
            Expr::Binary(binary) if self.moved(binary) => self.visit_expr(&binary.right),
            _ => visit::visit_expr(self, node),
        }
        self.edits.depth -= 1;
    }

    fn visit_arm(&mut self, node: &'ast Arm) {
        self.edits.depth += 1;
        self.arm(node);
        visit::visit_arm(self, node);
        self.edits.depth -= 1;
    }

    fn visit_item_fn(&mut self, node: &'ast ItemFn) {
        if self.switchable(&node.sig, &node.block) {
            self.body(&node.block);
            visit::visit_item_fn(self, node);
        }
    }

    fn visit_impl_item_fn(&mut self, node: &'ast ImplItemFn) {
        if self.switchable(&node.sig, &node.block) {
            self.body(&node.block);
            visit::visit_impl_item_fn(self, node);
        }
    }

    fn visit_trait_item_fn(&mut self, node: &'ast TraitItemFn) {
        node.default.iter().for_each(|block| self.body(block));
        visit::visit_trait_item_fn(self, node);
    }
}

#[cfg(test)]
mod tests;
