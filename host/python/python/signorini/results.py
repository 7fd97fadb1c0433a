"""What a solve found."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Dict, List, Mapping, Optional

import numpy as np

from . import plotting


@dataclass(frozen=True)
class Output:
    """An output of the scene: its value on this mesh, and where it lies for the exact solution."""

    value: Optional[float]
    """On this mesh."""
    center: Optional[float]
    """The middle of the interval that is guaranteed to hold the exact value; None where there is none."""
    plus_minus: Optional[float]
    """Half of its width."""
    estimate: Optional[float]
    """How far the value moves where the mesh is refined once; no guarantee."""
    reason: Optional[str]
    """Why there is no interval."""


class SolveWarning(UserWarning):
    """A solution is not what was asked for, or may not be what is meant."""


@dataclass(frozen=True, eq=False)
class Result:
    """A solution. Arrays take over the solver's memory."""

    u: np.ndarray
    """Mean of u over each edge."""
    flux: np.ndarray
    """Mean of (A∇u)·n over each edge: n is outward on the boundary, and inside the direction of the edge turned clockwise."""
    edges: Dict[str, np.ndarray]
    """Columns for each edge: `ends` (x0, y0, x1, y1), `vertices`, `kind`, `boundary` (a name, or empty), `cells` (left and right, −1 for
    none)."""
    contact: Dict[str, np.ndarray]
    """Columns for each contact edge: `edge` (its number), `lambda`, `gap` (u − ψ), `state` (1 open, 0 touching, −1 at the limit), `psi`,
    `q`, `limit`, `boundary`."""
    bound: Optional[float]
    """The error in the energy norm is at most this; None where there is no bound, and `summary["error_bound_reason"]` says why."""
    relative_bound: Optional[float]
    """The same over `summary["energy_norm"]`; None where there is no bound, or where the solution is constant up to rounding."""
    indicators: np.ndarray
    """The share of each cell in the bound."""
    summary: Dict[str, Any]
    """What `summary.json` has."""
    points: np.ndarray
    """Vertices of the mesh, n × 2."""
    triangles: np.ndarray
    quads: np.ndarray
    point_numbers: np.ndarray
    """For a mesh in arrays that was not refined: which of its points each vertex is."""
    vertex_u: np.ndarray
    """The continuous s at the vertices, which the bound is about; empty where there is no bound."""
    cell_u: np.ndarray
    """u in the middle of each cell, triangles first."""
    cell_flux: np.ndarray
    """A∇u in the middle of each cell."""
    regions: np.ndarray
    """The name of each cell's material."""
    converged: bool
    """Whether the solver came to its end."""
    outputs: Dict[str, Output] = field(default_factory=dict)

    def to_meshio(self) -> Any:
        """A `meshio.Mesh` with the fields of `solution.vtu`."""
        try:
            import meshio
        except ModuleNotFoundError as error:
            raise ModuleNotFoundError("to_meshio needs meshio: pip install meshio") from error
        parts = [("triangle", self.triangles), ("quad", self.quads)]
        cells = [(kind, of) for kind, of in parts if len(of)]
        cut = len(self.triangles)

        def split(values: np.ndarray) -> List[np.ndarray]:
            return [part for part, (_, of) in zip((values[:cut], values[cut:]), parts) if len(of)]

        data = {"u": split(self.cell_u), "flux": split(self.cell_flux)}
        if len(self.indicators):
            data["indicator"] = split(self.indicators)
        points = np.column_stack([self.points, np.zeros(len(self.points))])
        point_data = {"u_continuous": self.vertex_u} if len(self.vertex_u) else {}
        return meshio.Mesh(points, cells, point_data=point_data, cell_data=data)

    @property
    def warnings(self) -> List[str]:
        """What may not be meant: a sentence each."""
        return list(self.summary["warnings"])

    def plot(self, ax: Any = None, *, cmap: str = "viridis", contact: bool = True) -> Any:
        """u over the mesh, and contact edges by their state; returns matplotlib's axes."""
        return plotting.plot(self, ax, cmap=cmap, contact=contact)

    def __repr__(self) -> str:
        unknowns = self.summary["unknowns"]
        bound = "no bound" if self.bound is None else f"bound {self.bound:.3g}"
        part = "" if self.relative_bound is None else f" ({100 * self.relative_bound:.2g} %)"
        ended = "" if self.converged else f", not converged: {self.summary['status']}"
        return f"<signorini.Result: {unknowns} unknowns, {bound}{part}{ended}>"


def outputs_of(summary: Mapping[str, Any]) -> Dict[str, Output]:
    """The outputs of a summary."""
    reasons = summary.get("output_bounds_reasons", {})

    def output(name: str, value: Optional[float]) -> Output:
        bound = summary["output_bounds"].get(name) or {}
        return Output(
            value, bound.get("center"), bound.get("plus_minus"), bound.get("estimate"), reasons.get(name)
        )

    return {name: output(name, value) for name, value in summary["outputs"].items()}
