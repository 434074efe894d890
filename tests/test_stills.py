"""The instants that the stills show, and how they are laid out."""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image
from tools.stills.instants import LINE, SHOWN, Shown, fullest
from tools.stills.sheet import CELL, FACE, MOUTH, sheet
from tools.stills.shots import GROUND, Crop, cut

from lipwright import pipeline
from lipwright.animation import Animation
from lipwright.errors import InputError
from lipwright.phones import PhoneTrack
from lipwright.timeline import Tier

POP = Shown("/p/", "p", "pop", ("mandibles_in", "PBM"))


def animation(*levels: float, control: str = "PBM") -> Animation:
    """Return ten frames a second of one control over "pop pa"."""
    values = np.array(levels, np.float32)[:, None]
    phones = PhoneTrack(
        Tier.of(("p", 0.0, 0.3), ("ɑː", 0.3, 0.5), ("p", 0.5, 0.8), ("p", 0.8, 1.0))
    )
    words = Tier.of(("pop", 0.0, 0.8), ("pa", 0.8, 1.0))
    return Animation((control,), values, 10.0, phones=phones, words=words)


@pytest.mark.parametrize(
    ("levels", "seconds"),
    [
        ((0, 0.5, 0, 0, 0, 0, 0.9, 0, 0, 0), 0.6),
        ((0, 1, 0, 0, 0, 0, 1, 0, 0, 0), 0.1),
        ((0, 0, 0, 0, 0, 0.99, 1, 0.99, 0, 0), 0.6),
        # What a neighbour or another word is at is not the sound's own.
        ((0, 0.5, 0, 1, 1, 0, 0, 0, 0, 1), 0.1),
    ],
)
def test_the_fullest_instant_of_a_sound(levels: list[float], seconds: float) -> None:
    found = fullest(animation(*levels), POP)
    assert found.seconds == pytest.approx(seconds)
    assert found.level == pytest.approx(levels[round(10 * seconds)])


def test_what_cannot_be_shown_is_refused() -> None:
    with pytest.raises(InputError, match="no pose for /p/"):
        fullest(animation(0, control="open"), POP)
    with pytest.raises(InputError, match="/ɑː/ is not said in 'pa'"):
        fullest(animation(0), Shown("/ɑː/", "ɑː", "pa", ("PBM",)))


def test_head_and_crab_reach_every_shape_in_the_line() -> None:
    speech = pipeline.say(LINE)
    levels = {}
    for who in ("head", "crab"):
        made = pipeline.animate(speech, character=who).animation
        found = [fullest(made, shown) for shown in SHOWN]
        levels[who] = [instant.level for instant in found]
    for closed, opened, round_, bitten in levels.values():
        assert (closed, bitten) == pytest.approx((1, 1), abs=0.02)
        assert opened > 0.5
        assert round_ > 0.8


def test_a_cut_keeps_its_middle_and_is_ground_beside_the_picture() -> None:
    picture = Image.new("RGB", (100, 100), "red")
    made = cut(picture, Crop("front", 0.5, 0.5), 200, 50)
    assert made.size == (200, 50)
    assert made.getpixel((100, 25)) == (255, 0, 0)
    assert made.getpixel((5, 25)) == GROUND


def test_the_sheet_has_a_row_for_each_character() -> None:
    pair = (Image.new("RGB", (CELL, FACE), "red"), Image.new("RGB", (CELL, MOUTH), "blue"))
    one, two = (sheet([("head", [pair, pair])] * rows, [("/p/", "Pop")] * 2) for rows in (1, 2))
    small, large = (Image.open(io.BytesIO(made)) for made in (one, two))
    assert small.width == large.width > 2 * CELL
    assert large.height - small.height > FACE + MOUTH
    counted = small.convert("RGB").getcolors()
    assert counted is not None
    area = {colour: count for count, colour in counted}
    assert area[255, 0, 0] == pytest.approx(2 * CELL * FACE, rel=0.01)
    assert area[0, 0, 255] == pytest.approx(2 * CELL * MOUTH, rel=0.01)
