//! The example around a controller: a timer, a state that outlives a reset, a watchdog; for QEMU's boards, or for the desk.

use std::fmt::Write as _;

use super::names::field;
use crate::module_api::ModuleApi;
use signorini_image::library::Machine;

const MAIN: &str = include_str!("example/main.c");
const BOARD_H: &str = include_str!("example/board.h");
const BOARD: &str = include_str!("example/board.c");
const LINKER: &str = include_str!("example/board.ld");
const CMAKE: &str = include_str!("example/CMakeLists.txt");
const TOOLCHAIN: &str = include_str!("example/toolchain.cmake");
const BOARD_HOST: &str = include_str!("example/board_host.c");
const CMAKE_HOST: &str = include_str!("example/host.cmake");

/// Places on the example's board, by the tokens of its files: memories, timer and watchdog of CMSDK, and megahertz.
const MPS2: [(&str, &str); 7] = [
    ("@flash@", "0x00000000"),
    ("@retained-ram@", "0x20000000"),
    ("@ram@", "0x20100000"),
    ("@timer@", "0x40000000"),
    ("@timer-interrupt@", "8"),
    ("@watchdog@", "0x40008000"),
    ("@megahertz@", "25"),
];

/// Places on the mps2-an505, by the addresses of its secure state.
const AN505: [(&str, &str); 7] = [
    ("@flash@", "0x10000000"),
    ("@retained-ram@", "0x38000000"),
    ("@ram@", "0x38100000"),
    ("@timer@", "0x50000000"),
    ("@timer-interrupt@", "3"),
    ("@watchdog@", "0x50081000"),
    ("@megahertz@", "20"),
];

/// Its files.
pub(super) fn files(name: &str, api: &ModuleApi, on: &Machine) -> Vec<(String, String)> {
    let templates: &[(&str, &str)] = match on.board {
        Some(_) => &[
            ("main.c", MAIN),
            ("board.h", BOARD_H),
            ("board.c", BOARD),
            ("board.ld", LINKER),
            ("CMakeLists.txt", CMAKE),
            ("toolchain.cmake", TOOLCHAIN),
        ],
        None => &[
            ("main.c", MAIN),
            ("board.h", BOARD_H),
            ("board.c", BOARD_HOST),
            ("CMakeLists.txt", CMAKE_HOST),
        ],
    };
    let [machine, cpu] = on.board.map_or([""; 2], |board| [board.machine, board.cpu]);
    let retained = if on.board.is_some() { "__attribute__((section(\".retained\")))" } else { "" };
    let places = if machine == "mps2-an505" { AN505 } else { MPS2 };
    let filled = |text: &str| {
        let placed = places.iter().fold(text.to_owned(), |text, (of, is)| text.replace(of, is));
        let text = placed
            .replace("@sensors@", &sensors(name, api))
            .replace("@actuators@", &actuators(name, api))
            .replace("@pace@", &pace(api));
        let text = text
            .replace("@machine@", machine)
            .replace("@cpu@", cpu)
            .replace("@retained@", retained);
        text.replace("@NAME@", &name.to_uppercase()).replace("@name@", name)
    };
    templates.iter().map(|(file, text)| (format!("example/{file}"), filled(text))).collect()
}

/// A value for each input.
fn sensors(name: &str, api: &ModuleApi) -> String {
    let mut text = String::new();
    for (item, [lo, hi]) in api.inputs.iter().zip(&api.given_ranges) {
        let field = field(&item.identifier);
        let ends = match lo.is_finite() && hi.is_finite() {
            true => ["least", "most"].map(|end| format!("{name}_{end}_inputs.{field}")),
            false => ["-", "+"].map(|sign| format!("{name}_default_inputs.{field} {sign} 0.1f")),
        };
        let _ = writeln!(text, "    inputs->{field} = swing({}, {});", ends[0], ends[1]);
    }
    if text.is_empty() { "    (void)inputs;\n    (void)swing;\n".to_owned() } else { text }
}

/// A remark on the timer, where a tick is a step in time.
fn pace(api: &ModuleApi) -> String {
    let Some(step) = api.step else { return String::new() };
    format!(
        "/* A tick is a step of {step}: a board's timer comes as often. This one, in microseconds, does not wait so long. */\n"
    )
}

/// A line for each output, and one for the evolution in time.
fn actuators(name: &str, api: &ModuleApi) -> String {
    let mut text = String::new();
    for item in &api.outputs {
        let field = field(&item.identifier);
        let _ = writeln!(
            text,
            "    printf(\"  {field} %g +- %g\\n\", (double)outputs->{field}, (double)report->plus_minus.{field});"
        );
    }
    if text.is_empty() {
        text = "    (void)outputs;\n".to_owned();
    }
    if api.step.is_some() {
        let _ = write!(
            text,
            "    {{\n        {name}_scalar energy, seconds;\n        (void){name}_window(&state, &energy, &seconds);\n        \
             printf(\"  since the start: at most %g, as a mean over %g\\n\", (double)energy, (double)seconds);\n    }}\n"
        );
    }
    text
}
