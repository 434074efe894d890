"""Edits of one line: they hang on phones, act at their stage, and are never lost in silence."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lipwright import pipeline
from lipwright.animation import Animation
from lipwright.engines.bigram import BigramEngine, Edit, load_set, read_edits
from lipwright.engines.bigram.why import why
from lipwright.errors import InputError
from lipwright.phones import PhoneTrack
from lipwright.speech import Speech
from lipwright.timeline import Tier
from tests.engines.bigram.test_promises import check_stages

ENGINE = BigramEngine(load_set("english"))


def speech(stretch: float = 1.0) -> Speech:
    """ "Map a map", at any speed."""
    rows = [("m", 0, 0.1), ("ae", 0.1, 0.3), ("p", 0.3, 0.4), ("ah", 0.4, 0.5)]
    rows += [("m", 0.5, 0.6), ("ae", 0.6, 0.8), ("p", 0.8, 0.9)]
    words = [("Map", 0, 0.4), ("a", 0.4, 0.5), ("map.", 0.5, 0.9)]
    tiers = [Tier.of(*((n, a * stretch, b * stretch) for n, a, b in r)) for r in (rows, words)]
    return Speech(PhoneTrack(tiers[0]), tiers[1])


def edited(*edits: Edit, stretch: float = 1.0) -> Animation:
    return ENGINE.animate(speech(stretch), 100.0, edits)


def at(animation: Animation, control: str, time: float) -> float:
    return float(animation.at([time])[0, animation.controls.index(control)])


def test_a_gain_changes_its_phone_and_nothing_else() -> None:
    plain, softer = edited(), edited(Edit("map", 2, "open", occurrence=2, gain=0.5))
    assert at(softer, "open", 0.7) < 0.7 * at(plain, "open", 0.7)
    assert at(softer, "open", 0.2) == pytest.approx(at(plain, "open", 0.2))
    assert softer.control("PBM") == pytest.approx(plain.control("PBM"), abs=1e-6)


def test_an_edit_follows_its_phone_when_the_line_is_spoken_anew() -> None:
    edit = Edit("MAP", 2, "open", occurrence=2, gain=0.5)
    plain, slower = edited(stretch=1.7), edited(edit, stretch=1.7)
    assert at(slower, "open", 0.7 * 1.7) < 0.7 * at(plain, "open", 0.7 * 1.7)
    assert at(slower, "open", 0.2 * 1.7) == pytest.approx(at(plain, "open", 0.2 * 1.7))


@pytest.mark.parametrize(
    ("spoken", "named", "found"),
    [
        ("Grüße", "GRU\u0308SSE", True),
        ("İstanbul", "istanbul", True),
        ("مَرحبا", "مرحبا", True),
        ("L’eau,", "l'eau", True),
        ("女儿", "女儿", True),
        ("की", "के", False),  # two words of Hindi, of one consonant and a vowel each
    ],
)
def test_a_word_is_found_in_any_spelling_of_it(spoken: str, named: str, found: bool) -> None:
    line = Speech(PhoneTrack(Tier.of(("m", 0, 0.1), ("ae", 0.1, 0.3))), Tier.of((spoken, 0, 0.3)))
    report = ENGINE.animate(line, 100.0, [Edit(named, 2, "open", gain=0.5)]).report
    assert len(report["edits"]) == found
    assert len(report["edits_lost"]) == (not found)


def test_a_level_is_reached_even_where_nothing_was_drawn() -> None:
    assert at(edited(), "ShCh", 0.2) < 0.05
    assert at(edited(Edit("map", 2, "ShCh", level=0.8)), "ShCh", 0.2) > 0.6


def test_a_hold_keeps_lips_closed_for_longer() -> None:
    def closed(animation: Animation) -> float:
        late = animation.times > 0.75
        return float(np.sum(animation.control("PBM")[late] > 0.9)) / animation.rate

    longer = edited(Edit("map", 3, "PBM", occurrence=2, hold=0.1))
    assert closed(longer) == pytest.approx(closed(edited()) + 0.2, abs=0.05)
    assert at(longer, "open", 0.75) == 0


def test_drawn_keys_stand_and_the_bounds_are_solved_again() -> None:
    drawn = Edit("map", 2, "PBM", keys=((0.3, 0.0), (0.4, 1.0), (0.6, 1.0), (0.7, 0.0)))
    animation = edited(drawn)
    assert at(animation, "PBM", 0.2) > 0.9
    assert at(animation, "open", 0.2) == 0  # it would be wide open
    solved = ENGINE.solve(speech().phones, speech().words, [drawn])
    check_stages(ENGINE, solved)


def test_an_unlocked_edit_stands_against_the_bounds() -> None:
    keys = ((0.0, 0.6), (1.0, 0.6))
    for unlocked, expected in ((False, 0.0), (True, 0.6)):
        edit = Edit("map", 1, "open", occurrence=2, keys=keys, unlocked=unlocked)
        assert at(edited(edit), "open", 0.545) == pytest.approx(expected, abs=0.03)


def test_edits_that_find_no_phone_are_named() -> None:
    lost = [
        Edit("mop", 1, "PBM", gain=2),
        Edit("map", 1, "PBM", occurrence=3),
        Edit("map", 9, "PBM"),
        Edit("map", 1, "PBM", label="b"),
    ]
    animation = edited(*lost, Edit("a", 1, "open", gain=0.9))
    assert animation.report["edits"] == ["open in phone 1 of 'a'"]
    assert len(animation.report["edits_lost"]) == 4
    assert "PBM in phone 1 of 'map' (3)" in animation.report["edits_lost"]


def test_why_names_the_edit() -> None:
    edit = Edit("map", 2, "open", gain=0.5)
    solved = ENGINE.solve(speech().phones, speech().words, [edit])
    assert why(ENGINE, solved, "open", 0.2).edits == ("open in phone 2 of 'map'",)
    assert why(ENGINE, solved, "open", 0.7).edits == ()


def write(path: Path, **edit: Any) -> Path:
    head = {"format": "lipwright/edits", "version": 1}
    path.write_text(json.dumps({**head, "edits": [{"word": "map", "phone": 2, **edit}]}))
    return path


def test_edits_are_a_file(tmp_path: Path) -> None:
    path = write(tmp_path / "edits.json", pose="open", gain=0.5)
    assert read_edits(path) == (Edit("map", 2, "open", gain=0.5),)
    performance = pipeline.animate(speech(), edits=path)
    assert performance.animation.report["edits"] == ["open in phone 2 of 'map'"]


@pytest.mark.parametrize(
    ("edit", "words"),
    [
        ({"pose": "open", "gain": -1}, "gain -1"),
        ({"pose": "open", "phone": 0}, "from 1"),
        ({"pose": "open", "level": 3}, "level 3"),
        ({"pose": "open", "keys": [[0.5, 0], [0.5, 1]]}, "rising"),
        ({"pose": "smirk"}, "unknown pose 'smirk'"),
        ({"pose": "open", "gian": 2}, "gian"),
        ({}, "pose"),
    ],
)
def test_broken_edits_are_refused(tmp_path: Path, edit: dict[str, Any], words: str) -> None:
    path = write(tmp_path / "edits.json", **edit)
    with pytest.raises(InputError, match=words):
        pipeline.animate(speech(), edits=path)
