"""`signorini.solve`."""

from __future__ import annotations

import json
import os
import warnings
from dataclasses import dataclass
from typing import Mapping, Optional, Union

import numpy as np

from . import _native, arguments
from .results import Result, SolveWarning, outputs_of
from .scenes import Mesh, Scene, given


@dataclass
class _How:
    scalar: Optional[str]
    solver: Optional[str]
    tolerance: Optional[float]
    max_sweeps: Optional[int]
    max_error: Optional[str]
    max_unknowns: Optional[int]
    intervals: Optional[bool]


def solve(
    scene: Scene,
    mesh: Optional[Mesh] = None,
    *,
    inputs: Optional[Mapping[str, float]] = None,
    max_error: Optional[Union[str, float]] = None,
    max_unknowns: Optional[int] = None,
    scalar: Optional[str] = None,
    solver: Optional[str] = None,
    tolerance: Optional[float] = None,
    max_sweeps: Optional[int] = None,
    intervals: Optional[bool] = None,
    out: Optional[Union[str, "os.PathLike[str]"]] = None,
) -> Result:
    """Solves a scene.

    Parameters
    ----------
    scene : the path of a scene file, or the same as nested dictionaries.
    mesh : instead of the scene's own: a Gmsh file, a `meshio.Mesh`, or arrays
        ``(points, {"triangle": …, "quad": …}, {"boundary": edges})``.
    inputs : values of the scene's inputs.
    max_error : refine the mesh where the bound says until it is below this: "5%" of `energy_norm`, or an energy.
    max_unknowns : the largest mesh that may be tried for it.
    scalar, solver, tolerance, max_sweeps : as for `signorini solve`; the scene's own setting where left out.
    intervals : whether outputs get intervals; on meshes of up to 2.5 million unknowns where left out.
    out : a folder for the files of `signorini solve`.

    Raises
    ------
    SceneError : scene, mesh or inputs are wrong; it has file, line, key and hint.

    Warns
    -----
    SolveWarning : the solver did not converge, an error that was asked for is not reached, or something may not be meant.

    Examples
    --------
    >>> import numpy as np
    >>> points = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    >>> bar = {
    ...     "material": {"default": {"conductivity": 3}},
    ...     "boundary": {
    ...         "cold": {"kind": "dirichlet", "value": 0},
    ...         "heater": {"kind": "contact", "gap": 2},
    ...         "default": {"kind": "neumann", "flux": 0},
    ...     },
    ... }
    >>> mesh = (points, {"quad": [[0, 1, 2, 3]]}, {"cold": [[3, 0]], "heater": [[1, 2]]})
    >>> round(signorini.solve(bar, mesh).summary["contact_force"], 9)
    6.0
    """
    tolerance = arguments.number("tolerance", tolerance)
    if tolerance is not None and not 0 <= tolerance < np.inf:
        raise ValueError(f"tolerance is {tolerance}, expected a number ≥ 0")
    if max_error is not None and not isinstance(max_error, str):
        max_error = repr(arguments.number("max_error", max_error))
    how = _How(
        arguments.text("scalar", scalar, "f32 or f64"),
        arguments.text("solver", solver, "auto, kernel, direct or multigrid"),
        tolerance,
        arguments.count("max_sweeps", max_sweeps),
        arguments.text("max_error", max_error),
        arguments.count("max_unknowns", max_unknowns, least=1, bits=63),
        arguments.flag("intervals", intervals),
    )
    found = _native.solve(given(scene, mesh, inputs), how, None if out is None else arguments.path("out", out))
    summary = json.loads(found["summary"])
    boundaries = np.array([*found["boundaries"], ""])
    edges = found["edges"]
    edges["kind"] = np.array(edges["kind"])
    edges["boundary"] = boundaries[edges["boundary"]]
    contact = found["contact"]
    contact["boundary"] = edges["boundary"][contact["edge"]]
    for sentence in summary["warnings"]:
        warnings.warn(sentence, SolveWarning, stacklevel=2)
    if not summary["converged"]:
        warnings.warn(f"the solver has not converged: {summary['status']}", SolveWarning, stacklevel=2)
    return Result(
        u=found["u"],
        flux=found["flux"],
        edges=edges,
        contact=contact,
        bound=found["bound"],
        relative_bound=found["relative_bound"],
        indicators=found["indicators"],
        summary=summary,
        points=found["points"],
        triangles=found["triangles"],
        quads=found["quads"],
        point_numbers=found["origins"],
        vertex_u=found["vertex_u"],
        cell_u=found["cell_u"],
        cell_flux=found["cell_flux"],
        regions=np.array(found["materials"])[found["materials_of_cells"]],
        converged=found["converged"],
        outputs=outputs_of(summary),
    )
