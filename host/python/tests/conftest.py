"""The program whose files results are compared with, and the scenes of the repository."""

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]


@pytest.fixture
def scenes():
    return ROOT / "meshes" / "scenes"


@pytest.fixture
def command(tmp_path):
    """Runs `signorini` of this checkout; the folder of its files."""
    program = os.environ.get("SIGNORINI", str(ROOT / "target" / "release" / "signorini"))

    def run(*words):
        out = tmp_path / "command"
        subprocess.run([program, *map(str, words), "--out", str(out)], check=True, capture_output=True)
        return out

    run.program = program
    return run
