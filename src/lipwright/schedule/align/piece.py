"""One piece of sound, up to about a minute, with its words: where each phone lies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lipwright.phones import SILENCE
from lipwright.schedule.align.confidence import margins
from lipwright.schedule.align.features import HOP, RATE, cepstra, with_changes
from lipwright.schedule.align.heard import Heard
from lipwright.schedule.align.lexicon import Spoken
from lipwright.schedule.align.model import AcousticModel
from lipwright.schedule.align.network import Network, build_network, columns
from lipwright.schedule.align.scores import senone_scores
from lipwright.schedule.align.viterbi import Stretch, best_path


def align_piece(
    model: AcousticModel,
    samples: NDArray[np.float32],
    tokens: Sequence[Spoken],
    *,
    whole: bool = True,
    entries: int = 1,
) -> tuple[Heard, ...]:
    """Return the phones of a piece, pauses included, without gaps.

    Parameters
    ----------
    samples : (N,) float32
        At 16 kHz.
    tokens : sequence of Spoken
    whole : bool
        Whether all tokens are in it; else as many as fit best from the first on.
    entries : int
        How many of the first tokens it may start with.

    Returns
    -------
    tuple of Heard
        Empty if the piece is too short for the words.
    """
    return through(model, build_network(model, tokens, entries=entries), samples, whole=whole)


def through(
    model: AcousticModel, network: Network, samples: NDArray[np.float32], *, whole: bool = True
) -> tuple[Heard, ...]:
    """Return the phones of the most likely path of a piece through any network.

    Parameters
    ----------
    samples : (N,) float32
        At 16 kHz.
    whole : bool
        Whether the path has to reach the network's end.

    Returns
    -------
    tuple of Heard
        Without gaps; empty if the piece is too short.
    """
    needed, places = columns(network)
    plain = model.triphones.senones[: len(model.phones)].reshape(-1)
    features = with_changes(cepstra(samples))
    scores = senone_scores(model, features, np.concatenate([needed, plain]))
    best = scores[:, len(needed) :].max(axis=1)
    path = best_path(model, network, scores, places, whole=whole)
    if not path:
        return ()
    found = margins(path, scores, places, best)
    return _merged(_timed(model, network, path, found, len(samples) / RATE))


def _timed(
    model: AcousticModel,
    network: Network,
    path: Sequence[Stretch],
    margins: Sequence[float],
    duration: float,
) -> list[Heard]:
    """Put boundaries half-way between the centres of two frames."""
    frame = HOP / RATE
    last = len(path) - 1
    result = []
    for index, (stretch, margin) in enumerate(zip(path, margins, strict=True)):
        node = network.nodes[stretch.node]
        start = (stretch.start - 0.5) * frame if index else 0.0
        end = (stretch.end - 0.5) * frame if index < last else duration
        label = SILENCE if node.phone in model.triphones.fillers else model.phones[node.phone]
        result.append(Heard(label, start, end, node.token, margin))
    return result


def _merged(phones: Sequence[Heard]) -> tuple[Heard, ...]:
    """Make one pause of silences and noises that follow each other."""
    result: list[Heard] = []
    for phone in phones:
        if result and phone.is_pause and result[-1].is_pause:
            result[-1] = _joined(result[-1], phone)
        else:
            result.append(phone)
    return tuple(result)


def _joined(pause: Heard, following: Heard) -> Heard:
    first, second = pause.end - pause.start, following.end - following.start
    margin = (first * pause.margin + second * following.margin) / (first + second)
    return replace(pause, end=following.end, margin=margin)
