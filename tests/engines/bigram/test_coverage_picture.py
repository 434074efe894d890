"""The picture of coverage: whole, well-formed, and every mark where it belongs."""

import re
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import pytest

from lipwright.engines.bigram import load_set
from lipwright.engines.bigram.coverage import Coverage, coverage
from lipwright.engines.bigram.coverage_picture import picture, shade
from lipwright.errors import InputError, OutputError
from lipwright.files import check_picture
from tests.engines.bigram.test_coverage import A_MAP, MAP, SET, lacking, track

SVG = "{http://www.w3.org/2000/svg}"


def cells(of: Coverage) -> dict[str, ElementTree.Element]:
    """Each cell by the name of its pair, in the order of the picture."""
    root = ElementTree.fromstring(picture(of, "A & B <c>"))
    found = [group for group in root.iter(f"{SVG}g") if group.get("class") == "cell"]
    return {group[0].text.split(":")[0].split(",")[0]: group for group in found if group[0].text}


def fill(cell: ElementTree.Element) -> str:
    return cell[1].get("fill", "")


def test_there_is_a_cell_for_each_pair_in_the_phone_sets_order() -> None:
    found = cells(coverage(SET, [MAP, A_MAP]))
    assert len(found) == 22 * 22
    assert list(found)[:2] == ["ah-ah", "ah-aa"]
    assert list(found)[22] == "aa-ah"
    assert len(cells(coverage(SET, [MAP], silence=False))) == 21 * 21


def test_shade_follows_frequency() -> None:
    found = cells(coverage(SET, [MAP, A_MAP]))
    assert fill(found["ah-bmp"]) == shade(1)
    assert fill(found["bmp-ah"]) == shade((2 / 3) ** 0.5)
    assert fill(found["oy-oy"]) == "#fff"
    shades = [int(shade(depth / 10)[1:3], 16) for depth in range(11)]
    assert shades == sorted(shades, reverse=True)


def test_marks_stand_where_the_set_lacks_something() -> None:
    of = lacking(("ah", "bmp"), ("oy", "oy"))
    found = cells(coverage(of, [MAP]))
    marked = {pair for pair, cell in found.items() if len(cell) > 2}
    assert marked == {"ah-bmp", "oy-oy", "sil-sil"}
    bare = cells(coverage(replace(of, singles={}), [MAP]))
    assert ElementTree.tostring(bare["ah-bmp"]) != ElementTree.tostring(found["ah-bmp"])
    assert "no pair" in str(found["sil-sil"][0].text)


def test_nearest_classes_are_marked_and_explained() -> None:
    drawn = picture(coverage(SET, [track("ɪ ç t", "ipa")]))
    assert "nearest class only" in drawn
    assert "nearest class only" not in picture(coverage(SET, [MAP]))


def test_the_title_is_escaped_and_every_cell_says_what_it_is() -> None:
    drawn = picture(coverage(SET, [MAP, A_MAP]), "A & B <c>")
    assert "A &amp; B &lt;c&gt;" in drawn
    assert "<title>ah-bmp, as in map: 3, 33.33%; drawn</title>" in drawn


def test_a_whole_set_is_drawn_without_a_scale() -> None:
    drawn = picture(coverage(load_set("english")))
    assert "share of pairs" not in drawn
    assert len(re.findall('class="cell"', drawn)) == 484


def test_a_set_with_a_class_more_has_a_wider_picture(tmp_path: Path) -> None:
    from tests.engines.bigram.test_own_classes import split

    path, _ = split(tmp_path)
    assert len(cells(coverage(load_set(str(path))))) == 23 * 23


def test_names_that_no_picture_can_have(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"a picture with '\.png'; expected \.svg"):
        check_picture("a.png")
    with pytest.raises(InputError, match="no suffix"):
        check_picture("a")
    (tmp_path / "a.svg").write_text("precious")
    with pytest.raises(InputError, match="over its own input"):
        check_picture(tmp_path / "a.svg", [None, tmp_path / "a.svg"])
    with pytest.raises(OutputError, match="does not exist"):
        check_picture(tmp_path / "nowhere" / "a.svg")
