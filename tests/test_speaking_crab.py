"""The whole way with the crab: a typed line, its own set, its own poses, the page, Chromium."""

from pathlib import Path

import numpy as np
import pytest

from lipwright import pipeline
from lipwright.character.crab import build_crab
from lipwright.character.mesh import Part
from lipwright.performance import Performance
from tests.chromium import chromium, opened

LINE = "Papa, father, my map."
PARTS = {part.name: part for part in build_crab()}


@pytest.fixture(scope="module")
def performance() -> Performance:
    return pipeline.animate(pipeline.say(LINE), bigram_set="crab", character="crab")


def left_tip(part: Part) -> int:
    """Return the vertex of the left mandible that meets the other one."""
    return int(np.argmin((part.positions + part.morphs["mandibles_in"])[:, 0]))


def test_the_mandibles_meet_on_every_p_and_m_and_part_in_father(performance: Performance) -> None:
    channels = performance.rig().channels
    part = PARTS["mandible_left"]
    tip = left_tip(part)
    place = float(part.positions[tip, 0]) + sum(
        values * part.morphs[name][tip, 0]
        for name, values in zip(channels.controls, channels.values.T, strict=True)
        if name in part.morphs
    )
    times = channels.times
    phones = performance.animation.phones
    closures = [phone for phone in phones if phone.label in ("p", "m")]
    vowels = [phone for phone in phones if phone.label in ("ɑː", "aɪ", "æ")]
    assert len(closures) == 5
    assert len(vowels) >= 3
    for phone in closures:
        inside = (times >= phone.start) & (times < phone.end)
        assert np.abs(place[inside]).min() < 0.004
    for phone in vowels:
        assert place[np.argmin(np.abs(times - phone.middle))] > 0.030


def test_the_page_shows_it(performance: Performance, tmp_path: Path) -> None:
    path = tmp_path / "crab.html"
    pipeline.save(performance, path)
    assert path.stat().st_size < 4_500_000
    phones = {phone.label: phone.middle for phone in performance.animation.phones}
    tip = 3 * left_tip(PARTS["mandible_left"])
    with chromium() as browser, opened(browser, path) as page:
        page.ask("lipwright.setIdle(true)")
        places = {}
        for label in ("p", "ɑː"):
            page.at(phones[label])
            places[label] = page.ask("lipwright.positions()['mandible_left']")[tip]
        assert abs(places["p"]) < 0.008 < 0.030 < places["ɑː"]
        assert {"eyeBlinkLeft", "eyeBlinkRight"} <= set(page.ask("lipwright.morphs()"))
        assert page.complaints == []
