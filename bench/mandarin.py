"""Mandarin beside the curves that animators made for it; prints one line of JSON.

The recordings' texts are not given, so no phone of theirs can be compared. What needs no
text: four takes are 100 single syllables each, with pauses between them, found here by
the sound's energy. When the mouth begins to open for a syllable, is widest and shut again,
from the syllable's sound; and in how many syllables the lips are round. Lipwright says
syllables of Mandarin one by one for comparison. In running speech, how far loudness alone
follows the animators' jaw.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from bench.measure import say
from bench.recordings import DATA
from lipwright import pipeline
from lipwright.schedule.mandarin import legal_syllables
from lipwright.sound import Sound
from lipwright.sound_files import read_sound

FOLDER = DATA / "facegood"
STEP = 0.01  # s
QUIET = 28.0  # dB under the loud parts
JOINED, SHORTEST = 0.12, 0.06  # s
AROUND = 0.25  # s before and after a syllable in which the mouth moves for it
RISEN = 0.2  # of the peak
EVERY = 8  # of the legal syllables

Values = NDArray[np.float64]


@dataclass(frozen=True)
class Moments:
    """When the mouth moves for one syllable.

    ``begins`` and ``ends_after`` in seconds from the sound's start and end, ``widest`` as a
    share of the sound's time.
    """

    begins: float
    widest: float
    ends_after: float
    rounded: bool


def loudness(sound: Sound) -> Values:
    """Return decibels, a value each hundredth of a second."""
    hop = round(sound.rate * STEP)
    power = np.convolve(sound.samples.astype(np.float64) ** 2, np.ones(2 * hop) / (2 * hop), "same")
    return 10 * np.log10(power[::hop] + 1e-12)


def bursts(sound: Sound) -> list[tuple[float, float]]:
    """Return where something is said, from pause to pause."""
    level = loudness(sound)
    on = np.flatnonzero(level > np.percentile(level, 95) - QUIET)
    cuts = np.flatnonzero(np.diff(on) * STEP > JOINED)
    first, last = np.r_[on[0], on[cuts + 1]], np.r_[on[cuts], on[-1]]
    pairs = zip(first * STEP, (last + 1) * STEP, strict=True)
    return [(float(a), float(b)) for a, b in pairs if b - a > SHORTEST]


def moments(
    times: Values, opening: Values, rounded: Values, start: float, end: float
) -> Moments | None:
    """Return when a mouth moved for what sounds from ``start`` to ``end``."""
    near = np.flatnonzero((times > start - AROUND) & (times < end + AROUND))
    if not len(near) or opening[near].max() <= 0:
        return None
    peak = near[int(opening[near].argmax())]
    low = opening <= RISEN * opening[peak]
    before, after = np.flatnonzero(low[:peak]), np.flatnonzero(low[peak:])
    if not len(before) or not len(after):
        return None
    return Moments(
        float(times[before[-1]] - start),
        float((times[peak] - start) / (end - start)),
        float(times[peak + after[0]] - end),
        bool(rounded[near].max() > 0.2),
    )


def animators(path: Path) -> list[Moments]:
    """Return the moments of each syllable of a take."""
    rows = np.genfromtxt(path, delimiter=",", names=True)
    rounded = np.maximum(rows["mouthPucker"], rows["mouthFunnel"])
    found = [
        moments(rows["time"], rows["jawOpen"], rounded, start, end)
        for start, end in bursts(read_sound(path.with_suffix(".flac")))
    ]
    return [each for each in found if each is not None]


def ours() -> list[Moments]:
    """Return the moments of every few syllables as Lipwright says them."""
    found = []
    for spelled in legal_syllables()[::EVERY]:
        speech = pipeline.say(f"{spelled}4", voice="cmn")
        made = pipeline.animate(speech, bigram_set="mandarin", rate=30).animation
        assert speech.sound is not None
        (start, *_), (*_, end) = zip(*bursts(speech.sound), strict=True)
        opening, rounded = (made.control(name).astype(np.float64) for name in ("open", "W"))
        found.append(moments(made.times, opening, rounded, start, end))
    return [each for each in found if each is not None]


def told(of: list[Moments]) -> dict[str, float]:
    """Return medians and shares."""
    return {
        "syllables": len(of),
        "begins_ms": round(1000 * float(np.median([m.begins for m in of]))),
        "widest_share": round(float(np.median([m.widest for m in of])), 2),
        "shut_after_end_ms": round(1000 * float(np.median([m.ends_after for m in of]))),
        "rounded": round(float(np.mean([m.rounded for m in of])), 3),
    }


def loudness_and_jaw(path: Path) -> float:
    """Return how far loudness alone follows the jaw of running speech: a correlation."""
    rows = np.genfromtxt(path, delimiter=",", names=True)
    level = loudness(read_sound(path.with_suffix(".flac")))
    level = np.convolve(np.maximum(level, level.max() - 40), np.ones(9) / 9, "same")
    heard = np.interp(rows["time"], np.arange(len(level)) * STEP, level)
    lags = [np.corrcoef(np.roll(heard, lag), rows["jawOpen"])[0, 1] for lag in (-1, 0, 1)]
    return round(float(max(lags)), 3)


def main() -> None:
    """Measure and print."""
    takes = sorted(FOLDER.glob("1114_2_*.csv"))
    result: dict[str, object] = {"ours": told(ours())}
    if takes:
        result["animators"] = told([m for path in takes for m in animators(path)])
        result["loudness_and_jaw"] = loudness_and_jaw(FOLDER / "1114_3_15.csv")
    say("mandarin", **result)


if __name__ == "__main__":
    main()
