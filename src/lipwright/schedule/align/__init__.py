"""Alignment: a sound and its words become phones in time."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from lipwright.errors import SoundError, TextError
from lipwright.phones import PhoneTrack
from lipwright.sound import Sound
from lipwright.speech import Speech
from lipwright.timeline import Interval, Tier


def align(
    sound: Sound,
    text: str,
    *,
    lexicon: Path | Mapping[str, object] | None = None,
    progress: Callable[[float], None] | None = None,
) -> Speech:
    """Say when each phone of ``text`` sounds (thin version; the API stays)."""
    import pocketsphinx as ps
    import soxr

    words = re.findall(r"[a-z']+", text.lower())
    if not words:
        raise TextError("no words to align")
    samples = sound.samples
    if sound.rate != 16000:
        samples = soxr.resample(samples, sound.rate, 16000)
    noise = np.random.default_rng(0).normal(0, 1.5, len(samples))
    raw = np.clip(samples * 32767 + noise, -32768, 32767).astype(np.int16).tobytes()
    decoder = ps.Decoder(
        lm=None, loglevel="FATAL", bestpath=False, beam=1e-200, wbeam=1e-200, pbeam=1e-200
    )
    decoder.set_align_text(" ".join(words))

    def run() -> None:
        decoder.reinit_feat()
        decoder.start_utt()
        try:
            decoder.process_raw(raw, full_utt=True)
        finally:
            decoder.end_utt()

    run()
    if decoder.hyp() is None:
        raise SoundError("the words do not fit the sound")
    decoder.set_alignment()
    run()
    phones: list[Interval] = []
    heard: list[Interval] = []
    end = sound.duration
    for word in decoder.get_alignment():
        start, stop = word.start / 100, min(end, (word.start + word.duration) / 100)
        if not word.name.startswith("<"):
            heard.append(Interval(re.sub(r"\(\d+\)$", "", word.name), start, stop))
        for phone in word:
            name = phone.name.lower()
            label = "sil" if name == "sil" or name.startswith("+") else name
            phones.append(
                Interval(label, phone.start / 100, min(end, (phone.start + phone.duration) / 100))
            )
    if phones[-1].end < end:
        phones.append(Interval("sil", phones[-1].end, end))
    return Speech(
        PhoneTrack(Tier(tuple(phones))), Tier(tuple(heard)), sound, text, "en-us", "align"
    )
