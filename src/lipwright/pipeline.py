"""The whole flow, on one screen (DESIGN section 1).

text, sound or labels → :class:`Speech` → engine → :class:`Animation` → character →
files. Anything the command line does is one call here. Schedules, engines, characters
and exporters do not know each other; they meet in this module.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import cache, lru_cache, partial
from pathlib import Path
from typing import TYPE_CHECKING

from lipwright.acting import Acted, Acting, act
from lipwright.casting import character_file, check_engine, engine_for, motion_engine
from lipwright.errors import SoundError
from lipwright.hearing import act_by_ear, choose_engine
from lipwright.hearing import sound_alone as sound_alone
from lipwright.measuring import evaluate_motion as evaluate_motion
from lipwright.performance import Performance
from lipwright.sound import Sound
from lipwright.speech import Speech

if TYPE_CHECKING:
    from lipwright.character import Character
    from lipwright.engines.bigram import BigramSet
    from lipwright.engines.bigram.fit import FitReport

Progress = Callable[[float], None]


def say(
    text: str,
    *,
    voice: str = "en-us",
    rate: float = 175.0,
    pitch: float | None = None,
    character: str | Path | None = None,
) -> Speech:
    """Return typed text as speech: sound, words and phones.

    Parameters
    ----------
    text : str
        What to say.
    voice : str
        A language or voice of espeak-ng (``"en-us"``, ``"de"``, ``"cmn"``), or
        ``"festival"``.
    rate : float
        Words per minute, 80 to 450.
    pitch : float, optional
        0..99.
    character : str or path, optional
        Who will speak: its character file may say how slowly and how fast it can.

    Raises
    ------
    TextError
        If there is nothing to say, or the voice is unknown.
    MissingExtraError
        If the extra ``tts`` is not installed.
    """
    from lipwright.schedule.say import say as speak

    file, note = character_file(character), ""
    if file is not None:
        rate, note = file.speakable(rate)
    speech = speak(text, voice=voice, rate=rate, pitch=pitch)
    return replace(speech, notes=(*speech.notes, note)) if note else speech


def align(
    sound: Sound | str | Path,
    text: str,
    *,
    language: str = "en-us",
    lexicon: str | Path | None = None,
    progress: Progress | None = None,
) -> Speech:
    """Return a recording with its words and phones in time, the words being known.

    Parameters
    ----------
    sound : Sound or path
    text : str
        What is said in it.
    language : str
        What it is said in: ``"de"``, ``"pt-br"``, or another of espeak-ng's; the phones of
        all but English come in IPA.
    lexicon : path, optional
        Pronunciations of English words that no dictionary has, in the CMU dictionary's
        form.
    progress : function, optional
        Called with the share that is done, 0..1.

    Raises
    ------
    SoundError, TextError
        If either cannot be used.
    MissingExtraError
        If the language is not English and the extra ``tts`` is not installed.
    """
    from lipwright.schedule.align import align as find

    path = Path(lexicon) if lexicon is not None else None
    with _named(sound):
        heard = _sound(sound)
        return _told(heard, find(heard, text, language=language, lexicon=path, progress=progress))


def recognise(sound: Sound | str | Path, *, progress: Progress | None = None) -> Speech:
    """Return a recording with words and phones in time, the words being unknown."""
    from lipwright.schedule.recognise import recognise as listen

    with _named(sound):
        return _told(heard := _sound(sound), listen(heard, progress=progress))


def hear(sound: Sound | str | Path, *, progress: Progress | None = None) -> Speech:
    """Return a recording with the phones that it sounds like, in any language; no words."""
    from lipwright.schedule.by_ear import hear as listen

    with _named(sound):
        return _told(heard := _sound(sound), listen(heard, progress=progress))


def from_labels(
    labels: str | Path, sound: Sound | str | Path | None = None, *, phone_set: str | None = None
) -> Speech:
    """Return speech from labels that others made (TextGrid, .lab, .ctm, .phn, JSON)."""
    from lipwright.schedule.labels import speech_from_labels

    heard = _sound(sound) if sound is not None else None
    return speech_from_labels(Path(labels), heard, phone_set=phone_set)


def _sound(sound: Sound | str | Path) -> Sound:
    if isinstance(sound, Sound):
        return sound
    from lipwright.sound_files import read_sound

    return read_sound(sound)


def _told(sound: Sound, speech: Speech) -> Speech:
    """Say of a line what had to be mended in its sound."""
    return replace(speech, notes=(*sound.notes, *speech.notes))


@contextmanager
def _named(sound: Sound | str | Path) -> Iterator[None]:
    """Put the file's name into what is said of a sound that was read from one."""
    try:
        yield
    except SoundError as error:
        if isinstance(sound, Sound) or error.where:
            raise
        raise error.at(str(sound)) from None


def animate(
    speech: Speech,
    *,
    engine: str = "bigram",
    bigram_set: str | Path | None = None,
    preset: str = "default",
    overrides: str | Path | None = None,
    reduction: str | Path | None = None,
    edits: str | Path | None = None,
    character: str | Path = "head",
    mapping: str | Path | None = None,
    rate: float = 60.0,
    database: str | Path | None = None,
    search: str = "several",
    model: str | Path | None = None,
    controls: str | None = None,
    markers: str | Path | None = None,
    pictures: str | Path | None = None,
    without: Sequence[str] = (),
    fps: float | None = None,
    on: int | None = None,
    hold: str | None = None,
) -> Performance:
    """Return a line animated on a character.

    Parameters
    ----------
    speech : Speech
        From :func:`say`, :func:`align`, :func:`recognise`, :func:`hear` or :func:`from_labels`.
    engine : str
        ``"bigram"``; ``"motion"``, which searches a ``database``; ``"neural"``, which hears
        the sound by a ``model`` and needs no phones; or ``"auto"``, which chooses between the
        first and the last, and says why.
    bigram_set : str or path, optional
        A set that comes with Lipwright, or a file; else the character's, else English. With
        the motion engine: in whose poses its motion is told.
    preset : str
        ``"default"``, ``"published"``, or one that the set brings.
    overrides : path, optional
        A file that changes single bigrams, gains or settings, on top of the character's.
    reduction : path, optional
        A file that says what phones become in the set's classes, instead of the one
        that comes with Lipwright.
    edits : path, optional
        Corrections of this line, hung on its words and phones.
    character : str or path
        ``"head"``, a character file, or a GLB, VRM or glTF file; or a character of pictures:
        ``"rhubarb"``, ``"preston_blair"``, ``"fleming_dobbs"``, or a file.
    mapping : path, optional
        A mapping file that goes before the character's own and the one found.
    rate : float
        Frames per second.
    database : path, optional
        A motion database (:mod:`lipwright.motion_takes`); else the built-in synthetic one.
    search : str
        How the motion engine searches: see
        :class:`~lipwright.engines.motion.engine.MotionEngine`.
    model : str or path, optional
        What the neural engine has learnt (:mod:`lipwright.neural_takes`), or one of the models
        that come with Lipwright: ``"whole"``, which is the default, or ``"live"``.
    controls : str, optional
        What the motion engine gives: ``"recorded"``, the takes' own channels, or ``"poses"``,
        those of the set; what the character can play, where it is not given.
    markers : path, optional
        Where a database's markers lie on the character.
    pictures : str or path, optional
        The mouth shapes that formats of held shapes use for a character with a model;
        ``"rhubarb"`` where none are given.
    without : sequence of str
        Mouth shapes that are not drawn.
    fps, on, hold : float, int, str, optional
        How mouth shapes are held, where it is not as their file says: frames per second,
        1 for ones or 2 for twos, the shortest hold (``"2 frames"``, ``"80 ms"``).

    Raises
    ------
    InputError
        If a part of it is unknown or broken.
    """
    from lipwright.character import keep_character
    from lipwright.character.pictures import choose, is_pictures
    from lipwright.character.pictures import hold as hold_pictures
    from lipwright.engines.bigram import read_edits

    of_bigrams = (overrides, reduction, edits, bigram_set if engine == "neural" else None)
    check_engine(engine, database, of_bigrams, model, (controls, markers))
    chosen = choose_engine(speech, rate, model) if engine == "auto" else None
    if chosen:
        engine, speech = chosen.engine, chosen.speech
    shapes = choose(character, pictures, mapping, without=without, fps=fps, on=on, hold=hold)
    own: str | None = ""
    if engine == "motion":
        mover = motion_engine(database, search)
        how = Acting(character, mapping, controls, bigram_set, markers)
        acted = act(mover.animate(speech, rate), speech, mover.database, how)
    elif engine == "neural":
        heard = chosen.acted if chosen else None
        acted, own = heard or act_by_ear(speech, rate, model), None
    else:
        made = engine_for(bigram_set, preset, overrides, reduction, character, speech.language)
        own = made.of.name
        acted = Acted.as_it_is(made.animate(speech, rate, read_edits(edits) if edits else ()))
    animation, end = acted.animation, max(speech.duration, speech.phones.tier.end)
    cues = cache(lambda: hold_pictures(acted.told(), shapes, end))
    if is_pictures(character):
        shapes.check_controls(animation.controls)
        return Performance(animation, speech, shapes.no_model, cues, flat=True)
    actor = keep_character(character, mapping)
    notes = [*speech.notes, *filter(None, [chosen.why if chosen else "", acted.note])]
    if acted.rig is None and (not actor.fits or actor.bigram_set != own):
        notes += filter(None, [_check(actor, animation.controls)])
    named = replace(animation, report={**animation.report, "character": actor.report()})
    told = replace(speech, notes=(*notes, *actor.notes(animation.controls, speech)))
    rig = acted.rig or partial(actor.rig, named)
    return Performance(named, told, rig, cues, curves=acted.told if acted.rig else None)


@lru_cache(maxsize=8)
def _check(actor: Character, controls: tuple[str, ...]) -> str:
    """Refuse controls that move nothing on a character; return what to say of few that do."""
    from lipwright.character.vocabulary import POSES

    if actor.fits and set(controls) <= set(POSES):
        return ""
    actor.check(controls)
    return actor.strange_to(controls)


def save(performance: Performance, *paths: str | Path) -> None:
    """Write a performance, each path in the format of its suffix; all or nothing.

    Raises
    ------
    InputError
        If a suffix is unknown.
    OutputError
        If a file cannot be written.
    """
    from lipwright.export import save as write

    write(performance, *paths)


def check_labels(*paths: str | Path) -> None:
    """Refuse names of label files that could not be written, before any work is spent."""
    from lipwright.export import check_outputs
    from lipwright.schedule.labels import WRITERS

    check_outputs(paths, tuple(WRITERS))


def save_labels(speech: Speech, *paths: str | Path) -> None:
    """Write the phones and words of speech, each path in the format of its suffix.

    Raises
    ------
    InputError
        If a suffix is unknown (.TextGrid .lab .ctm .phn .json).
    OutputError
        If a file cannot be written.
    """
    from lipwright.files import STANDARD_STREAM, write_all
    from lipwright.schedule.labels import write_labels

    check_labels(*paths)
    encoded = []
    for path in paths:
        suffix = ".json" if str(path) == STANDARD_STREAM else Path(path).suffix.lower()
        encoded.append((path, write_labels(speech, suffix)))
    write_all(encoded)


def fit_set(
    folder: str | Path,
    *,
    text: str | Path | None = None,
    base: str | Path = "english",
    name: str = "fitted",
    as_scored: bool = False,
    progress: Progress | None = None,
) -> tuple[BigramSet, FitReport]:
    """Return a bigram set fitted to recorded faces, and what it rests on.

    See :func:`lipwright.recorded_database.takes_to_fit` for the folder and ``text``, and
    :func:`lipwright.recorded.fit_set` for the rest.
    """
    from lipwright import recorded
    from lipwright.recorded_database import takes_to_fit

    def half(first: float) -> Progress | None:
        return (lambda share: progress(first + share / 2)) if progress else None

    takes = takes_to_fit(folder, text, base, half(0.0))
    return recorded.fit_set(takes, base=base, name=name, as_scored=as_scored, progress=half(0.5))
