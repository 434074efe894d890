"""A performance: an animation with the speech behind it and the character that plays it.

What :mod:`lipwright.pipeline` makes and every exporter takes. It stands below both, so
that characters and exporters need not know each other.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from lipwright.animation import Animation
from lipwright.errors import InputError
from lipwright.speech import Speech


@dataclass(frozen=True, slots=True)
class JointTurn:
    """How a channel turns a joint: a jaw bone instead of a morph target.

    Parameters
    ----------
    node : int
        The joint's place among the model's nodes.
    name : str
        Its name.
    axis : tuple of 3 float
        What it turns about, of unit length, in the joint's own space at rest; by the right
        hand.
    degrees : float
        How far it turns when the channel is 1.
    """

    node: int
    name: str
    axis: tuple[float, float, float]
    degrees: float


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
        The rig's own channels over time: its controls are names of morph targets, and of
        what turns joints.
    joints : dict of str to JointTurn
        The channels that turn joints. The joint's rotation is that at rest, then the turn.
    """

    name: str
    glb: bytes
    channels: Animation
    joints: dict[str, JointTurn] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """A picture's file.

    Parameters
    ----------
    media : str
        What it is, as browsers say it: ``"image/png"``, ``"image/svg+xml"``.
    data : bytes
        Its content.
    drawn_by_code : bool
        Whether it is a mouth without a face that no artist drew.
    """

    media: str
    data: bytes
    drawn_by_code: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Cues:
    """Mouth shapes that are held one after the other, on whole frames, without gaps.

    Parameters
    ----------
    character : str
        Whose shapes they are.
    shapes : tuple of str
        The shape of each cue; two neighbours differ.
    frames : tuple of int
        The frame at which each cue starts; the first is 0.
    end : int
        The frame at which the last cue ends.
    fps : float
        Frames per second.
    rest : str
        The shape that comes after the end.
    pictures : function
        Returns the picture of each shape; called only by formats that show them.
    notes : tuple of str
        What the user should know: phones that found no place for their shape.
    """

    character: str
    shapes: tuple[str, ...]
    frames: tuple[int, ...]
    end: int
    fps: float
    rest: str
    pictures: Callable[[], dict[str, Picture]]
    notes: tuple[str, ...] = ()

    @property
    def duration(self) -> float:
        """From 0 to the end of the last cue, in seconds."""
        return self.end / self.fps

    def rows(self) -> list[tuple[str, int, int]]:
        """Return shape, first frame, and the frame after the last, of each cue."""
        return list(zip(self.shapes, self.frames, (*self.frames[1:], self.end), strict=True))


def _no_cues() -> Cues:
    raise InputError(
        "there are no mouth shapes to hold", cure="make the performance with lipwright.animate"
    )


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
    cues : function
        Makes the :class:`Cues`; called only by formats of pictures that are held.
    flat : bool
        Whether the character is one of pictures: it has no model.
    sound_file : str
        The name of the sound's file, for formats that name it.
    curves : function, optional
        Returns what a page draws for the animation, where that has hundreds of channels.
    """

    animation: Animation
    speech: Speech
    rig: Callable[[], RiggedModel]
    cues: Callable[[], Cues] = _no_cues
    flat: bool = False
    sound_file: str = ""
    curves: Callable[[], Animation] | None = None
