"""How a net learns, and what counts as wrong."""

from __future__ import annotations

import sys

import numpy as np
import torch
from torch import Tensor, nn
from torch.nn import functional

from tools.neural_model.closing import CLOSED
from tools.neural_model.net import Net
from tools.neural_model.shape import Shape
from tools.neural_model.shown import Lessons, stretches
from tools.neural_model.spoken import CLASSES, POSES

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
    for step, batch in zip(range(1, steps + 1), seen, strict=False):
        bands, poses, classes = map(torch.from_numpy, batch)
        loss = wrong(net(bands)[:, net.shape.ahead :], poses, classes, closures)
        optimiser.zero_grad()
        torch.autograd.backward(loss)
        nn.utils.clip_grad_norm_(net.parameters(), CLIP)
        optimiser.step()
        rates.step()
        mean += 0.01 * (float(loss.detach()) - mean)
        if step % 100 == 0:
            print(f"  step {step} of {steps}: {mean:.4f}", file=sys.stderr, flush=True)


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
