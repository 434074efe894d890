"""Mouths drawn by code: whole SVG documents that show what their shapes are."""

import json
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

from lipwright.character.pictures import BUILT_IN_PICTURES, load_pictures
from lipwright.character.pictures.drawing import INSIDE, TEETH, TONGUE, draw_mouth, pictures_of
from tests.character.pictures.test_picture_file import PIXEL, own


@pytest.mark.parametrize("name", BUILT_IN_PICTURES)
def test_every_shape_is_a_picture_of_its_own(name: str) -> None:
    found = pictures_of(load_pictures(name))
    assert list(found) == list(load_pictures(name).labels)
    for picture in found.values():
        assert picture.media == "image/svg+xml"
        ElementTree.fromstring(picture.data)
    assert len({picture.data for picture in found.values()}) == len(found)


def opening(svg: str) -> tuple[float, float]:
    """Width and height of the box around the inner edge's points."""
    found = re.search(r'<clipPath id="in"><path d="([^"]+)"', svg)
    assert found is not None
    numbers = [float(n) for n in re.findall(r"-?\d+\.\d", found[1])]
    xs, ys = numbers[::2], numbers[1::2]
    return max(xs) - min(xs), max(ys) - min(ys)


def test_mouths_look_as_they_are_called() -> None:
    drawn = {s.label: draw_mouth(s.at[0]) for s in load_pictures("rhubarb").shapes}
    boxes = {label: opening(svg) for label, svg in drawn.items()}
    heights = [boxes[label][1] for label in "ABCD"]
    assert heights == sorted(heights)
    assert heights[3] > 3 * heights[1]
    widths = [boxes[label][0] for label in "FEC"]
    assert widths == sorted(widths)
    for closed in "AX":
        assert INSIDE not in drawn[closed].partition("</defs>")[2]
    for toothed in "BCDG":
        assert TEETH in drawn[toothed]
    assert TEETH not in drawn["F"]
    assert TONGUE in drawn["H"]


def test_artists_pictures_go_before_drawn_ones(tmp_path: Path) -> None:
    (tmp_path / "art").mkdir()
    (tmp_path / "art" / "shut.png").write_bytes(PIXEL)
    (tmp_path / "duck.json").write_text(json.dumps(own()))
    found = pictures_of(load_pictures(tmp_path / "duck.json"))
    assert (found["shut"].media, found["shut"].data) == ("image/png", PIXEL)
    assert found["open"].media == "image/svg+xml"
    assert [found[label].drawn_by_code for label in found] == [False, True, True]
