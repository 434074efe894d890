"""Sound alone: a line of which no words are known, and the net that animates it.

Models are kept while their files stay as they are. The publication's five outputs are told
in poses, which every character knows; other controls are played as they are named. Where the
user leaves the engine to us, it is chosen here, by what is known of the line.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lipwright.acting import Acted
from lipwright.animation import Animation
from lipwright.curves import reduced
from lipwright.errors import LipwrightError, SoundError
from lipwright.files import Kept, Version, file_version
from lipwright.phones import PhoneTrack
from lipwright.sound import Sound
from lipwright.speech import Speech
from lipwright.timeline import Tier

if TYPE_CHECKING:
    from lipwright.engines.neural.engine import NeuralEngine

UNLIKE = 0.3
"""Share of frames unlike the training from which on that is said."""
QUIET = 0.05
"""Share of frames in which the mouth moves, below which that is said."""
SHOWN = 3
"""Spells of doubt that are named."""
DOUBTED, SURE = 0.4, 0.6
"""Confidence of the net below which words are sought, and of words from which they are taken."""


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


def neural_engine(model: str | Path | None = None) -> NeuralEngine:
    """Return the engine for a model, ``"whole"`` where none is named.

    It is made once, and anew when the model's file changes.
    """
    from lipwright.engines.neural.built_in import WHOLE, model_file

    named = WHOLE if model is None else model
    path = model_file(named)
    name = str(named) if path != Path(named) else path.name
    return _engines.get(path.absolute(), lambda: _made(str(path), name)).engine


def _made(path: str, name: str) -> _Kept:
    from lipwright.engines.neural.built_in import load_model
    from lipwright.engines.neural.engine import NeuralEngine

    version = file_version(path)
    return _Kept(NeuralEngine(load_model(path), name), ((path, version),))


def act_by_ear(speech: Speech, rate: float, model: str | Path | None = None) -> Acted:
    """Return what a model makes of a line's sound, in controls for a character.

    Raises
    ------
    InputError
        If the line has no sound, or the model's file cannot be used.
    SoundError
        If the sound is silent or too short.
    """
    made = neural_engine(model).animate(speech, rate)
    return replace(Acted.as_it_is(_playable(made)), note=_note(made.report))


def _note(report: dict[str, Any]) -> str:
    """Return what the user should know of an answer; mostly nothing."""
    if report.get("unlike_training", 0.0) >= UNLIKE:
        return (
            f"{100 * report['unlike_training']:.0f} % of it sounds like nothing in the model's"
            " training (noise, another microphone): look at the result"
        )
    if report.get("speaks", 1.0) < QUIET:
        return f"the mouth rests {100 * (1 - report['speaks']):.0f} % of the time: is it speech?"
    spells = report.get("unsure", [])
    if not spells:
        return ""
    longest = sorted(spells, key=lambda spell: spell[0] - spell[1])[:SHOWN]
    places = ", ".join(f"{start:.1f} to {end:.1f} s" for start, end in sorted(longest))
    more = f" and {len(spells) - SHOWN} more" if len(spells) > SHOWN else ""
    return f"the net is unsure at {places}{more}: look there first"


@dataclass(frozen=True, slots=True, eq=False)
class Choice:
    """An engine that was chosen for a line.

    Parameters
    ----------
    engine : str
    speech : Speech
        The line as that engine needs it.
    why : str
    acted : Acted, optional
        What the net made of it, where the net was chosen.
    """

    engine: str
    speech: Speech
    why: str
    acted: Acted | None = None


def choose_engine(speech: Speech, rate: float = 60.0, model: str | Path | None = None) -> Choice:
    """Choose the engine that suits a line.

    Known phones go to the bigram engine: they say when each closure is. Sound alone goes to
    the net, which is as close to a face as phones by ear are (``bench.neural_live``), in any
    language and faster; but where the net doubts its own answer, the recogniser is asked, and
    taken if it is surer.

    Parameters
    ----------
    speech : Speech
        :func:`sound_alone`, or with phones.
    rate : float
        Frames per second.
    model : str or path, optional
        For the net.
    """
    if len(speech.phones):
        return Choice("bigram", speech, "the bigram engine: the phones are known")
    acted = act_by_ear(speech, rate, model)
    sure = acted.animation.report.get("confidence", 1.0)
    if sure >= DOUBTED:
        why = f"the neural engine: no words are known, and it is sure ({sure:.2f})"
        return Choice("neural", speech, why, acted)
    words = _recognised(speech)
    if words is None or (words.confidence or 0.0) < SURE:
        why = f"the neural engine: it is not sure ({sure:.2f}), but no words are recognised either"
        return Choice("neural", speech, why, acted)
    why = (
        f"the bigram engine: the net is not sure ({sure:.2f}), the recognised words are"
        f" ({words.confidence:.2f})"
    )
    return Choice("bigram", replace(words, notes=(*speech.notes, *words.notes)), why)


def _recognised(speech: Speech) -> Speech | None:
    """Return a line with the words that are recognised in it; None where there are none."""
    from lipwright.schedule.recognise import recognise

    assert speech.sound is not None
    try:
        return recognise(speech.sound)
    except LipwrightError:
        return None


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
