"""Files of mouth shapes: the built-in lists, a list of one's own, and what is refused."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from lipwright.character.pictures import (
    BUILT_IN_PICTURES,
    Timing,
    is_pictures,
    load_pictures,
)
from lipwright.character.pictures.picture_file import DATA
from lipwright.errors import InputError

PIXEL = bytes.fromhex("89504e470d0a1a0a")
VOCABULARIES = {
    "rhubarb": list("ABCDEFGHX"),
    "preston_blair": ["AI", "E", "O", "U", "etc", "L", "WQ", "MBP", "FV", "rest"],
    "fleming_dobbs": ["MBP", "NLTDR", "FV", "TH", "GK", "SH", "O", "EHSZ", "AA", "IY", "rest"],
}


def test_the_built_in_lists_are_those_that_animators_know() -> None:
    assert set(VOCABULARIES) == set(BUILT_IN_PICTURES)
    for name, labels in VOCABULARIES.items():
        found = load_pictures(name)
        assert list(found.labels) == labels
        assert is_pictures(name)
        # Whatever is left out but the closed mouth, something stands in.
        bare = found.without(found.fallback)
        assert all(bare.shown_for(label) in bare.drawn for label in labels)


def test_rhubarbs_stand_ins_are_rhubarbs() -> None:
    found = load_pictures("rhubarb").without("GHX")
    assert [found.shown_for(label) for label in "GHX"] == ["A", "C", "A"]
    assert found.drawn == tuple("ABCDEF")


def own() -> dict[str, Any]:
    return {
        "format": "lipwright/pictures",
        "version": 1,
        "name": "duck",
        "shapes": [
            {"label": "shut", "at": [{"PBM": 1}], "picture": "art/shut.png"},
            {"label": "open", "at": [{"open": 0.5}, {"W": 0.5}]},
            {"label": "idle", "at": [{}], "only": ["sil"]},
        ],
        "rest": "idle",
        "reach": {"bmp": "shut"},
        "relax": {"open": "idle"},
        "timing": {"fps": 12, "on": 2, "minimum_hold": "100 ms"},
    }


@pytest.fixture
def file(tmp_path: Path) -> Path:
    (tmp_path / "art").mkdir()
    (tmp_path / "art" / "shut.png").write_bytes(PIXEL)
    return tmp_path / "duck.json"


def test_a_list_of_ones_own(file: Path) -> None:
    file.write_text(json.dumps(own()))
    duck = load_pictures(file)
    assert is_pictures(file)
    assert duck.labels == ("shut", "open", "idle")
    assert duck.timing == Timing(fps=12, on=2, minimum_hold="100 ms")
    assert duck.timing.drawings() == 1


def test_other_files_are_no_pictures(tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text('{"format": "lipwright/animation"}')
    (tmp_path / "b.json").write_text("[1,")
    names = ("a.json", "b.json", "none.json", "head.glb")
    assert not any(is_pictures(tmp_path / name) for name in names)
    assert not is_pictures("head")


def change(*path: str | int, to: Any) -> Callable[[dict[str, Any]], None]:
    def apply(content: dict[str, Any]) -> None:
        place: Any = content
        for step in path[:-1]:
            place = place[step]
        place[path[-1]] = to

    return apply


def no_rest(content: dict[str, Any]) -> None:
    del content["rest"]


BAD: dict[str, tuple[Callable[[dict[str, Any]], None], str]] = {
    "unknown shape in relax": (
        change("relax", "open", to="ajar"),
        "at relax: no shape 'ajar'; expected one of shut open idle",
    ),
    "unknown shape in fallback": (change("fallback", to={"gone": "open"}), "no shape 'gone'"),
    "missing picture": (
        change("shapes", 0, "picture", to="art/none.png"),
        r"at shapes\[0\].picture: there is no picture 'art/none.png'",
    ),
    "a picture of no kind": (change("shapes", 0, "picture", to="art/shut.psd"), "one of .png .svg"),
    "a picture in a folder of its own": (change("shapes", 0, "picture", to="/x.png"), "no picture"),
    "hold of 0": (change("timing", "minimum_hold", to="0 frames"), "at timing.minimum_hold"),
    "negative hold": (change("timing", "minimum_hold", to="-2 frames"), "as '2 frames' or '80 ms'"),
    "hold without a unit": (change("timing", "minimum_hold", to="2"), "frames or seconds"),
    "a hold of hours": (change("timing", "minimum_hold", to="9999 s"), "at most 2 s"),
    "hold as a number": (change("timing", "minimum_hold", to=2), "Expected `str`"),
    "fps NaN": (change("timing", "fps", to=float("nan")), "the number NaN"),
    "fps 0": (change("timing", "fps", to=0), "at timing.fps: 0 frames per second"),
    "fps beyond": (change("timing", "fps", to=1000), "expected 1 to 100"),
    "on 0": (change("timing", "on", to=0), "at timing.on: a drawing every 0 frames"),
    "negative lead": (change("timing", "lead", to="-1 frame"), "at timing.lead"),
    "no rest shape": (no_rest, "missing required field `rest`"),
    "unknown rest": (change("rest", to="asleep"), "at rest: no shape 'asleep'"),
    "no closed shape": (change("reach", to={}), "no closed shape; expected a shape for 'bmp'"),
    "unknown sound": (change("reach", "qq", to="shut"), "at reach: no sound 'qq'"),
    "unknown sound of a shape": (change("shapes", 1, "only", to=["p"]), r"shapes\[1\].only"),
    "no shapes": (change("shapes", to=[]), "0 shapes; expected two or more"),
    "a label twice": (change("shapes", 1, "label", to="shut"), "'shut' stands twice"),
    "a label of two words": (change("shapes", 1, "label", to="half open"), "without spaces"),
    "an empty label": (change("shapes", 1, "label", to=""), "without spaces"),
    "nowhere": (change("shapes", 1, "at", to=[]), r"shapes\[1\].at: no point"),
    "infinite place": (change("shapes", 1, "at", to=[{"open": 1e999}]), "finite|Infinity"),
    "nothing stands in": (change("missing", to=["idle"]), "nothing stands in for it"),
    "stands in for itself": (
        lambda c: (change("missing", to=["idle"])(c), change("fallback", to={"idle": "idle"})(c))[
            0
        ],
        "stands in for itself",
    ),
    "negative weight": (change("weights", to={"open": -1}), "at weights.open: -1"),
    "unknown key": (change("colour", to="red"), "unknown field `colour`"),
    "from the future": (change("version", to=2), "newer Lipwright"),
}


@pytest.mark.parametrize("name", BAD)
def test_what_is_refused(name: str, file: Path) -> None:
    apply, words = BAD[name]
    content = own()
    apply(content)
    file.write_text(json.dumps(content))
    with pytest.raises(InputError, match=words) as caught:
        load_pictures(file)
    assert "duck.json" in str(caught.value)


def test_the_example_of_the_page_is_a_list(tmp_path: Path) -> None:
    page = Path(__file__).parents[3] / "docs" / "pictures-2d.md"
    example = page.read_text("utf-8").partition("```json\n")[2].partition("```")[0]
    (tmp_path / "art").mkdir()
    for shape in json.loads(example)["shapes"]:
        if "picture" in shape:
            (tmp_path / shape["picture"]).write_bytes(PIXEL)
    (tmp_path / "duck.json").write_text(example)
    assert load_pictures(tmp_path / "duck.json").shown_for("idle") == "shut"


def test_names_that_are_unknown() -> None:
    with pytest.raises(InputError, match="no mouth shapes 'rubarb'; expected rhubarb, preston"):
        load_pictures("rubarb")


@pytest.mark.parametrize("name", BUILT_IN_PICTURES)
def test_built_in_files_are_read_by_people(name: str) -> None:
    """A shape per line, so that a diff shows what was changed."""
    lines = (DATA / f"{name}.json").read_text("utf-8").splitlines()
    shapes = [line for line in lines if line.lstrip().startswith('{"label"')]
    assert len(shapes) == len(VOCABULARIES[name])
