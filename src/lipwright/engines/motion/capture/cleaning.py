"""Markers cleaned: swapped labels, spikes, head motion, gaps, rest face (DESIGN section 5).

In this order: the markers that do not deform are found and the head is held still; swapped
labels are put right and spikes taken out on the still head; the head's motion is found
anew from what is left and removed; gaps are filled; the rest face is subtracted. What
comes out are displacements in metres, in the axes of the reference face.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lipwright.engines.motion.capture.gaps import fill, find_gaps
from lipwright.engines.motion.capture.head import (
    FEWEST,
    Flags,
    HeadMotion,
    head_motion,
    spans,
    still_face,
)
from lipwright.engines.motion.capture.motion import Floats, Motion
from lipwright.engines.motion.capture.report import CleaningReport, RestFace
from lipwright.engines.motion.capture.rigid import rigid_markers
from lipwright.engines.motion.capture.spikes import find_spikes
from lipwright.engines.motion.capture.swaps import Swap, find_swaps
from lipwright.errors import InputError, did_you_mean
from lipwright.markers import marker_channels

LONGEST_GAP = 1.0
"""Seconds without a marker that are filled; one lost for longer is left out."""
MOST_LOST = 0.5
"""A marker lost in a greater share of the frames is left out."""
MOST_REFUSED = 0.25
"""A take of which a greater share of the markers is left out is refused."""
BLIND = 0.25
"""Seconds in which fewer than half of the markers may be seen."""
REST = 0.25
"""Seconds of the stillest stretch, which is taken for rest."""


def clean(
    markers: Motion,
    *,
    rest: RestFace | tuple[float, float] | None = None,
    rigid: Sequence[str] | None = None,
    longest_gap: float = LONGEST_GAP,
) -> tuple[Motion, CleaningReport]:
    """Clean the markers of a take.

    Parameters
    ----------
    markers : Motion
        As read: places in metres, NaN where a marker was not seen.
    rest : RestFace or (float, float), optional
        The actor's face at rest, from another take; or the seconds of this take in which
        it rests; without it the stillest quarter of a second is taken.
    rigid : sequence of str, optional
        The markers that do not deform; without it, and without a rest face, those whose
        distances vary least.
    longest_gap : float
        Seconds without a marker that are filled.

    Returns
    -------
    motion : Motion
        Displacements from rest in metres, free of NaN, of a head that does not move.
    report : CleaningReport
        Its ``rest`` is what was subtracted: give it for the actor's other takes.

    Raises
    ------
    InputError
        If more than a quarter of the markers are lost for too long, most are lost at once,
        none keep their distances, or names or seconds are not in the take.
    """
    where = markers.where
    points, labels = markers.points, markers.labels
    if isinstance(rest, RestFace):
        points, labels = _as_in(rest, points, labels, where)
    lost = ~np.isfinite(points[:, :, 0])
    kept, refused = _kept(lost, labels, longest_gap, markers.rate, where)
    _check_blind(lost[:, kept], markers.rate, markers.start, where)
    points, labels = points[:, kept], tuple(np.array(labels)[kept].tolist())
    named = rigid or (rest.rigid if isinstance(rest, RestFace) else None)
    group = _group(points, labels, named, where)
    face = rest.points[kept] if isinstance(rest, RestFace) else still_face(points, group)
    points, swaps, spikes = _repaired(points, labels, face, group, markers.rate)
    head = head_motion(points, face, group)
    filled, by_spline, from_others = fill(head.removed(points), markers.rate)
    if isinstance(rest, RestFace):
        resting = RestFace(labels, face, tuple(np.array(labels)[group].tolist()))
    else:
        span = _span(filled, markers, rest)
        still = filled[span].mean(axis=0)
        resting = RestFace(labels, still, tuple(np.array(labels)[group].tolist()))
    report = CleaningReport(
        where,
        len(points),
        len(labels),
        float(lost.mean()),
        max((g.last - g.first for g in find_gaps(lost[:, kept])), default=0) / markers.rate,
        by_spline,
        from_others,
        spikes,
        tuple(_said(swap, markers) for swap in swaps),
        resting,
        head.degrees(),
        1e3 * head.travel(face[group].mean(axis=0)),
        tuple(refused),
    )
    values = (filled - resting.points).reshape(len(filled), -1).astype(np.float32)
    motion = Motion(
        marker_channels(labels),
        values,
        markers.rate,
        markers.start,
        (*markers.notes, *report.notes()),
        "markers",
        where,
    )
    return motion, report


def _as_in(
    rest: RestFace, points: Floats, labels: tuple[str, ...], where: str
) -> tuple[Floats, tuple[str, ...]]:
    """Return a take's markers in the order of a rest face, those it lacks left out."""
    missing = [label for label in rest.labels if label not in labels]
    if missing:
        raise InputError(
            f"no marker {missing[0]!r}",
            where=where,
            expected=f"the {len(rest.labels)} markers of the rest face",
            cure=did_you_mean(missing[0], labels),
        )
    return points[:, [labels.index(label) for label in rest.labels]], rest.labels


def _kept(
    lost: Flags, labels: tuple[str, ...], longest: float, rate: float, where: str
) -> tuple[Flags, list[str]]:
    """Return the markers that are seen often enough, and why others are not kept."""
    gap = np.zeros(lost.shape[1])
    for one in find_gaps(lost):
        gap[one.marker] = max(gap[one.marker], (one.last - one.first) / rate)
    share = lost.mean(axis=0)
    kept = (gap <= longest) & (share <= MOST_LOST)
    refused = [
        f"{labels[m]} (lost for {gap[m]:.2f} s, {share[m]:.0%} of the frames)"
        for m in np.flatnonzero(~kept)
    ]
    if len(refused) > MOST_REFUSED * len(labels) or kept.sum() < FEWEST:
        raise InputError(
            f"{len(refused)} of {len(labels)} markers are lost for too long: {refused[0]}, …",
            where=where,
            expected=f"gaps of at most {longest:g} s",
            cure="fill them where they were recorded, or cut the take",
        )
    return kept, refused


def _check_blind(lost: Flags, rate: float, start: float, where: str) -> None:
    blind = (lost.mean(axis=1) > 0.5)[:, None]
    for gap in find_gaps(blind):
        if (gap.last - gap.first) / rate > BLIND:
            raise InputError(
                f"most markers are lost from {start + gap.first / rate:.2f} to "
                f"{start + gap.last / rate:.2f} s",
                where=where,
                expected=f"half of them seen, but for {BLIND:g} s",
                cure="cut the take there",
            )


def _group(
    points: Floats, labels: tuple[str, ...], named: Sequence[str] | None, where: str
) -> Flags:
    if named is None:
        group = rigid_markers(points)
        if not group.any():
            raise InputError(
                "no markers keep their distances from one another",
                where=where,
                expected=f"{FEWEST} or more on brow, nose or temples",
                cure="name those that do not deform",
            )
        return group
    for name in named:
        if name not in labels:
            raise InputError(
                f"no marker {name!r} to hold the head",
                where=where,
                expected="markers of this take",
                cure=did_you_mean(name, labels),
            )
    group = np.isin(labels, list(named))
    seen = points[int(np.argmax(np.isfinite(points[:, group, 0]).sum(axis=1)))]
    group &= np.isfinite(seen[:, 0])
    if group.sum() < 3 or not spans(seen, group):
        raise InputError(
            f"the markers {', '.join(named)} lie on a line or in one place",
            where=where,
            expected="three or more that lie apart",
        )
    return group


def _repaired(
    points: Floats, labels: tuple[str, ...], face: Floats, group: Flags, rate: float
) -> tuple[Floats, list[Swap], int]:
    """Return the places with labels put right and spikes out; the head still moves."""
    head: HeadMotion = head_motion(points, face, group)
    order, swaps = find_swaps(head.removed(points), labels)
    points = np.take_along_axis(points, order[:, :, None], axis=1)
    head = head_motion(points, face, group)
    spikes = find_spikes(head.removed(points), rate)
    points[spikes] = np.nan
    return points, swaps, int(spikes.sum())


def _span(points: Floats, markers: Motion, rest: tuple[float, float] | RestFace | None) -> slice:
    """Return the frames that show the face at rest."""
    if isinstance(rest, tuple):
        chosen = np.flatnonzero((markers.times >= rest[0]) & (markers.times < rest[1]))
        if not len(chosen):
            raise InputError(
                f"rest from {rest[0]:g} to {rest[1]:g} s",
                where=markers.where,
                expected=f"seconds between {markers.start:g} and {markers.end:g}",
            )
        return slice(int(chosen[0]), int(chosen[-1]) + 1)
    width = min(max(2, round(REST * markers.rate)), len(points))
    total = np.concatenate([np.zeros((1, *points.shape[1:])), np.cumsum(points, axis=0)])
    squares = np.concatenate([[0.0], np.cumsum((points**2).sum(axis=(1, 2)))])
    means = (total[width:] - total[:-width]) / width
    moves = (squares[width:] - squares[:-width]) / width - (means**2).sum(axis=(1, 2))
    first = int(np.argmin(moves))
    return slice(first, first + width)


def _said(swap: Swap, markers: Motion) -> str:
    first, last = (markers.start + frame / markers.rate for frame in (swap.first, swap.last))
    return f"{' and '.join(swap.labels)} {first:.2f} to {last:.2f} s"
