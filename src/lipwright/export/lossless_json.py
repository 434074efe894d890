"""JSON: the lossless animation (DESIGN section 8). It leaves out only the sound and the rig."""

from __future__ import annotations

from lipwright.performance import Performance


def encode(performance: Performance) -> bytes:
    """Return the animation's own file."""
    return performance.animation.to_bytes()
