"""`signorini.bake` and `signorini.Controller`."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from typing import Any, Dict, List, Mapping, Optional, Tuple, Union

from . import _native, arguments
from .scenes import Mesh, Scene, given


@dataclass(frozen=True)
class Baked:
    """A scene as a module of firmware."""

    source: str = field(repr=False)
    """Its Rust source."""
    chosen: Dict[str, Any]
    """What was chosen: model, scalar, features of the kernel, bytes, instructions, ranges, worst case."""

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the source to a file, whole or not at all."""
        arguments.write(arguments.path("path", path), self.source)


def bake(
    scene: Scene, mesh: Optional[Mesh] = None, *, scalar: Optional[str] = None, model: Optional[str] = None
) -> Baked:
    """The smallest model that represents the scene exactly, as a module of firmware.

    Parameters
    ----------
    scalar : "f32" or "f64" [the scene's setting, else f32].
    model : "full" or "condensed" [what is smaller and fits; in time, what is quicker].
    """
    scalar = arguments.text("scalar", scalar, "f32 or f64")
    model = arguments.text("model", model, "full or condensed")
    source, chosen = _native.bake(given(scene, mesh, None), scalar, model)
    return Baked(source, json.loads(chosen))


@dataclass(frozen=True)
class ControllerAnswer:
    """What a tick came to."""

    outputs: Dict[str, float]
    plus_minus: Dict[str, float]
    """How far each output may be from its exact value, in its own unit, by the bound alone; infinite where nothing is guaranteed."""
    between: Dict[str, Tuple[float, float]]
    """Between which values each output lies, by all that the tick knows."""
    ended: str
    """exact, accurate, settled, out-of-sweeps, out-of-time or not-finite."""
    bound: Optional[float]
    """The error in the energy norm is at most this."""
    of_u: Optional[float]
    """The same for the means of u over edges."""
    sweeps: int
    contact_force: float
    contact_length: float

    def __getitem__(self, name: str) -> float:
        return self.outputs[name]


class Controller:
    """The model that firmware gets, on this machine, with the bits of the device.

    >>> controller = signorini.Controller("levee.toml")
    >>> controller(rain=2.0, river=0.1)["seepage"]

    A call starts from where the last one ended. Inputs that are left out have the values of the scene. Threads may share a controller:
    their calls come one after the other.
    """

    def __init__(
        self,
        scene: Scene,
        mesh: Optional[Mesh] = None,
        *,
        inputs: Optional[Mapping[str, float]] = None,
        scalar: Optional[str] = None,
    ) -> None:
        scalar = arguments.text("scalar", scalar, "f32 or f64")
        self._native = _native.Controller(given(scene, mesh, inputs), scalar)
        self.defaults: Dict[str, float] = {name: default for name, default, _ in self._native.inputs}
        """The inputs with the values of the scene."""
        self.ranges: Dict[str, Tuple[float, float]] = {name: tuple(ends) for name, _, ends in self._native.inputs}
        """What each may be."""
        self.outputs: List[str] = list(self._native.outputs)
        """Their names."""
        self.name: str = self._native.name
        """Model, solver and scalar."""

    def __call__(self, **inputs: float) -> ControllerAnswer:
        """One tick.

        Raises
        ------
        SceneError : inputs without an answer; its `refusal` says why (no-solution, not-unique, excluded, empty-range or not-finite).
            The next call goes on from the last answer.
        """
        unknown = set(inputs) - set(self.defaults)
        if unknown:
            names = ", ".join(self.defaults) or "none"
            raise TypeError(f"no input {', '.join(sorted(unknown))}; inputs of the scene: {names}")
        values = [arguments.number(name, inputs.get(name, default)) for name, default in self.defaults.items()]
        ended, outputs, (plus_minus, between), bound, sweeps, (force, length) = self._native.tick(values)
        return ControllerAnswer(
            outputs=dict(zip(self.outputs, outputs)),
            plus_minus=dict(zip(self.outputs, plus_minus)),
            between={name: (least, most) for name, (least, most) in zip(self.outputs, between)},
            ended=ended,
            bound=bound and bound[0],
            of_u=bound and bound[1],
            sweeps=sweeps,
            contact_force=force,
            contact_length=length,
        )

    def reset(self) -> None:
        """Forgets all ticks: the next one is the first again."""
        self._native.reset()

    def window(self) -> Optional[Tuple[float, float]]:
        """The bound of the evolution from the start until now, of a scene that steps in time: the root of the mean over time of the
        square of the energy error is at most the first number, with weights that reach back as long as the second says. None where
        there is no such bound."""
        return self._native.window()

    def state(self) -> bytes:
        """What the next step in time takes from the last one, byte for byte as `state` gives it in Rust and `NAME_save` in C."""
        state = self._native.state()
        if state is None:
            raise ValueError("the scene does not step in time, and has no state")
        return state

    def restore(self, state: bytes) -> None:
        """Goes on from a state with the same bits, in the bound of the evolution too.

        Raises
        ------
        SceneError : a state of another scene (its `refusal` is foreign-state) or a damaged one (damaged-state); nothing has changed then.
        """
        self._native.restore(bytes(state))

    def __repr__(self) -> str:
        return f"<signorini.Controller: {self.name}>"
