"""Joints as channels: the jaw that a rig has, and the joints that a mapping names.

How a jaw opens is found in :mod:`lipwright.character.jaw`; who moves which channel is
:mod:`lipwright.character.fitting`'s.
"""

from __future__ import annotations

import difflib

import numpy as np

from lipwright.character.mapping import Mapping
from lipwright.character.names import some
from lipwright.character.rig import Rig
from lipwright.errors import CharacterError
from lipwright.performance import JointTurn


def jaw_channel(rig: Rig) -> dict[str, JointTurn]:
    """Return the channel that opens the rig's own jaw, by name; none where it has no jaw."""
    if rig.jaw is None:
        return {}
    name = rig.jaw.name if rig.jaw.name not in rig.targets else f"{rig.jaw.name} (joint)"
    return {name: rig.jaw}


def mapped_joints(rig: Rig, mapping: Mapping, where: str) -> dict[str, JointTurn]:
    """Return the joints of a user's mapping; what it leaves open is found from the model.

    Raises
    ------
    CharacterError
        If the model has no such joint, or one without an axis carries nothing to find it by.
    """
    found = {}
    for channel, joint in mapping.joints.items():
        name = joint.joint or channel
        place = f"{where}, at joints.{channel}"
        if name not in rig.nodes:
            raise _no_joint(name, rig, place)
        node = rig.nodes[name]
        turn = rig.opening(node, joint.degrees)
        if joint.axis is not None:
            length = float(np.linalg.norm(joint.axis))
            x, y, z = (value / length for value in joint.axis)
            turn = JointTurn(node, name, (x, y, z), joint.degrees)
        if turn is None:
            raise CharacterError(
                f"the joint {name!r} carries no vertices",
                where=place,
                cure='give its "axis", or name another joint',
            )
        found[channel] = turn
    return found


def _no_joint(name: str, rig: Rig, where: str) -> CharacterError:
    names = rig.jaws or tuple(rig.nodes)
    near = difflib.get_close_matches(name, tuple(rig.nodes), 3, 0.5)
    return CharacterError(
        f"the model has no joint {name!r}",
        where=where,
        expected=f"one of {some(names)}" if names else "a model with joints",
        cure=f"did you mean {' or '.join(map(repr, near))}?" if near else "",
    )
