//! Headers as the compiler sees them.

use std::process::Command;

use super::super::names::{KEYWORDS_OF_C, KEYWORDS_OF_CPP, MACROS, name_of};
use super::*;
use crate::choice::{Choice, Wanted};
use crate::emit::emit;
use crate::item::items;
use crate::tests::standard;
use signorini_image::library::MACHINES;

/// The header of a standard scene for this machine, with the sizes of a state and a report; `outputs` stand in it instead of
/// the scene's own, where there are any.
fn header_with(name: &str, state: usize, report: usize, outputs: &[&str]) -> String {
    let problem = standard(name, |_| ());
    let chosen = Choice::<f32>::new(&problem, Wanted::default()).expect("a model");
    let mut chosen = emit(&problem, &chosen).chosen;
    let (mut api, on) = (ModuleApi::new(&problem), &MACHINES[MACHINES.len() - 1]);
    if !outputs.is_empty() {
        let docs = outputs.iter().map(|_| "One of many.".to_owned());
        api.outputs = items(outputs.iter().copied(), docs);
        chosen.without_interval = vec![None; outputs.len()];
    }
    let mark = "_of_0123456789abcdef_01234567".to_owned();
    let saved = problem.scene.stores().then_some(16);
    let library = Library { archive: Vec::new(), state, report, saved, mark };
    let name = name_of(&problem);
    Header { name: &name, api: &api, chosen: &chosen, library: &library, on }.text()
}

fn header(name: &str, state: usize, report: usize) -> String {
    header_with(name, state, report, &[])
}

fn compiled(header: &str) -> Result<(), String> {
    compiled_by("cc", "-std=c99", header)
}

/// Words of a compiler of the desk on a text.
fn compiled_by(compiler: &str, age: &str, text: &str) -> Result<(), String> {
    let language = if compiler == "c++" { "c++" } else { "c" };
    told(compiler, &format!("{age} -Wpedantic -fsyntax-only -x {language} main"), &[("main", text)])
}

/// Words of a compiler on these files, for which every warning is an error.
fn told(compiler: &str, words: &str, files: &[(&str, &str)]) -> Result<(), String> {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).expect("a file");
    }
    let mut command = Command::new(compiler);
    command.args(["-Wall", "-Wextra", "-Werror"]).args(words.split(' '));
    let said = command.current_dir(folder.path()).output().expect("a C compiler");
    match said.status.success() {
        true => Ok(()),
        false => Err(String::from_utf8_lossy(&said.stderr).into_owned()),
    }
}

/// The header behind all headers of C: no field is called as a keyword or a macro.
#[test]
fn it_holds_every_word_of_c_and_cpp() {
    let words = [KEYWORDS_OF_C, KEYWORDS_OF_CPP, MACROS].map(str::split_whitespace);
    let words: Vec<_> = words.into_iter().flatten().collect();
    assert!(words.len() > 150 && words.contains(&"co_await"), "{words:?}");
    // 13 numbers and words, and an interval for each output.
    let text = header_with("levee", 624, 52 + 4 * words.len(), &words);
    let include = |name| format!("#if __has_include(<{name}.h>)\n#include <{name}.h>\n#endif\n");
    let names = "assert complex errno math signal stdalign stdio stdlib threads time";
    let before: String = names.split(' ').map(include).collect();
    for age in ["-std=gnu99", "-std=gnu17", "-std=gnu2x"] {
        assert_eq!(compiled_by("cc", age, &(before.clone() + &text)), Ok(()), "{age}");
    }
    let before = before.replace("complex.h", "iso646.h").replace("threads.h", "wchar.h");
    for age in ["-std=gnu++11", "-std=gnu++20", "-std=gnu++23"] {
        assert_eq!(compiled_by("c++", age, &(before.clone() + &text)), Ok(()), "{age}");
    }
}

/// A program with one header whose functions are those of another one.
fn linked(header: &str, of_library: &str) -> Result<(), String> {
    let library = "levee_error levee_init(levee_state *state) { (void)state; return LEVEE_OK; }\n\
                   const levee_inputs levee_default_inputs = {0, 0};\n";
    let main = "static levee_state state;\nint main(void) {\n    levee_inputs inputs = levee_default_inputs;\n    \
                (void)inputs;\n    return levee_init(&state);\n}\n";
    let main = &format!("#include \"scene.h\"\n{main}");
    let library = &format!("#include \"library.h\"\n{library}");
    let files =
        [("scene.h", header), ("library.h", of_library), ("main.c", main), ("library.c", library)];
    told("cc", "-std=c99 main.c library.c -o program", &files)
}

/// Two controllers of one scene, whose states and reports have the same sizes.
#[test]
fn a_header_and_the_library_of_another_bake_do_not_link() {
    let own = header("levee", 624, 64);
    assert_eq!(linked(&own, &own), Ok(()));
    let other = own.replace("_01234567", "_01234568");
    let why = linked(&own, &other).expect_err("two bakes");
    for name in [
        "levee_init_of_0123456789abcdef_01234567",
        "levee_default_inputs_of_0123456789abcdef_01234567",
    ] {
        assert!(why.contains(name) && why.contains("undefined"), "{why}");
    }
    for own in exports(false) {
        let define = format!("#define levee_{own} levee_{own}_of_");
        let is_declared = [format!("levee_{own}("), format!("levee_{own};")];
        assert!(other.contains(&define) && is_declared.iter().any(|text| other.contains(text)));
    }
}

#[test]
fn it_is_c_and_asserts_the_sizes_of_the_library() {
    // Three outputs: 13 numbers and words of 4 bytes, and three intervals.
    let levee = header("levee", 624, 64);
    assert_eq!(compiled(&levee), Ok(()));
    assert!(compiled(&header("levee", 624, 68)).is_err_and(|why| why.contains("report_has")));
    let wrong = levee.replace("words[78]", "words[77]");
    assert!(compiled(&wrong).is_err_and(|why| why.contains("state_has")));
    for line in [
        "levee_error levee_init(levee_state *state);",
        "extern const levee_inputs levee_default_inputs;",
        "    LEVEE_INPUT_OUT_OF_RANGE = 5,",
        "     * contact set has none. */",
        "#define LEVEE_WORST_EXCHANGES 10u",
    ] {
        assert!(levee.lines().any(|of| of == line), "{line}");
    }
    let left = levee.replace("_name_of_", "");
    assert!(!left.contains("name_") && !left.contains(MARK));
    assert_eq!(compiled(&header("slab", 8, 64)), Ok(()));
}

/// What steps in time has a saved state, of the library's size, and the bound of the evolution; nothing else has.
#[test]
fn steps_in_time_have_a_state_that_outlives_the_program() {
    // 13 numbers and words of 4 bytes, and intervals of ten outputs.
    let warm = header("antiicing-warm", 33_000, 92);
    assert_eq!(compiled(&warm), Ok(()));
    assert_eq!(compiled_by("c++", "-std=c++98", &warm), Ok(()));
    let wrong = warm.replace("words[2]", "words[1]");
    assert!(compiled(&wrong).is_err_and(|why| why.contains("saved_has_the_size")));
    for line in [
        "#define ANTIICING_WARM_STEP 1.0",
        "antiicing_warm_error antiicing_warm_save(const antiicing_warm_state *state, antiicing_warm_saved *saved);",
    ] {
        assert!(warm.lines().any(|of| of == line), "{line}");
    }
    let said = warm.replace("\n *", "");
    assert!(said.contains("A tick is a step of length ANTIICING_WARM_STEP"), "{warm}");
    assert!(said.contains("antiicing_warm_window bounds the error"), "{warm}");
    let levee = header("levee", 624, 64);
    assert!(["_saved", "_window", "LEVEE_STEP"].iter().all(|of| !levee.contains(of)));
}
