"""Markers as channels: three coordinates each, ``"chin.x", "chin.y", "chin.z"``."""

from __future__ import annotations

from collections.abc import Sequence

AXES = ("x", "y", "z")


def marker_channels(labels: Sequence[str]) -> tuple[str, ...]:
    """Return the channels of markers: three coordinates each.

    Examples
    --------
    >>> marker_channels(("chin",))
    ('chin.x', 'chin.y', 'chin.z')
    """
    return tuple(f"{label}.{axis}" for label in labels for axis in AXES)


def marker_labels(channels: Sequence[str]) -> tuple[str, ...]:
    """Return the markers whose coordinates channels are; none where they are something else.

    Examples
    --------
    >>> marker_labels(("chin.x", "chin.y", "chin.z")), marker_labels(("jawOpen",))
    (('chin',), ())
    """
    labels = tuple(name.removesuffix(".x") for name in channels[::3])
    return labels if labels and marker_channels(labels) == tuple(channels) else ()
