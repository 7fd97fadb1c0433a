"""Unilateral contact with a guaranteed error bound.

>>> import signorini
>>> result = signorini.solve("levee.toml")
>>> result.bound, result.relative_bound          # in the energy norm, guaranteed
>>> result.outputs["seepage"]                    # value, interval and estimate
>>> result.plot()                                # needs matplotlib

Scenes are files or dictionaries; meshes are files or numpy arrays. `tick` plays a scene over time, `bake` writes it as firmware in
Rust, and `Controller` is that firmware on this machine, with the same bits. Wrong input raises `SceneError`.
"""

from ._native import SceneError
from .baking import Baked, Controller, ControllerAnswer, bake
from .results import Output, Result, SolveWarning
from .solving import solve
from .ticking import Ticks, tick

__all__ = [
    "Baked",
    "Controller",
    "ControllerAnswer",
    "Output",
    "Result",
    "SceneError",
    "SolveWarning",
    "Ticks",
    "bake",
    "solve",
    "tick",
]
__version__ = "0.9.0"
