"""Where the errors come from: speaker, manner, phones that were lacking, the animator."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from lipwright import pipeline
from lipwright.speech import Speech
from tools.neural_page.pieces import HEARING, Piece, drawn
from tools.neural_page.trials import Targets, Trial, five_of, trial

Floats = NDArray[np.float64]

LATE, GAIN = 0.04, 0.3
"""An animator who is not consistent: a sentence early or late, strong or weak, by so much."""
RUNNING = "1114_3_15"
AMOUNTS = (5.0, 10.0, 20.0, 60.0, 300.0, 1200.0)


def amounts(
    pieces: Sequence[Piece], draws: int, targets: Targets | None = None
) -> dict[float, list[Trial]]:
    """Return trials by the seconds that were taught, as far as there are so many.

    The unseen two minutes and the face's range, that of 20 s, are the same for all.
    """
    found: dict[float, list[Trial]] = {}
    total = sum(piece.seconds for piece in pieces)
    for seconds in AMOUNTS:
        if seconds + 130 > total:
            continue
        found[seconds] = []
        for number in range(draws):
            way = targets or five_of(drawn(pieces, number)[0])
            found[seconds].append(trial(*drawn(pieces, number, seconds), targets=way))
    return found


def voices(own: Sequence[Piece], other: Sequence[Piece], draws: int) -> list[Trial]:
    """Return trials on a speaker whose voice was not taught; each face has its own range."""
    found = []
    for number in range(draws):
        taught, _ = drawn(own, number)
        seen, unseen = drawn(other, number)
        found.append(trial(taught, unseen, wanted=five_of(seen)))
    return found


def manners(pieces: Sequence[Piece], draws: int) -> dict[str, list[Trial]]:
    """Return trials on running speech, taught by running speech or by single words."""
    running = [piece for piece in pieces if piece.name == RUNNING]
    words = [piece for piece in pieces if piece.name != RUNNING]
    found: dict[str, list[Trial]] = {"running speech": [], "single words": []}
    if not running or not words:
        return {}
    for number in range(draws):
        taught, unseen = drawn(running, number)
        other, _ = drawn(words, number)
        way = five_of(taught)
        found["running speech"].append(trial(taught, unseen, targets=way))
        found["single words"].append(trial(other, unseen, lesson=five_of(other), wanted=way))
    return found


class Spoken:
    """The phones of pieces that have a text; found once."""

    def __init__(self) -> None:
        self._known: dict[str, Speech] = {}

    def speech(self, piece: Piece) -> Speech:
        """Return a piece's speech."""
        if piece.name not in self._known:
            self._known[piece.name] = piece.speech()
        return self._known[piece.name]

    def phones(self, piece: Piece) -> list[str]:
        """Return the phone at each of a piece's frames."""
        track = self.speech(piece).phones.normalised()
        found = (track.tier.at(time) for time in piece.times)
        return [phone.label if phone else "sil" for phone in found]

    def drawn(self, piece: Piece) -> Floats:
        """Return the bigram engine's animation of a piece, as the five: wholly consistent."""
        made = pipeline.animate(self.speech(piece)).animation
        opening, rounding, spreading, closing = (
            np.interp(piece.times, made.times, made.control(name))
            for name in ("open", "W", "wide", "PBM")
        )
        vowel = opening * (1.0 - np.maximum(rounding, spreading))
        return np.stack([vowel, spreading, rounding, closing, opening], axis=1)


def lacking(pieces: Sequence[Piece], spoken: Spoken, draws: int) -> dict[str, tuple[float, float]]:
    """Return each phone's error where it was taught and where it was lacking, RMS.

    Only phones that some draws have and others lack are told.
    """
    had: dict[str, list[float]] = defaultdict(list)
    lacked: dict[str, list[float]] = defaultdict(list)
    for number in range(draws):
        taught, unseen = drawn(pieces, number)
        known = {label for piece in taught for label in spoken.phones(piece)}
        found = trial(taught, unseen)
        errors = np.square(found.given - found.wanted).mean(axis=1)
        labels = np.array([label for piece in unseen for label in spoken.phones(piece)])
        for label in np.unique(labels):
            side = had if label in known else lacked
            side[str(label)].append(float(errors[labels == label].mean()))
    return {
        label: (float(np.sqrt(np.mean(had[label]))), float(np.sqrt(np.mean(lacked[label]))))
        for label in sorted(lacked)
        if label in had
    }


def unsteady(taught: Sequence[Piece], number: int) -> Targets:
    """Return targets of an animator who is early or late, strong or weak, from piece to piece."""
    way, rng = five_of(taught), np.random.default_rng(number)
    moods = {
        (piece.name, float(piece.times[0])): (
            round(float(rng.choice([-LATE, 0.0, LATE])) / HEARING.frame),
            1.0 + float(rng.uniform(-GAIN, GAIN)),
        )
        for piece in taught
    }

    def targets(piece: Piece) -> Floats:
        late, gain = moods[piece.name, float(piece.times[0])]
        five = way(piece)
        places = np.clip(np.arange(len(five)) - late, 0, len(five) - 1)
        return np.asarray(np.clip(gain * five[places], 0.0, 1.0), np.float64)

    return targets


def animators(pieces: Sequence[Piece], spoken: Spoken, draws: int) -> dict[str, list[Trial]]:
    """Return trials with a face as the animator, a wholly consistent one, and one that is not."""
    found: dict[str, list[Trial]] = {"the face": [], "unsteady": [], "consistent": []}
    for number in range(draws):
        taught, unseen = drawn(pieces, number)
        way = five_of(taught)
        found["the face"].append(trial(taught, unseen, targets=way))
        lesson = unsteady(taught, number)
        found["unsteady"].append(trial(taught, unseen, lesson=lesson, wanted=way))
        found["consistent"].append(trial(taught, unseen, targets=spoken.drawn))
    return found
