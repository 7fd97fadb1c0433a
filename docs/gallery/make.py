"""Writes docs/gallery.md and its pictures: eight scenes, solved or played by the Python module.

Run `python docs/gallery/make.py` at the root of a checkout, with the module of that checkout and matplotlib.
"""

from pathlib import Path

import signorini

ROOT = Path(__file__).parents[2]
PICTURES = ROOT / "docs" / "img" / "gallery"

# Name, scene, output that is told, three lines: what it is, what contact means there, what to look at.
SOLVED = [
    ("A levee", "meshes/scenes/levee.toml", "seepage",
     "River water seeps through a levee with a clay foot, and leaves it on the dry side.",
     "On the seepage face water can leave and never enter: head ≤ elevation.",
     "How far up the face water comes out is found, not given."),
    ("A zoned dam", "tests/firmware/scenes/dam.toml", "seepage",
     "A core and a cut-off wall hold the water back; conductivities differ by a factor of 5000.",
     "The face of the shell drains where the head reaches it.",
     "The error bound sees the corners where zones meet: `--max-error 10%` refines there."),
    ("A tactile strip", "meshes/scenes/strip.toml", "force",
     "A rounded indenter presses on a thin elastic strip.",
     "The strip touches the indenter or is free; it is never pulled.",
     "Force and width of the contact come with intervals."),
    ("A corrosion pit", "meshes/scenes/pit.toml", "current",
     "An anode protects steel in an electrolyte, down to the bottom of a pit.",
     "Ideal diodes let current pass one way: the steel is protected, or passes none.",
     "The bottom of the pit is the last place that the current reaches."),
    ("A one-way membrane", "meshes/scenes/membrane.toml", "flow",
     "Nothing but a valve holds the pressure in this sheet: there is no fixed value.",
     "The lower side lets fluid out where the pressure is zero, and none in.",
     "Contact alone holds the solution; `signorini check` says so."),
]

PLAYED = [
    ("Anti-icing in flight", "meshes/scenes/antiicing-warm.toml", ["nose_power", "nose_skin"],
     {"log": "tests/firmware/logs/flight.csv"},
     "Three heater mats keep the skin of a leading edge free of ice, from cold, for twenty minutes.",
     "A mat only heats, and gives no more than it can: below that the skin is colder than 2 °C.",
     "The flight's log changes airspeed, air and supply in every second."),
    ("A thermostat over a day", "docs/gallery/thermostat.toml", ["power", "floor"], {},
     "A mat under a floor over a cold cellar follows a set point that swings by 4 °C within a day.",
     "The mat only heats, at most 60 W/m²: it never cools.",
     "The mat gives most some time before the set point is highest: the floor has to be warmed on the way."),
    ("A drain after a storm", "docs/gallery/drain.toml", ["outflow"], {},
     "Rain of four hours falls on a metre of ground above a drain.",
     "The drain lets water out and none in.",
     "The ground stores what the drain cannot take at once: the outflow comes later, and lasts longer."),
]


def value(output, unit):
    """An output with its interval, in three digits."""
    shown = f"{output.value:.3g} {unit}".rstrip()
    if output.plus_minus is None:
        return shown
    return f"{output.center:.3g} ± {output.plus_minus:.2g} {unit}".rstrip()


def unit_of(scene, name):
    """The unit that the scene writes beside an output."""
    import tomllib

    return tomllib.loads((ROOT / scene).read_text())["output"][name].get("unit", "")


def solved(scene, told):
    """A solved scene and the line with its number."""
    result = signorini.solve(ROOT / scene)
    output = result.outputs[told]
    bound = "" if result.relative_bound is None else f"; the whole solution is right to {100 * result.relative_bound:.2g} %"
    return result, f"* Guaranteed: `{told}` = {value(output, unit_of(scene, told))}{bound}."


def played(scene, told, words):
    """The ticks of a scene and the line with their largest values."""
    words = {key: str(ROOT / of) if key == "log" else of for key, of in words.items()}
    ticks = signorini.tick(ROOT / scene, **words)
    most = [f"`{name}` at most {max(ticks.outputs[name]):.3g} {unit_of(scene, name)}".rstrip() for name in told]
    return ticks, f"* {len(ticks.t)} ticks, each with its bound: {', '.join(most)}."


def lines(scene, verb, words, texts, number):
    """Five lines of a scene."""
    more = "".join(f" --{key} {of}" for key, of in words.items())
    arguments = "".join(f", {key}={of!r}" for key, of in words.items())
    what, contact, look = texts
    return "\n".join([
        f"* {what} {contact}",
        f"* {look}",
        number,
        f"* Shell: `signorini {verb} {scene}{more}`",
        f'* Python: `signorini.{verb}("{scene}"{arguments})`',
    ])


def entries():
    """Name, text, result and told outputs of each scene."""
    for name, scene, told, *texts in SOLVED:
        result, number = solved(scene, told)
        yield name, lines(scene, "solve", {}, texts, number), result, [told]
    for name, scene, told, words, *texts in PLAYED:
        ticks, number = played(scene, told, words)
        yield name, lines(scene, "tick", words, texts, number), ticks, told


def draw(result, told, file):
    """A picture of a solution, or of outputs over time."""
    import matplotlib.pyplot as plt

    if hasattr(result, "plot"):
        figure = result.plot().figure
    else:
        figure, axes = plt.subplots(len(told), squeeze=False, sharex=True, layout="constrained", figsize=(7, 4))
        axes = axes[:, 0]
        for name, ax in zip(told, axes):
            ax.plot(result.t, result.outputs[name], color="#31688e")
            ax.set_ylabel(name)
            ax.grid(alpha=0.3)
        axes[-1].set_xlabel("t [s]")
    figure.savefig(file, dpi=90)
    plt.close(figure)


HEAD = """# Gallery

Eight scenes, each with one picture and the commands that solve it. `python docs/gallery/make.py` writes this page and its pictures.
"""


def page(all_entries):
    """The page, from name and text of each scene."""
    def picture(name):
        return name.lower().replace(" ", "-") + ".png"

    return HEAD + "".join(f"\n## {name}\n\n![{name}](img/gallery/{picture(name)})\n\n{text}\n" for name, text, *_ in all_entries)


def main():
    PICTURES.mkdir(parents=True, exist_ok=True)
    made = list(entries())
    for name, _, result, told in made:
        draw(result, told, PICTURES / (name.lower().replace(" ", "-") + ".png"))
    (ROOT / "docs" / "gallery.md").write_text(page(made))


if __name__ == "__main__":
    main()
