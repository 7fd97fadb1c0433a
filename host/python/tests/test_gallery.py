"""The gallery's page is what its program writes, and each of its scenes is solved."""

import importlib.util
from pathlib import Path

ROOT = Path(__file__).parents[3]


def test_the_page_is_that_of_the_program():
    spec = importlib.util.spec_from_file_location("make", ROOT / "docs" / "gallery" / "make.py")
    make = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(make)
    made = list(make.entries())
    assert len(made) == 8
    page = (ROOT / "docs" / "gallery.md").read_text()
    for own, expected in zip(page.splitlines(), make.page(made).splitlines()):
        assert own == expected
    for name, *_ in made:
        assert (make.PICTURES / (name.lower().replace(" ", "-") + ".png")).stat().st_size > 10_000
