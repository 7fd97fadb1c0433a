//! A solved scene as the report shows it: its picture, its checks and all its numbers.

use super::case::KnownScene;
use super::{OF_ENERGY, OF_FLUX, OF_GRADIENT, OF_U};
use signorini_draw::ScenePanel;
use signorini_files::panel;
use signorini_problem::Problem;
use signorini_solve::Solution;

/// How far the kernel is from the reference.
const FROM_FAER: &str = "largest distance of u to faer’s, over the range of u";

pub fn panel(problem: &Problem, solution: &Solution, case: &KnownScene) -> ScenePanel {
    ScenePanel {
        name: case.name.clone(),
        title: case.title.clone(),
        passed: case.checks.iter().all(|check| check.passed),
        error: case.f64.certified.error(),
        sentence: case.outputs.sentence.clone(),
        facts: facts(case),
        ..panel::panel(problem, solution)
    }
}

fn facts(case: &KnownScene) -> Vec<(String, String)> {
    let [triangles, quads] = case.cells;
    let certified = &case.f64.certified;
    let mut facts = vec![
        ("unknowns".to_owned(), case.unknowns.to_string()),
        ("triangles".to_owned(), triangles.to_string()),
        ("quads".to_owned(), quads.to_string()),
        ("contact force ∫(σ·n − q)".to_owned(), format!("{:.6e}", case.force)),
        ("active contact edges".to_owned(), format!("{} of {}", case.contact[0], case.contact[1])),
        ("sweeps in f64".to_owned(), certified.sweeps.to_string()),
        ("sweeps in f32".to_owned(), case.f32.certified.sweeps.to_string()),
        (format!("{FROM_FAER}, f64"), format!("{:.1e}", case.f64.distance)),
        (format!("{FROM_FAER}, f32"), format!("{:.1e}", case.f32.distance)),
    ];
    let told = case.outputs.told.iter();
    facts.extend(told.map(|(name, words)| (format!("output {name}"), words.clone())));
    if let Some(errors) = &certified.errors {
        let norms = [
            (OF_ENERGY, errors.energy),
            (OF_GRADIENT, errors.h1),
            (OF_U, errors.l2),
            (OF_FLUX, errors.flux),
        ];
        facts.extend(norms.map(|(name, error)| (name.to_owned(), format!("{error:.4e}"))));
    }
    if let Some(ratio) = certified.efficiency(case.energy) {
        let name = "gap of the bound / gradient error of u, weighed by A";
        facts.push((name.to_owned(), format!("{ratio:.3}")));
    }
    facts
}
