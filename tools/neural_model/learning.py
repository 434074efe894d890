"""How a net learns: what it is shown, what it is told, and what counts as wrong."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn
from torch.nn import functional

from lipwright.engines.neural import mel
from tools.neural_model.closing import CLOSED
from tools.neural_model.hearing import Heard, bands_of
from tools.neural_model.net import Net
from tools.neural_model.shape import Shape
from tools.neural_model.spoken import CLASSES, POSES

BATCH, SECONDS = 32, 5.0
WARMING = 40
"""Frames at the start of each stretch that are not judged: the net has no past there."""
RATE, DECAY, CLIP = 2e-3, 0.01, 1.0
CLOSURES, LAST_CLOSURES = 0.2, 1.0
MOVED = 0.5
_POSE = torch.tensor([1.0, 0.8, 0.6, 0.7, 0.7, 0.8, 0.15, 0.15, 0.15])
"""What each pose counts: what is seen of the tongue is little."""
_SHOWN = torch.tensor([0.0, 0.7, 0.0, 1.5, 4.0, 0.0, 0.0, 0.0, 0.0])
"""How much more each counts where it is to be seen: a net gives the mean of what it cannot tell
apart, and a rare shape would hardly ever be shown."""
_OPENS = torch.tensor([1.95, 0.0, 0.21, 0.39, 0.27, 0.0, 0.0, 0.0, 0.0])
"""By how much each pose opens the built-in head's lips, as a share of the opening's range."""
_MISSED = 3.0
"""A closure that is missed counts for so many that are made up."""


@dataclass(frozen=True, slots=True, eq=False)
class Lessons:
    """All that is heard and seen, in one row.

    Parameters
    ----------
    bands : (T, 40) float16
        As the net hears them.
    poses : (T, P) float16
    classes : (T,) int8
    """

    bands: NDArray[np.float16]
    poses: NDArray[np.float16]
    classes: NDArray[np.int8]


def lessons_of(heard: Sequence[Heard], shape: Shape, rng: np.random.Generator) -> Lessons:
    """Return what a net of a shape hears of lines."""
    return Lessons(
        np.concatenate([bands_of(one, shape, rng) for one in heard]),
        np.concatenate([one.poses for one in heard]),
        np.concatenate([one.classes for one in heard]),
    )


def learn(lessons: Lessons, shape: Shape, *, steps: int, seed: int) -> Net:
    """Return a net that has learnt: all at first, then above all when lips close."""
    torch.manual_seed(seed)
    net = Net(shape, len(POSES), len(CLASSES))
    go_on(net, lessons, steps=steps, seed=seed, rate=RATE, closures=CLOSURES, apart=MOVED)
    return sharpened(net, lessons, steps=steps, seed=seed)


def sharpened(net: Net, lessons: Lessons, *, steps: int, seed: int) -> Net:
    """Return a net after a fifth of its steps more, in which closures count for more.

    What a shape says of these steps holds, too.
    """
    seed += 1
    torch.manual_seed(seed)
    net.dropped = net.shape.last_dropped
    last = {"rate": RATE / 4, "closures": LAST_CLOSURES, "apart": net.shape.last_moved}
    go_on(net, lessons, steps=steps // 5, seed=seed, **last)
    net.eval()
    return net


def go_on(
    net: Net,
    lessons: Lessons,
    *,
    steps: int,
    seed: int,
    rate: float,
    closures: float,
    apart: float,
) -> None:
    """Teach a net further.

    Parameters
    ----------
    net : Net
    lessons : Lessons
    steps : int
    seed : int
        Of what is shown.
    rate : float
        The greatest step; it begins small and ends at nearly nothing.
    closures : float
        What a closure counts.
    apart : float
        How far bands are moved: by so many at most, and by 0.06 of their place times that.
    """
    net.train()
    optimiser = torch.optim.AdamW(net.parameters(), lr=rate, weight_decay=DECAY)
    rates = torch.optim.lr_scheduler.OneCycleLR(optimiser, rate, total_steps=steps, pct_start=0.1)
    seen = stretches(lessons, net.shape, apart, np.random.default_rng(seed))
    mean = 0.0
    for step, (bands, poses, classes) in zip(range(1, steps + 1), seen, strict=False):
        loss = wrong(net(bands)[:, net.shape.ahead :], poses, classes, closures)
        optimiser.zero_grad()
        torch.autograd.backward(loss)
        nn.utils.clip_grad_norm_(net.parameters(), CLIP)
        optimiser.step()
        rates.step()
        mean += 0.01 * (float(loss.detach()) - mean)
        if step % 100 == 0:
            print(f"  step {step} of {steps}: {mean:.4f}", file=sys.stderr, flush=True)


def stretches(
    lessons: Lessons, shape: Shape, apart: float, rng: np.random.Generator
) -> Iterator[tuple[Tensor, Tensor, Tensor]]:
    """Return, without end, stretches of some seconds: bands, poses, classes.

    Bands before each stretch make up what the first frame stacks. All are moved along the
    scale, some are hidden or raised, so that no band alone decides.
    """
    frames = int(SECONDS * 50)
    span = 2 * (frames + shape.ahead) + 2
    while True:
        starts = 2 * rng.integers(2, (len(lessons.bands) - span) // 2, BATCH)
        bands = np.stack([lessons.bands[s - 4 : s - 4 + span] for s in starts]).astype(np.float32)
        poses = np.stack([lessons.poses[s : s + 2 * frames : 2] for s in starts])
        classes = np.stack([lessons.classes[s : s + 2 * frames : 2] for s in starts])
        bands = shifted(bands, apart, rng)
        bands += rng.normal(0, 0.03, (BATCH, 1, 1)) + rng.normal(0, 0.04, (BATCH, 1, mel.BANDS))
        for row in np.flatnonzero(rng.random(BATCH) < 0.5):
            first, wide = int(rng.integers(mel.BANDS - 6)), int(rng.integers(1, 7))
            bands[row, :, first : first + wide] = 0.0
        yield (
            torch.from_numpy(bands),
            torch.from_numpy(poses.astype(np.float32)),
            torch.from_numpy(classes.astype(np.int64)),
        )


def shifted(
    bands: NDArray[np.float32], apart: float, rng: np.random.Generator
) -> NDArray[np.float32]:
    """Return bands as longer and shorter throats would have them: moved along the scale."""
    places = np.arange(mel.BANDS)
    found = np.empty_like(bands)
    for row, one in enumerate(bands):
        longer = rng.uniform(1 - 0.06 * apart, 1 + 0.06 * apart)
        at = np.clip(places * longer + rng.uniform(-apart, apart), 0, mel.BANDS - 1)
        low = np.minimum(at.astype(np.intp), mel.BANDS - 2)
        share = (at - low).astype(np.float32)
        found[row] = one[:, low] * (1 - share) + one[:, low + 1] * share
    return found


def wrong(outputs: Tensor, poses: Tensor, classes: Tensor, weight: float) -> Tensor:
    """Return how wrong a net is: poses, opening, closures, classes, and its own doubt.

    Parameters
    ----------
    outputs : (B, T, O)
    poses : (B, T, P)
    classes : (B, T)
    weight : float
        What a closure counts.
    """
    count = len(POSES)
    outputs, poses, classes = (one[:, WARMING:] for one in (outputs, poses, classes))
    found = torch.sigmoid(outputs[..., :count])
    apart = found @ _OPENS - poses @ _OPENS
    shut = (poses[..., POSES.index("PBM")] > CLOSED).float()
    closures = functional.binary_cross_entropy_with_logits(
        outputs[..., count], shut, pos_weight=torch.tensor(_MISSED)
    )
    said = outputs[..., count + 1 : -1]
    named = functional.cross_entropy(said.reshape(-1, said.shape[-1]), classes.reshape(-1))
    doubt = functional.l1_loss(outputs[..., -1], torch.log(apart.abs().detach() + 0.02))
    total: Tensor = (
        4.0 * (_POSE * (1.0 + _SHOWN * poses) * (found - poses) ** 2).mean()
        + 2.0 * (apart**2).mean()
        + weight * closures
        + 0.1 * named
        + 0.02 * doubt
    )
    return total
