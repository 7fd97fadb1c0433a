"""Writes the logs beside it: 400 ticks whose inputs change every 40, the same ones each time.

    python3 tests/firmware/logs/generate.py

Every second stretch is at a corner of all ranges, the others are drawn evenly from them; the first has the defaults.
"""

import pathlib
import random
import tomllib

HERE = pathlib.Path(__file__).parent
SCENES = HERE.parents[2] / "meshes" / "scenes"
TICKS, HELD = 400, 40


def value(entry, stretch, draw):
    """A value of an input in a stretch."""
    least, most = entry["range"]
    if stretch == 0:
        return entry["default"]
    if stretch % 2:
        return draw.choice((least, most))
    return round(least + (most - least) * draw.random(), 3)


def write(name, scene, step):
    """A log of a scene's inputs, a line each step in s."""
    inputs = tomllib.loads((SCENES / scene).read_text())["input"]
    draw = random.Random(name)
    lines = [",".join(["t", *inputs])]
    for tick in range(TICKS):
        if tick % HELD == 0:
            held = [repr(value(entry, tick // HELD, draw)) for entry in inputs.values()]
        lines.append(",".join([repr(round(step * (tick + 1), 9)), *held]))
    (HERE / name).with_suffix(".csv").write_text("\n".join(lines) + "\n")


write("antiicing-10ms", "antiicing-warm.toml", 0.01)
write("antiicing-1s", "antiicing-warm.toml", 1.0)
write("levee-60s", "levee-warm.toml", 60.0)
