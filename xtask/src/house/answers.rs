//! Rules on what answers a scene: one struct for the answer, one session per model.

use syn::visit_mut::{self, VisitMut};

use super::sources::{Source, beyond_one, found_in};

/// What an answer has, by the names that a field of it may have.
const OF_AN_ANSWER: [&[&str]; 4] = [
    &["u"],
    &["flux", "fluxes", "tau"],
    &["status", "ended"],
    &["bound", "certificate", "verdict"],
];
/// The models, by the type that plays each over time.
const SESSIONS: [&str; 4] = ["Condensed", "Full", "KernelTick", "Solves"];

/// Structs that own u, flux, status and bound, where there are more than one.
pub fn structs(sources: &[Source]) -> Vec<String> {
    beyond_one(found_in(sources, |structs: Structs| structs.0))
}

#[derive(Default)]
struct Structs(Vec<String>);

impl VisitMut for Structs {
    fn visit_item_struct_mut(&mut self, item: &mut syn::ItemStruct) {
        let names: Vec<_> = item
            .fields
            .iter()
            .filter_map(|field| Some(field.ident.as_ref()?.to_string()))
            .collect();
        let has = |kind: &&[&str]| names.iter().any(|name| kind.contains(&name.as_str()));
        if OF_AN_ANSWER.iter().all(has) {
            self.0.push(item.ident.to_string());
        }
    }
}

/// Sessions beside the one that each model has.
pub fn sessions(sources: &[Source]) -> Vec<String> {
    let found = found_in(sources, |sessions: Sessions| sessions.0);
    let name = |found: &str| found.rsplit(' ').next().map(str::to_owned);
    let mut known = SESSIONS.to_vec();
    let is_beside = |found: &String| {
        let at = known.iter().position(|one| name(found).as_deref() == Some(one));
        at.map(|at| known.swap_remove(at)).is_none()
    };
    found.into_iter().filter(is_beside).collect()
}

#[derive(Default)]
struct Sessions(Vec<String>);

impl VisitMut for Sessions {
    fn visit_item_impl_mut(&mut self, item: &mut syn::ItemImpl) {
        let last = |path: &syn::Path| path.segments.last().map(|last| last.ident.to_string());
        let is_session = item.trait_.as_ref().and_then(|(_, path, _)| last(path));
        if is_session.as_deref() == Some("Session") {
            let name = match &*item.self_ty {
                syn::Type::Path(of) => last(&of.path),
                _ => None,
            };
            self.0.push(format!("Session for {}", name.unwrap_or_default()));
        }
        visit_mut::visit_item_impl_mut(self, item);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(files: &[(&str, &str)]) -> Vec<Source> {
        let parse = |(path, text): &(&str, &str)| Source::parse(path, text).expect("syntax");
        files.iter().map(parse).collect()
    }

    #[test]
    fn a_second_answer_is_named() {
        let one = ("host/a.rs", "struct A { u: V, flux: V, status: S, bound: B, sweeps: u32 }");
        let part = ("host/b.rs", "struct B { u: V, flux: V, bound: B }");
        assert_eq!(structs(&parsed(&[one, part])), Vec::<String>::new());
        let second = ("kernel/c.rs", "mod a { struct C { ended: E, tau: V, u: V, verdict: B } }");
        assert_eq!(structs(&parsed(&[one, part, second])), ["host/a.rs: A", "kernel/c.rs: C"]);
    }

    #[test]
    fn a_second_session_is_named() {
        let one = ("host/a.rs", "impl<R> Session for Full<R> {} impl Other for Full<u8> {}");
        assert_eq!(sessions(&parsed(&[one])), Vec::<String>::new());
        let second = ("host/b.rs", "impl crate::Session for Full<f32> {} impl Session for Fast {}");
        assert_eq!(
            sessions(&parsed(&[one, second])),
            ["host/b.rs: Session for Full", "host/b.rs: Session for Fast"]
        );
    }
}
