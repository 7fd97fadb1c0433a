//! The modules that tests bake, each once a run, and what is asked of each.
//!
//! ```text
//!   scene ─ bake, once ─► module ─┬─ image per board ─► played, measured, audited
//!                                 └─ library per board ─► played from C, audited
//! ```

mod row;
mod table;

use crate::baked::bakes;
use crate::c::package;
use crate::logs;
use crate::steps::Steps;
pub use row::Row;
use table::ROWS;

/// The row of a scene in f32.
pub fn row(scene: &str, model: &str) -> Result<&'static Row, String> {
    let found = ROWS.iter().find(|row| {
        row.recipe().scene_name() == scene && row.model == model && row.scalar == "f32"
    });
    found.ok_or_else(|| format!("no module of {scene} {model}"))
}

/// The rows of a run.
pub fn rows(is_whole: bool) -> impl Iterator<Item = &'static Row> {
    ROWS.iter().filter(move |row| is_whole || !row.is_at_length)
}

/// Bakes each module that a run needs for C, a step each, with its libraries.
pub fn bake_for_c(steps: &mut Steps) {
    bake(steps, |words| !words.is_empty());
}

/// Bakes every module, a step each, with its libraries for C.
pub fn bake_all(steps: &mut Steps) {
    bake(steps, |_| true);
}

fn bake(steps: &mut Steps, is_asked: impl Fn(&[&str]) -> bool) {
    let is_whole = steps.is_whole();
    for row in rows(is_whole) {
        let words = row.c.words(is_whole);
        let name = format!("{}, baked, for C on {} machines", row.name(), words.len());
        if is_asked(&words) && !steps.has(&name) {
            steps.compile(&name, || Ok(package::bake(&row.recipe(), &words).map(drop)?));
        }
    }
}

/// `Ok` where no module was baked twice, those that play logs among them.
pub fn baked_once(is_whole: bool) -> Result<(), String> {
    let (bakes, modules) = (bakes(), rows(is_whole).count() + logs::modules(is_whole));
    println!("{bakes} bakes of {modules} modules");
    if bakes > modules { Err(format!("{bakes} bakes, {modules} modules")) } else { Ok(()) }
}
