"""What a net is shown while it learns: stretches of lines, changed anew each time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.neural import mel
from tools.neural_model.hearing import Heard, bands_of
from tools.neural_model.shape import Shape

BATCH, SECONDS = 32, 5.0
RAISED, TILTED, DEEPENED = 0.1, 0.1, 0.15
"""How far recordings lie apart, standard deviations: all bands and either end of the scale, as
shares of the depth; and how deep all that lies below the loudest is, 15 %."""
_SCALE = np.log(10.0) / 10.0 * mel.DEPTH
_SILENT = 1e-3
"""Of the power at the floor."""
_ALONG = np.linspace(-1, 1, mel.BANDS, dtype=np.float32)


@dataclass(frozen=True, slots=True, eq=False)
class Lessons:
    """All that is heard and seen, in one row.

    Parameters
    ----------
    bands : (T, 40) float16
        As the net hears them.
    poses : (T, P) float16
    classes : (T,) int8
    """

    bands: NDArray[np.float16]
    poses: NDArray[np.float16]
    classes: NDArray[np.int8]


def lessons_of(heard: Sequence[Heard], shape: Shape, rng: np.random.Generator) -> Lessons:
    """Return what a net of a shape hears of lines."""
    return Lessons(
        np.concatenate([bands_of(one, shape, rng) for one in heard]),
        np.concatenate([one.poses for one in heard]),
        np.concatenate([one.classes for one in heard]),
    )


def stretches(
    lessons: Lessons, shape: Shape, apart: float, rng: np.random.Generator
) -> Iterator[tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.int64]]]:
    """Return, without end, stretches of some seconds: bands, poses, classes, 32 at a time.

    Bands before each stretch make up what the first frame stacks. All are moved along the
    scale and lie as other recordings', some are hidden or raised, so that no band alone decides.
    """
    frames = int(SECONDS * 50)
    span = 2 * (frames + shape.ahead) + 2
    while True:
        starts = 2 * rng.integers(2, (len(lessons.bands) - span) // 2, BATCH)
        bands = np.stack([lessons.bands[s - 4 : s - 4 + span] for s in starts]).astype(np.float32)
        poses = np.stack([lessons.poses[s : s + 2 * frames : 2] for s in starts])
        classes = np.stack([lessons.classes[s : s + 2 * frames : 2] for s in starts])
        bands = recorded(shifted(bands, apart, rng), rng)
        bands += rng.normal(0, 0.03, (BATCH, 1, 1)) + rng.normal(0, 0.04, (BATCH, 1, mel.BANDS))
        for row in np.flatnonzero(rng.random(BATCH) < 0.5):
            first, wide = int(rng.integers(mel.BANDS - 6)), int(rng.integers(1, 7))
            bands[row, :, first : first + wide] = 0.0
        yield bands, poses.astype(np.float32), classes.astype(np.int64)


def shifted(
    bands: NDArray[np.float32], apart: float, rng: np.random.Generator
) -> NDArray[np.float32]:
    """Return bands as longer and shorter throats would have them: moved along the scale."""
    places = np.arange(mel.BANDS)
    found = np.empty_like(bands)
    for row, one in enumerate(bands):
        longer = rng.uniform(1 - 0.06 * apart, 1 + 0.06 * apart)
        at = np.clip(places * longer + rng.uniform(-apart, apart), 0, mel.BANDS - 1)
        low = np.minimum(at.astype(np.intp), mel.BANDS - 2)
        share = (at - low).astype(np.float32)
        found[row] = one[:, low] * (1 - share) + one[:, low + 1] * share
    return found


def recorded(bands: NDArray[np.float32], rng: np.random.Generator) -> NDArray[np.float32]:
    """Return bands as other people and microphones would have them.

    Synthesisers are bright, and their soft sounds nearly as loud as their loud ones. Of people
    all that is softer lies lower, and the upper bands lowest: in this each stretch differs.
    What is silent stays near the floor.

    Parameters
    ----------
    bands : (B, T, 40) float32
        As :func:`lipwright.engines.neural.mel.told` tells them.
    rng : Generator
    """

    def spread(by: float) -> NDArray[np.float32]:
        return rng.normal(0, by, (len(bands), 1, 1)).astype(np.float32)

    scale = np.float32(_SCALE)
    level = np.log(np.maximum(np.expm1(scale * np.maximum(bands, 0)), _SILENT)) / scale
    level = 1 - (1 - level) * np.exp(spread(DEEPENED)) + spread(RAISED) + spread(TILTED) * _ALONG
    return (np.logaddexp(np.float32(0), scale * level) / scale).astype(np.float32)
