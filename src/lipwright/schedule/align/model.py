"""The acoustic model that pocketsphinx brings: its numbers, read from its files.

A phonetically tied mixture model of American English (CMU Sphinx, BSD): each base phone
owns a codebook of Gaussians per feature stream, each tied state (senone) weighs them.
Formats: Sphinx-3 parameter files, and the binary model definition with its triphone tree.
Nothing here computes with them; :mod:`.scores` does.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lipwright.errors import FileFormatError

STATES = 3
WORD_POSITIONS = {"internal": 0, "begin": 1, "end": 2, "single": 3}
_BYTE_ORDER = 0x11223344
_NEPER_PER_STEP = 1024 * np.log(1.0001)  # mixture weights are bytes of -log_1.0001 >> 10


@dataclass(frozen=True, slots=True)
class AcousticModel:
    """Gaussians, mixture weights, transitions and triphones.

    Parameters
    ----------
    phones : tuple of str
        Base phones, lower case; their index is used everywhere.
    means, precisions : (P, F, G, D) float32
        Of P base phones, F feature streams, G Gaussians, D dimensions; 1 / variance.
    offsets : (P, F, G) float32
        Log normalisation of each Gaussian.
    weights : (F, G, S) float32
        Mixture weights of the S senones, not as logarithms.
    owner : (S,) int
        Base phone whose Gaussians a senone weighs.
    stay, leave : (P, 3) float32
        Log probabilities of staying in a state for a frame of 10 ms, and of leaving it.
    """

    phones: tuple[str, ...]
    means: NDArray[np.float32]
    precisions: NDArray[np.float32]
    offsets: NDArray[np.float32]
    weights: NDArray[np.float32]
    owner: NDArray[np.int64]
    stay: NDArray[np.float32]
    leave: NDArray[np.float32]
    triphones: Triphones = field(repr=False)

    def index(self, phone: str) -> int:
        """Return the index of a base phone."""
        return self.phones.index(phone)


@dataclass(frozen=True, slots=True)
class Triphones:
    """Which senones a phone between two others has.

    Parameters
    ----------
    tree : (N, 3) int
        Nodes: key, number of children, first child or phone (binary model definition).
    senones : (Q, 3) int
        The senones of every known phone: base phones first, then phones in context.
    fillers : frozenset of int
        Base phones that are no speech; as neighbours they count as silence.
    silence : int
        The base phone ``sil``.
    """

    tree: NDArray[np.int64]
    senones: NDArray[np.int64]
    fillers: frozenset[int]
    silence: int
    _known: dict[tuple[int, int, int, int], tuple[int, ...]] = field(default_factory=dict)

    def of(self, phone: int, left: int, right: int, position: str) -> tuple[int, ...]:
        """Return the senones of ``phone`` between two others at a place in its word.

        What the model has not seen falls back as in pocketsphinx: other places in the
        word, then silence beyond the word's edge, then the phone without context.
        """
        key = (phone, left, right, WORD_POSITIONS[position])
        if key not in self._known:
            self._known[key] = tuple(int(s) for s in self.senones[self._nearest(*key)])
        return self._known[key]

    def _nearest(self, phone: int, left: int, right: int, position: int) -> int:
        places = [position, *(p for p in range(4) if p != position)]
        left = self.silence if left in self.fillers else left
        right = self.silence if right in self.fillers else right
        begins = position in (WORD_POSITIONS["begin"], WORD_POSITIONS["single"])
        ends = position in (WORD_POSITIONS["end"], WORD_POSITIONS["single"])
        open_left = self.silence if begins else left
        open_right = self.silence if ends else right
        for neighbours in ((left, right), (open_left, open_right)):
            for place in places:
                found = self._find((place, phone, *neighbours))
                if found >= 0:
                    return found
        return phone

    def _find(self, path: tuple[int, int, int, int]) -> int:
        first, count = 0, len(WORD_POSITIONS)
        for key in path:
            keys = self.tree[first : first + count, 0]
            hits = np.flatnonzero(keys == key)
            if not len(hits):
                return -1
            _, count, below = self.tree[first + int(hits[0])]
            if count == 0:
                return int(below)
            first = int(below)
        return -1


@cache
def load_model() -> AcousticModel:
    """Read the model of the installed pocketsphinx, once per process.

    Raises
    ------
    FileFormatError
        If a file is not in the format that pocketsphinx 5 ships.
    """
    folder = model_folder() / "en-us" / "en-us"
    means = _parameters(folder / "means")
    variances = np.maximum(_parameters(folder / "variances"), 1e-4)
    names, tree, phone_table, senones = _definition(folder / "mdef")
    transitions = _parameters(folder / "transition_matrices")
    transitions = transitions / transitions.sum(axis=-1, keepdims=True)
    fillers = frozenset(i for i, row in enumerate(phone_table[: len(names)]) if row[2] & 0xFF)
    triphones = Triphones(tree, senones[phone_table[:, 0]], fillers, names.index("sil"))
    table = _base_of(phone_table, len(names))
    owner = np.zeros(int(senones.max()) + 1, np.int64)
    owner[triphones.senones.ravel()] = np.repeat(table, STATES)
    rows = np.arange(STATES)
    with np.errstate(divide="ignore"):
        stay = np.log(transitions[:, rows, rows])
        leave = np.log(transitions[:, rows, rows + 1])
    return AcousticModel(
        names,
        means.astype(np.float32),
        (1 / variances).astype(np.float32),
        (-0.5 * np.log(2 * np.pi * variances).sum(axis=-1)).astype(np.float32),
        _weights(folder / "sendump", len(owner)),
        owner,
        stay.astype(np.float32),
        leave.astype(np.float32),
        triphones,
    )


def model_folder() -> Path:
    """Return the folder of the models inside the installed pocketsphinx."""
    import pocketsphinx

    return Path(pocketsphinx.get_model_path())


def _base_of(phone_table: NDArray[np.int64], bases: int) -> NDArray[np.int64]:
    in_context = (phone_table[:, 2] >> 8) & 0xFF
    return np.where(np.arange(len(phone_table)) < bases, np.arange(len(phone_table)), in_context)


def _parameters(path: Path) -> NDArray[np.float64]:
    """Read a Sphinx-3 parameter file: means and variances, or transition matrices."""
    data = path.read_bytes()
    at = data.index(b"endhdr\n") + 7
    header = np.frombuffer(data, "<i4", 4, at)
    if header[0] != _BYTE_ORDER:
        raise FileFormatError("another byte order", where=str(path), expected="little endian")
    if path.name == "transition_matrices":
        shape: tuple[int, ...] = tuple(int(n) for n in header[1:4])
        at += 20
    else:
        streams = int(header[2])
        shape = (
            int(header[1]),
            streams,
            int(header[3]),
            int(np.frombuffer(data, "<i4", 1, at + 16)[0]),
        )
        at += 16 + 4 * streams + 4
    count = int(np.prod(shape))
    return np.frombuffer(data, "<f4", count, at).astype(np.float64).reshape(shape)


def _weights(path: Path, senones: int) -> NDArray[np.float32]:
    data = path.read_bytes()
    at = 0
    while length := int(np.frombuffer(data, "<i4", 1, at)[0]):
        at += 4 + length
    gaussians, columns = (int(n) for n in np.frombuffer(data, "<i4", 2, at + 4))
    at += 12
    streams = (len(data) - at) // (gaussians * columns)
    if columns != senones or streams * gaussians * columns != len(data) - at:
        raise FileFormatError(
            f"{columns} states in {len(data)} bytes", where=str(path), expected=f"{senones} states"
        )
    steps = np.frombuffer(data, np.uint8, streams * gaussians * columns, at)
    lookup = np.exp(-_NEPER_PER_STEP * np.arange(256)).astype(np.float32)
    return np.asarray(lookup[steps].reshape(streams, gaussians, columns), np.float32)


def _definition(
    path: Path,
) -> tuple[tuple[str, ...], NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Read the binary model definition: names, tree, phones (senones, transition, kind)."""
    data = path.read_bytes()
    if data[:4] != b"BMDF":
        raise FileFormatError("no model definition", where=str(path), expected="BMDF")
    at = 12 + int(np.frombuffer(data, "<i4", 1, 8)[0])
    head = [int(n) for n in np.frombuffer(data, "<i4", 10, at)]
    bases, phones, states, sequences, nodes = head[0], head[1], head[2], head[6], head[8]
    if states != STATES:
        raise FileFormatError(f"{states} states a phone", where=str(path), expected=f"{STATES}")
    at += 40
    start = at
    names: list[str] = []
    for _ in range(bases):
        end = data.index(b"\0", at)
        names.append(data[at:end].decode("ascii").lower())
        at = end + 1
    at = start + (at - start + 3) // 4 * 4
    tree = np.frombuffer(data, [("key", "<i2"), ("down", "<i2"), ("to", "<i4")], nodes, at)
    at += 8 * nodes
    table = np.frombuffer(data, "<i4", 3 * phones, at).reshape(phones, 3).astype(np.int64)
    at += 12 * phones + 4
    senones = np.frombuffer(data, "<u2", sequences * states, at).reshape(sequences, states)
    columns = np.stack([tree["key"], tree["down"], tree["to"]], axis=1).astype(np.int64)
    return tuple(names), columns, table, senones.astype(np.int64)
