"""Markers are laid onto a face: found whatever their axes, pinned by a file, or refused."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lipwright.character import load_character
from lipwright.errors import CharacterError, FileFormatError, InputError
from lipwright.marker_faces import (
    MarkerFile,
    MarkerLayout,
    bind,
    read_face_mesh,
    read_marker_file,
)
from tests.marker_faces.heads import bound, chosen, head, layout
from tests.models import model


@pytest.mark.parametrize("seed", range(4))
def test_markers_are_found_whatever_the_axes(seed: int) -> None:
    rng = np.random.default_rng(seed)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    found = bind(layout(turn, rng.normal(size=3)), head())
    off = np.linalg.norm(found.points - head().points[list(chosen())], axis=1)
    assert np.median(off) < 0.0005
    assert off.max() < 0.004
    assert found.residual < 0.0005
    assert found.alignment.turn @ turn == pytest.approx(np.eye(3), abs=0.01)
    assert found.alignment.scale == pytest.approx(1.0, abs=0.01)


def test_a_larger_face_is_found_too() -> None:
    grown = layout()
    grown = MarkerLayout(
        grown.labels, 1.15 * grown.rest, 1.15 * grown.mean, 1.15 * grown.basis, grown.variance
    )
    found = bind(grown, head())
    assert found.alignment.scale == pytest.approx(1 / 1.15, abs=0.01)
    assert found.residual < 0.0005


def test_markers_of_a_lip_come_to_lie_on_it() -> None:
    sides = head().sides[list(chosen())]
    found = np.array([each.shares @ head().sides[each.corners] for each in bound().placed])
    assert (found[sides == 1] > 0.5).all()
    assert (found[sides == 0] < 0.5).all()


def test_the_same_layout_gives_the_same_binding() -> None:
    assert (bind(layout(), head()).points == bound().points).all()


def test_a_face_of_other_proportions_is_refused() -> None:
    crab = read_face_mesh(load_character("crab"))
    with pytest.raises(CharacterError, match=r"crab: the markers miss this face by \d+ mm"):
        bind(layout(), crab)


def test_a_model_without_lips_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "square.glb"
    path.write_bytes(model().to_glb())
    with pytest.raises(CharacterError, match="square: markers need a mouth, and nothing on it"):
        read_face_mesh(load_character(path))


def test_a_file_says_where_all_markers_lie(tmp_path: Path) -> None:
    path = tmp_path / "head.json"
    path.write_bytes(bound().to_file(head()).to_bytes())
    assert '\n    "m000": [' in path.read_text("utf-8")
    again = bind(layout(), head(), read_marker_file(path))
    assert again.points == pytest.approx(bound().points, abs=2e-6)
    assert again.alignment.scale == pytest.approx(1.0, abs=1e-3)


def test_a_pin_goes_before_what_is_found() -> None:
    whole = bound().to_file(head())
    x, y, z = whole.markers["m030"]
    moved = replace(whole, pins={"m030": (x + 0.003, y, z)})
    assert bind(layout(), head(), moved).points[30, 0] == pytest.approx(x + 0.003, abs=0.002)
    alone = replace(moved, markers={})
    found = bind(layout(), head(), alone)
    assert found.points[30, 0] == pytest.approx(x + 0.003, abs=0.002)
    others = np.delete(np.arange(len(found.labels)), 30)
    assert found.points[others] == pytest.approx(bound().points[others], abs=0.003)


def file(**changes: object) -> str:
    whole = bound().to_file(head())
    return replace(whole, **changes).to_bytes().decode()  # type: ignore[arg-type]


MARKER = {"m000": (0.0, -0.06, 0.09)}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (lambda: file(vertices=17), r"was made for 'head' of 17 vertices; expected 'head' of 5,"),
        (lambda: file(markers=MARKER), "at markers: lacks m001, m002, m003, …; expected all 109"),
        (lambda: file(pins={"m00": (0, 0, 0)}), r"at pins.m00: no such marker. Did you mean 'm"),
        (lambda: file(pins={"m001": (0.0, 0.0, 3.0)}), "at pins.m001: lies .* from the skin"),
        (lambda: file(markers={}), "holds no marker"),
        (lambda: file().replace('"m000": [', '"m000": [NaN, '), "NaN"),
        (lambda: file().replace('"m000": [', '"m000": [1, '), "at markers.*length 3, got 4"),
        (lambda: file().replace('"model"', '"modle"'), "modle"),
        (lambda: file().replace('"version": 1', '"version": 9'), "version 9"),
        (lambda: file().replace("lipwright/markers", "lipwright/set"), "lipwright/set"),
        (lambda: file()[:200], "line"),
    ],
)
def test_bad_files_are_refused_in_one_line(
    tmp_path: Path, text: Callable[[], str], said: str
) -> None:
    path = tmp_path / "markers.json"
    path.write_text(text(), "utf-8")
    with pytest.raises(FileFormatError, match=said) as caught:
        bind(layout(), head(), read_marker_file(path))
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)


def test_no_file() -> None:
    with pytest.raises(InputError, match=r"nowhere\.json"):
        read_marker_file("nowhere.json")


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"labels": ("a", "b"), "rest": np.zeros((2, 3))}, "2 markers; expected 8 or more"),
        ({"rest": np.full((109, 3), np.nan)}, "no finite number"),
        ({"rest": np.linspace(0, 1, 109)[:, None] * np.ones(3)}, "in one line"),
        ({"mean": np.zeros((109, 3)), "variance": np.zeros(5)}, "do not move"),
    ],
)
def test_layouts_that_tell_nothing_are_refused(change: dict[str, object], said: str) -> None:
    whole = layout()
    parts = {name: getattr(whole, name) for name in ("labels", "rest", "mean", "basis", "variance")}
    parts |= change
    if "variance" in change:
        parts["variance"] = np.zeros(len(whole.basis))
    with pytest.raises(InputError, match=f"markers: .*{said}|{said}"):
        MarkerLayout(**parts)


def test_a_file_is_what_it_is_made_of() -> None:
    made = MarkerFile("head", 3, {"chin": (0.0, -0.1, 0.08)}, {"chin": (0.0, -0.11, 0.08)})
    assert made.to_bytes().decode() == (
        '{\n  "format": "lipwright/markers",\n  "version": 1,\n  "model": "head",\n'
        '  "vertices": 3,\n  "pins": {\n    "chin": [0, -0.11, 0.08]\n  },\n'
        '  "markers": {\n    "chin": [0, -0.1, 0.08]\n  }\n}\n'
    )
