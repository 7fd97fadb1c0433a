"""The gallery's page is what its program writes. Ticks take a minute, so that a short run plays two of each scene."""

import importlib.util
import os
from pathlib import Path

import pytest
import signorini

ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="module")
def make():
    spec = importlib.util.spec_from_file_location("make", ROOT / "docs" / "gallery" / "make.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def page():
    return (ROOT / "docs" / "gallery.md").read_text()


def test_solved_scenes_stand_on_the_page(make, page):
    for name, scene, told, *texts in make.SOLVED:
        _, number = make.solved(scene, told)
        assert make.page([(name, make.lines(scene, "solve", {}, texts, number))]).removeprefix(make.HEAD) in page


def test_played_scenes_stand_on_the_page(make, page):
    for name, scene, told, words, *texts in make.PLAYED:
        number = "* number"
        if os.environ.get("SIGNORINI_WHOLE"):
            _, number = make.played(scene, told, words)
        head, tail = make.page([(name, make.lines(scene, "tick", words, texts, number))]).removeprefix(make.HEAD).split(number)
        assert head in page and tail in page
        assert not os.environ.get("SIGNORINI_WHOLE") or number in page
        ticks = signorini.tick(ROOT / scene, ticks=2)
        assert all(len(ticks.outputs[output]) for output in told)


def test_each_scene_has_a_picture(make, page):
    pictures = sorted(make.PICTURES.glob("*.png"))
    assert len(pictures) == len(make.SOLVED) + len(make.PLAYED) == page.count("](img/gallery/")
    assert all(f"img/gallery/{picture.name}" in page and picture.stat().st_size > 10_000 for picture in pictures)
