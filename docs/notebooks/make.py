"""Runs the notebooks of this folder and writes them anew: outputs as they come, and nothing of the machine or of the time.

Run `python docs/notebooks/make.py` at the root of a checkout, with `pip install "./host/python[test]"`. Cells with the tag `board` build
firmware for an emulated board, which takes minutes. Names of notebooks behind the command run these alone.
"""

import os
import sys
import tempfile
from pathlib import Path

import nbformat
from nbclient import NotebookClient

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parents[1]

# The tag of cells that need the emulated board.
BOARD = "board"


def read(path):
    """The notebook of a file."""
    return nbformat.read(path, as_version=4)


def executed(path, with_board):
    """The notebook after a run in a folder of its own below the checkout; cells for the board keep their outputs where they are left out."""
    notebook = read(path)
    work = ROOT / "target" / "notebooks"
    work.mkdir(parents=True, exist_ok=True)
    # Pictures come where no other backend is asked for.
    environment = {name: value for name, value in os.environ.items() if name not in ("MPLBACKEND", "PYTEST_CURRENT_TEST")}
    # The kernel of this Python, whatever others a user has.
    os.environ.setdefault("JUPYTER_PREFER_ENV_PATH", "1")
    with tempfile.TemporaryDirectory(dir=work) as folder:
        client = NotebookClient(
            notebook,
            kernel_name="python3",
            timeout=3600,
            record_timing=False,
            skip_cells_with_tag="none" if with_board else BOARD,
            resources={"metadata": {"path": folder}},
        )
        client.execute(env=environment)
    return normalised(notebook)


def normalised(notebook):
    """The notebook with what says something to a reader, and no more."""
    notebook.metadata = {"language_info": {"name": "python"}}
    notebook.nbformat, notebook.nbformat_minor = 4, 5
    count = 0
    for number, cell in enumerate(notebook.cells, 1):
        cell.id = f"cell-{number:02}"
        tags = cell.metadata.get("tags", [])
        cell.metadata = {"tags": tags} if tags else {}
        if cell.cell_type != "code":
            continue
        count += 1
        cell.execution_count = count
        for output in cell.outputs:
            if "execution_count" in output:
                output.execution_count = count
            if "metadata" in output:
                output.metadata = {}
            # Beside a picture its description as a Python object says nothing.
            if "image/png" in output.get("data", {}):
                output.data.pop("text/plain", None)
    return notebook


def written(notebook):
    """The text of its file."""
    return nbformat.writes(notebook).rstrip("\n") + "\n"


def main(names):
    for path in sorted(FOLDER.glob("*.ipynb")):
        if not names or path.stem in names:
            path.write_text(written(executed(path, with_board=True)), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
