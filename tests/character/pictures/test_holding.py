"""Held pictures: what they promise for any line, and what an animator would look for."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lipwright.animation import Animation
from lipwright.character.pictures import PictureCharacter, Shape, Timing, hold, load_pictures
from lipwright.character.pictures.holding import CHANGE, cheapest
from lipwright.character.pictures.sounds import Grid, Sounds, required
from lipwright.errors import CharacterError
from lipwright.performance import Cues
from lipwright.phones import PhoneTrack
from lipwright.timeline import Tier
from tests.character.pictures.lines import animated, speech, spoken_as

RHUBARB = load_pictures("rhubarb")
TIMINGS = [Timing(fps=fps, on=on) for fps in (12.0, 24.0, 25.0, 30.0) for on in (1, 2)]


def timed(timing: Timing, name: str = "rhubarb") -> PictureCharacter:
    return replace(load_pictures(name), timing=timing)


def shown(cues: Cues, start: float, end: float) -> set[str]:
    """The shapes that are seen at some time between two instants."""
    rows = cues.rows()
    return {s for s, a, b in rows if a / cues.fps < end - 1e-9 and b / cues.fps > start + 1e-9}


@settings(max_examples=60)
@given(
    st.integers(0, 2**32), st.sampled_from(TIMINGS), st.sampled_from(["rhubarb", "preston_blair"])
)
def test_promises_for_any_line(seed: int, timing: Timing, name: str) -> None:
    line = speech(seed)
    of = timed(timing, name)
    animation, end = animated(line), max(line.phones.tier.end, 0.0)
    cues = hold(animation, of, end)
    edges = [*cues.frames, cues.end]
    # The time is covered without gaps, on the grid, and neighbours differ.
    assert edges[0] == 0
    assert all(a < b for a, b in itertools.pairwise(edges))
    assert all(frame % timing.on == 0 for frame in edges)
    assert 0 <= cues.duration - end < timing.on / timing.fps + 1e-6
    assert all(a != b for a, b in itertools.pairwise(cues.shapes))
    # Lips close on every p, b, m; teeth meet the lip, or it is told.
    closed, teeth = of.reach["bmp"], of.reach["f"]
    lost = 0
    for phone in line.phones:
        if phone.end <= 0:
            continue
        start = max(phone.start, 0.0)
        if phone.label in "pbm":
            assert closed in shown(cues, start, phone.end)
        elif phone.label in "fv":
            near = timing.on / timing.fps
            lost += teeth not in shown(cues, start - near, phone.end + near)
    assert lost <= len(cues.notes)
    # Shorter than the shortest hold only where what must be seen leaves no other way.
    step = timing.on / timing.fps
    grid = Grid(cues.end // timing.on, step, timing.seconds(timing.lead))
    must, _ = required(of, Sounds.of(animation), grid)
    shortest = min(timing.drawings(), grid.count)
    for shape, first, last in cues.rows():
        a, b = first // timing.on, last // timing.on
        if b - a < shortest:
            near_places = range(a - shortest, b + shortest)
            assert any(must.get(place, shape) != shape for place in near_places)
    for place, shape in must.items():
        assert shape in shown(cues, place * step, (place + 1) * step)


@pytest.mark.parametrize("shortest", [1, 2, 3])
@given(st.integers(0, 2**32))
@settings(max_examples=25)
def test_nothing_is_cheaper(shortest: int, seed: int) -> None:
    """Every sequence of 3 shapes over 7 places is tried."""
    costs = np.random.default_rng(seed).uniform(0, 4 * CHANGE, (7, 3))

    def price(sequence: tuple[int, ...]) -> float:
        lengths = [len(list(run)) for _, run in itertools.groupby(sequence)]
        if min(lengths) < shortest:
            return math.inf
        return float(costs[range(7), sequence].sum()) + CHANGE * (len(lengths) - 1)

    starts, shapes = cheapest(costs, shortest)
    found = np.repeat(shapes, np.diff([*starts, 7]))
    best = min(price(each) for each in itertools.product(range(3), repeat=7))
    assert price(tuple(found.tolist())) == pytest.approx(best)


def test_lips_close_early_rather_than_late() -> None:
    animation = spoken_as(("aa", 0.2, 0.5), ("p", 0.51, 0.59), ("aa", 0.6, 0.9))
    cues = hold(animation, RHUBARB, 1.1)
    [(_, first, last)] = [row for row in cues.rows() if row[0] == "A"]
    assert 0.51 - 2.5 / 24 <= first / 24 <= 0.51
    assert last / 24 <= 0.6
    assert last - first >= 2


def test_a_greater_lead_is_earlier() -> None:
    animation = spoken_as(("aa", 0.2, 0.5), ("p", 0.5, 0.6), ("aa", 0.6, 0.9))
    firsts = []
    for lead in ("0 frames", "2 frames"):
        cues = hold(animation, timed(Timing(lead=lead)), 1.1)
        firsts.append(cues.frames[cues.shapes.index("A")])
    assert firsts[1] == firsts[0] - 2


def test_vowels_open_and_round() -> None:
    rows = (("aa", 0.3, 0.7), ("s", 0.7, 0.85), ("uw", 0.85, 1.2))
    cues = hold(spoken_as(*rows), RHUBARB, 1.6)
    assert "D" in shown(cues, 0.35, 0.65)
    assert "B" in shown(cues, 0.7, 0.85)
    assert "F" in shown(cues, 0.9, 1.15)


@pytest.mark.parametrize(("pause", "rests"), [(0.32, True), (0.8, True), (0.1, False)])
@pytest.mark.parametrize("on", [1, 2])
def test_long_silences_rest(pause: float, rests: bool, on: int) -> None:
    rows = (("iy", 0.3, 0.6), ("sil", 0.6, 0.6 + pause), ("iy", 0.6 + pause, 1 + pause))
    cues = hold(spoken_as(*rows), timed(Timing(on=on)), 1.4 + pause)
    assert ("X" in shown(cues, 0.6, 0.6 + pause)) == rests
    assert cues.shapes[-1] == "X"


def stiff(rows: tuple[tuple[str, float, float], ...], **weights: float) -> Animation:
    """Return these phones on a face that does not move."""
    animation = spoken_as(*rows)
    level = np.array([weights.get(control, 0.0) for control in animation.controls], np.float32)
    return replace(animation, values=np.tile(level, (len(animation), 1)))


@pytest.mark.parametrize(("pause", "rests"), [(0.29, False), (0.31, True)])
def test_a_long_silence_rests_whatever_the_curves_do(pause: float, rests: bool) -> None:
    rows = (("ah", 0.0, 0.5), ("sil", 0.5, 0.5 + pause), ("ah", 0.5 + pause, 1.0 + pause))
    cues = hold(stiff(rows, open=0.33), replace(RHUBARB, relax={}), 1.0 + pause)
    assert cues.shapes == (("C", "X", "C") if rests else ("C",))


def test_a_mouth_relaxes_in_a_short_pause() -> None:
    rows = (("ah", 0.0, 0.5), ("sil", 0.5, 0.79), ("ah", 0.79, 1.2))
    between = stiff(rows, open=0.31, W=0.05, wide=0.03)  # a little nearer to C than to B
    assert "B" in shown(hold(between, RHUBARB, 1.2), 0.5, 0.79)
    tense = replace(RHUBARB, relax={})
    assert hold(between, tense, 1.2).shapes == ("C",)


def test_a_shape_is_shown_for_its_sounds_only() -> None:
    rows = (("k", 0.0, 0.5), ("l", 0.5, 0.9), ("d", 0.9, 1.4))
    assert "X" not in hold(stiff(rows), RHUBARB, 1.4).shapes
    tongue = stiff(rows, open=0.35, W=0.3, tRoof=0.7)
    [(first, last)] = [row[1:] for row in hold(tongue, RHUBARB, 1.4).rows() if row[0] == "H"]
    assert first / 24 == pytest.approx(0.5, abs=0.09)
    assert last / 24 == pytest.approx(0.9, abs=0.09)


def test_two_that_meet_in_one_drawing_are_shown_in_their_order() -> None:
    rows = (("aa", 0.2, 0.51), ("m", 0.51, 0.54), ("f", 0.54, 0.58), ("aa", 0.58, 0.9))
    cues = hold(spoken_as(*rows), timed(Timing(on=2)), 1.2)
    assert cues.notes == ()
    assert "AG" in "".join(cues.shapes)


def test_closures_too_near_for_the_hold_win() -> None:
    labels = ("m", "f", "m", "v", "p")
    rows = [(label, 0.3 + 0.05 * i, 0.35 + 0.05 * i) for i, label in enumerate(labels)]
    cues = hold(spoken_as(*rows), timed(Timing(minimum_hold="3 frames")), 0.8)
    for label, start, end in rows:
        assert ("G" if label in "fv" else "A") in shown(cues, start, end)


def test_what_finds_no_place_is_told() -> None:
    rows = [("p", 0.30, 0.33), ("f", 0.33, 0.36), ("p", 0.36, 0.39)]
    cues = hold(spoken_as(*rows), timed(Timing(fps=12, on=2)), 0.8)
    assert "A" in cues.shapes
    assert "G" not in cues.shapes
    assert cues.notes == ("no drawing is left for G at 0.33 s",)


def test_shapes_that_are_not_drawn_are_stood_in_for() -> None:
    rows = (("f", 0.3, 0.4), ("aa", 0.4, 0.7), ("l", 0.7, 0.85), ("p", 0.85, 0.95))
    cues = hold(spoken_as(*rows), RHUBARB.without(["G", "H", "X"]), 1.6)
    assert set(cues.shapes) <= set("ABCDEF")
    assert cues.rest == "A"
    assert cues.shapes[-1] == "A"
    assert "A" in shown(cues, 0.3, 0.4)


def test_phones_that_nobody_knows_close_by_their_curves() -> None:
    animation = spoken_as(("aa", 0.2, 0.5), ("p", 0.5, 0.6), ("aa", 0.6, 0.9))
    own = PhoneTrack(Tier.of(("oo!", 0.2, 0.9)), "klingon")
    cues = hold(replace(animation, phones=own), RHUBARB, 1.1)
    assert "A" in shown(cues, 0.5, 0.6)


def test_nobody_speaks() -> None:
    silent = replace(spoken_as(("aa", 0.2, 0.5)), phones=PhoneTrack(Tier()))
    silent = replace(silent, values=np.zeros_like(silent.values))
    assert hold(silent, RHUBARB, 0.0).rows() == [("X", 0, 1)]
    assert hold(silent, RHUBARB, 2.0).shapes == ("X",)


def test_any_list_of_any_controls_works() -> None:
    shapes = (
        Shape("shut", [{}]),
        Shape("gape", [{"maw": 1.0}]),
    )
    crab = PictureCharacter("crab", shapes, "shut", {"bmp": "shut"})
    animation = spoken_as(("aa", 0.3, 0.6), ("p", 0.6, 0.7))
    renamed = replace(
        animation,
        controls=tuple("maw" if c == "open" else f"x{c}" for c in animation.controls),
        values=animation.values * 1.5,
        keys={},
    )
    cues = hold(renamed, crab, 1.0)
    assert cues.shapes == ("shut", "gape", "shut")
    with pytest.raises(CharacterError, match="no control 'maw'"):
        hold(animation, crab, 1.0)


def test_the_same_line_gives_the_same_cues() -> None:
    animation = animated(speech(7))
    first, second = (hold(animation, RHUBARB, 3.0) for _ in range(2))
    assert first.rows() == second.rows()
