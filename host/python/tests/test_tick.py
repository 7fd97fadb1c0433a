"""`tick`, `bake` and `Controller` beside the files of the command line."""

import csv
import subprocess
import threading

import numpy as np
import pytest

import signorini


def columns(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {key: [row[key] for row in rows] for key in rows[0]}


def numbers(values):
    return np.array([float(value) if value else np.nan for value in values])


@pytest.mark.parametrize("baked", [False, True])
def test_ticks_are_those_of_the_command_line(baked, scenes, command):
    words = ["tick", scenes / "levee.toml", "--ticks", "6", *(["--baked"] if baked else [])]
    out = command(*words)
    ticks = signorini.tick(scenes / "levee.toml", ticks=6, baked=baked)
    table = columns(out / "ticks.csv")
    for key in ("t", "contact_force", "contact_length", "error_bound", "sweeps"):
        assert np.array_equal(getattr(ticks, key), numbers(table[key]), equal_nan=True), key
    assert ticks.status.tolist() == table["status"]
    for name, values in ticks.outputs.items():
        assert np.array_equal(values, numbers(table[name])), name
    bounds = columns(out / "output_bounds.csv")
    assert np.array_equal(ticks.output_bounds["seepage"][:, 0], numbers(bounds["seepage_least"]))
    assert np.array_equal(ticks.output_bounds["seepage"][:, 1], numbers(bounds["seepage_most"]))
    assert np.isnan(ticks.output_bounds["wet"]).all()


def test_times_with_inputs_are_a_log(scenes, tmp_path):
    log = tmp_path / "log.csv"
    log.write_text("t,rain,river\n0,0,0\n0.5,2,0.1\n2,5,-1\n")
    scene = scenes / "levee.toml"
    by_log = signorini.tick(scene, log=log, baked=True)
    by_times = signorini.tick(scene, times=[0, 0.5, 2], inputs={"rain": [0, 2, 5], "river": [0, 0.1, -1]}, baked=True)
    assert np.array_equal(by_log.outputs["seepage"], by_times.outputs["seepage"])
    constant = signorini.tick(scene, times=[0, 1], inputs={"rain": 3}, intervals=False)
    assert len(constant) == 2 and np.isnan(constant.output_bounds["seepage"]).all()


def test_wrong_ticks(scenes):
    scene = scenes / "levee.toml"
    with pytest.raises(ValueError, match="one of ticks"):
        signorini.tick(scene, ticks=3, times=[0, 1])
    with pytest.raises(ValueError, match="one for each of times"):
        signorini.tick(scene, times=[0, 1], inputs={"rain": [1, 2, 3]})
    with pytest.raises(ValueError, match="come after"):
        signorini.tick(scene, times=[1, 1])
    with pytest.raises(signorini.SceneError, match="outside the range"):
        signorini.tick(scene, times=[0, 1], inputs={"rain": [1, 9]})
    with pytest.raises(signorini.SceneError, match="no input `snow`") as raised:
        signorini.tick(scene, times=[0, 1], inputs={"snow": [1, 2]})
    assert "rain" in raised.value.hint


def test_a_module_is_that_of_the_command_line(scenes, command, tmp_path):
    written = tmp_path / "levee.rs"
    subprocess.run([command.program, "bake", scenes / "levee.toml", "-o", written], check=True, capture_output=True)
    baked = signorini.bake(scenes / "levee.toml")
    assert baked.source == written.read_text()
    assert baked.chosen["model"] == "condensed"
    baked.save(tmp_path / "again.rs")
    assert (tmp_path / "again.rs").read_text() == baked.source
    missing = tmp_path / "missing" / "levee.rs"
    with pytest.raises(FileNotFoundError) as raised:
        baked.save(missing)
    assert raised.value.filename == str(missing) and not (tmp_path / "missing").exists()
    with pytest.raises(OSError) as raised:
        baked.save(tmp_path)
    assert raised.value.filename == str(tmp_path) and not list(tmp_path.parent.glob(f"{tmp_path.name}.*"))
    with pytest.raises(TypeError, match="scalar is <class 'numpy.float32'>"):
        signorini.bake(scenes / "levee.toml", scalar=np.float32)
    with pytest.raises(TypeError, match="scalar is <class 'numpy.float32'>"):
        signorini.Controller(scenes / "levee.toml", scalar=np.float32)
    assert signorini.bake(scenes / "levee.toml", model="full", scalar="f64").chosen["model"] == "full"
    with pytest.raises(ValueError, match="full or condensed"):
        signorini.bake(scenes / "levee.toml", model="half")


@pytest.mark.parametrize("name", ["levee", "antiicing"])
def test_a_controller_has_the_bits_of_the_baked_ticks(name, scenes):
    scene = scenes / f"{name}.toml"
    controller = signorini.Controller(scene)
    ends = controller.ranges
    random = np.random.default_rng(5)
    drawn = {input: random.uniform(*ends[input], size=8).tolist() for input in ends}
    ticks = signorini.tick(scene, times=range(8), inputs=drawn, baked=True)
    for at in range(8):
        answer = controller(**{input: values[at] for input, values in drawn.items()})
        for output, value in answer.outputs.items():
            assert value == ticks.outputs[output][at], (output, at)
            ends = answer.between[output]
            assert np.isfinite(ends).all() == np.isfinite(answer.plus_minus[output])
            if np.isfinite(ends).all():
                assert list(ends) == ticks.output_bounds[output][at].tolist()
        assert answer.bound == ticks.error_bound[at]
        assert answer.ended == ticks.status[at]


def test_a_refused_input_leaves_the_state(scenes):
    one, other = (signorini.Controller(scenes / "levee.toml") for _ in range(2))
    one(rain=1), other(rain=1)
    with pytest.raises(signorini.SceneError) as raised:
        one(rain=50)
    assert raised.value.key == "input.rain"
    with pytest.raises(signorini.SceneError, match="finite"):
        one(rain=float("nan"))
    with pytest.raises(TypeError, match="rain, river"):
        one(snow=1)
    assert one(rain=2, river=0.2) == other(rain=2, river=0.2)
    one.reset()
    assert one() == signorini.Controller(scenes / "levee.toml")()


def test_threads_share_a_controller(scenes):
    controller = signorini.Controller(scenes / "levee.toml")
    expected = {rain: round(controller(rain=rain)["seepage"], 9) for rain in range(5)}
    wrong = []

    def ask(rain):
        for _ in range(20):
            if round(controller(rain=rain)["seepage"], 9) != expected[rain]:
                wrong.append(rain)

    threads = [threading.Thread(target=ask, args=(rain,)) for rain in range(5)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def refined(scene, error):
    """The mesh that an error takes, as arrays."""
    result = signorini.solve(scene, max_error=error)
    boundaries = [name for name in np.unique(result.edges["boundary"]) if name]
    curves = {name: result.edges["vertices"][result.edges["boundary"] == name] for name in boundaries}
    regions = [name for name in np.unique(result.regions) if name != "default"]
    surfaces = {name: np.flatnonzero(result.regions == name) for name in regions}
    return result.points, {"triangle": result.triangles, "quad": result.quads}, curves, surfaces


@pytest.mark.parametrize(
    "name, error", [("levee", "4%"), ("slab", "5%"), ("strip", "4%"), ("pit", "5%"), ("antiicing", "10%")]
)
def test_intervals_of_ticks_hold_what_a_finer_mesh_says(name, error, scenes):
    scene = scenes / f"{name}.toml"
    controller = signorini.Controller(scene)
    random = np.random.default_rng(7)

    def drawn(input):
        ends = controller.ranges[input]
        near = controller.defaults[input] + np.array([-0.1, 0.1])
        return random.uniform(*(ends if np.isfinite(ends).all() else near), size=4)

    inputs = {input: drawn(input) for input in controller.ranges}
    times = range(4)
    own, baked = (signorini.tick(scene, times=times, inputs=inputs, baked=of) for of in (False, True))
    finer = signorini.tick(scene, refined(scene, error), times=times, inputs=inputs)
    # A controller has no interval of a probe, whose own is about another number: the mean over a cell.
    known = [output for output, ends in baked.output_bounds.items() if np.isfinite(ends).all()]
    assert known
    for output in known:
        for ticks in (own, baked):
            least, most = ticks.output_bounds[output].T
            assert ((least <= finer.outputs[output]) & (finer.outputs[output] <= most)).all(), output


def test_loads_that_contact_cannot_hold(tmp_path):
    scene = tmp_path / "pushed.toml"
    scene.write_text("""
mesh = "given.msh"
[material.default]
conductivity = 1
[boundary.right]
kind = "contact"
[boundary.left]
kind = "neumann"
flux = -1
[boundary.default]
kind = "neumann"
flux = 0
[input.push]
of = "left"
field = "flux"
pattern = 1
range = [-3, 3]
[output.power]
kind = "force"
""")
    steps = np.linspace(0, 1, 5)
    x, y = (grid.ravel() for grid in np.meshgrid(steps, steps))
    at = np.arange(25).reshape(5, 5)
    quads = np.stack([at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]], axis=-1).reshape(-1, 4)
    edges = {
        "left": np.stack([at[:-1, 0], at[1:, 0]], axis=-1),
        "right": np.stack([at[:-1, -1], at[1:, -1]], axis=-1),
    }
    mesh = (np.stack([x, y], axis=-1), {"quad": quads}, edges)
    controller = signorini.Controller(scene, mesh)
    before = controller(push=-1)
    for push, why in ((2, "no-solution"), (1, "not-unique")):
        with pytest.raises(signorini.SceneError) as raised:
            controller(push=push)
        assert raised.value.refusal == why
    assert controller(push=-1) == before
    for baked in (False, True):
        with pytest.warns(signorini.SolveWarning, match="2 of 4 ticks have no solution"):
            ticks = signorini.tick(scene, mesh, times=[0, 1, 2, 3], inputs={"push": [-1, 2, 1, -1]}, baked=baked)
        assert ticks.status.tolist()[1:3] == ["no-solution", "not-unique"]
        assert np.isnan(ticks.outputs["power"][1:3]).all()
        assert np.allclose(ticks.outputs["power"][[0, 3]], 2)


@pytest.fixture
def warm(scenes):
    """A scene whose ticks are steps in time."""
    return scenes / "antiicing-warm.toml"


def test_steps_in_time_are_those_of_the_command_line(warm, command):
    out = command("tick", warm, "--ticks", "3", "--step", "0.25")
    ticks = signorini.tick(warm, ticks=3, step=0.25)
    table, bounds = columns(out / "ticks.csv"), columns(out / "output_bounds.csv")
    assert ticks.status[0] == "start" and ticks.t.tolist() == [0, 0.25, 0.5, 0.75]
    for key in ("error_bound", "window_energy", "window_seconds"):
        assert np.array_equal(getattr(ticks, key), numbers(table[key]), equal_nan=True), key
    assert np.isnan(ticks.window_error).all()
    for name in ("nose_skin", "nose_skin_step"):
        ends = [numbers(bounds[f"{name}_{end}"]) if f"{name}_{end}" in bounds else np.full(4, np.nan) for end in ("least", "most")]
        assert np.array_equal(ticks.output_bounds[name].T, ends, equal_nan=True), name
    assert np.isfinite(ticks.output_bounds["nose_skin_step"][1:]).all()
    # Times that are given have no row of the start, and follow each other by the step.
    assert signorini.tick(warm, times=[0.5, 1], step=0.5, intervals=False).t.tolist() == [0.5, 1]
    with pytest.raises(signorini.SceneError, match="expected the step 0.5"):
        signorini.tick(warm, times=[0.5, 1.2], step=0.5)


def test_a_play_goes_on_from_its_file(warm, tmp_path):
    state, jump = tmp_path / "state.json", {"ambient": -30}
    whole = signorini.tick(warm, ticks=5, inputs=jump, tolerance=1e-9)
    signorini.tick(warm, ticks=2, inputs=jump, tolerance=1e-9, save=state)
    rest = signorini.tick(warm, ticks=3, tolerance=1e-9, begin=state)
    assert np.array_equal(rest.t, whole.t[3:]) and np.array_equal(rest.window_energy, whole.window_energy[3:])
    for name, values in rest.outputs.items():
        assert np.array_equal(values, whole.outputs[name][3:]), name
    other = signorini.tick(warm, ticks=3, inputs={"ambient": 0}, tolerance=1e-9, begin=state)
    assert not np.array_equal(other.outputs["nose_skin"], rest.outputs["nose_skin"])
    with pytest.raises(signorini.SceneError, match="step: the state is one of step 1"):
        signorini.tick(warm, ticks=3, step=0.25, begin=state)
    with pytest.raises(ValueError, match="baked takes no save"):
        signorini.tick(warm, ticks=3, baked=True, save=state)


def test_ticks_say_what_they_warn_of(scenes, tmp_path):
    text = (scenes / "levee.toml").read_text().replace('mesh = "', f'mesh = "{scenes}/')
    scene = tmp_path / "stored.toml"
    scene.write_text(text.replace("[material.sand]", "[material.sand]\ncapacity = 1", 1))
    with pytest.warns(signorini.SolveWarning, match="capacity"):
        ticks = signorini.tick(scene, ticks=1, intervals=False)
    assert any("capacity" in sentence for sentence in ticks.warnings)


def test_a_controller_goes_on_from_its_state(warm, scenes):
    one, other = signorini.Controller(warm), signorini.Controller(warm)
    start, begun = one.state(), one.window()
    for ambient in (-22, -30, -35):
        one(ambient=ambient)
    state, window = one.state(), one.window()
    # A stated start has no bound over time before its first step.
    assert window != begun and np.isfinite(window).all()
    then = [one(ambient=ambient) for ambient in (-35, -10)]
    other(ambient=5)
    other.restore(state)
    assert other.window() == window and other.state() == state
    assert [other(ambient=ambient) for ambient in (-35, -10)] == then and other.window() == one.window()
    for at in (0, 3, 9, 16, len(state) // 2):
        damaged = bytearray(state)
        damaged[at] ^= 4
        with pytest.raises(signorini.SceneError) as raised:
            other.restore(bytes(damaged))
        assert raised.value.refusal == ("foreign-state" if at < 8 else "damaged-state")
    for foreign in (b"", bytes(len(state)), state[:-8]):
        with pytest.raises(signorini.SceneError):
            other.restore(foreign)
    assert other.state() == one.state()
    other.restore(start)
    assert other.window() == begun
    other.reset()
    assert other.state() == start
    with pytest.raises(ValueError, match="does not step in time"):
        signorini.Controller(scenes / "levee.toml").state()
