"""`signorini.tick`."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _native, arguments
from .scenes import Mesh, Scene, given


@dataclass
class _Ticks:
    count: Optional[int]
    log: Optional[str]
    times: Optional[List[float]]
    inputs: list
    baked: bool
    budget_sweeps: Optional[int]
    intervals: bool


@dataclass(frozen=True)
class Ticks:
    """A scene over time: a number for each tick in every array, NaN where there is none."""

    t: np.ndarray
    status: np.ndarray
    sweeps: np.ndarray
    contact_force: np.ndarray
    contact_length: np.ndarray
    error_bound: np.ndarray
    outputs: Dict[str, np.ndarray]
    output_bounds: Dict[str, np.ndarray]
    """For each output two columns: the exact value lies between; for a probe the mean over its cell."""

    def __len__(self) -> int:
        return len(self.t)

    def __repr__(self) -> str:
        return f"<signorini.Ticks: {len(self)} ticks from t = {self.t[0]:g} to {self.t[-1]:g}>"


def tick(
    scene: Scene,
    mesh: Optional[Mesh] = None,
    *,
    ticks: Optional[int] = None,
    times: Optional[ArrayLike] = None,
    inputs: Optional[Mapping[str, Any]] = None,
    log: Optional[Union[str, "os.PathLike[str]"]] = None,
    baked: bool = False,
    budget_sweeps: Optional[int] = None,
    intervals: bool = True,
) -> Ticks:
    """Plays a scene over time, each tick from the answer of the one before.

    Parameters
    ----------
    ticks : how many, in steps of the scene's `[time]`; or
    times : when they are, with
    inputs : a number for all of them, or one for each of `times`, by the name of the input; or
    log : a CSV file with a column t and columns of inputs.
    baked : by the controller that `bake` writes, with its bits.
    budget_sweeps : most sweeps of one tick.
    intervals : whether `output_bounds` are worked out; `baked` always has those of the controller.
    """
    if sum(of is not None for of in (ticks, times, log)) > 1:
        raise ValueError("give one of ticks, times and log")
    moments = None if times is None else [arguments.number("times", time) for time in np.asarray(times).ravel()]
    constant: Dict[str, float] = {}
    varying = []
    for name, values in (inputs or {}).items():
        if np.ndim(values) == 0:
            constant[name] = values
        elif moments is None or len(values) != len(moments):
            raise ValueError(f"inputs[{name!r}]: expected a number, or one for each of times")
        else:
            name = arguments.text("inputs", str(name))
            varying.append((name, [arguments.number(f"inputs[{name!r}]", value) for value in values]))
    if moments is not None and any(b <= a for a, b in zip(moments, moments[1:])):
        raise ValueError("times: expected each to come after the one before")
    found = _native.tick(
        given(scene, mesh, constant),
        _Ticks(
            arguments.count("ticks", ticks),
            None if log is None else arguments.path("log", log),
            moments,
            varying,
            bool(baked),
            arguments.count("budget_sweeps", budget_sweeps),
            bool(intervals),
        ),
    )
    found["status"] = np.array(found["status"])
    return Ticks(**found)
