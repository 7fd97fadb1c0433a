"""`signorini.tick`."""

from __future__ import annotations

import os
import warnings
from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _native, arguments
from .results import SolveWarning
from .scenes import Mesh, Scene, given


@dataclass
class _Ticks:
    count: Optional[int]
    log: Optional[str]
    times: Optional[List[float]]
    inputs: list
    step: Optional[float]
    baked: bool
    budget_sweeps: Optional[int]
    tolerance: Optional[float]
    intervals: bool
    begin: Optional[str]


@dataclass(frozen=True)
class Ticks:
    """A scene over time: a number for each tick in every array, NaN where there is none."""

    t: np.ndarray
    status: np.ndarray
    sweeps: np.ndarray
    contact_force: np.ndarray
    contact_length: np.ndarray
    error_bound: np.ndarray
    """Of steps in time it is about the one step."""
    window_energy: np.ndarray
    """The bound over time, of steps that have one: the root of the mean of the energy error's square, with weights that fade."""
    window_seconds: np.ndarray
    """How far back these weights reach."""
    window_error: np.ndarray
    """The error that window_energy is for, where the scene knows its exact solution."""
    outputs: Dict[str, np.ndarray]
    output_bounds: Dict[str, np.ndarray]
    """For each output two columns: the exact value lies between; for a probe the mean over its cell. Of steps in time NAME is about the
    evolution, and NAME_step about the one step."""
    warnings: List[str]
    """What may not be meant, and what has no answer."""

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
    step: Optional[float] = None,
    baked: bool = False,
    budget_sweeps: Optional[int] = None,
    tolerance: Optional[float] = None,
    intervals: bool = True,
    save: Optional[Union[str, "os.PathLike[str]"]] = None,
    begin: Optional[Union[str, "os.PathLike[str]"]] = None,
) -> Ticks:
    """Plays a scene over time, each tick from the answer of the one before.

    Parameters
    ----------
    ticks : how many, in steps of the scene's `[time]`; or
    times : when they are, with
    inputs : a number for all of them, or one for each of `times`, by the name of the input; or
    log : a CSV file with a column t and columns of inputs.
    step : another length of a tick than that of the scene's `[time]`.
    baked : by the controller that `bake` writes, with its bits.
    budget_sweeps : most sweeps of one tick.
    tolerance : the residual that ends a tick, as it ends a solve.
    intervals : whether `output_bounds` are worked out; `baked` always has those of the controller.
    save : a file for the state after the last tick.
    begin : a file that `save`, or `--save` of the command line, has written, from which to go on: t and the inputs are those of the
        state until `inputs` or a log says otherwise.

    Warns
    -----
    SolveWarning : something may not be meant, or ticks have no answer; `warnings` has these sentences.
    """
    if sum(of is not None for of in (ticks, times, log)) > 1:
        raise ValueError("give one of ticks, times and log")
    if baked and (save, begin, tolerance, budget_sweeps) != (None,) * 4:
        raise ValueError("baked takes no save, begin, tolerance or budget_sweeps: its controller has its own")
    step, tolerance = arguments.number("step", step), arguments.number("tolerance", tolerance)
    if step is not None and not 0 < step < np.inf:
        raise ValueError(f"step is {step}, expected a number > 0")
    if tolerance is not None and not 0 <= tolerance < np.inf:
        raise ValueError(f"tolerance is {tolerance}, expected a number ≥ 0")
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
            step,
            bool(baked),
            arguments.count("budget_sweeps", budget_sweeps),
            tolerance,
            bool(intervals),
            None if begin is None else arguments.path("begin", begin),
        ),
    )
    found["status"] = np.array(found["status"])
    state = found.pop("state")
    if save is not None and state is None:
        found["warnings"].append("save: not written, since the last tick left no numbers to go on from")
    elif save is not None:
        arguments.write(arguments.path("save", save), state)
    for sentence in found["warnings"]:
        warnings.warn(sentence, SolveWarning, stacklevel=2)
    return Ticks(**found)
