"""A performance: an animation with the speech behind it and the character that plays it.

What :mod:`lipwright.pipeline` makes and every exporter takes. It stands below both, so
that characters and exporters need not know each other.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from lipwright.animation import Animation
from lipwright.speech import Speech


@dataclass(frozen=True, slots=True, eq=False)
class RiggedModel:
    """A character's model with what moves on it.

    Parameters
    ----------
    name : str
        The character's name.
    glb : bytes
        The model as a GLB file, without the new animation.
    channels : Animation
        The rig's own channels over time: its controls are names of morph targets.
    """

    name: str
    glb: bytes
    channels: Animation


@dataclass(frozen=True, slots=True, eq=False)
class Performance:
    """An animation, what it was made from, and who plays it.

    Parameters
    ----------
    animation : Animation
        The controls of the set.
    speech : Speech
        The sound (where there is one), words and phones.
    rig : function
        Makes the :class:`RiggedModel`; called only by formats that hold a model.
    """

    animation: Animation
    speech: Speech
    rig: Callable[[], RiggedModel]
