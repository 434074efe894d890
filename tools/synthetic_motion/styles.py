"""Speaking styles: how one take's mouth differs from the next one's.

A database of one way of speaking has one motion for a pair of phones; people have many.
Each take draws how far every pose goes, how soft the motion is, how firmly lips press and
teeth rest on the lip, and a slow drift of effort. Closures stay closures: they are pressed
at least to :data:`PRESSED`, and nothing is drawn there that could part them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.bigram import BigramEngine, BigramSet
from lipwright.engines.bigram.overrides import with_character

PRESSED = 0.94
"""Weight of the closing pose in the least firm style."""
LIVELY = (0.9, 1.25)
"""How far all poses go; lazy mouths move less, and more softly. What drift takes is in it."""
OWN = 0.12
"""By how much the gain of one pose leaves that of all."""
SOFT = (0.85, 1.25)
DRIFT = 0.15
"""Share of a movement that a drift of effort takes away at most."""
_DRIFT_RATES = (0.3, 0.7, 1.3)  # Hz


@dataclass(frozen=True, slots=True)
class Style:
    """How one take is spoken.

    Parameters
    ----------
    gains : dict of str to float
        By how much each pose is more or less than the set has it.
    softness : float
        By how much wider the set's softening is.
    drift : tuple of (float, float)
        Rate (Hz) and phase of the waves whose mean is the drift of effort.
    """

    gains: dict[str, float]
    softness: float
    drift: tuple[tuple[float, float], ...]


def draw(of: BigramSet, rng: np.random.Generator) -> Style:
    """Draw a style at random."""
    lively = float(rng.uniform(*LIVELY))
    closing = set(of.reach.values())
    gains = {
        name: float(rng.uniform(PRESSED, 1.0) if name in closing else lively * _own(rng))
        for name in of.rules.names
    }
    # What is lazy is soft, too.
    softness = float(rng.uniform(*SOFT)) * (sum(LIVELY) / 2 / lively)
    drift = [(rate * float(rng.uniform(0.8, 1.25)), float(rng.random())) for rate in _DRIFT_RATES]
    return Style(
        {name: round(gain, 3) for name, gain in gains.items()}, round(softness, 3), tuple(drift)
    )


def _own(rng: np.random.Generator) -> float:
    return float(rng.uniform(1.0 - OWN, 1.0 + OWN))


def engine_of(of: BigramSet, style: Style) -> BigramEngine:
    """Return the engine that moves a set in a style."""
    closing = set(of.reach.values())
    soft = {
        pose.name: {"softness": round(pose.softness * style.softness, 4)}
        for pose in of.rules.poses
        if pose.name not in closing
    }
    return BigramEngine(
        with_character(of, "style", "style", [{"gains": style.gains, "poses": soft}], {})
    )


def drifted(
    values: NDArray[np.float64], times: NDArray[np.float64], style: Style, of: BigramSet
) -> NDArray[np.float64]:
    """Return (T, P) weights with the style's drift; it takes away only, so all bounds hold."""
    waves = [np.cos(2 * np.pi * (rate * times + phase)) for rate, phase in style.drift]
    share = 1.0 - DRIFT * (0.5 + 0.5 * np.mean(waves, axis=0))
    closing = np.isin(of.rules.names, list(of.reach.values()))
    return np.where(closing[None, :], values, values * share[:, None])
