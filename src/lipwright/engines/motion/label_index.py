"""Where a string of phones occurs in the database: a suffix array over unit labels.

Each unit begins a string: the labels from it to the end of its take. The array holds
the units in the alphabetical order of these strings, equal ones in order of units; the
units that begin with a given string lie together in it and are found by bisection, in
time logarithmic in the database. Beside it lies, in the same order, a packed number
with the first few labels of each string, so that most bisections compare one number.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

_BITS = 63


def packing(labels: int) -> tuple[int, int]:
    """Return how many bits a label takes and how many labels a packed number holds.

    Zero stands for the end of a take.
    """
    bits = max(int(labels).bit_length(), 1)
    return bits, _BITS // bits


def pack(label: NDArray[np.int16], take: NDArray[np.int32], labels: int) -> NDArray[np.int64]:
    """Return the first labels of each unit's string as a number: (U,) int64.

    Numbers compare as their strings do.
    """
    bits, length = packing(labels)
    key = np.zeros(len(label), np.int64)
    for depth in range(length):
        here = np.zeros(len(label), np.int64)
        with_next = len(label) - depth
        if with_next > 0:
            same = take[depth:] == take[:with_next]
            here[:with_next] = np.where(same, label[depth:].astype(np.int64) + 1, 0)
        key = (key << bits) | here
    return key


def suffix_array(
    label: NDArray[np.int16], take: NDArray[np.int32], labels: int
) -> NDArray[np.int32]:
    """Sort the units by the labels from each to the end of its take (prefix doubling).

    Parameters
    ----------
    label : (U,) int16
    take : (U,) int32
        Ascending; a string ends where it changes.
    labels : int
        How many labels there are.
    """
    count = len(label)
    units = np.arange(count)
    if not count:
        return units.astype(np.int32)
    ends = np.append(np.flatnonzero(np.diff(take)), count - 1)
    left = ends[np.searchsorted(ends, units)] + 1 - units  # labels to the end of the take
    rank = np.unique(pack(label, take, labels), return_inverse=True)[1].astype(np.int64)
    known = packing(labels)[1]
    longest = int(left.max())
    while known < longest:
        beyond = np.zeros(count, np.int64)
        further = left > known
        beyond[further] = rank[units[further] + known] + 1
        rank = np.unique(rank * (count + 1) + beyond, return_inverse=True)[1].astype(np.int64)
        known *= 2
    return np.argsort(rank, kind="stable").astype(np.int32)


class LabelIndex:
    """Finds strings of labels.

    Parameters
    ----------
    suffixes : (U,) int32
        From :func:`suffix_array`.
    keys : (U,) int64
        From :func:`pack`, in the order of ``suffixes``.
    label : (U,) int16
    take_unit : (N + 1,) int64
        First unit of each take, and the number of units.
    take : (U,) int32
    labels : int
    """

    def __init__(
        self,
        suffixes: NDArray[np.int32],
        keys: NDArray[np.int64],
        label: NDArray[np.int16],
        take: NDArray[np.int32],
        take_unit: NDArray[np.int64],
        labels: int,
    ) -> None:
        self._bits, self._length = packing(labels)
        self.suffixes = suffixes
        self._keys = memoryview(keys)  # type: ignore[arg-type]
        self._label, self._take, self._take_unit = label, take, take_unit
        self._most = int(np.diff(take_unit).max(initial=0))

    def longest(self, wanted: Sequence[int], start: int = 0) -> tuple[int, int, int]:
        """Return the longest string of the database that ``wanted[start:]`` begins with.

        Returns
        -------
        length : int
            0 where even the first label is unknown.
        low, high : int
            The units that begin with it: ``suffixes[low:high]``.
        """
        rest = wanted[start : start + self._length]
        key = self._packed(rest)
        at = bisect_left(self._keys, key)
        length = max(
            self._common(key, self._keys[near], len(rest))
            for near in (at - 1, at)
            if 0 <= near < len(self._keys)
        )
        if length == 0:
            return 0, 0, 0
        low, high = self._range(rest[:length], at)
        if length == self._length and start + length < len(wanted):
            return self._deeper(wanted[start + length : start + self._most], length, low, high)
        return length, low, high

    def occurrences(self, wanted: Sequence[int]) -> NDArray[np.int32]:
        """Return the units that begin with a whole string, in the order of the array."""
        low, high = self.places(wanted)
        return self.suffixes[low:high]

    def places(self, wanted: Sequence[int]) -> tuple[int, int]:
        """Return where in ``suffixes`` the units lie that begin with a whole string."""
        length, low, high = self.longest(wanted)
        return (low, high) if length == len(wanted) else (0, 0)

    def _packed(self, labels: Sequence[int]) -> int:
        key = 0
        for one in labels:
            key = key << self._bits | one + 1
        return key << self._bits * (self._length - len(labels))

    def _common(self, key: int, other: int, most: int) -> int:
        """How many labels two packed numbers share from the start."""
        differing = -(-(key ^ other).bit_length() // self._bits)
        return min(self._length - differing, most)

    def _range(self, labels: Sequence[int], near: int) -> tuple[int, int]:
        low = self._packed(labels)
        high = low + (1 << self._bits * (self._length - len(labels)))
        return (
            bisect_left(self._keys, low, 0, near),
            bisect_left(self._keys, high, near),
        )

    def _deeper(self, rest: Sequence[int], depth: int, low: int, high: int) -> tuple[int, int, int]:
        """Go on where the packed numbers end: the units low..high share ``depth`` labels."""

        def string(place: int, most: int) -> list[int]:
            unit = int(self.suffixes[place])
            end = int(self._take_unit[self._take[unit] + 1])
            found: list[int] = self._label[unit + depth : min(unit + depth + most, end)].tolist()
            return found

        goal = list(rest)
        places = range(low, high)
        at = low + bisect_left(places, goal, key=lambda place: string(place, len(goal)))
        length = 0
        for near in (at - 1, at):
            if low <= near < high:
                pairs = zip(goal, string(near, len(goal)), strict=False)
                matched = next((n for n, (a, b) in enumerate(pairs) if a != b), None)
                reached = len(string(near, len(goal))) if matched is None else matched
                length = max(length, reached)
        prefix = goal[:length]
        left = bisect_left(places, prefix, key=lambda place: string(place, length))
        right = bisect_right(places, prefix, key=lambda place: string(place, length))
        return depth + length, low + left, low + right
