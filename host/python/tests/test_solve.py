"""`solve` beside the files of the command line, and what is wrong with input."""

import csv
import json
import subprocess

import meshio
import numpy as np
import pytest

import signorini

BAR = {
    "title": "a heated bar",
    "material": {"default": {"conductivity": 3}},
    "boundary": {
        "cold": {"kind": "dirichlet", "value": 0},
        "heater": {"kind": "contact", "gap": 2},
        "default": {"kind": "neumann", "flux": 0},
    },
}
SQUARE = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
# The same square, 3 above the plane of the scene.
RAISED = np.column_stack([SQUARE, np.full(4, 3.0)])
CURVES = {"cold": [[3, 0]], "heater": [[1, 2]]}


def table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


@pytest.mark.parametrize("name", ["levee", "strip", "antiicing"])
def test_arrays_are_the_columns_of_the_command_line(name, scenes, command):
    out = command("solve", scenes / f"{name}.toml")
    result = signorini.solve(scenes / f"{name}.toml")
    rows = table(out / "edges.csv")

    def column(key):
        return np.array([float(row[key]) for row in rows])

    assert np.array_equal(result.u, column("u_mean"))
    assert np.array_equal(result.flux, column("flux_normal"))
    ends = np.column_stack([column(key) for key in ("x0", "y0", "x1", "y1")])
    assert np.array_equal(result.edges["ends"], ends)
    for key in ("kind", "boundary"):
        assert result.edges[key].tolist() == [row[key] for row in rows]
    cells = [[int(row["left"]), int(row["right"] or -1)] for row in rows]
    assert result.edges["cells"].tolist() == cells
    touching = [rows[edge] for edge in result.contact["edge"]]
    for key in ("lambda", "psi", "q", "limit"):
        assert np.array_equal(result.contact[key], [float(row[key]) for row in touching]), key
    words = {1: "open", 0: "touching", -1: "saturated"}
    assert [words[state] for state in result.contact["state"]] == [row["state"] for row in touching]
    gap = np.where(result.contact["state"] == 0, 0, result.u[result.contact["edge"]] - result.contact["psi"])
    assert np.array_equal(result.contact["gap"], gap)


def test_the_summary_is_the_command_line_s(scenes, command):
    out = command("solve", scenes / "levee.toml", "--input", "rain=2")
    result = signorini.solve(scenes / "levee.toml", inputs={"rain": 2})
    summary = json.loads((out / "summary.json").read_text())
    for of in (summary, result.summary):
        del of["seconds"]
    assert result.summary == summary
    assert result.bound == summary["error_bound"]["total"]
    assert result.relative_bound == summary["relative_error_bound"]
    seepage = result.outputs["seepage"]
    assert seepage.value == summary["outputs"]["seepage"]
    assert seepage.plus_minus == summary["output_bounds"]["seepage"]["plus_minus"]
    assert result.outputs["wet"].center is None and "length" in result.outputs["wet"].reason


def test_intervals_can_be_left_out(scenes):
    scene = scenes / "levee.toml"
    assert signorini.solve(scene).summary["output_bounds"]
    assert not signorini.solve(scene, intervals=False).summary["output_bounds"]
    with pytest.raises(TypeError, match="expected True or False"):
        signorini.solve(scene, intervals="no")


def test_fields_are_those_of_the_files(scenes, tmp_path):
    result = signorini.solve(scenes / "strip.toml", out=tmp_path)
    written = meshio.read(tmp_path / "solution.vtu")
    mesh = result.to_meshio()
    assert np.array_equal(mesh.points, written.points)
    for own, read in zip(mesh.cells, written.cells):
        assert own.type == read.type and np.array_equal(own.data, read.data)
    for name in ("u", "flux", "indicator"):
        for own, read in zip(mesh.cell_data[name], written.cell_data[name]):
            assert np.array_equal(own, read[:, : own.shape[1]] if own.ndim == 2 else read), name
    assert np.array_equal(mesh.point_data["u_continuous"], written.point_data["u_continuous"])
    assert set(result.regions) <= set(written.field_data)
    assert (tmp_path / "summary.json").exists() and (tmp_path / "edges.csv").exists()


def test_a_mesh_in_arrays_is_the_one_of_the_file(scenes):
    scene = scenes / "levee.toml"
    read = meshio.read(next(scenes.parent.rglob("levee.msh")))
    by_file, by_arrays = signorini.solve(scene), signorini.solve(scene, read)
    assert by_arrays.summary["unknowns"] == by_file.summary["unknowns"]
    assert by_arrays.bound == pytest.approx(by_file.bound, rel=1e-9)
    assert by_arrays.outputs["seepage"].value == pytest.approx(by_file.outputs["seepage"].value, rel=1e-9)


def test_a_dictionary_with_arrays():
    result = signorini.solve(BAR, (SQUARE, {"quad": [[0, 1, 2, 3]]}, CURVES))
    assert result.summary["contact_force"] == pytest.approx(6)
    assert result.outputs["contact_force"].plus_minus < 1e-7
    assert result.edges["boundary"][result.edges["kind"] == "contact"].tolist() == ["heater"]


def test_cells_are_turned_and_points_without_a_cell_dropped():
    points = np.vstack([[[9.0, 9.0]], SQUARE])
    triangles = np.array([[1, 3, 2], [1, 3, 4]], dtype=np.int32)
    curves = {"cold": [[1, 4]], "heater": [[2, 3]]}
    result = signorini.solve(BAR, (points, {"triangle": triangles}, curves))
    assert result.point_numbers.tolist() == [1, 2, 3, 4]
    assert result.summary["contact_force"] == pytest.approx(6)


def test_surfaces_have_materials():
    scene = {**BAR, "material": {"left": {"conductivity": 3}, "right": {"conductivity": 6}}}
    points = [[0, 0], [1, 0], [2, 0], [2, 1], [1, 1], [0, 1]]
    cells = {"quad": [[0, 1, 4, 5], [1, 2, 3, 4]]}
    curves = {"cold": [[5, 0]], "heater": [[2, 3]]}
    result = signorini.solve(scene, (points, cells, curves, {"left": [0], "right": [1]}))
    assert result.regions.tolist() == ["left", "right"]
    assert result.summary["contact_force"] == pytest.approx(2 / (1 / 3 + 1 / 6))


def test_an_error_that_is_asked_for(scenes):
    result = signorini.solve(scenes / "levee.toml", max_error="8%")
    assert result.converged and result.relative_bound < 0.08
    with pytest.warns(signorini.SolveWarning, match="more than the 4000"):
        limited = signorini.solve(scenes / "levee.toml", max_error="1%", max_unknowns=4000)
    assert limited.summary["unknowns"] <= 4000 and limited.warnings
    with pytest.warns(signorini.SolveWarning, match="out-of-sweeps"):
        cut = signorini.solve(scenes / "levee.toml", max_sweeps=3)
    assert not cut.converged and "not converged: out-of-sweeps" in repr(cut)


def test_arrays_are_not_copies():
    result = signorini.solve(BAR, (SQUARE, {"quad": [[0, 1, 2, 3]]}, CURVES))
    assert result.u.base is not None and result.u.flags.c_contiguous
    result.u[0] = 7.0
    assert result.u[0] == 7.0


def test_a_wrong_file_names_file_line_key_and_hint(tmp_path, scenes):
    text = (scenes / "levee.toml").read_text().replace('kind = "contact"', 'kind = "contakt"', 1)
    wrong = tmp_path / "wrong.toml"
    wrong.write_text(text)
    with pytest.raises(signorini.SceneError) as raised:
        signorini.solve(wrong)
    error = raised.value
    line = 1 + text[: text.index("contakt")].count("\n")
    assert (error.file, error.line) == (str(wrong), line)
    assert error.key.endswith(".kind") and "contakt" in error.message
    assert str(wrong) in str(error) and (error.hint is None or error.hint in str(error))
    assert isinstance(error, ValueError)


@pytest.mark.parametrize(
    "scene, mesh, said",
    [
        ({**BAR, "boundary": {"cold": {"kind": "dirichlet", "value": "1+"}}}, None, "boundary.cold.value"),
        ({**BAR, "boundary": {"cold": {"kind": None}}}, None, "boundary.cold.kind: None"),
        (BAR, (SQUARE, {"quad": [[0, 1, 2, 3]]}, {**CURVES, "hot": np.empty((0, 2), int)}), "`hot` has no edge"),
        ({**BAR, "boundary": {**BAR["boundary"], "hot": {"kind": "contact", "gap": 1}}}, None, "the mesh that was given"),
        (BAR, (SQUARE, {"quad": [[0, 1, 2, 7]]}, CURVES), "quad 0 has the vertex 7"),
        (BAR, (SQUARE, {"quad": [[0, 1, 3, 2]]}, CURVES), "quad 0 crosses itself"),
        (BAR, (SQUARE, {"quad": [[0, 1, 2, 3]]}, {"cold": [[0, 2]]}), "curve `cold`: no cell has the edge"),
    ],
)
def test_wrong_scenes_and_meshes(scene, mesh, said):
    mesh = mesh or (SQUARE, {"quad": [[0, 1, 2, 3]]}, CURVES)
    with pytest.raises(signorini.SceneError, match=said) as raised:
        signorini.solve(scene, mesh)
    assert raised.value.file is None and raised.value.line is None


@pytest.mark.parametrize(
    "mesh, said",
    [
        ((SQUARE, {"quad": [[0, 1, 2, -1]]}, CURVES), "from 0 on"),
        ((SQUARE, {"hexahedron": []}, CURVES), "hexahedron"),
        ((SQUARE, {"quad": [[0.0, 1.0, 2.0, 3.0]]}, CURVES), "expected integers"),
        ((np.ones((4, 4)), {"quad": [[0, 1, 2, 3]]}, CURVES), "n × 2 or n × 3"),
        ((RAISED + [[0, 0, 1]] * np.eye(4)[:, :1], {"quad": [[0, 1, 2, 3]]}, CURVES), "plane z = constant"),
        ((SQUARE,), "expected a path"),
    ],
)
def test_arrays_of_another_shape(mesh, said):
    with pytest.raises((ValueError, TypeError), match=said):
        signorini.solve(BAR, mesh)


def test_a_plane_may_lie_anywhere():
    flat = signorini.solve(BAR, (SQUARE, {"quad": [[0, 1, 2, 3]]}, CURVES))
    # A point that no cell has may lie in another one.
    points = np.vstack([RAISED, [[7.0, 7.0, -1.0]]])
    raised = signorini.solve(BAR, (points, {"quad": [[0, 1, 2, 3]]}, CURVES))
    cells = [("quad", [[0, 1, 2, 3]]), ("line", [[3, 0], [1, 2]])]
    sets = {"cold": [np.array([], int), np.array([0])], "heater": [np.array([], int), np.array([1])]}
    mesh = signorini.solve(BAR, meshio.Mesh(RAISED, cells, cell_sets=sets))
    for other in (raised, mesh):
        assert np.array_equal(other.u, flat.u) and np.array_equal(other.points, flat.points)


@pytest.mark.parametrize(
    "arguments, named",
    [
        ({"scene": b"levee.toml"}, "scene is b'levee.toml'"),
        ({"scene": "levee\ud800.toml"}, "scene is 'levee"),
        ({"scene": 7}, "scene is 7"),
        ({"mesh": b"levee.msh"}, "mesh is b'levee.msh'"),
        ({"mesh": "levee\ud800.msh"}, "mesh is 'levee"),
        ({"scalar": np.float32}, "scalar is <class 'numpy.float32'>, expected f32 or f64"),
        ({"scalar": "\ud800"}, "scalar is"),
        ({"solver": 1}, "solver is 1"),
        ({"tolerance": "small"}, "tolerance is 'small'"),
        ({"max_sweeps": 1.5}, "max_sweeps is 1.5"),
        ({"max_error": [5]}, r"max_error is \[5\]"),
        ({"inputs": {"rain": "much"}}, r"inputs\['rain'\] is 'much'"),
        ({"inputs": {"\udfff": 1}}, "is no character"),
        ({"scene": {**BAR, "title": "a\ud800"}}, "title: "),
        ({"scene": {**BAR, "\ud800": {}}}, "is no character"),
        ({"mesh": (SQUARE, {"quad": [[0, 1, 2, 3]]}, {"\ud800": [[3, 0]]})}, "curve is"),
        ({"out": b"out"}, "out is b'out'"),
    ],
)
def test_what_is_no_argument_is_refused_in_plain_words(scenes, arguments, named):
    arguments = {"scene": scenes / "levee.toml", **arguments}
    with pytest.raises((TypeError, ValueError), match=named) as raised:
        signorini.solve(**arguments)
    assert "failed to extract" not in str(raised.value)


def test_a_missing_file_is_named():
    with pytest.raises(signorini.SceneError, match="nowhere.toml"):
        signorini.solve("nowhere.toml")


def test_sets_of_meshio_are_boundaries():
    cells = [("quad", [[0, 1, 2, 3]]), ("line", [[3, 0], [1, 2]])]
    sets = {"cold": [[], [0]], "heater": [[], [1]], "plate": [[0], []]}
    sets = {name: [np.array(of, dtype=int) for of in members] for name, members in sets.items()}
    mesh = meshio.Mesh(SQUARE.astype(float), cells, cell_sets=sets)
    assert signorini.solve(BAR, mesh).summary["contact_force"] == pytest.approx(6)
    with pytest.raises(ValueError, match="triangle6"):
        signorini.solve(BAR, meshio.Mesh(np.zeros((6, 2)), [("triangle6", [[0, 1, 2, 3, 4, 5]])]))


def test_words_of_how_to_solve(scenes):
    for wrong in ({"tolerance": -1}, {"tolerance": float("nan")}, {"max_sweeps": -1}, {"max_unknowns": 0}):
        with pytest.raises(ValueError, match=next(iter(wrong))):
            signorini.solve(scenes / "levee.toml", **wrong)
    with pytest.raises(signorini.SceneError, match="input.rain") as raised:
        signorini.solve(scenes / "levee.toml", inputs={"rain": 50})
    assert raised.value.key == "input.rain" and "--input" not in str(raised.value)
    with pytest.raises(ValueError, match="auto or kernel or direct"):
        signorini.solve(scenes / "levee.toml", solver="fast")
    with pytest.raises(ValueError, match="max_error"):
        signorini.solve(scenes / "levee.toml", max_error="five")
    direct = signorini.solve(scenes / "levee.toml", solver="direct")
    assert direct.summary["solver_used"] == "direct"
    assert signorini.solve(scenes / "levee.toml", scalar="f32").summary["scalar"] == "f32"


def test_a_picture(scenes, tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    axes = signorini.solve(scenes / "antiicing.toml").plot()
    names = [text.get_text() for text in axes.figure.legends[0].get_texts()]
    assert names == ["open", "touching", "at its limit"]
    axes.figure.savefig(tmp_path / "slab.png")
    assert (tmp_path / "slab.png").stat().st_size > 10_000


def test_the_example_of_the_docstring():
    import doctest

    from signorini import solving

    failures, tried = doctest.testmod(solving, globs={"signorini": signorini})
    assert tried > 0 and failures == 0


def test_the_program_has_the_same_version(command):
    said = subprocess.run([command.program, "--version"], capture_output=True, text=True, check=True)
    assert said.stdout.split()[-1] == signorini.__version__
