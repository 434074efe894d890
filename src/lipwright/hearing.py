"""Sound alone: a line of which no words are known, and the net that animates it.

Models are kept while their files stay as they are. The publication's five outputs are told
in poses, which every character knows; other controls are played as they are named.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from lipwright.acting import Acted
from lipwright.animation import Animation
from lipwright.curves import reduced
from lipwright.errors import SoundError
from lipwright.files import Kept, Version, file_version
from lipwright.phones import PhoneTrack
from lipwright.sound import Sound
from lipwright.speech import Speech
from lipwright.timeline import Tier

if TYPE_CHECKING:
    from lipwright.engines.neural.engine import NeuralEngine

UNLIKE = 0.3
"""Share of frames unlike the training from which on that is said."""


def sound_alone(sound: Sound | str | Path) -> Speech:
    """Return a recording of which nothing is known: no words, no phones.

    It is what the neural engine needs.

    Raises
    ------
    SoundError
        If the file cannot be read, or the sound is silent or too short.
    """
    from lipwright.engines.neural.features import check_audible

    where = "" if isinstance(sound, Sound) else str(sound)
    if not isinstance(sound, Sound):
        from lipwright.sound_files import read_sound

        sound = read_sound(sound)
    try:
        check_audible(sound)
    except SoundError as error:
        raise (error.at(where) if where else error) from None
    return Speech(PhoneTrack(Tier()), sound=sound, source="sound", notes=sound.notes)


@dataclass(frozen=True, slots=True)
class _Kept:
    """An engine, and the file that its model was read from."""

    engine: NeuralEngine
    files: tuple[tuple[str, Version | None], ...]


_engines: Kept[_Kept] = Kept(4)


def neural_engine(model: str | Path) -> NeuralEngine:
    """Return the engine for a model's file; made once, and anew when the file changes."""
    return _engines.get(Path(model).absolute(), lambda: _made(str(model))).engine


def _made(path: str) -> _Kept:
    from lipwright.engines.neural.engine import NeuralEngine
    from lipwright.engines.neural.model import read_model

    version = file_version(path)
    return _Kept(NeuralEngine(read_model(path), Path(path).name), ((path, version),))


def act_by_ear(speech: Speech, rate: float, model: str | Path) -> Acted:
    """Return what a model makes of a line's sound, in controls for a character.

    Raises
    ------
    InputError
        If the line has no sound, or the model's file cannot be used.
    SoundError
        If the sound is silent or too short.
    """
    made = neural_engine(model).animate(speech, rate)
    acted = Acted.as_it_is(_playable(made))
    unlike = made.report["unlike_training"]
    if unlike < UNLIKE:
        return acted
    note = (
        f"{100 * unlike:.0f} % of it sounds like nothing in the model's training"
        " (noise, another microphone): look at the result"
    )
    return replace(acted, note=note)


def _playable(animation: Animation) -> Animation:
    """Return the publication's five as poses; other controls as they are."""
    from lipwright.engines.neural.engine import TOLERANCE
    from lipwright.engines.neural.five import FIVE, in_poses

    if animation.controls != FIVE:
        return animation
    poses, values = in_poses(animation.values)
    keys = {
        name: reduced(animation.times, column, TOLERANCE)
        for name, column in zip(poses, values.T, strict=True)
    }
    told = {**animation.report, "outputs": list(FIVE)}
    return replace(
        animation, controls=poses, values=values.astype("float32"), keys=keys, report=told
    )
