"""A picture of a result, by matplotlib."""

from __future__ import annotations

import textwrap
from typing import Any, Dict, Mapping, Optional, Protocol, Tuple

import numpy as np

TITLE = 50
"""Letters of a line of the title."""

STATES = {1: ("open", "#1f77b4"), 0: ("touching", "#d62728"), -1: ("at its limit", "#9467bd")}
"""The name and colour of each state of a contact edge."""


class Drawn(Protocol):
    """What a picture needs of a result."""

    points: np.ndarray
    triangles: np.ndarray
    quads: np.ndarray
    vertex_u: np.ndarray
    cell_u: np.ndarray
    edges: Dict[str, np.ndarray]
    contact: Dict[str, np.ndarray]
    summary: Mapping[str, Any]
    relative_bound: Optional[float]


def plot(result: Drawn, ax: Any, *, cmap: str, contact: bool) -> Any:
    """u over the mesh: continuous where there is a bound, else one value a cell; contact edges in the colour of their state."""
    try:
        import matplotlib.pyplot as plt
        from matplotlib.collections import LineCollection
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError("plot needs matplotlib: pip install matplotlib") from error

    x, y = result.points.T
    is_wide = np.ptp(x) > np.ptp(y)
    has_own = ax is None
    if has_own:
        size = 7.0 * np.array([np.ptp(x), np.ptp(y)]) / max(np.ptp(x), np.ptp(y))
        _, ax = plt.subplots(layout="constrained", figsize=np.maximum(size, 2.0) + [1.0, 2.0])
    triangles, cells = split(result)
    if len(result.vertex_u):
        drawn = ax.tripcolor(x, y, triangles, result.vertex_u, shading="gouraud", cmap=cmap)
    else:
        drawn = ax.tripcolor(x, y, triangles, facecolors=result.cell_u[cells], cmap=cmap)
    ax.figure.colorbar(drawn, ax=ax, label="u", location="bottom" if is_wide else "right")
    segments = result.edges["ends"].reshape(-1, 2, 2)
    for state, (name, colour) in STATES.items():
        edges = result.contact["edge"][result.contact["state"] == state]
        if contact and len(edges):
            lines = LineCollection(segments[edges], colors=colour, linewidths=3, label=name, capstyle="round")
            ax.add_collection(lines)
    if contact and len(result.contact["edge"]):
        # Beside the picture, where there is room.
        place = {"loc": "outside upper right"} if has_own else {"loc": "best"}
        (ax.figure if has_own else ax).legend(title="contact", **place)
    ax.set_aspect("equal")
    ax.set_title(title(result), loc="left", fontsize="medium")
    return ax


def split(result: Drawn) -> Tuple[np.ndarray, np.ndarray]:
    """All cells as triangles, and the cell of each."""
    halves = [result.quads[:, [0, 1, 2]], result.quads[:, [0, 2, 3]]]
    count = len(result.triangles)
    quads = np.arange(count, count + len(result.quads))
    return np.concatenate([result.triangles, *halves]), np.concatenate([np.arange(count), quads, quads])


def title(result: Drawn) -> str:
    """The scene's title, and how wrong the solution can be."""
    name = textwrap.fill(result.summary["title"], TITLE)
    if result.relative_bound is None:
        return name
    bound = f"error at most {100 * result.relative_bound:.2g} % in energy"
    return f"{name}\n{bound}" if name else bound
