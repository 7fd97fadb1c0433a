"""A scene and its mesh, in the shape that the native part reads."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Mapping, Optional, Sequence, Union

import numpy as np
import tomli_w

from . import arguments
from ._native import SceneError

Scene = Union[str, "os.PathLike[str]", Mapping[str, Any]]
"""The path of a scene file, or what is in one as nested dictionaries."""

Mesh = Union[str, "os.PathLike[str]", Sequence[Any], Any]
"""A Gmsh file; (points, cells, curves) with an optional fourth entry, surfaces; or a `meshio.Mesh`.

A mesh that is given wins over the one that the scene names. points: n × 2, or n × 3 with the same z everywhere. cells: {"triangle": n × 3, "quad": n × 4}, positions in points. curves: {name: n × 2}, the
edges of each named boundary. surfaces: {name: numbers of cells, triangles first}.
"""

_NO_FILE = "the mesh that was given"


@dataclass
class GivenScene:
    """What the native part reads."""

    path: str
    text: Optional[str]
    mesh_file: Optional[str]
    arrays: Optional[tuple]
    inputs: list


def given(scene: Scene, mesh: Optional[Mesh], inputs: Optional[Mapping[str, float]]) -> GivenScene:
    """The scene as the native part reads it."""
    values = [
        (arguments.text("inputs", str(name)), arguments.number(f"inputs[{name!r}]", value))
        for name, value in (inputs or {}).items()
    ]
    mesh_file = arguments.path("mesh", mesh) if isinstance(mesh, (str, bytes, os.PathLike)) else None
    arrays = None if mesh is None or mesh_file is not None else mesh_arrays(mesh)
    if not isinstance(scene, Mapping):
        return GivenScene(arguments.path("scene", scene), None, mesh_file, arrays, values)
    tables = plain(scene)
    if mesh is not None:
        tables.setdefault("mesh", mesh_file or _NO_FILE)
    tables.setdefault("title", "")
    # Where a mesh named in the dictionary is looked for.
    place = str(Path.cwd() / "scene")
    return GivenScene(place, tomli_w.dumps(tables), mesh_file, arrays, values)


def plain(value: Any, key: str = "") -> Any:
    """Numbers of numpy and paths as TOML has them; `key` is where it stands."""
    if isinstance(value, Mapping):
        inner = f"{key}." if key else ""
        for name in map(str, value):
            why = arguments.unwritable(name)
            if why:
                raise refused(f"{inner}{name!a}", why)
        return {str(name): plain(of, f"{inner}{name}") for name, of in value.items()}
    if isinstance(value, np.generic) or isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if isinstance(value, (list, tuple, np.ndarray)):
        return [plain(of, key) for of in value]
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if not isinstance(value, (str, bool, int, float)):
        raise refused(key, f"{value!r} is no text, number or list")
    why = arguments.unwritable(value) if isinstance(value, str) else None
    if why:
        raise refused(key, f"{value!a}: {why}")
    return value


def refused(key: str, why: str) -> SceneError:
    """The error of a key of a dictionary."""
    error = SceneError(f"{key}: {why}")
    error.message, error.file, error.line = str(error), None, None
    error.key, error.hint = key, None
    return error


def mesh_arrays(mesh: Any) -> tuple:
    """Arrays of a mesh, checked for shape and sign; all else is checked by the native part."""
    if hasattr(mesh, "points") and hasattr(mesh, "cells_dict"):
        mesh = of_meshio(mesh)
    try:
        points, cells, curves, *rest = mesh
    except (TypeError, ValueError):
        raise TypeError(
            "mesh: expected a path, a meshio.Mesh, or (points, cells, curves[, surfaces])"
        ) from None
    unknown = set(cells) - {"triangle", "quad"}
    if unknown:
        raise ValueError(f"mesh: cells of the kind {sorted(unknown)}, expected triangle and quad")
    surfaces = rest[0] if rest else {}
    triangles = indices(cells.get("triangle", ()), 3, "triangle")
    quads = indices(cells.get("quad", ()), 4, "quad")
    edges = [(arguments.text("curve", str(name)), indices(of, 2, f"curve {name!r}")) for name, of in curves.items()]
    inside = [
        (arguments.text("surface", str(name)), indices(np.asarray(of).reshape(-1, 1), 1, f"surface {name!r}").ravel().tolist())
        for name, of in surfaces.items()
    ]
    return (in_space(points), triangles, quads, edges, inside)


def in_space(points: Any) -> np.ndarray:
    """Coordinates, n × 3: whether they lie in a plane, the native part sees."""
    points = np.asarray(points, dtype=np.float64)
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise ValueError(f"mesh: points have the shape {points.shape}, expected n × 2 or n × 3")
    if points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    return np.ascontiguousarray(points)


def indices(of: Any, width: int, what: str) -> np.ndarray:
    """Positions in an array, n × width."""
    numbers = np.asarray(of)
    if numbers.size == 0:
        return np.zeros((0, width), dtype=np.uint32)
    if numbers.ndim != 2 or numbers.shape[1] != width or not np.issubdtype(numbers.dtype, np.integer):
        shape = f"{numbers.dtype} of the shape {numbers.shape}"
        raise ValueError(f"mesh: {what} is {shape}, expected integers, n × {width}")
    if numbers.min() < 0 or numbers.max() >= 2**32 - 1:
        raise ValueError(f"mesh: {what} has {numbers.min()} to {numbers.max()}, expected positions from 0 on")
    return np.ascontiguousarray(numbers, dtype=np.uint32)


def of_meshio(mesh: Any) -> tuple:
    """A `meshio.Mesh` with its physical groups, by name where it has names."""
    unknown = set(mesh.cells_dict) - {"triangle", "quad", "line", "vertex"}
    if unknown:
        raise ValueError(f"mesh: cells of the kind {sorted(unknown)}, expected triangle and quad, line and vertex")
    triangles = mesh.cells_dict.get("triangle", np.zeros((0, 3), dtype=int))
    quads = mesh.cells_dict.get("quad", np.zeros((0, 4), dtype=int))
    names = {(int(dim), int(tag)): name for name, (tag, dim) in mesh.field_data.items()}
    tags = mesh.cell_data_dict.get("gmsh:physical", {})
    curves: dict = {}
    lines, of_lines = mesh.cells_dict.get("line", []), tags.get("line", [])
    for tag in np.unique(of_lines):
        curves[names.get((1, int(tag)), str(tag))] = np.asarray(lines)[np.asarray(of_lines) == tag]
    of_cells = np.concatenate(
        [np.asarray(tags.get(kind, np.zeros(len(cells)))) for kind, cells in (("triangle", triangles), ("quad", quads))]
    )
    surfaces = {
        names.get((2, int(tag)), str(int(tag))): np.flatnonzero(of_cells == tag)
        for tag in np.unique(of_cells)
        if tag != 0
    }
    for name, of in mesh.cell_sets_dict.items():
        # Gmsh's own sets of entities are not for scenes.
        if name.startswith("gmsh:"):
            continue
        if "line" in of:
            curves[name] = np.asarray(lines)[np.asarray(of["line"])]
        inside = [np.asarray(of.get("triangle", []), dtype=int), len(triangles) + np.asarray(of.get("quad", []), dtype=int)]
        if sum(map(len, inside)):
            surfaces[name] = np.concatenate(inside)
    return mesh.points, {"triangle": triangles, "quad": quads}, curves, surfaces


__all__ = ["GivenScene", "Mesh", "Scene", "SceneError", "given"]
