"""Small performances for the tests of exporters."""

import numpy as np

from lipwright.animation import Animation
from lipwright.performance import Performance, RiggedModel
from lipwright.phones import PhoneTrack
from lipwright.sound import Sound
from lipwright.speech import Speech
from lipwright.timeline import Tier


def _no_rig() -> RiggedModel:
    raise AssertionError("a format without a model asked for one")


def performance(
    *, controls: tuple[str, ...] = ("open", "PBM"), silent: bool = False
) -> Performance:
    """Return two frames of a /p/; the third control and on repeat the second."""
    columns = [[0.25, 0.5], *([[1.0, 0.123456789]] * (len(controls) - 1))]
    phones = PhoneTrack(Tier.of(("p", 0.0, 0.08)))
    sound = None if silent else Sound(np.linspace(-1, 1, 1600, dtype=np.float32), 16000)
    return Performance(
        Animation(controls, np.array(columns, np.float32).T.copy(), 25.0, -0.04, phones=phones),
        Speech(phones, sound=sound, text="p"),
        _no_rig,
    )
