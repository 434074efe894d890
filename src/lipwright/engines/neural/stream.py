"""Sound in pieces of any size, frames as soon as they are due.

>>> import numpy as np
>>> from lipwright.engines.neural import Stream
>>> stream = Stream(rate=48000)
>>> piece = np.zeros(4800)  # from a microphone
>>> len(stream.push(piece)), len(stream.finish())
(4, 2)

The same frames, bit for bit, whatever the pieces: sums are exact
(:mod:`~lipwright.engines.neural.convolution`), and everything else looks at one mel frame at
a time. What is kept of the past does not grow.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.neural import mel
from lipwright.engines.neural.built_in import LIVE, live_model
from lipwright.engines.neural.convolution import on_grid
from lipwright.engines.neural.live_model import FRAME, STACKED, LiveModel
from lipwright.errors import InputError, SoundError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

Floats = NDArray[np.float64]
START = -30.0
"""dB of full scale: how loud a speaker is taken to be before anything was heard."""
LOUDEST = 8.0
"""Samples beyond this are not -1..1 but whole numbers."""
RATES = (8000, 384_000)
_AT_ONCE = 4096


@dataclass(frozen=True, slots=True, eq=False)
class Frames:
    """Frames that follow each other.

    Parameters
    ----------
    first : int
        Number of the first; frame ``j`` is the instant ``0.02 j`` s of the sound.
    values : (T, K) float32
        The model's controls.
    doubt : (T,) float32
        How far off the opening may be, as a share of its range.
    """

    first: int
    values: NDArray[np.float32]
    doubt: NDArray[np.float32]

    def __len__(self) -> int:
        return len(self.values)

    @property
    def times(self) -> Floats:
        """The frames' instants, seconds, (T,)."""
        return np.asarray((self.first + np.arange(len(self.values))) * FRAME, np.float64)


class Stream:
    """A live model that listens.

    Parameters
    ----------
    model : LiveModel, str or path
        ``"live"``, which comes with Lipwright, or one taught with ``--hears live``.
    rate : int
        Samples per second of the pieces, 8000 to 384,000. At 16,000 nothing is added to
        the model's latency; at other rates the resampler adds 10 to 20 ms, 33 at 8000.

    Raises
    ------
    InputError
        If the model hears recordings only, or the rate is out of range.
    """

    def __init__(self, model: LiveModel | str | Path = LIVE, rate: int = mel.RATE) -> None:
        if not isinstance(model, LiveModel):
            model = live_model(model)
        if model.both_ways:
            raise InputError(
                "a model that hears whole recordings cannot stream",
                expected="one that looks back only",
                cure="choose the live model",
            )
        self.model = model
        self.rate = rate
        self._inlet = Inlet(rate)
        self._pending = np.zeros(0, np.float32)
        self._level = START
        self._hearing = Hearing(model)
        self._mels = 0
        self._finished = False

    @property
    def latency(self) -> float:
        """Seconds from an instant to its frame, that from frame to frame included, at 16 kHz."""
        return self.model.latency + FRAME

    def push(self, piece: ArrayLike) -> Frames:
        """Return the frames that are due after another piece of sound.

        Parameters
        ----------
        piece : (N,) or (N, channels)
            Samples in -1..1, or whole numbers of 16 bits; N may be 0.

        Raises
        ------
        SoundError
            If a sample is not a number, or the piece has another form; the stream is as it
            was before, and goes on with the next piece.
        InputError
            If the stream is finished.
        """
        if self._finished:
            raise InputError("the stream is finished", cure="open another one")
        return self._heard(self._inlet.through(checked(piece)))

    def finish(self) -> Frames:
        """Return the frames up to the end of the sound; the stream takes no more."""
        if self._finished:
            return self._hearing.none()
        self._finished = True
        rest = self._inlet.rest()
        wanted = self._inlet.given // round(FRAME * mel.RATE) + 1
        silence = np.zeros(mel.WINDOW, np.float32)
        last = self._heard(np.concatenate([rest, silence]), self._inlet.given)
        return joined([last, self._hearing.to_the_end(wanted)], self._hearing.none())

    def _heard(self, samples: NDArray[np.float32], end: int | None = None) -> Frames:
        """Take samples at 16 kHz; a frame of bands begins before ``end``."""
        found = []
        self._pending = np.concatenate([self._pending, samples])
        while (due := self._due(end)) > 0:
            power = mel.powers(self._pending, due)
            levels = mel.followed(mel.loudness(power), self._level)
            self._level = float(levels[-1])
            self._pending = self._pending[due * mel.HOP :]
            self._mels += due
            found.append(self._hearing.hear(mel.told(power, levels, self.model.depth)))
        return joined(found, self._hearing.none())

    def _due(self, end: int | None) -> int:
        due = (len(self._pending) - mel.WINDOW) // mel.HOP + 1
        if end is not None:  # what begins after the end of the sound is silence
            due = min(due, -(-end // mel.HOP) - self._mels)
        return min(due, _AT_ONCE)


class Hearing:
    """The net and what it remembers: bands in, frames out, however they come.

    Parameters
    ----------
    model : LiveModel
    """

    def __init__(self, model: LiveModel) -> None:
        self.model = model
        self._memory = model.net.settled()
        self._past = np.zeros((model.behind, model.net.units + mel.BANDS))
        self._bands = np.zeros((STACKED, mel.BANDS))
        self._made = 0  # by the net; frame j is number j + ahead

    def none(self) -> Frames:
        """Return no frames."""
        count = len(self.model.controls)
        due = max(self._made - self.model.ahead, 0)
        return Frames(due, np.zeros((0, count), np.float32), np.zeros(0, np.float32))

    def hear(self, bands: Floats) -> Frames:
        """Return the frames that are due after further bands, (T, 40)."""
        known = np.concatenate([self._bands, bands])
        count = (len(known) - STACKED) // 2 + (self._made == 0)
        first = 0 if self._made == 0 else 2
        if count <= 0:
            self._bands = known
            return self.none()
        starts = first + 2 * np.arange(count)
        heard = known[starts[:, None] + np.arange(STACKED)].reshape(count, -1)
        self._bands = known[starts[-1] :]
        return self._answer(on_grid(heard))

    def to_the_end(self, frames: int) -> Frames:
        """Return the frames up to a number of them, nothing more being heard."""
        missing = frames + self.model.ahead - self._made
        made = self.hear(np.zeros((2 * max(missing, 0), mel.BANDS)))
        kept = max(min(len(made), frames - made.first), 0)
        return Frames(made.first, made.values[:kept], made.doubt[:kept])

    def _answer(self, heard: Floats) -> Frames:
        model = self.model
        made = model.net(heard, self._memory)
        own = 0.5 * (heard[:, -2 * mel.BANDS : -mel.BANDS] + heard[:, -mel.BANDS :])
        rows = np.concatenate([self._past, np.concatenate([made, own], axis=1)])
        values, doubt = model.answered(rows)
        self._past = rows[len(rows) - model.behind :]
        first = self._made - model.ahead
        self._made += len(made)
        early = max(-first, 0)  # what the net said before the sound began
        return Frames(
            max(first, 0),
            values[early:].astype(np.float32),
            doubt[early:].astype(np.float32),
        )


class Inlet:
    """Pieces at any rate become samples at 16 kHz.

    Parameters
    ----------
    rate : int
    """

    def __init__(self, rate: int) -> None:
        low, high = RATES
        if isinstance(rate, bool) or rate != int(rate) or not low <= rate <= high:
            raise InputError(f"{rate} samples per second", expected=f"{low} to {high:,}")
        self.given = 0
        """Samples at 16 kHz that came out."""
        self._resampler: Any = None
        if rate != mel.RATE:
            import soxr

            # Its shortest filter but one: what it lacks lies above what is listened to.
            self._resampler = soxr.ResampleStream(rate, mel.RATE, 1, "float32", "LQ")

    def through(self, samples: NDArray[np.float32]) -> NDArray[np.float32]:
        """Return what is due of further samples."""
        return self._out(samples, last=False)

    def rest(self) -> NDArray[np.float32]:
        """Return what is left at the end."""
        return self._out(np.zeros(0, np.float32), last=True)

    def _out(self, samples: NDArray[np.float32], *, last: bool) -> NDArray[np.float32]:
        if self._resampler is not None:
            samples = self._resampler.resample_chunk(samples, last)
        self.given += len(samples)
        return samples


def checked(piece: ArrayLike) -> NDArray[np.float32]:
    """Return a piece of sound as one channel of float32, or refuse it.

    Raises
    ------
    SoundError
    """
    given = np.asarray(piece)
    if given.dtype == np.int16:
        given = given.astype(np.float32) / np.float32(32768)
    if given.dtype.kind not in "fiu" or given.ndim not in (1, 2):
        raise SoundError(
            f"a piece of shape {given.shape} and type {given.dtype}",
            expected="samples, (N,) or (N, channels), in -1..1",
        )
    if not np.isfinite(given).all():
        place = int(np.flatnonzero(~np.isfinite(given).reshape(len(given), -1).all(axis=1))[0])
        raise SoundError(
            "a piece that holds samples that are not numbers",
            where=f"sample {place}",
            expected="-1..1",
            cure="leave it out or send silence in its place; the stream goes on",
        )
    single = given.mean(axis=1) if given.ndim == 2 and given.size else given.reshape(len(given))
    if len(single) and np.abs(single).max() > LOUDEST:
        raise SoundError(
            f"a sample of {float(np.abs(single).max()):g}",
            expected="-1..1",
            cure="divide whole numbers of 16 bits by 32768",
        )
    return np.asarray(single, np.float32)


def joined(parts: list[Frames], none: Frames) -> Frames:
    """Return frames that follow each other as one."""
    some = [part for part in parts if len(part)]
    if not some:
        return none
    if len(some) == 1:
        return some[0]
    return Frames(
        some[0].first,
        np.concatenate([part.values for part in some]),
        np.concatenate([part.doubt for part in some]),
    )


def hear_all(samples: NDArray[np.float32], rate: int, model: LiveModel) -> Frames:
    """Return every frame of a recording.

    With a model that streams they are those of a stream, bit for bit; one that hears both
    ways takes its loudness from the whole.

    Parameters
    ----------
    samples : (N,) float32
    rate : int
    model : LiveModel
    """
    if not model.both_ways:
        stream = Stream(model, rate)
        return joined([stream.push(samples), stream.finish()], stream.finish())
    inlet = Inlet(rate)
    heard = np.concatenate([inlet.through(checked(samples)), inlet.rest()])
    count = -(-len(heard) // mel.HOP)
    padded = np.concatenate([heard, np.zeros(mel.WINDOW, np.float32)])
    hearing, found = Hearing(model), []
    blocks = [
        mel.powers(padded[first * mel.HOP :], min(_AT_ONCE, count - first))
        for first in range(0, count, _AT_ONCE)
    ]
    levels = mel.settled(np.concatenate([mel.loudness(block) for block in blocks]))
    for number, block in enumerate(blocks):
        own = levels[number * _AT_ONCE :][: len(block)]
        found.append(hearing.hear(mel.told(block, own, model.depth)))
    wanted = len(heard) // round(FRAME * mel.RATE) + 1
    found.append(hearing.to_the_end(wanted))
    return joined(found, hearing.none())
