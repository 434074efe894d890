"""Alignment in other languages than English, held against the synthesiser's own times.

espeak-ng speaks the sentences of ``aligning_languages.txt`` with three voices, speeds and
pitches, white noise is put 20 dB below each, and each is aligned with its text; then with
the text of another sentence, which the confidence should tell. The text is read by the
same synthesiser that spoke, so that the pronunciation is always right, and its voices
are nothing like as varied as people: these figures are the best that can be hoped for
from recordings, not what to expect. What recordings cost is measured in English alone:
those beside the project with times by hand, read by the synthesiser as if English were
any language, without the dictionary.
"""

import contextlib
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from bench.aligning import sentences as recordings
from bench.measure import say
from bench.recordings import DATA, is_damaged, matched, starts
from bench.robustness import noisy
from lipwright import pipeline
from lipwright.errors import LipwrightError
from lipwright.phones import PhoneTrack, load_reduction
from lipwright.schedule.align import align_words
from lipwright.schedule.languages import Reading, read_text
from lipwright.schedule.say import say as speak
from lipwright.sound import Sound
from lipwright.sound_files import read_sound
from lipwright.speech import Speech
from lipwright.timeline import Interval, Tier

SENTENCES = Path(__file__).with_suffix(".txt")
# Variant, words a minute, pitch. Variants with breath differ from run to run.
VOICES = (("", 175.0, None), ("+f4", 160.0, 60.0), ("+m3", 195.0, 40.0))
DOUBTFUL = 0.5
_below_by_20_decibels = noisy(20.0)


@dataclass(slots=True)
class Figures:
    """What was found in one language."""

    off: list[float] = field(default_factory=list)
    phones: int = 0
    failed: int = 0
    cpu: float = 0.0
    seconds: float = 0.0
    right: list[Speech] = field(default_factory=list)
    wrong: list[Speech] = field(default_factory=list)


def sentences() -> dict[str, list[str]]:
    """The sentences of each language."""
    found: dict[str, list[str]] = {}
    for line in SENTENCES.read_text("utf-8").splitlines():
        if not line.startswith("#"):
            language, text = line.split("\t")
            found.setdefault(language, []).append(text)
    return found


def separation(right: Sequence[float], wrong: Sequence[float]) -> float:
    """How often something right is surer than something wrong: the area under the ROC."""
    one, other = np.array(right)[:, None], np.array(wrong)[None, :]
    return round(float(np.mean(one > other) + 0.5 * np.mean(one == other)), 3)


def take(figures: Figures, read: Reading, text: str, other: Reading, voice: int) -> None:
    """Speak a sentence, align it with its text and with another, and count."""
    variant, rate, pitch = VOICES[voice]
    spoken = speak(text, voice=read.language + variant, rate=rate, pitch=pitch)
    assert spoken.sound is not None
    samples = _below_by_20_decibels(spoken.sound.samples, spoken.sound.rate)
    sound = Sound(samples, spoken.sound.rate)
    figures.phones += len(starts(spoken.phones))
    before = time.process_time()
    try:
        ours = align_words(
            sound, read.words, text=text, language=read.language, phone_set=read.phone_set
        )
    except LipwrightError:
        figures.failed += 1
        return
    figures.cpu += time.process_time() - before
    figures.seconds += sound.duration
    figures.off += matched(starts(ours.phones), starts(spoken.phones))
    figures.right.append(ours)
    with contextlib.suppress(LipwrightError):  # it may not fit at all, and that is said
        figures.wrong.append(
            align_words(
                sound, other.words, text="", language=read.language, phone_set=read.phone_set
            )
        )


def measure(language: str, texts: Sequence[str]) -> None:
    """Print the line of one language."""
    figures = Figures()
    read = [read_text(text, language) for text in texts]
    for index, text in enumerate(texts):
        for voice in range(len(VOICES)):
            other = read[(index + 1 + voice) % len(texts)]
            take(figures, read[index], text, other, voice)
    apart = np.abs(figures.off)
    lines = [[s.confidence or 0.0 for s in some] for some in (figures.right, figures.wrong)]
    words = [
        [word.confidence or 0.0 for s in some for word in s.words]
        for some in (figures.right, figures.wrong)
    ]
    say(
        f"align language {language}",
        recordings=len(figures.right) + figures.failed,
        failed=figures.failed,
        phones=figures.phones,
        matched=round(len(apart) / figures.phones, 3),
        median_ms=round(1e3 * float(np.median(apart)), 1),
        within_20_ms=round(float(np.mean(apart <= 0.020)), 3),
        within_50_ms=round(float(np.mean(apart <= 0.050)), 3),
        right_lines_doubted=round(float(np.mean(np.array(lines[0]) < DOUBTFUL)), 3),
        wrong_lines_doubted=round(float(np.mean(np.array(lines[1]) < DOUBTFUL)), 3),
        line_auc=separation(*lines),
        word_auc=separation(*words),
        cpu_per_second_of_sound=round(figures.cpu / figures.seconds, 4),
    )


def measure_recordings() -> None:
    """Print how near to a hand's times English comes that is read as any language is."""
    reduction = load_reduction("ipa", "arpabet")
    off: list[float] = []
    phones, count = 0, 0
    for path, text in recordings("timit"):
        sound = read_sound(path)
        if is_damaged(sound.samples):
            continue
        read = read_text(text, "en-us")
        ours = align_words(sound, read.words, text=text, language=read.language)
        rows, _ = reduction.rows(ours.phones)
        tier = Tier(tuple(Interval(label, start, end) for label, start, end in rows))
        hand = starts(pipeline.from_labels(path.with_suffix(".phn")).phones)
        off += matched(starts(PhoneTrack(tier)), hand)
        phones, count = phones + len(hand), count + 1
    apart = np.abs(off)
    say(
        "align TIMIT read as any language",
        recordings=count,
        matched=round(len(apart) / phones, 3),
        median_ms=round(1e3 * float(np.median(apart)), 1),
        within_20_ms=round(float(np.mean(apart <= 0.020)), 3),
        within_50_ms=round(float(np.mean(apart <= 0.050)), 3),
    )


if __name__ == "__main__":
    for name, lines in sentences().items():
        measure(name, lines)
    if (DATA / "timit").is_dir():
        measure_recordings()
