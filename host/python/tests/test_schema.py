"""The JSON Schema of scenes, tried by a validator of its own: it takes every scene, and refuses each mistake that it can express."""

import json
import math
import subprocess
import tomllib
from pathlib import Path

import jsonschema
import pytest

ROOT = Path(__file__).parents[3]
CASES = ROOT / "host" / "scene" / "src" / "scene" / "tests"
SMALL = """
mesh = '../plate.msh'
material.default.conductivity = 2
boundary.default = { kind = 'contact' }
"""

# What the schema cannot see: what is no TOML, grammar of expressions, signs and relations of numbers, infinite ones, which
# JSON lacks, names in other tables, a `capacity` that another table would need, characters of a unit, and that 1.0 is no whole number.
UNSEEN = [
    "not TOML", "expected an operator", "unknown name", "its value is", "value: not a finite number", "is negative", "expected a number, a name or", "no boundary",
    "has no field", "there is no value", "is outside the range", "expected a contact boundary", "no material", "less than flux",
    "leaves no flux", "leaves every flux", "comes before the first step", "nothing can be added", "characters of a unit",
    "has a start", "found the number 1.0",
]


def known(value):
    """A value of TOML as JSON has it: no number that is infinite."""
    if isinstance(value, dict):
        return {key: known(inner) for key, inner in value.items()}
    if isinstance(value, list):
        return [known(inner) for inner in value]
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


@pytest.fixture
def takes(command):
    schema = json.loads(subprocess.run([command.program, "schema"], check=True, capture_output=True).stdout)
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    return lambda text: validator.is_valid(known(tomllib.loads(text)))


def test_every_scene_of_the_repository_is_taken(takes):
    scenes = [path for folder in ["meshes", "tests/firmware"] for path in (ROOT / folder).rglob("*.toml")]
    scenes = [path for path in scenes if "mesh =" in path.read_text() or "extends" in path.read_text()]
    assert len(scenes) > 40
    assert [str(path) for path in scenes if not takes(path.read_text())] == []


def test_mistakes_are_refused(takes):
    levee = (CASES / "levee.toml").read_text()
    assert takes(levee) and takes(SMALL)
    changes = tomllib.loads((CASES / "malformed.toml").read_text())["cases"]
    settings = tomllib.loads((CASES / "setting.toml").read_text())["cases"]
    cases = [(levee.replace(old, new, 1), said) for old, new, said in changes]
    cases += [(f"{SMALL}[setting]\n{lines}\n", said) for lines, said in settings]
    expressible = [case for case in cases if not any(words in case[1] for words in UNSEEN)]
    assert len(expressible) > 75
    assert "\n".join(said for text, said in expressible if takes(text)) == ""


def test_a_new_scene_lacks_what_is_to_be_filled_in(takes, command, tmp_path):
    mesh = tmp_path / "slab.msh"
    mesh.write_bytes((ROOT / "meshes" / "scenes" / "slab.msh").read_bytes())
    subprocess.run([command.program, "new", str(mesh)], check=True, capture_output=True)
    text = (tmp_path / "slab.toml").read_text()
    assert text.startswith("#:schema signorini.schema.json\n")
    written = (tmp_path / "signorini.schema.json").read_text()
    assert written == subprocess.run([command.program, "schema"], check=True, capture_output=True, text=True).stdout
    assert not takes(text)
    filled = text.replace('conductivity = "?"', "conductivity = 2").replace('kind = "?"', 'kind = "contact"')
    assert takes(filled)
