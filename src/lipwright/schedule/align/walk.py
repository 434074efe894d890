"""Long sounds, piece by piece: cut at pauses, as much text as fits, and on from there.

Memory and time per second of sound stay the same however long it is. Each piece gets
more text than it can hold and the decoder finds how much of it is there; the next piece
starts from the last pause that both sides of are sure. Where a piece fits badly, words
may be missing from the sound, or from the text: then it may start at a later word, or
stay without words.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from lipwright.phones import SILENCE
from lipwright.schedule.align.confidence import DOUBTFUL, line_confidence, mean_margin
from lipwright.schedule.align.features import RATE
from lipwright.schedule.align.heard import NO_TOKEN, Heard
from lipwright.schedule.align.lexicon import Spoken
from lipwright.schedule.align.model import AcousticModel
from lipwright.schedule.align.network import shortest
from lipwright.schedule.align.piece import align_piece
from lipwright.schedule.align.prepare import LONGEST, cut
from lipwright.schedule.align.refine import STAGES, Stage, refine

Progress = Callable[[float], None]

_FASTEST = 20.0  # phones a second that nobody exceeds for long
_PAUSE = 0.15  # s of a pause that a piece may be resumed in
_GAIN = 1.0  # nats per frame by which leaving words out must fit better
_HOPELESS = 0.05  # a piece surer than this has words of the text in it
_WORDLESS = -10.0  # the margin of a piece that no words fit


@dataclass(frozen=True, slots=True)
class Walked:
    """The phones of a sound, refined, without gaps; and whether they came by force."""

    phones: tuple[Heard, ...]
    forced: bool = False


def walk(
    model: AcousticModel,
    samples: NDArray[np.float32],
    tokens: Sequence[Spoken],
    progress: Progress | None = None,
    stages: Sequence[Stage] = STAGES,
) -> Walked:
    """Align a sound of any length.

    Parameters
    ----------
    samples : (N,) float32
        At 16 kHz.
    tokens : sequence of Spoken
    progress : function, optional
        Called with 0..1 as the sound is gone through.
    stages : sequence of Stage
        What corrects the boundaries.

    Returns
    -------
    Walked
        Its phones are empty if the sound is too short for the words.
    """
    tell = progress or (lambda _: None)
    if len(samples) <= LONGEST * RATE:
        heard = align_piece(model, samples, tokens)
        tell(1.0)
        return Walked(refine(heard, samples, stages) if heard else ())
    found = _follow(model, samples, tokens, tell, stages)
    placed = {phone.token for phone in found if phone.token != NO_TOKEN}
    if len(placed) >= 0.5 * len(tokens):
        return Walked(found)
    return Walked(_proportional(model, samples, tokens, tell, stages), forced=True)


def _follow(
    model: AcousticModel,
    samples: NDArray[np.float32],
    tokens: Sequence[Spoken],
    tell: Progress,
    stages: Sequence[Stage],
) -> tuple[Heard, ...]:
    result: list[Heard] = []
    at, word = 0, 0
    while at < len(samples):
        final = len(samples) - at <= LONGEST * RATE
        piece = samples[at:] if final else samples[at : cut(samples, at)]
        window = _window(tokens, word, len(piece) / RATE)
        heard = _fitting(model, piece, window, final=final and len(window) == len(tokens) - word)
        keep, resume = (heard, len(piece)) if final else _sure(heard, len(piece))
        keep = refine(keep, piece[:resume], stages) if keep else ()
        result += _moved(keep, at / RATE, word)
        said = [phone.token for phone in keep if phone.token != NO_TOKEN]
        word += max(said) + 1 if said else 0
        at += resume
        tell(at / len(samples))
    return tuple(result)


def _fitting(
    model: AcousticModel, piece: NDArray[np.float32], window: Sequence[Spoken], *, final: bool
) -> tuple[Heard, ...]:
    """Align a piece; if it fits badly, try leaving out words at its start, then all."""
    if not window:
        return _wordless(piece)
    heard = align_piece(model, piece, window, whole=final)
    if not heard:
        heard = align_piece(model, piece, window, whole=False)
    if line_confidence(heard) >= DOUBTFUL:
        return heard
    later = align_piece(model, piece, window, whole=False, entries=len(window))
    if mean_margin(later) > mean_margin(heard) + _GAIN:
        heard = later
    return heard if line_confidence(heard) > _HOPELESS else _wordless(piece)


def _window(tokens: Sequence[Spoken], word: int, duration: float) -> Sequence[Spoken]:
    """Return the tokens from ``word`` on that may be said in ``duration`` seconds."""
    phones = 0
    for index in range(word, len(tokens)):
        phones += shortest(tokens[index : index + 1])
        if phones > _FASTEST * duration:
            return tokens[word:index]
    return tokens[word:]


def _sure(heard: tuple[Heard, ...], samples: int) -> tuple[tuple[Heard, ...], int]:
    """Return the phones up to where the next piece resumes, and that sample."""
    said = [index for index, phone in enumerate(heard) if not phone.is_pause]
    if not said:
        return heard, samples
    half = 0.4 * samples / RATE
    for index in range(said[-1], 0, -1):
        phone = heard[index]
        long_enough = phone.is_pause and phone.end - phone.start >= _PAUSE
        if long_enough and phone.start > half:
            middle = int(0.5 * (phone.start + phone.end) * RATE)
            return (*heard[:index], replace(phone, end=middle / RATE)), middle
    tokens = [heard[index].token for index in said]
    third_last = sorted(set(tokens))[-3:][0]
    index = said[tokens.index(third_last)]
    if index == 0 or heard[index].start < half:
        return heard, samples
    resume = int(heard[index].start * RATE)
    return (*heard[: index - 1], replace(heard[index - 1], end=resume / RATE)), resume


def _proportional(
    model: AcousticModel,
    samples: NDArray[np.float32],
    tokens: Sequence[Spoken],
    tell: Progress,
    stages: Sequence[Stage],
) -> tuple[Heard, ...]:
    """Give every piece its share of the text: when the words do not fit the sound."""
    result: list[Heard] = []
    at, word = 0, 0
    while at < len(samples):
        final = len(samples) - at <= LONGEST * RATE
        stop = len(samples) if final else cut(samples, at)
        upto = round(len(tokens) * stop / len(samples))
        piece, share = samples[at:stop], tokens[word:upto]
        heard = align_piece(model, piece, share) if share else ()
        heard = heard or _wordless(piece)
        result += _moved(refine(heard, piece, stages), at / RATE, word)
        at, word = stop, upto
        tell(at / len(samples))
    return tuple(result)


def _wordless(piece: NDArray[np.float32]) -> tuple[Heard, ...]:
    return (Heard(SILENCE, 0.0, len(piece) / RATE, NO_TOKEN, _WORDLESS),)


def _moved(phones: Sequence[Heard], seconds: float, tokens: int) -> list[Heard]:
    return [
        replace(
            phone,
            start=phone.start + seconds,
            end=phone.end + seconds,
            token=phone.token if phone.token == NO_TOKEN else phone.token + tokens,
        )
        for phone in phones
    ]
