"""Silences: how a recorded rest answers a wanted one that is longer or shorter.

Stretched like a phone, a rest of a fifth of a second would open the mouth half a second
before a line. What counts is the pace next to speech.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.recorded import Floats, Ints, Recorded
from lipwright.engines.motion.splicing import REACH

CREEP = 0.1
"""Share of a recorded silence that goes on evenly while the rest of it is held."""


def rest(
    data: Recorded,
    units: Ints,
    time: Floats,
    length: Floats,
    leads: NDArray[np.bool_],
    ends: NDArray[np.bool_],
) -> Floats:
    """Return the position in a recorded silence at each instant of a wanted one.

    A face opens and closes next to speech at the pace at which it was recorded, however
    long it is silent: a silence that is longer all but holds its middle; one at the start of
    a take the face before it, one at the end the face after it. Of a long recorded rest as
    much is taken as a wanted short one needs. A pause that leads a line, or ends it, has only
    its half next to speech.

    Parameters
    ----------
    data : Recorded
    units : (N,) int64
        The recorded silences.
    time, length : (N,) float64
        Seconds from the start of the wanted silence, and how long that is.
    leads, ends : (N,) bool
        Whether nothing is said before it, or after it.

    Returns
    -------
    (N,) float64
        In frames of the database: frame k shows position k + 0.5.
    """
    begin, end = np.asarray(data.spans[units], np.float64).T
    opens, closes = _at_edges(data, units)
    middle = 0.5 * (begin + end)
    begin, end = np.where(leads & ~opens, middle, begin), np.where(ends & ~closes, middle, end)
    opens, closes = leads | (opens & ~ends), ends | (closes & ~leads)
    recorded = (end - begin) / data.rate
    # The least that is taken: of a rest at either end of a take, what lies next to speech.
    least = np.where(opens | closes, np.minimum(recorded, REACH), recorded)
    pace = np.maximum(np.clip(length, least, recorded) / length, 1.0)
    before, behind = pace * time, pace * (length - time)
    held = np.where(opens, 0.0, np.where(closes, recorded, 0.5 * recorded))
    paced = np.minimum(before, held) + recorded - held - np.minimum(behind, recorded - held)
    # A face that stands quite still looks dead.
    share = (1 - CREEP) * paced / recorded + CREEP * time / length
    result: Floats = begin + share * (end - begin)
    return result


def _at_edges(data: Recorded, units: Ints) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Whether units are the first, and the last, of their takes."""
    take, last = data.take, len(data.take) - 1
    first_ones = (units == 0) | (take[np.maximum(units - 1, 0)] != take[units])
    last_ones = (units == last) | (take[np.minimum(units + 1, last)] != take[units])
    return first_ones, last_ones
