"""A paragraph in each language, from text to motion: the lips close wherever they must."""

import numpy as np
import pytest

from lipwright import pipeline
from lipwright.phones import load_reduction
from lipwright.phones.languages import languages, sample_text

RATE = 60.0


@pytest.mark.parametrize("language", languages())
def test_the_lips_close_on_every_sound_of_the_lips(language: str) -> None:
    voice = {"en": "en-us"}.get(language, language)
    speech = pipeline.say(sample_text(language), voice=voice)
    animation = pipeline.animate(speech, rate=RATE).animation
    classes = "mandarin" if language == "cmn" else "common"
    rows, report = load_reduction(speech.phones.phone_set, classes).rows(speech.phones)
    times = animation.start + np.arange(len(animation)) / RATE
    for label, pose in (("bmp", "PBM"), ("f", "FV")):
        curve = animation.control(pose)
        found = [(start, end) for name, start, end in rows if name == label]
        assert len(found) > 10 or label == "f"  # not every language has an f or v
        for start, end in found:
            inside = curve[(times >= start) & (times < end)]
            nearest = curve[int(np.abs(times - (start + end) / 2).argmin())]
            assert max(inside, default=nearest) >= 0.9, (label, start)
    assert animation.report["nearest_classes"] == report.stand_ins
    assert animation.control("open").max() > 0.3
