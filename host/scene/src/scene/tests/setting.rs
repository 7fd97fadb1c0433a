//! `[setting]`, in a scene and in a fragment that extends one.

use std::path::Path;

use signorini_kernel::element::QuadElement;

use super::{LEVEE, SMALL, hint, parse};
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
    ] {
        let text = toml::to_string(&written).expect("a text");
        assert_eq!(setting(&text), Some(written), "{text}");
    }
}

/// Lines of a setting, and the message after `FILE:`.
#[rustfmt::skip] // A table.
const WRONG: &[(&str, &str)] = &[
    ("sweep = 3", "6: setting.sweep: unknown key of the setting"),
    ("refine = 7", "6: setting.refine: expected a whole number from 0 to 6, found the number 7"),
    ("refine = -1", "6: setting.refine: expected a whole number from 0 to 6, found the number -1"),
    ("refine = 1.0", "6: setting.refine: expected a whole number from 0 to 6, found the number 1.0"),
    ("error = 0", "6: setting.error: expected a number > 0, such as 0.01, or a part such as \"5%\", found the number 0"),
    ("error = '5 percent'", "6: setting.error: expected a number > 0, such as 0.01, or a part such as \"5%\", found the text \"5 percent\""),
    ("error = '5%'\nrefine = 1", "7: setting.refine: excludes `error`, which says how fine the mesh becomes"),
    ("cells = 'hexagons'", "6: setting.cells: `hexagons` is not one of: triangles, quads"),
    ("cells = 4", "6: setting.cells: expected a text, found the number 4"),
    ("element = 'conforming'", "6: setting.element: `conforming` is not one of: parametric, nonparametric"),
    ("scalar = 'f16'", "6: setting.scalar: `f16` is not one of: f32, f64, f32+f64"),
    ("math = 'std'", "6: setting.math: `std` is not one of: libm, micromath"),
    ("model = 'half'", "6: setting.model: `half` is not one of: full, condensed"),
    ("solver = 'direct'", "6: setting.solver: `direct` is not one of: auto, sweeps, factor, exact"),
    ("solver = 'multigrid'", "6: setting.solver: `multigrid` is a solver of the desk, no device has it"),
    ("model = 'condensed'\nsolver = 'factor'", "7: setting.solver: a factor is for the full model"),
    ("model = 'full'\nsolver = 'exact'", "7: setting.solver: the exact method is for the condensed model"),
    ("solver = 'exact'\nsweeps = 9", "7: setting.sweeps: the exact method takes no number of sweeps"),
    ("solver = 'exact'\nshare = 0.1", "7: setting.share: the condensed model has no share to stop at"),
    ("solver = 'exact'\nomega = 1.5", "7: setting.omega: the condensed model has its own relaxation factor"),
    ("solver = 'exact'\nstart = 'cold'", "7: setting.start: the condensed model has no cold start"),
    ("solver = 'factor'\nsweeps = 9", "7: setting.sweeps: a factor takes no sweeps"),
    ("solver = 'factor'\nshare = 0.1", "7: setting.share: a factor leaves nothing of the bound to sweeps"),
    ("solver = 'factor'\nscalar = 'f32+f64'", "7: setting.scalar: a factor is for one number format"),
    ("start = 'hot'", "6: setting.start: `hot` is not one of: cold, warm"),
    ("omega = 2", "6: setting.omega: 2 is not inside (0, 2)"),
    ("omega = 0.0", "6: setting.omega: 0 is not inside (0, 2)"),
    ("omega = nan", "6: setting.omega: not a finite number"),
    ("omega = 'Auto'", "6: setting.omega: expected \"auto\" or a number inside (0, 2), found the text \"Auto\""),
    ("omega = true", "6: setting.omega: expected \"auto\" or a number inside (0, 2), found true"),
    ("sweeps = 0", "6: setting.sweeps: expected a whole number from 1 to 4294967295, found the number 0"),
    ("sweeps = 4294967296", "6: setting.sweeps: expected a whole number from 1 to 4294967295, found the number 4294967296"),
    ("share = 1", "6: setting.share: 1 is not inside (0, 1)"),
    ("share = 'all'", "6: setting.share: expected a number, found the text \"all\""),
    ("certificate = 1", "6: setting.certificate: expected true or false, found the number 1"),
    ("share = 0.1\nsweeps = 3", "6: setting.share: excludes `sweeps`: one of them says when to stop"),
    ("certificate = false\nshare = 0.1", "7: setting.share: a share of the error bound, which certificate = false leaves out"),
    ("model = 'condensed'\nshare = 0.1", "7: setting.share: the condensed model has no share to stop at"),
    ("model = 'condensed'\nomega = 1.5", "7: setting.omega: the condensed model has its own relaxation factor"),
    ("model = 'condensed'\nstart = 'cold'", "7: setting.start: the condensed model has no cold start"),
    ("scalar = 'f32+f64'\nmodel = 'condensed'", "6: setting.scalar: the condensed model is solved in one number format"),
    ("scalar = 'f64'\nmath = 'micromath'", "7: setting.math: micromath is for f32 alone"),
    ("math = 'micromath'\nscalar = 'f32+f64'", "6: setting.math: micromath is for f32 alone"),
];

#[test]
fn each_mistake_has_one_message_with_line_and_key() {
    for (lines, message) in WRONG {
        let error = parse(&with(lines)).expect_err(message);
        assert_eq!(error.to_string(), format!("scenes/levee.toml:{message}"));
        assert_eq!(error.exit_status(), 2);
    }
    for (lines, _) in WRONG.iter().filter(|(lines, _)| lines.contains('\n')) {
        let error = parse(&with(lines)).expect_err(lines);
        assert!(!hint(&error).is_empty(), "{lines}");
    }
    let error = parse(&format!("setting = 3\n{SMALL}")).expect_err("a number");
    let message = "scenes/levee.toml:1: setting: expected a table, found the number 3";
    assert_eq!(error.to_string(), message);
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
    assert!(missing.starts_with("levee.toml: No such file"), "{missing}");
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
