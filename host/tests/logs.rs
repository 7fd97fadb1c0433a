//! Recorded inputs in `tests/firmware/logs`, played by the controllers that `bake` writes: inputs that stay for 40 ticks, and a
//! flight from cold beside the steady model on the same inputs.

use crate::command::{meshes, repository, text, word};
use crate::tick::{Table, played};

/// A standard scene on a log.
fn replayed(scene: &str, log: &str, more: &[&str]) -> Table {
    let log = word(&repository(&format!("tests/firmware/logs/{log}.csv")));
    let own = ["--log", &log, "--baked", "--no-intervals"];
    played(&format!("scenes/{scene}.toml"), &[&own, more].concat())
}

/// The lines of a scene that say something, without its title, its times and what a tick may take.
fn data(name: &str) -> Vec<String> {
    let scene = text(meshes(&format!("scenes/{name}.toml")));
    let lines = scene.lines().map(|line| line.split('#').next().unwrap_or_default().trim());
    let of_time = ["title", "step", "end", "initial", "tick"];
    let is_data =
        |line: &&str| !line.is_empty() && !of_time.iter().any(|own| line.starts_with(own));
    lines.filter(is_data).map(str::to_owned).collect()
}

#[test]
fn scenes_that_store_have_all_data_of_their_steady_ones() {
    for name in ["antiicing", "levee"] {
        let (warm, mut at) = (data(&format!("{name}-warm")), 0);
        for line in data(name).iter().filter(|line| *line != "[time]") {
            let found = warm[at..].iter().position(|of| of == line);
            at += 1 + found.unwrap_or_else(|| panic!("{name}: `{line}` is lacking"));
        }
        assert!(warm.iter().any(|line| line.starts_with("capacity")));
    }
}

#[test]
fn every_tick_of_a_log_has_an_answer_and_both_bounds() {
    for (scene, log, more) in [
        ("antiicing-warm", "antiicing-10ms", &["--step", "0.01"][..]),
        ("antiicing-warm", "antiicing-1s", &[]),
        ("levee-warm", "levee-60s", &[]),
    ] {
        let inputs = Table::read(repository(&format!("tests/firmware/logs/{log}.csv")));
        let values: Vec<_> = inputs.lines.iter().map(|line| &line[1..]).collect();
        for (at, pair) in (1..).zip(values.windows(2)) {
            assert_eq!(pair[0] == pair[1], at % 40 != 0, "{log}, line {at}");
        }
        let table = replayed(scene, log, more);
        assert_eq!((inputs.lines.len(), table.lines.len()), (400, 400), "{log}");
        for bound in ["error_bound", "window_energy"] {
            let bounds = table.numbers(bound);
            assert!(bounds.iter().all(|bound| *bound > 0.0 && bound.is_finite()), "{log}: {bound}");
        }
    }
}

const MATS: [&str; 3] = ["nose", "middle", "aft"];
/// Seconds of the flight in cruise with both generators, those with one, and those behind.
const CRUISE: std::ops::Range<usize> = 300..550;
const OUT: std::ops::Range<usize> = 550..700;

/// A row of the page's table: what, and a text for each mat.
fn row(what: &str, of: impl Fn(&str) -> String) -> String {
    let [nose, middle, aft] = MATS.map(of);
    format!("| {what} | {nose} | {middle} | {aft} |")
}

/// The rows on one model.
fn rows(model: &str, table: &Table) -> [String; 5] {
    let skin = |mat: &str| table.numbers(&format!("{mat}_skin"));
    let least = |of: &[f64]| of.iter().copied().fold(f64::INFINITY, f64::min);
    let most = |of: &[f64]| of.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let after = |mat: &str, from: usize| {
        let warm = skin(mat)[from..].iter().position(|skin| *skin >= 0.5);
        (1 + warm.expect("it gets warm")).to_string()
    };
    [
        row(&format!("0.5 °C from cold after, s; {model}"), |mat| after(mat, 0)),
        row(&format!("0.5 °C with both generators again after, s; {model}"), |mat| {
            after(mat, OUT.end)
        }),
        row(&format!("skin in the cruise, °C; {model}"), |mat| {
            let skin = &skin(mat)[CRUISE];
            format!("{:.1} to {:.1}", least(skin), most(skin))
        }),
        row(&format!("coldest with one generator, °C; {model}"), |mat| {
            format!("{:.1}", least(&skin(mat)[OUT]))
        }),
        row(&format!("saturated, s; {model}"), |mat| {
            let lengths = table.numbers(&format!("{mat}_saturated"));
            lengths.iter().filter(|length| **length > 0.0).count().to_string()
        }),
    ]
}

#[test]
fn the_page_tells_how_far_off_the_steady_model_is_on_a_flight() {
    let [warm, steady] =
        ["antiicing-warm", "antiicing"].map(|scene| replayed(scene, "flight", &[]));
    assert_eq!((warm.lines.len(), steady.lines.len()), (1200, 1200));
    let off = row("how far off the steady model is, K; at most, root mean square", |mat| {
        let [warm, steady] = [&warm, &steady].map(|table| table.numbers(&format!("{mat}_skin")));
        let off: Vec<_> =
            warm.iter().zip(steady).map(|(warm, steady)| (warm - steady).abs()).collect();
        let mean = off.iter().map(|off| off * off).sum::<f64>() / off.len() as f64;
        format!("{:.1}, {:.1}", off.into_iter().fold(0.0, f64::max), mean.sqrt())
    });
    let (in_time, at_rest) = (rows("in time", &warm), rows("steady", &steady));
    let pairs = in_time.into_iter().zip(at_rest).flat_map(|(one, other)| [one, other]);
    let table: Vec<_> = pairs.chain([off]).collect();
    let page = text(repository("docs/time.md"));
    assert!(page.contains(&table.join("\n")), "docs/time.md lacks\n{}", table.join("\n"));
}

#[test]
fn the_page_shows_what_ticks_take() {
    let record = text(repository("tests/firmware/logs.txt"));
    let (_, tables) = record.split_once("\n\n").expect("versions, then tables");
    assert!(text(repository("docs/time.md")).contains(tables), "docs/time.md lacks\n{tables}");
}
