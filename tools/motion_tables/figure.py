"""Figure 4: a long utterance that was left out, put together by greedy search, as stills."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from PIL import Image, ImageDraw, ImageFont
from tests.chromium import chromium

from lipwright.performance import Performance
from lipwright.phones import SILENCE, PhoneTrack
from lipwright.sound import Sound
from lipwright.speech import Speech
from lipwright.timeline import Interval, Tier
from tools.stills.shots import Crop, Crops, pictures

STILLS, WIDTH, HEIGHT = 10, 170, 190
CROPS = Crops(Crop("front", 0.24, 0.74), Crop("mouth", 0.26, 0.56))
GAP, BELOW = 4, 44
INK, FAINT = (32, 34, 38), (104, 108, 116)


def one_after_the_other(lines: Sequence[Speech]) -> Speech:
    """Return lines as one utterance: their sounds, words and phones in a row."""
    at, phones, words, samples = 0.0, list[Interval](), list[Interval](), []
    for line in lines:
        assert line.sound is not None
        for kind, every in ((phones, line.phones.normalised().tier), (words, line.words)):
            kind += [replace(one, start=one.start + at, end=one.end + at) for one in every]
        samples.append(line.sound.samples)
        at += line.sound.duration
    first = lines[0]
    assert first.sound is not None
    return Speech(
        PhoneTrack(Tier(tuple(phones)), first.phones.normalised().phone_set),
        Tier(tuple(words)),
        Sound(np.concatenate(samples), first.sound.rate),
        " ".join(line.text for line in lines),
        first.language,
    )


def row(performance: Performance) -> bytes:
    """Return the row of stills as a PNG file, each with its phone and word."""
    said = [phone for phone in performance.speech.phones if phone.label != SILENCE]
    shown = [said[place] for place in np.linspace(0, len(said) - 1, STILLS).astype(int)]
    with chromium() as browser:
        times = [phone.middle for phone in shown]
        both = pictures(browser, performance, times, CROPS, WIDTH, (HEIGHT, HEIGHT))
    page = Image.new("RGB", (STILLS * (WIDTH + GAP), HEIGHT + BELOW), "white")
    pen = ImageDraw.Draw(page)
    large, small = ImageFont.load_default(17), ImageFont.load_default(13)
    for number, (phone, (face, _)) in enumerate(zip(shown, both, strict=True)):
        left = number * (WIDTH + GAP)
        page.paste(face, (left, 0))
        word = performance.speech.words.at(phone.middle)
        middle = left + WIDTH // 2
        pen.text((middle, HEIGHT + 14), phone.label, INK, large, anchor="mm")
        text = f"{word.label}, {phone.middle:.2f} s" if word else f"{phone.middle:.2f} s"
        pen.text((middle, HEIGHT + 33), text, FAINT, small, anchor="mm")
    packed = io.BytesIO()
    few = page.quantize(256, Image.Quantize.MEDIANCUT, kmeans=3)
    few.save(packed, "PNG", optimize=True)
    return packed.getvalue()
