"""Who speaks in the studio: a character with its model, and how its rig is driven."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from hashlib import sha256

import numpy as np

from lipwright.animation import Animation
from lipwright.casting import character_file
from lipwright.character import BUILT_IN, Character, keep_character
from lipwright.engines.bigram.overrides import Overrides, character_overrides
from lipwright.errors import CharacterError
from lipwright.studio.cast import Parts
from lipwright.studio.messages import CharacterView, Joint


@dataclass(eq=False)
class Actor:
    """A character that is loaded and fitted.

    Parameters
    ----------
    name : str
        How a page asks for it.
    spec : str
        How the pipeline does: a built-in name, or a file.
    """

    name: str
    spec: str
    character: Character = field(init=False)

    def __post_init__(self) -> None:
        self.character = keep_character(self.spec)

    @cached_property
    def glb(self) -> bytes:
        """The model."""
        return self.character.model().to_glb()

    @cached_property
    def key(self) -> str:
        """What the model is asked for by."""
        return sha256(self.glb).hexdigest()[:24]

    def channels(self, animation: Animation) -> Animation:
        """Return the rig's channels over time; none where nothing of it moves this model."""
        try:
            return self.character.channels(animation)
        except CharacterError:
            return Animation((), animation.values[:, :0], animation.rate, animation.start)

    def pose(self, weights: Mapping[str, float]) -> dict[str, float]:
        """Return the rig's channels for weights of controls."""
        values = np.array([list(weights.values())], np.float32)
        moved = self.channels(Animation(tuple(weights), values.reshape(1, -1), 1.0))
        return dict(zip(moved.controls, moved.values[0].tolist(), strict=True))

    def parts(self, phone_set: str, opened: str = "") -> Parts:
        """Return what the character changes of a set, beneath all else first.

        Parameters
        ----------
        phone_set : str
        opened : str
            An override file of the character's own that is open: it is left out.
        """
        file = character_file(self.spec)
        found: list[Overrides] = []
        for layer in file.layers if file else ():
            found += character_overrides(
                phone_set, layer.name, layer.path, layer.overrides, layer.settings
            )
        places = [n for n, part in enumerate(found) if opened and part.where == opened]
        if not places:
            return Parts(tuple(found))
        return Parts(tuple(found[: places[-1]]), tuple(found[places[-1] + 1 :]))

    def view(self, version: str, poses: tuple[str, ...]) -> CharacterView:
        """Return what the page needs to show it."""
        fitting = self.character.fit()
        joints = tuple(
            Joint(channel, turn.node, turn.axis, turn.degrees)
            for channel, turn in fitting.joints.items()
        )
        known = tuple(
            pose for pose in poses if pose in fitting.controls or fitting.weights_of(pose)
        )
        note = self.character.strange_to(poses) if self.spec not in BUILT_IN else ""
        return CharacterView(
            version="b" if version == "b" else "a",
            name=self.name,
            title=self.character.name,
            model=f"models/{self.key}.glb",
            backwards="VRM" in self.character.model().json.get("extensions", {}),
            joints=joints,
            known=known,
            notes=(note,) if note else (),
        )
