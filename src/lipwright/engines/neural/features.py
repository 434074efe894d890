"""What the net hears: log spectra in 27 areas, nine of them around every frame.

Frank, Hoch, Trogemann, "Processing Speech Data": every 40 ms a context of 112 ms; nine
segments of 32 ms, 10 ms apart, each under a Hamming window; FFT; the logarithmic spectrum
summed in 27 areas: 27 x 9 inputs. They name neither rate nor the areas' edges. Here the
rate is 16 kHz, so that a segment is an FFT of 512, and the areas are equally wide in mel.
Two things are added: means are taken off (an offset is not speech), and a line is brought to
one loudness, with a floor under its spectrum, so that a quieter copy, digital silence and the
missing upper half of 8 kHz sound stay within what the net can know.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from itertools import pairwise
from typing import Literal

import msgspec
import numpy as np
from numpy.typing import NDArray

from lipwright.errors import SoundError
from lipwright.sound import Sound

Floats = NDArray[np.float64]
Scale = Literal["linear", "mel", "bark", "octave"]

SHORTEST = 0.112
"""Seconds: a whole context."""
SILENT = 1e-4
"""The loudest sample, -80 dB of full scale, below which there is nothing to hear."""
LOUD = 95
"""Per cent of segments that are less loud than what is brought to one loudness."""
MOST, HIGHEST = 20_000, 96_000
"""Inputs, and samples per second, that a net may ask for."""
_BLOCK = 2048

_WARPS: dict[str, Callable[[Floats], Floats]] = {
    "linear": lambda hertz: hertz,
    "mel": lambda hertz: 2595.0 * np.log10(1.0 + hertz / 700.0),
    "bark": lambda hertz: 26.81 * hertz / (1960.0 + hertz),
    "octave": lambda hertz: np.log2(np.maximum(hertz, 1.0)),
}


class Hearing(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """How a net hears; as published but for what the publication leaves open.

    Parameters
    ----------
    rate : int
        Samples per second that the sound is brought to.
    segment, hop : float
        Seconds: how long a segment is, and from one to the next.
    segments : int
        In a context.
    step : int
        Hops from frame to frame: 4, for 25 frames per second.
    ahead : float
        Seconds by which the middle of the context lies after its frame; below 0 it looks
        back, as a net must that listens to a microphone.
    areas : int
        That the spectrum is summed in.
    scale : str
        On which they are equally wide: ``"linear"``, ``"mel"``, ``"bark"``, ``"octave"``.
    lowest, highest : float
        Hz, the outer edges.
    floor : float
        Power under the spectrum, of that of the line's loud segments.
    """

    rate: int = 16000
    segment: float = 0.032
    hop: float = 0.010
    segments: int = 9
    step: int = 4
    ahead: float = 0.0
    areas: int = 27
    scale: Scale = "mel"
    lowest: float = 60.0
    highest: float = 8000.0
    floor: float = 1e-5

    def __post_init__(self) -> None:
        counts = (self.rate, self.segments, self.step, self.areas)
        lengths = (self.segment * self.rate, self.hop * self.rate, self.floor * 1e12)
        edges = 0 < self.lowest < self.highest <= self.rate / 2
        if min(counts) < 1 or min(lengths) < 1 or not edges or abs(self.ahead) > 1:
            raise ValueError("numbers that no net can hear by")  # msgspec names the place
        if self.inputs > MOST or self.rate > HIGHEST:
            raise ValueError(f"{self.inputs} inputs at {self.rate} Hz; at most {MOST}")
        if self.areas >= round(self.segment * self.rate) // 2:
            raise ValueError(f"{self.areas} areas in a spectrum that has fewer lines")

    @property
    def inputs(self) -> int:
        """Numbers that go into the net: 243."""
        return self.areas * self.segments

    @property
    def frame(self) -> float:
        """Seconds from frame to frame: 0.04."""
        return self.step * self.hop

    @property
    def context(self) -> float:
        """Seconds that a frame hears: 0.112."""
        return (self.segments - 1) * self.hop + self.segment


def area_edges(hearing: Hearing) -> NDArray[np.intp]:
    """Return the areas' edges as lines of the spectrum, (areas + 1,).

    Area ``i`` holds the lines from edge ``i`` up to, without, edge ``i + 1``; at least one.
    """
    lines = round(hearing.segment * hearing.rate)
    per_line = hearing.rate / lines
    hertz = np.linspace(hearing.lowest, hearing.highest, 20000)
    warped = _WARPS[hearing.scale](hertz)
    at = np.interp(np.linspace(warped[0], warped[-1], hearing.areas + 1), warped, hertz)
    edges = np.rint(at / per_line).astype(np.intp)
    edges[-1] = min(edges[-1], lines // 2)
    for i in range(1, len(edges)):  # narrow areas at the foot of a scale: a line each
        edges[i] = max(edges[i], edges[i - 1] + 1)
    return edges


@lru_cache(maxsize=16)
def _summing(hearing: Hearing) -> tuple[Floats, Floats]:
    """Return the window, and the matrix that takes the mean of each area."""
    count = round(hearing.segment * hearing.rate)
    window = np.hamming(count)
    edges = area_edges(hearing)
    means = np.zeros((count // 2 + 1, hearing.areas))
    for area, (low, high) in enumerate(pairwise(edges)):
        means[low:high, area] = 1.0 / (high - low)
    return window / np.sqrt(np.square(window).sum()), means


def check_audible(sound: Sound) -> NDArray[np.float32]:
    """Refuse a sound in which nothing can be heard; return its samples without their mean.

    Raises
    ------
    SoundError
        If there is less than one context, all is silence, or a sample is not finite.
    """
    if not len(sound.samples) or sound.duration < SHORTEST:
        raise SoundError(
            f"{len(sound.samples)} samples ({1000 * sound.duration:.0f} ms)",
            expected=f"{1000 * SHORTEST:.0f} ms or more",
        )
    if not np.isfinite(sound.samples).all():
        raise SoundError("the sound holds samples that are not numbers", expected="-1..1")
    centred: NDArray[np.float32] = sound.samples - np.float32(sound.samples.mean(dtype=np.float64))
    if np.abs(centred).max() < SILENT:
        raise SoundError("no speech in it: the sound is silent", expected="speech")
    return centred


def audible(sound: Sound, hearing: Hearing) -> NDArray[np.float32]:
    """Return a sound at the net's rate, brought to one loudness.

    Raises
    ------
    SoundError
        If there is less than one context, all is silence, or a sample is not finite.
    """
    centred = check_audible(sound)
    samples = Sound(centred, sound.rate).resampled(hearing.rate).samples
    step = round(hearing.segment * hearing.rate)
    blocks = samples[: len(samples) // step * step].reshape(-1, step)
    loud = np.percentile(blocks.var(axis=1, dtype=np.float64), LOUD)
    return np.asarray(samples / np.sqrt(max(loud, SILENT**2)), np.float32)


def spectra(samples: NDArray[np.float32], hearing: Hearing, frames: int) -> Floats:
    """Return the areas of every segment that some frame hears, (G, areas), natural log.

    Segment ``g`` has its middle at ``(g - segments // 2) * hop + ahead`` seconds; what lies
    outside the sound is silence.
    """
    window, means = _summing(hearing)
    count, hop = len(window), round(hearing.hop * hearing.rate)
    total = (frames - 1) * hearing.step + hearing.segments
    first = round(hearing.ahead * hearing.rate) - (hearing.segments // 2) * hop - count // 2
    found = np.empty((total, hearing.areas))
    for start in range(0, total, _BLOCK):
        rows = min(_BLOCK, total - start)
        part = _cut(samples, first + start * hop, (rows - 1) * hop + count)
        pieces = np.lib.stride_tricks.sliding_window_view(part, count)[::hop].astype(np.float64)
        pieces -= pieces.mean(axis=1, keepdims=True)
        power = np.square(np.abs(np.fft.rfft(pieces * window, axis=1)))
        found[start : start + rows] = np.log(power + hearing.floor) @ means
    return found


def _cut(samples: NDArray[np.float32], first: int, count: int) -> NDArray[np.float32]:
    """Return samples from ``first`` on, zeros where the sound has none."""
    part = np.zeros(count, np.float32)
    low, high = max(first, 0), min(first + count, len(samples))
    if low < high:
        part[low - first : high - first] = samples[low:high]
    return part


def frame_times(sound: Sound, hearing: Hearing) -> Floats:
    """Return the instants of a sound's frames, seconds: 0, 0.04, … up to its end."""
    count = int(sound.duration / hearing.frame + 1e-9) + 1
    return np.arange(count, dtype=np.float64) * hearing.frame


def features(sound: Sound, hearing: Hearing | None = None) -> Floats:
    """Return what the net hears at every frame of a sound.

    Parameters
    ----------
    sound : Sound
    hearing : Hearing, optional
        As published where it is not given.

    Returns
    -------
    (T, segments * areas) float64
        Frame ``k`` is the instant ``0.04 k`` s, in the middle of its context; the areas of
        the earliest segment first. Mean natural logarithm of the power in each area; 0 is
        that of noise as strong as the line's loud segments.

    Raises
    ------
    SoundError
        If the sound is too short, silent, or not finite.
    """
    hearing = hearing or Hearing()
    frames = len(frame_times(sound, hearing))
    areas = spectra(audible(sound, hearing), hearing, frames)
    contexts = np.lib.stride_tricks.sliding_window_view(areas, hearing.segments, axis=0)
    return np.asarray(contexts[:: hearing.step].transpose(0, 2, 1)).reshape(frames, hearing.inputs)
