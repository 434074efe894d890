"""Where between two phones the sound changes from one to the other.

A small network says of each instant near a boundary how well it divides these two
phones: after the boundary models of Stolcke et al., "Highly accurate phonetic
segmentation using boundary correction models and system fusion" (ICASSP 2014). It was
learnt on synthesised speech alone, whose times are exact, made worse by rooms, noise and
equalisers; ``python -m tools.boundaries`` makes its data file anew.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from io import BytesIO
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lipwright.files import read_bytes
from lipwright.schedule.align.bands import STEP, bands, contexts
from lipwright.schedule.align.features import RATE

DATA = Path(__file__).parents[2] / "data" / "boundaries" / "english.npz"
REACH = 10  # frames to either side that a boundary may move
FRAME = STEP / RATE
# How far the decoder errs, and how much the network is believed: set on recordings.
_SPREAD = 0.03  # s
_TRUST = 0.7


@dataclass(frozen=True, slots=True, eq=False)
class BoundaryNetwork:
    """Two hidden layers: the sound around an instant, and the two phones, to a score.

    Parameters
    ----------
    phones : tuple of str
        Labels it knows.
    sound : (252, H) float32
        From the sound's context to the first layer.
    left, right : (P, H) float32
        What the phones before and after add to it.
    offset : (H,) float32
    second : (H, K) float32
    second_offset : (K,) float32
    score : (K,) float32
    """

    phones: tuple[str, ...]
    sound: NDArray[np.float32]
    left: NDArray[np.float32]
    right: NDArray[np.float32]
    offset: NDArray[np.float32]
    second: NDArray[np.float32]
    second_offset: NDArray[np.float32]
    score: NDArray[np.float32]

    def scores(
        self, hidden: NDArray[np.float32], left: NDArray[np.int64], right: NDArray[np.int64]
    ) -> NDArray[np.float32]:
        """Return the logarithm, but for a constant, of how likely boundaries lie there.

        Parameters
        ----------
        hidden : (B, C, H) float32
            ``contexts @ sound`` at C instants for each of B boundaries.
        left, right : (B,) int
            The phones before and after.

        Returns
        -------
        (B, C) float32
        """
        phones = (self.left[left] + self.right[right] + self.offset)[:, None, :]
        first = np.maximum(hidden + phones, 0)
        second = np.maximum(first @ self.second + self.second_offset, 0)
        return np.asarray(second @ self.score)


def as_bytes(network: BoundaryNetwork) -> bytes:
    """Return a network as a NumPy archive, in half precision."""
    arrays = {
        name: getattr(network, name).astype(np.float16)
        for name in ("sound", "left", "right", "offset", "second", "second_offset", "score")
    }
    file = BytesIO()
    np.savez_compressed(file, phones=np.array(network.phones), **arrays)
    return file.getvalue()


@cache
def load_network() -> BoundaryNetwork:
    """Return the network that comes with the project."""
    with np.load(BytesIO(read_bytes(DATA))) as archive:
        arrays = {name: archive[name] for name in archive.files}
    phones = tuple(map(str, arrays.pop("phones")))
    return BoundaryNetwork(phones, **{k: v.astype(np.float32) for k, v in arrays.items()})


def located(
    labels: list[str], edges: NDArray[np.float64], samples: NDArray[np.float32]
) -> NDArray[np.float64]:
    """Return where boundaries are expected, given about where they are.

    Parameters
    ----------
    labels : list of str
        P phones, ``sil`` included.
    edges : (P - 1,) float64
        Boundaries between them, seconds.
    samples : (N,) float32
        At 16 kHz.

    Returns
    -------
    (P - 1,) float64
        Seconds; none further than 55 ms away.
    """
    network = load_network()
    if not len(edges) or len(samples) < STEP:
        return edges
    hidden = contexts(bands(samples)) @ network.sound
    phones = np.array([network.phones.index(label) for label in labels])
    middles = np.rint(edges / FRAME).astype(np.int64)
    instants = middles[:, None] + np.arange(-REACH, REACH + 1)
    near = hidden[np.clip(instants, 0, len(hidden) - 1)]
    times = instants * FRAME
    likely = _TRUST * network.scores(near, phones[:-1], phones[1:])
    likely = likely - 0.5 * ((times - edges[:, None]) / _SPREAD) ** 2
    weights = np.exp(likely - likely.max(axis=1, keepdims=True))
    return np.asarray((weights * times).sum(axis=1) / weights.sum(axis=1))
