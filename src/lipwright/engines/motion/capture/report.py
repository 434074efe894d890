"""What was done to the markers of a take, in figures and in one line."""

from __future__ import annotations

from dataclasses import dataclass

from lipwright.engines.motion.capture.motion import Floats


@dataclass(frozen=True, slots=True, eq=False)
class RestFace:
    """A face at rest, to which takes of one actor are laid.

    Parameters
    ----------
    labels : tuple of str
    points : (M, 3) float64
        Metres.
    rigid : tuple of str
        The markers that do not deform.
    """

    labels: tuple[str, ...]
    points: Floats
    rigid: tuple[str, ...]


@dataclass(frozen=True, slots=True, eq=False)
class CleaningReport:
    """What was found and mended.

    Parameters
    ----------
    where : str
        The file.
    frames, markers : int
        Markers that were kept.
    gap_share : float
        Share of all places that were not seen, 0..1, markers left out included.
    longest_gap : float
        Seconds, of the markers that were kept.
    by_spline, from_others : int
        Gaps filled by a spline, and from the other markers.
    spikes : int
        Places taken out.
    swaps : tuple of str
        Which labels were swapped, and when.
    rest : RestFace
        What was subtracted, and the markers that held the head.
    head_degrees, head_mm : float
        How far the head turned and moved from its mean.
    refused : tuple of str
        Markers left out, and why.
    """

    where: str
    frames: int
    markers: int
    gap_share: float
    longest_gap: float
    by_spline: int
    from_others: int
    spikes: int
    swaps: tuple[str, ...]
    rest: RestFace
    head_degrees: float
    head_mm: float
    refused: tuple[str, ...]

    def notes(self) -> tuple[str, ...]:
        """Return what the user should know: labels put right, markers left out."""
        swaps = (f"labels swapped, put right: {'; '.join(self.swaps)}",) if self.swaps else ()
        refused = (f"markers left out: {', '.join(self.refused)}",) if self.refused else ()
        return swaps + refused

    def __str__(self) -> str:
        return (
            f"{self.where}: {self.markers} markers, {self.frames} frames, "
            f"{self.gap_share:.1%} gaps (longest {self.longest_gap:.2f} s, "
            f"{self.by_spline} filled by a spline, {self.from_others} from the other markers), "
            f"{self.spikes} spikes, {_many(self.swaps, 'swap')}; the head turns "
            f"{self.head_degrees:.1f}° and moves {self.head_mm:.0f} mm, held by "
            f"{len(self.rest.rigid)} markers; left out: {', '.join(self.refused) or 'none'}"
        )


def _many(found: tuple[str, ...], word: str, shown: int = 4) -> str:
    if not found:
        return f"no {word}s"
    more = f"; and {len(found) - shown} more" if len(found) > shown else ""
    plural = "" if len(found) == 1 else "s"
    return f"{len(found)} {word}{plural} ({'; '.join(found[:shown])}{more})"
