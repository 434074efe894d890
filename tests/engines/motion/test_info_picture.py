"""The picture of a database: whole, well-formed, every mark where it belongs."""

from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from lipwright.engines.motion.database import Database, open_database
from lipwright.engines.motion.info import info, lacking, pair_counts
from lipwright.engines.motion.info_picture import LEFT, picture, shade, write_picture
from lipwright.engines.motion.synthetic import FOLDER
from tests.engines.motion.small import database

SVG = "{http://www.w3.org/2000/svg}"
LETTERS = database("bfbfb", "zbfzz")


def drawn(of: Database, kind: str) -> list[ElementTree.Element]:
    root = ElementTree.fromstring(picture(of, "A & B <c>"))
    return [element for element in root.iter() if element.get("class") == kind]


def title(element: ElementTree.Element) -> str:
    return element.findtext(f"{SVG}title") or ""


def pairs(of: Database) -> dict[str, ElementTree.Element]:
    cells = (cell for cell in drawn(of, "pair") if title(cell))
    return {title(cell): cell for cell in cells}


def phones(of: Database) -> dict[str, ElementTree.Element]:
    return {title(row).split(":")[0]: row for row in drawn(of, "phone")}


def bar(row: ElementTree.Element) -> ElementTree.Element:
    return row[1]


def test_pairs_that_occur_are_drawn_within_takes() -> None:
    found = pairs(LETTERS)
    assert set(found) == {"b-f: 3", "f-b: 2", "z-b: 1", "f-z: 1", "z-z: 1"}
    counts = pair_counts(LETTERS)
    assert (counts > 0).sum() == info(LETTERS).bigrams.different
    assert counts.sum() == 8


def test_rows_and_columns_of_the_matrix_are_the_phones() -> None:
    found = pairs(LETTERS)
    assert found["z-b: 1"].get("y") == found["z-z: 1"].get("y")
    assert found["z-b: 1"].get("x") == found["f-b: 2"].get("x")
    assert found["b-f: 3"].get("x") != found["f-b: 2"].get("x")
    for row, pair in (("b", "b-f: 3"), ("z", "z-z: 1")):
        assert float(bar(phones(LETTERS)[row]).get("y", 0)) == pytest.approx(
            float(found[pair].get("y", 0)), abs=2
        )


def test_often_is_drawn_stronger_than_seldom() -> None:
    found = pairs(LETTERS)
    often, seldom = (float(found[name].get("fill-opacity", 0)) for name in ("b-f: 3", "z-b: 1"))
    assert 1 > often > seldom > 0
    depths = [shade(count, 1000) for count in (1, 10, 100, 1000)]
    assert depths == sorted(depths)
    assert depths[-1] == 1
    assert np.ptp(np.diff(depths)) < 1e-9  # by the logarithm


def test_bars_are_as_long_as_there_are_units_and_thin_ones_are_marked() -> None:
    many = database("b" * 20 + "f" * 10 + "z" * 5)
    found = phones(many)
    long = {name: float(bar(found[name]).get("width", 0)) for name in "bfz"}
    assert long["b"] == pytest.approx(2 * long["f"]) == pytest.approx(4 * long["z"], rel=0.01)
    assert [bar(found[name]).get("class") for name in "bfz"] == ["bar", "bar", "thin"]
    ends = {float(bar(found[n]).get("x", 0)) + long[n] for n in "bfz"}
    assert max(ends) - min(ends) < 0.2
    assert max(ends) < LEFT


def test_phones_without_a_unit_are_there_and_marked() -> None:
    found = phones(LETTERS)
    assert {"m", "iy", "sil"} <= set(lacking(LETTERS)) <= set(found)
    assert "ax" not in found  # most dictionaries do without
    assert title(found["m"]) == "m: no unit"
    assert bar(found["m"]).get("class") == "none"
    assert lacking(open_database(FOLDER)) == ()


def test_what_looks_alike_stands_together() -> None:
    order = list(phones(open_database(FOLDER)))
    for alike in ("b m p", "f v", "s z", "uh uw w"):
        places = [order.index(phone) for phone in alike.split()]
        assert max(places) - min(places) == len(places) - 1
    assert order[-1] == "sil"


def test_labels_of_no_class_are_drawn_as_well() -> None:
    assert {"a", "c"} <= set(phones(database("abcab")))


def test_the_sum_of_the_variance_rises_to_what_is_kept() -> None:
    of = open_database(FOLDER)
    line = drawn(of, "sum")[0].get("points", "").split()
    heights = [float(point.split(",")[1]) for point in line]
    assert heights == sorted(heights, reverse=True)
    said = [element.text for element in drawn(of, "said")]
    assert said[-1] == f"{100 * sum(info(of).variance):.1f}"
    assert len(said) == len(line)


def test_of_many_components_only_some_are_labelled() -> None:
    shares = np.full(70, 1 / 70)
    of = replace(LETTERS, variance=shares, total_variance=1.0)
    places = [float(element.get("x", 0)) for element in drawn(of, "said")]
    assert 10 < len(places) < 30
    assert min(np.diff(places)) > 40
    assert len([one for one in drawn(of, "bar") if title(one).endswith("1.4%")]) == 70


def test_motionless_takes_and_one_unit_can_be_drawn() -> None:
    assert "1 take, 0.0 minutes" in picture(database("b"))
    still = replace(LETTERS, total_variance=0.0)
    assert "0.0" in [element.text for element in drawn(still, "said")]


def test_the_title_is_escaped_and_a_long_one_shortened(tmp_path: Path) -> None:
    assert "A &amp; B &lt;c&gt;: 2 takes" in picture(LETTERS, "A & B <c>")
    path = tmp_path / "a.svg"
    write_picture(path, LETTERS, "a/" * 200 + "end")
    assert "…" in path.read_text("utf-8")
    assert "a/end: 2 takes" in path.read_text("utf-8")
    assert max(map(len, path.read_text("utf-8").splitlines())) < 1000


def test_it_can_be_read_in_the_dark() -> None:
    style = ElementTree.fromstring(picture(LETTERS)).findtext(f"{SVG}style") or ""
    light, dark = style.split("@media (prefers-color-scheme:dark)")
    for kind in ("text", ".back", ".bed", ".thin", ".none", ".line", ".sum", ".dot", ".said"):
        assert f"{kind}{{" in light
        assert f"{kind}{{" in dark
