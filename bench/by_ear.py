"""Phones by ear beside a hand's, and the recogniser's own loop of phones for comparison.

TIMIT beside the project, damaged files left out. A phone is right if edit distance pairs
it with its like of the hand's; ``right_class`` is the share of the time in which both have
the same class of mouth. In other languages the same share is taken of what espeak-ng says,
with white noise 20 dB below.
"""

import time
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from bench.aligning_languages import VOICES, sentences
from bench.measure import say
from bench.recordings import DATA, is_damaged, matched, starts
from bench.robustness import noisy
from lipwright import pipeline
from lipwright.phones import PhoneTrack, load_reduction
from lipwright.schedule.align.model import model_folder
from lipwright.schedule.align.prepare import prepared
from lipwright.sound import Sound
from lipwright.sound_files import read_sound
from lipwright.timeline import Interval, Tier

SETTINGS: tuple[dict[str, float], ...] = (
    {},
    {"lw": 1.0},
    {"lw": 2.0},
    {"lw": 2.0, "beam": 1e-20, "pbeam": 1e-20},
)
"""Of pocketsphinx' ``allphone``; phones in context (``allphone_ci=False``) take minutes a line."""
Hearing = Callable[[Sound], PhoneTrack]


def classes(track: PhoneTrack, frames: int) -> NDArray[np.object_]:
    """The class of mouth in each hundredth of a second."""
    found = np.full(frames, "sil", dtype=object)
    for label, start, end in load_reduction(track.phone_set).rows(track)[0]:
        found[round(100 * start) : round(100 * end)] = label
    return found


def agreement(one: PhoneTrack, other: PhoneTrack, seconds: float) -> tuple[float, float]:
    """Shares of the time in which class, and speech or silence, are the same."""
    a, b = (classes(track, int(100 * seconds)) for track in (one, other))
    return float(np.mean(a == b)), float(np.mean((a == "sil") == (b == "sil")))


def recogniser(**settings: float) -> Hearing:
    """Pocketsphinx' loop of phones."""
    from pocketsphinx import Decoder

    folder = model_folder() / "en-us"
    given = {"hmm": str(folder / "en-us"), "samprate": 16000, "loglevel": "FATAL"}
    phones = str(folder / "en-us-phone.lm.bin")
    decoder = Decoder(allphone=phones, lm=None, dict=None, dither=False, **given, **settings)

    def hear(sound: Sound) -> PhoneTrack:
        samples = prepared(sound)
        noise = np.random.default_rng(0).normal(0.0, 1.0, len(samples))
        decoder.reinit_feat()
        decoder.start_utt()
        whole = np.clip(samples * 32767.0 + noise, -32768, 32767).astype(np.int16)
        decoder.process_raw(whole.tobytes(), full_utt=True)
        decoder.end_utt()
        found = [
            Interval(
                "sil" if segment.word[0] in "+<[" else segment.word.lower(),
                0.01 * segment.start_frame,
                0.01 * (segment.end_frame + 1),
            )
            for segment in decoder.seg()
        ]
        return PhoneTrack(Tier(tuple(found)), "arpabet")

    return hear


def ours(sound: Sound) -> PhoneTrack:
    """The project's own."""
    return pipeline.hear(sound).phones


def measure(what: str, hear: Hearing, lines: Sequence[tuple[Sound, PhoneTrack]]) -> None:
    """Print what one way of hearing finds in TIMIT."""
    off: list[float] = []
    said, heard, shares, seconds = 0, 0, [], 0.0
    for sound, hand in lines:
        before = time.process_time()
        track = hear(sound)
        seconds += time.process_time() - before
        off += matched(starts(track), starts(hand))
        said, heard = said + len(starts(hand)), heard + len(starts(track))
        shares.append(agreement(track, hand, sound.duration))
    apart = np.abs(off)
    right, silent = np.mean(shares, axis=0)
    say(
        f"by ear, TIMIT: {what}",
        recordings=len(lines),
        phones=[said, heard],
        found=round(len(off) / said, 3),
        right=round(len(off) / heard, 3),
        right_class=round(float(right), 3),
        right_silence=round(float(silent), 3),
        median_ms=round(1e3 * float(np.median(apart)), 1),
        within_20_ms=round(float(np.mean(apart <= 0.020)), 3),
        within_50_ms=round(float(np.mean(apart <= 0.050)), 3),
        cpu_per_second_of_sound=round(seconds / sum(s.duration for s, _ in lines), 4),
    )


def languages() -> None:
    """Print the share of right classes in each language."""
    worsen = noisy(20.0)
    found = {}
    for language, texts in sentences().items():
        shares = []
        for text, (variant, rate, pitch) in zip(texts, VOICES, strict=False):
            said = pipeline.say(text, voice=language + variant, rate=rate, pitch=pitch)
            assert said.sound is not None
            sound = Sound(worsen(said.sound.samples, said.sound.rate), said.sound.rate)
            shares.append(agreement(ours(sound), said.phones, sound.duration))
        right, silent = np.mean(shares, axis=0)
        found[language] = [round(float(right), 2), round(float(silent), 2)]
    say("by ear, synthesised: right class, right silence", **found)


def main() -> None:
    """Measure and print."""
    lines = []
    for path in sorted((DATA / "timit").glob("*/*.flac")):
        sound = read_sound(path)
        if not is_damaged(sound.samples):
            lines.append((sound, pipeline.from_labels(path.with_suffix(".phn")).phones))
    if lines:
        for settings in SETTINGS:
            given = ", ".join(f"{name} {value:g}" for name, value in settings.items())
            measure(f"pocketsphinx, {given or 'as it comes'}", recogniser(**settings), lines)
        measure("ours", ours, lines)
    languages()


if __name__ == "__main__":
    main()
