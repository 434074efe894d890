"""What a studio is opened with: names from the command line become a first state.

Built-in names and files of any kind may be named in any order: the content of a JSON file
says what it is. Work that takes long (putting words in time) is done here, once; a draft
keeps what came of it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import msgspec

from lipwright.animation import FORMAT as ANIMATION
from lipwright.animation import Animation
from lipwright.casting import DEFAULT_SET, character_file
from lipwright.character import set_of
from lipwright.engines.bigram.documents import OVERRIDES_FORMAT, SET_FORMAT
from lipwright.engines.bigram.edits import FORMAT as EDITS
from lipwright.engines.bigram.edits import edits_from
from lipwright.engines.bigram.overrides import Overrides, overrides_from
from lipwright.engines.bigram.set_file import built_in_sets
from lipwright.errors import InputError
from lipwright.files import decode_text, parse_json, read_bytes
from lipwright.speech import Speech
from lipwright.studio.changes import LineData
from lipwright.studio.lines import Sounds, line_of
from lipwright.studio.state import OwnSet, State

CHARACTER = "lipwright/character"
SPEECH = "lipwright/speech"
LABELS = (".textgrid", ".lab", ".ctm", ".phn")
SOUNDS = (".wav", ".flac", ".ogg", ".opus", ".mp3", ".aiff", ".aif", ".m4a", ".mp4")


@dataclass(frozen=True, slots=True)
class Given:
    """What is named on the command line.

    Parameters
    ----------
    names : tuple of str
        Sets, overrides, characters, sounds, labels, animations, edits, folders of these.
    character, preset : str
    text, labels, language : str
        Of the one sound that is named.
    say : str
        A text that is spoken as the first line.
    model : str
        What the neural engine has learnt.
    """

    names: tuple[str, ...] = ()
    character: str = ""
    preset: str = "default"
    text: str = ""
    labels: str = ""
    language: str = "en-us"
    say: str = ""
    model: str = ""

    def key(self) -> dict[str, str]:
        """Return what tells an opening from others."""
        paths = [str(Path(name).absolute()) for name in self.names]
        rest = {name: str(getattr(self, name)) for name in self.__slots__ if name != "names"}
        return {**rest, "names": "\n".join(paths), "folder": str(Path.cwd())}


@dataclass(slots=True)
class Sorted:
    """The files among what is named, by what they are."""

    set_name: str = ""
    overrides: str = ""
    character: str = ""
    edits: list[str] = field(default_factory=list)
    sounds: list[str] = field(default_factory=list)
    labels: list[str] = field(default_factory=list)
    animations: list[str] = field(default_factory=list)


def sort_names(given: Given) -> Sorted:
    """Return what each name is.

    Raises
    ------
    InputError
        If a name is none of what can be opened, or two of a kind are named where one can be.
    """
    found = Sorted(character=given.character)
    for name in _every(given.names):
        kind = _kind(name)
        if kind in ("set_name", "overrides", "character"):
            if known := getattr(found, kind):
                what = kind.removesuffix("_name")
                raise InputError(
                    f"a second {what}: {known} and {name}", expected="one", cure="leave one out"
                )
            setattr(found, kind, name)
        else:
            getattr(found, kind).append(name)
    if not found.overrides:
        found.overrides = own_overrides(found.character)
    return found


def own_overrides(character: str) -> str:
    """Return the override file that a character file names last; nothing where it names none."""
    file = character_file(character or None)
    named = file.layers[-1].overrides if file else ()
    return named[-1] if named and isinstance(named[-1], str) else ""


def _every(names: Sequence[str]) -> Iterator[str]:
    """Yield names, and for a folder the sounds, labels and animations in it."""
    for name in names:
        path = Path(name)
        if not path.is_dir():
            yield name
            continue
        inside = sorted(one for one in path.iterdir() if one.suffix.lower() in (*SOUNDS, *LABELS))
        if not inside:
            raise InputError("no sounds or labels in it", where=name, cure="name another folder")
        yield from map(str, inside)


def _kind(name: str) -> str:
    path = Path(name)
    suffix = path.suffix.lower()
    if name in built_in_sets() and not path.exists():
        return "set_name"
    if suffix in LABELS:
        return "labels"
    if suffix in SOUNDS:
        return "sounds"
    if suffix in (".glb", ".vrm", ".gltf"):
        return "character"
    if suffix == ".json":
        return _kind_of_json(name)
    raise InputError(
        "no such set, line or character" if not path.exists() else "cannot be opened here",
        where=name,
        expected=f"a set ({', '.join(built_in_sets())} or a .json file), a sound, labels, an "
        f"animation, overrides, edits, or a character",
    )


def _kind_of_json(name: str) -> str:
    said = parse_json(read_bytes(name), name)
    kind = said.get("format", "") if isinstance(said, dict) else ""
    kinds = {
        SET_FORMAT: "set_name",
        OVERRIDES_FORMAT: "overrides",
        CHARACTER: "character",
        EDITS: "edits",
        ANIMATION: "animations",
        SPEECH: "labels",
    }
    if kind in kinds:
        return kinds[kind]
    raise InputError(f"the format {kind!r}", where=name, expected=", ".join(kinds))


def chosen_set(found: Sorted) -> str:
    """Return the set to open: the named one, else the character's, else English."""
    spec = found.character or "head"
    return found.set_name or set_of(character_file(spec), spec) or DEFAULT_SET


def first_state(found: Sorted, files: dict[str, bytes]) -> State:
    """Return the set and the overrides as their files have them.

    Parameters
    ----------
    found : Sorted
    files : dict of str to bytes
        Contents by document, ``"set"`` and ``"overrides"``: what a draft knew, or what is read.
    """
    name = chosen_set(found)
    own = OwnSet.read(files["set"], name) if "set" in files else OwnSet.on(name)
    if "overrides" in files:
        owner = found.overrides == own_overrides(found.character)
        who = Path(found.character).stem if owner else ""
        over = overrides_from(files["overrides"], found.overrides, own.of.phone_set, who)
    else:
        over = Overrides(f"{_who(found)} overrides", where="the studio")
    return State(own, over)


def _who(found: Sorted) -> str:
    return Path(found.character).stem if found.character else Path(chosen_set(found)).stem


def read_files(found: Sorted) -> dict[str, bytes]:
    """Return the content of the documents that are files."""
    files = {}
    name = chosen_set(found)
    if name.endswith(".json"):
        files["set"] = read_bytes(name)
    if found.overrides:
        files["overrides"] = read_bytes(found.overrides)
    return files


def make_lines(
    given: Given, found: Sorted, sounds: Sounds, told: Callable[[str], None] = lambda _: None
) -> list[LineData]:
    """Return the lines that are named, each with the edits that belong to it.

    Edits belong to the line whose file has their file's name (``hello.edits.json`` to
    ``hello.wav``), else to the only line.

    Raises
    ------
    InputError
        If a line cannot be read, or nobody knows which line edits belong to.
    """
    speeches = list(_speeches(given, found, told))
    lines = [
        line_of(speech, sounds, str(number), Path(name).name if name else "")
        for number, (name, speech) in enumerate(speeches, 1)
    ]
    for path in found.edits:
        number = _owner(path, [name for name, _ in speeches])
        edits = edits_from(read_bytes(path), path)
        lines[number] = msgspec.structs.replace(lines[number], edits=edits)
    return lines


def _owner(path: str, names: list[str]) -> int:
    stem = Path(path).name.removesuffix(".json").removesuffix(".edits")
    for number, name in enumerate(names):
        if name and Path(name).stem == stem:
            return number
    if len(names) == 1:
        return 0
    raise InputError(
        "edits of which line?", where=path, cure="name one line, or a line of the same name"
    )


def edits_owner(path: str, found: Sorted, given: Given) -> str:
    """Return the id of the line that a file of edits belongs to."""
    return str(_owner(path, _named(given, found)) + 1)


def _named(given: Given, found: Sorted) -> list[str]:
    said = [""] if given.say else []
    paired = {Path(path).stem for path in found.sounds}
    labels = [path for path in found.labels if Path(path).stem not in paired]
    return [*said, *found.animations, *found.sounds, *labels]


def _speeches(
    given: Given, found: Sorted, told: Callable[[str], None]
) -> Iterator[tuple[str, Speech]]:
    from lipwright import pipeline

    if given.say:
        yield "", pipeline.say(given.say, voice=given.language)
    for name in found.animations:
        yield name, _of_animation(name)
    labels = {Path(path).stem: path for path in found.labels}
    for name in found.sounds:
        beside = given.labels or labels.pop(Path(name).stem, "")
        if beside:
            yield name, pipeline.from_labels(beside, name)
        elif given.text:
            told(f"putting words in time: {name}")
            yield name, pipeline.align(name, given.text, language=given.language)
        elif (text := _text_beside(name)) is not None:
            told(f"putting words in time: {name}")
            yield name, pipeline.align(name, text, language=given.language)
        else:
            told(f"recognising words: {name}")
            yield name, pipeline.recognise(name)
    for name in labels.values():
        yield name, pipeline.from_labels(name)


def _text_beside(name: str) -> str | None:
    path = Path(name).with_suffix(".txt")
    return decode_text(read_bytes(path), str(path)).strip() if path.is_file() else None


def _of_animation(name: str) -> Speech:
    """Return the speech behind an animation, with the sound beside it where there is one."""
    animation = Animation.load(name)
    speech = Speech(animation.phones, animation.words, source="animation")
    sound = Path(name).with_suffix(".wav")
    if not sound.is_file():
        return speech
    from lipwright.sound_files import read_sound

    return replace(speech, sound=read_sound(sound))
