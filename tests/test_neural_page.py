"""The experiment on made-up pieces, its pictures, and that the page is what the template says."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from tools.neural_page.__main__ import PAGE, TEMPLATE, curve_table, results, to_correct
from tools.neural_page.figures import figure_3, hidden_units
from tools.neural_page.pieces import Piece, drawn
from tools.neural_page.sources import unsteady
from tools.neural_page.trials import five_of, trial

from lipwright.sound import Sound
from lipwright.timeline import Tier

CHANNELS = ("jawOpen", "mouthPucker")


def piece(number: int) -> Piece:
    """Four seconds in which two inputs say what two shapes do."""
    rng = np.random.default_rng(number)
    shapes = rng.random((100, 2))
    heard = rng.normal(0, 0.3, (100, 243))
    heard[:, :100] += 4 * shapes[:, :1]
    heard[:, 100:] += 4 * shapes[:, 1:]
    times = np.arange(100, dtype=np.float64) * 0.04
    return Piece(f"take {number}", times, heard, shapes, CHANNELS, Path("none.flac"))


PIECES = [piece(number) for number in range(40)]


def test_a_larger_sample_holds_the_smaller_and_nothing_unseen_is_taught() -> None:
    taught, unseen = drawn(PIECES, 3)
    assert len(taught) == 5
    assert len(unseen) == 30
    more, same = drawn(PIECES, 3, 40.0)
    assert more[:5] == taught
    assert same == unseen
    every, rest = drawn(PIECES, 3, 150.0)
    assert not {one.name for one in every} & {one.name for one in rest}


def test_what_is_heard_is_learnt_and_the_mean_face_is_worse() -> None:
    found = trial(*drawn(PIECES, 0))
    assert found.unexplained < 0.2
    assert found.correlations[4] > 0.9
    assert found.correlations[1] == 0  # nothing spreads
    assert found.wrong() < found.wrong_at_rest()
    assert "0.25" in to_correct({"one": [found]})
    assert "| one |" in results({"one": [found]})


def test_an_unsteady_animator_is_late_and_weak_by_pieces() -> None:
    taught = drawn(PIECES, 0)[0]
    way, lesson = five_of(taught), unsteady(taught, 0)
    apart = [np.abs(way(one) - lesson(one)).mean() for one in taught]
    assert max(apart) > 0.05
    assert len({round(float(value), 6) for value in apart}) == len(apart)


def test_pictures_are_well_formed() -> None:
    times = np.arange(50, dtype=np.float64) * 0.04
    five = np.random.default_rng(0).random((50, 5))
    sound = Sound(np.sin(np.arange(32000) / 9).astype(np.float32), 16000)
    words = Tier.of(("<tag> & more", 0.2, 0.6), ("two", 0.6, 1.2))
    picture = figure_3(sound, words, times, five, 1 - five)
    curves = {"one": {2: 0.2, 18: 0.1}, "two": {2: 0.3, 18: 0.15}}
    for svg in (picture, hidden_units(curves)):
        ElementTree.fromstring(svg)
    assert "&lt;tag&gt; &amp; more" in picture
    assert curve_table(curves).count("0.") == 4


def test_the_page_is_the_template_with_its_figures() -> None:
    page, template = PAGE.read_text("utf-8"), TEMPLATE.read_text("utf-8")
    parts = [part for part in re.split(r"<[A-Z]+>", template) if part.strip()]
    assert len(parts) > 5
    at = 0
    for part in parts:
        found = page.find(part.strip(), at)
        assert found >= at, part[:80]
        at = found
    for picture in re.findall(r"\((pictures/[\w-]+\.svg)\)", page):
        assert (PAGE.parent / picture).is_file()


@pytest.mark.shared_data
def test_recordings_are_read_in_pieces() -> None:
    from bench.recordings import DATA
    from tools.neural_page.pieces import takes

    if not (DATA / "facegood").is_dir():
        pytest.skip("no recordings beside the project")
    found = takes(DATA / "facegood")
    assert len(found) > 100
    assert found[0].heard.shape == (100, 243)
