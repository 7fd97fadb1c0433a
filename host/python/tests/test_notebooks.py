"""The notebooks print what stands in them: the same words, and numbers to a part in 100 000, those of bytes and instructions to a tenth.

Cells for the emulated board run where SIGNORINI_WHOLE=1 is set.
"""

import base64
import importlib.util
import os
import platform
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
FOLDER = ROOT / "docs" / "notebooks"
NOTEBOOKS = ["discharge", "controller"]
IS_WHOLE = bool(os.environ.get("SIGNORINI_WHOLE"))

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")
# The last digit of an f32 may go with the processor that a matrix was factorised on.
ROUNDED = 1e-5
# What goes with the compiler, and with the records of its code.
MEASURED, PART = re.compile(r"\b(bytes|instructions)\b"), 0.1
# Which tick takes most goes with the compiler too: it may be any.
ANY = re.compile(r"the most at tick .*")


@pytest.fixture(scope="module")
def make():
    spec = importlib.util.spec_from_file_location("make_notebooks", FOLDER / "make.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def is_of_board(cell):
    return "board" in cell.metadata.get("tags", [])


def printed(cell):
    """What a cell prints, and the values that it ends with. Libraries may log what they do at their first start."""
    said = [output for output in cell.outputs if output.get("name") != "stderr"]
    parts = [output.get("text", "") or output.get("data", {}).get("text/plain", "") for output in said]
    return "".join(parts)


def pictures(cell):
    """The pictures that a cell shows, as bytes."""
    data = [output.get("data", {}) for output in cell.outputs]
    return [base64.b64decode(of["image/png"]) for of in data if "image/png" in of]


def is_same(line, other):
    """Whether a line is the one that stands in the notebook."""
    if ANY.search(line) and ANY.search(other):
        return True
    part = PART if MEASURED.search(line) else ROUNDED
    numbers, others = (list(map(float, NUMBER.findall(of))) for of in (line, other))
    words, other_words = (NUMBER.sub("#", of).split() for of in (line, other))
    return words == other_words and all(abs(own - of) <= part * abs(of) for own, of in zip(numbers, others))


def differences(text, expected):
    """Lines that are not those of the notebook."""
    lines, others = text.splitlines(), expected.splitlines()
    found = [f"{line!r}, expected {other!r}" for line, other in zip(lines, others) if not is_same(line, other)]
    return found + ([] if len(lines) == len(others) else [f"{len(lines)} lines, expected {len(others)}"])


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_cells_print_what_stands_in_the_notebook(make, name):
    expected = make.read(FOLDER / f"{name}.ipynb")
    found = make.executed(FOLDER / f"{name}.ipynb", with_board=IS_WHOLE)
    compared = 0
    for cell, stands in zip(found.cells, expected.cells):
        if cell.cell_type != "code" or is_of_board(cell) and not IS_WHOLE:
            continue
        said = differences(printed(cell), printed(stands))
        assert not said, f"{name}, {cell.id}: {said}; `python docs/notebooks/make.py {name}` writes it anew"
        assert len(pictures(cell)) == len(pictures(stands))
        compared += bool(printed(stands))
    assert compared >= 2


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_a_notebook_is_written_by_its_program_and_names_no_machine(make, name):
    path = FOLDER / f"{name}.ipynb"
    text, notebook = path.read_text(encoding="utf-8"), make.read(path)
    assert make.written(make.normalised(make.read(path))) == text
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert all(output.get("name") != "stderr" and output.output_type != "error" for cell in code for output in cell.outputs)
    assert sum(len(pictures(cell)) for cell in code) >= 1
    assert all(len(picture) < 60_000 for cell in code for picture in pictures(cell))
    assert all(printed(cell) for cell in code if is_of_board(cell))
    said = "\n".join(map(printed, code))
    assert not re.search(r"(^|[\s'\"(=])(/\w+/|[A-Z]:\\)", said, re.MULTILINE)
    assert str(ROOT) not in text
    # A machine may be called as a word is.
    node = platform.node()
    assert not re.search(r"[\d-]", node) or node not in said


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_links_and_sentences_of_a_notebook(make, name):
    notes = [cell.source for cell in make.read(FOLDER / f"{name}.ipynb").cells if cell.cell_type == "markdown"]
    links = [link for note in notes for link in re.findall(r"\]\(([^)]+)\)", note)]
    assert links and all((FOLDER / link.split("#")[0]).exists() for link in links)
    sentences = [sentence for note in notes for sentence in re.split(r"(?<=[.?])\s", note)]
    assert [sentence for sentence in sentences if len(sentence.split()) > 30] == []


def test_lines_differ_where_a_number_does():
    assert not differences("a 12.5 m\nRAM: 1000 bytes", "a 12.5 m\nRAM: 1050 bytes")
    assert differences("a 12.5 m", "a 12.6 m") and differences("a 12.5 m", "a 12.5 m\nb")
    assert differences("RAM: 1000 bytes", "RAM: 1200 bytes") and differences("RAM: 1000 bytes", "ROM: 1000 bytes")
    assert not differences("power 39.885376", "power  39.88538") and differences("power 39.885", "power 39.886")
    assert not differences("  the most at tick 11, at air = 10.0", "  the most at tick 12, at air = 3.0")
