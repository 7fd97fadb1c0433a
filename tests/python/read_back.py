"""Reads the files of a solve and of ticks with the programs that engineers use: meshio and PyVista.

    python3 tests/python/read_back.py FOLDER

FOLDER holds the folders that `cargo xtask results` has filled: `solve` (files of a solve with its levels) and `ticks`.
"""

import csv
import json
import sys
from pathlib import Path

import meshio
import numpy as np
import pyvista

STATES = {"open": 1, "touching": 0, "saturated": -1}
# A value in text has all digits of the binary one.
SAME = 1e-15


def same(name, found, expected, within=SAME):
    found, expected = np.asarray(found, float), np.asarray(expected, float)
    if found.shape != expected.shape:
        raise SystemExit(f"{name}: shape {found.shape}, expected {expected.shape}")
    worst = np.max(np.abs(found - expected), initial=0) / max(np.max(np.abs(expected), initial=0), 1e-300)
    if not worst <= within:
        raise SystemExit(f"{name}: off by {worst:.1e} of the largest, at most {within:.0e} expected")


def cell_data(mesh, name):
    """All blocks of meshio, one after the other: triangles, then quads."""
    return np.concatenate(mesh.cell_data[name])


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def solution(folder):
    path = folder / "solution.vtu"
    with_meshio, with_pyvista = meshio.read(path), pyvista.read(path)
    summary = json.loads((folder / "summary.json").read_text())
    for name in ("u", "flux", "indicator", "conductivity", "region"):
        same(f"{path}: {name}", cell_data(with_meshio, name), with_pyvista.cell_data[name])
    name = "u_continuous"
    same(f"{path}: {name}", with_meshio.point_data[name], with_pyvista.point_data[name])
    # Shares of the bound add up to it, but for rounding and what data lose within cells.
    whole = np.sqrt(np.sum(cell_data(with_meshio, "indicator") ** 2))
    bound = summary["error_bound"]["total"]
    if not 0.5 * bound <= whole <= 1.01 * bound:
        raise SystemExit(f"{path}: indicators add up to {whole}, the bound is {bound}")
    regions = set(cell_data(with_meshio, "region"))
    named = {int(np.ravel(value)[0]): name for name, value in with_meshio.field_data.items()}
    if not regions <= set(named):
        raise SystemExit(f"{path}: regions {regions}, names {named}")
    for name, (number, dimension) in ((name, with_pyvista.field_data[name]) for name in named.values()):
        if named[int(number)] != name or dimension != 2:
            raise SystemExit(f"{path}: {name} is {number} of dimension {dimension}")


def contact(folder):
    path = folder / "contact.vtu"
    with_meshio, with_pyvista = meshio.read(path), pyvista.read(path)
    edges = [row for row in rows(folder / "edges.csv") if row["kind"] == "contact"]
    lambdas = [float(row["lambda"]) for row in edges]
    same(f"{path}: lambda", cell_data(with_meshio, "lambda"), lambdas)
    same(f"{path}: lambda", with_pyvista.cell_data["lambda"], lambdas)
    states = [STATES[row["state"]] for row in edges]
    same(f"{path}: state", cell_data(with_meshio, "state"), states)
    gaps = [float(row["u_mean"]) - float(row["psi"]) for row in edges]
    same(f"{path}: gap", with_pyvista.cell_data["gap"], gaps, within=1e-12)
    names = {int(value[0]): name for name, value in ((n, with_pyvista.field_data[n]) for n in with_pyvista.field_data)}
    found = [names[int(at)] for at in with_pyvista.cell_data["boundary"]]
    if found != [row["boundary"] for row in edges]:
        raise SystemExit(f"{path}: boundaries {found}")
    ends = with_pyvista.points.reshape(-1, 2, 3)[:, :, :2]
    same(f"{path}: ends", ends, [[[row["x0"], row["y0"]], [row["x1"], row["y1"]]] for row in edges])


def series(path, times):
    reader = pyvista.get_reader(path)
    same(f"{path}: times", reader.time_values, times)
    for time in reader.time_values:
        reader.set_active_time_value(time)
        frame = reader.read()[0]
        if not np.all(np.isfinite(frame.cell_data["u"])) or frame.n_cells == 0:
            raise SystemExit(f"{path}: no u at {time}")


def main():
    folder = Path(sys.argv[1])
    solution(folder / "solve")
    contact(folder / "solve")
    series(folder / "solve" / "levels.pvd", [float(row["level"]) for row in rows(folder / "solve" / "levels.csv")])
    series(folder / "ticks" / "ticks.pvd", [float(row["t"]) for row in rows(folder / "ticks" / "ticks.csv")])
    print("solution.vtu, contact.vtu, levels.pvd and ticks.pvd read back")


main()
