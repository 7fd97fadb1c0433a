//! `[setting]`, in a scene and in a fragment that extends one.

use std::path::Path;

use signorini_kernel::element::QuadElement;

use super::{LEVEE, SMALL, hint, parse, refused};
use crate::goal::Goal;
use crate::scene::Scene;
use crate::setting::{CellKind, MathKind, Method, ModelKind, Omega, Precision, Setting, Start};

/// The small scene with these lines of a setting; the first stands in line 6.
fn with(lines: &str) -> String {
    format!("{SMALL}[setting]\n{lines}\n")
}

fn setting(lines: &str) -> Option<Setting> {
    parse(&with(lines)).unwrap_or_else(|error| panic!("{lines}: {error}")).setting
}

#[test]
fn every_key_is_read_and_what_is_left_out_is_the_default() {
    assert_eq!(super::scene(SMALL).setting, None);
    assert_eq!(setting(""), Some(Setting::default()));
    let all = "refine = 0x2\ncells = 'quads'\nelement = 'nonparametric'\nscalar = 'f32'\nmath = 'micromath'\nmodel = 'full'\n\
        solver = 'sweeps'\nstart = 'cold'\nomega = 1.5\nshare = 0.25\ncertificate = true";
    let expected = Setting {
        refine: 2,
        error: None,
        cells: Some(CellKind::Quads),
        element: QuadElement::Nonparametric,
        scalar: Some(Precision::F32),
        math: MathKind::Micromath,
        model: Some(ModelKind::Full),
        solver: Some(Method::Sweeps),
        start: Start::Cold,
        omega: Omega::Fixed(1.5),
        sweeps: None,
        share: Some(0.25),
        certificate: true,
        memory: None,
    };
    assert_eq!(setting(all), Some(expected));
    let omega = |line| setting(line).map(|setting| setting.omega);
    assert_eq!(omega("omega = 1"), Some(Omega::Fixed(1.0)));
    assert_eq!(omega("omega = 'auto'"), Some(Omega::Auto));
    let memory = setting("memory = 24").and_then(|setting| setting.memory);
    assert_eq!(memory, Some(24));
}

#[test]
fn a_solver_asks_for_its_model() {
    let read = |lines| setting(lines).map(|setting| (setting.solver, setting.model_kind()));
    let (full, condensed) = (Some(ModelKind::Full), Some(ModelKind::Condensed));
    assert_eq!(read("solver = 'auto'"), Some((None, None)));
    assert_eq!(read("solver = 'auto'\nmodel = 'condensed'"), Some((None, condensed)));
    assert_eq!(read("solver = 'sweeps'"), Some((Some(Method::Sweeps), full)));
    assert_eq!(read("solver = 'factor'"), Some((Some(Method::Factor), full)));
    assert_eq!(read("solver = 'exact'"), Some((Some(Method::Exact), condensed)));
    let sweeps = "solver = 'sweeps'\nmodel = 'condensed'";
    assert_eq!(read(sweeps), Some((Some(Method::Sweeps), condensed)));
}

#[test]
fn what_is_written_is_read_again() {
    let condensed = Setting { model: Some(ModelKind::Condensed), ..Setting::default() };
    for written in [
        Setting::default(),
        condensed,
        Setting { sweeps: Some(12), certificate: false, ..condensed },
        Setting { scalar: Some(Precision::Mixed), share: Some(0.1), ..Setting::default() },
        Setting { element: QuadElement::Nonparametric, ..Setting::default() },
        Setting { error: Some(Goal::Part(0.05)), ..Setting::default() },
        Setting { error: Some(Goal::Energy(1e-3)), ..condensed },
        Setting { refine: 6, cells: Some(CellKind::Triangles), ..Setting::default() },
        Setting { solver: Some(Method::Factor), ..Setting::default() },
        Setting { solver: Some(Method::Exact), ..condensed },
        Setting { solver: Some(Method::Sweeps), ..condensed },
        Setting { omega: Omega::Fixed(1.93), start: Start::Cold, ..Setting::default() },
        Setting { cells: Some(CellKind::Quads), ..Setting::default() },
    ] {
        let text = toml::to_string(&written).expect("a text");
        assert_eq!(setting(&text), Some(written), "{text}");
        assert_eq!(toml::from_str::<Setting>(&text), Ok(written), "{text}");
    }
}

/// Lines of a setting, and the message after `FILE:`. The schema is tried on them, too.
fn wrong() -> Vec<[String; 2]> {
    super::cases(include_str!("setting.toml"))
}

#[test]
fn each_mistake_has_one_message_with_line_and_key() {
    for [lines, message] in wrong() {
        let error = refused(&with(&lines), &message);
        assert!(!lines.contains('\n') || !hint(&error).is_empty(), "{lines}");
    }
    let message = "1: setting: expected a table, found the number 3";
    refused(&format!("setting = 3\n{SMALL}"), message);
}

/// A folder with `base/levee.toml`, which has a setting, and `fragment.toml` of this text.
fn folder(fragment: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(folder.path().join("base")).expect("a folder");
    let base = format!("{LEVEE}\n[setting]\nrefine = 2\nsweeps = 7\n");
    std::fs::write(folder.path().join("base/levee.toml"), base).expect("written");
    std::fs::write(folder.path().join("fragment.toml"), fragment).expect("written");
    folder
}

/// The message from reading the fragment, with the folder left out.
fn message(folder: &Path) -> String {
    let error = Scene::read(&folder.join("fragment.toml")).expect_err("no scene");
    assert_eq!(error.exit_status(), 2);
    error.to_string().replace(&format!("{}/", folder.display()), "")
}

#[test]
fn a_fragment_changes_title_and_setting_alone() {
    let full = folder("extends = 'base/levee.toml'\ntitle = 'quick'\n[setting]\nrefine = 1\n");
    let (base, fragment) = (full.path().join("base/levee.toml"), full.path().join("fragment.toml"));
    let extended = Scene::read(&base).expect("a scene");
    let scene = Scene::read(&fragment).expect("a scene");
    assert_eq!(scene.setting, Some(Setting { refine: 1, ..Setting::default() }));
    assert_eq!((scene.title.as_str(), scene.file()), ("quick", fragment.as_path()));
    assert_eq!(scene.mesh.value, full.path().join("base/levee.msh"));
    let (title, setting) = (extended.title.clone(), extended.setting);
    assert_eq!((extended.fragment.as_ref(), extended.file()), (None, base.as_path()));
    assert_eq!(Scene { title, setting, fragment: None, ..scene }, extended);

    let bare = folder("extends = 'base/levee.toml'");
    let scene = Scene::read(&bare.path().join("fragment.toml")).expect("a scene");
    assert_eq!((scene.title, scene.setting), (extended.title, setting));
}

#[test]
fn a_wrong_fragment_is_named() {
    #[rustfmt::skip] // A table.
    let cases = [
        ("extends = 'base/levee.toml'\nmesh = 'other.msh'", "2: mesh: unknown key of a fragment"),
        ("extends = 3", "1: extends: expected a text, found the number 3"),
        ("extends = ''", "1: extends: expected the path of a scene file, found the text \"\""),
        ("extends = 'fragment.toml'", "1: extends: fragment.toml extends another scene itself"),
        ("extends = 'base/levee.toml'\n[setting]\nsweeps = 0", "3: setting.sweeps: expected a whole number from 1 to 4294967295, found the number 0"),
        ("title = 'x'\n[setting]", "1: boundary: missing"),
        ("extends = 'base'", "1: extends: base is no file"),
    ];
    for (text, expected) in cases {
        assert_eq!(message(folder(text).path()), format!("fragment.toml:{expected}"));
    }
    let missing = message(folder("extends = 'levee.toml'").path());
    assert!(missing.starts_with("fragment.toml:1: extends: levee.toml: No such file"), "{missing}");
    let foreign = folder("extends = 'base/levee.toml'\n[time]\nstep = 1\nend = 2");
    let error = Scene::read(&foreign.path().join("fragment.toml")).expect_err("a time");
    assert_eq!(hint(&error), "a file that extends another changes [setting] and title alone");
}

#[test]
fn what_is_wrong_in_the_extended_scene_is_said_of_it() {
    let folder = folder("extends = 'base/levee.toml'\n[setting]\n");
    let base = folder.path().join("base/levee.toml");
    std::fs::write(&base, LEVEE.replace("\"-y\"", "\"2y\"")).expect("written");
    let expected = "base/levee.toml:20: boundary.face.gap: expected an operator before `y`";
    assert_eq!(message(folder.path()), expected);
    std::fs::write(&base, "extends = '../fragment.toml'").expect("written");
    let expected = "fragment.toml:1: extends: base/levee.toml extends another scene itself";
    assert_eq!(message(folder.path()), expected);
    // Its own setting is checked, though the fragment replaces it.
    std::fs::write(&base, format!("{LEVEE}\n[setting]\nomega = 3")).expect("written");
    assert!(message(folder.path()).starts_with("base/levee.toml:"), "{}", message(folder.path()));
}
