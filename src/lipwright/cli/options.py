"""Options that several commands share, so that they read and behave alike."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import wraps
from pathlib import Path
from typing import Any

import click

Command = Callable[..., Any]


def stack(*options: Callable[[Command], Command]) -> Callable[[Command], Command]:
    """Return one decorator for several options, in the order of ``--help``."""

    def decorate(command: Command) -> Command:
        for option in reversed(options):
            command = option(command)
        return command

    return decorate


def outputs(help: str) -> Callable[[Command], Command]:
    """``-o``, several times."""
    return click.option(
        "-o", "--output", "outputs", multiple=True, required=True, metavar="FILE", help=help
    )


animation = stack(
    click.option(
        "--engine", type=click.Choice(["bigram", "motion", "neural", "auto"]), default="bigram",
        show_default=True, help="What drives the mouth; auto chooses bigram or neural.",
    ),
    click.option(
        "--database", type=click.Path(path_type=Path), metavar="DB",
        help="The recorded motion that the motion engine searches, see 'motion build'.  "
        "[default: synthetic, which is made by code]",
    ),
    click.option(
        "--search", default="several", show_default=True,
        type=click.Choice(["several", "cheapest", "optimal", "greedy", "pq"]),
        help="How the motion engine searches: the mean of several paths, of those with the "
        "fewest jumps (optimal), or one path.",
    ),
    click.option(
        "--model", metavar="MODEL",
        help="What the neural engine has learnt: a file, see 'neural train', or whole or live, "
        "which come with Lipwright.  [default: whole]",
    ),
    click.option(
        "--controls", type=click.Choice(["recorded", "poses"]),
        help="What the motion engine gives: the takes' own channels, or the poses of the set; "
        "what the character can play, where it is not given.",
    ),
    click.option(
        "--markers", type=click.Path(path_type=Path), metavar="FILE",
        help="Where a database's markers lie on the character, see 'motion bind'.",
    ),
    click.option(
        "--set", "bigram_set", metavar="SET",
        help="Bigram set: a name, or a .json file; else the character's, else english.",
    ),
    click.option(
        "--preset", default="default", show_default=True,
        help="The set's settings: default, published, or one of its own.",
    ),
    click.option(
        "--overrides", type=click.Path(path_type=Path), metavar="FILE",
        help="A file that changes single bigrams, gains or settings, on top of the character's.",
    ),
    click.option(
        "--reduction", type=click.Path(path_type=Path), metavar="FILE",
        help="What phones become in the set's classes.",
    ),
    click.option(
        "--edits", type=click.Path(path_type=Path), metavar="FILE",
        help="Corrections of this line, hung on its words and phones.",
    ),
    click.option(
        "--character", default="head", show_default=True, metavar="WHO",
        help="head, crab, a character file (.json), or a .glb, .vrm or .gltf file; or mouths to "
        "cut out: rhubarb, preston_blair, fleming_dobbs, or a file of them (.json).",
    ),
    click.option(
        "--pictures", metavar="LIST",
        help="Mouth shapes of .tsv .xml .dat for a character with a model.  [default: rhubarb]",
    ),
    click.option(
        "--without", metavar="SHAPES", help="Mouth shapes that are not drawn: G,H,X.",
    ),
    click.option("--fps", type=float, help="Frames per second of held mouth shapes."),
    click.option("--on", type=int, help="Hold mouth shapes on ones (1), twos (2) or threes (3)."),
    click.option(
        "--hold", metavar="TIME", help="The shortest hold: '2 frames', '80 ms'.",
    ),
    click.option(
        "--mapping", type=click.Path(path_type=Path), metavar="FILE",
        help="A mapping file for the character, see 'character inspect'.",
    ),
    click.option(
        "--rate", "frame_rate", type=float, default=60.0, show_default=True, metavar="FPS",
        help="Frames per second.",
    ),
)  # fmt: skip

_recording = stack(
    click.argument("sound", metavar="SOUND"),
    click.option("--text", metavar="WORDS", help="What is said in it."),
    click.option(
        "--text-file", type=click.Path(path_type=Path), metavar="FILE",
        help="A file with what is said in it.",
    ),
    click.option(
        "--labels", type=click.Path(path_type=Path), metavar="FILE",
        help="Phone times that exist: .TextGrid .lab .ctm .phn .json",
    ),
    click.option(
        "--phone-set", metavar="NAME", help="The notation of the labels, where it is not clear."
    ),
    click.option(
        "--lexicon", type=click.Path(path_type=Path), metavar="FILE",
        help="Pronunciations of unusual words: WORD  P R OH N",
    ),
    click.option(
        "--language", metavar="NAME",
        help="What --text is in, such as de or pt-br; English where it is not given.",
    ),
    click.option(
        "--by-ear", is_flag=True,
        help="Hear phones without words, in any language; words give better ones.",
    ),
)  # fmt: skip


whose = click.option(
    "--character", metavar="WHO",
    help="The set as this character has it, with what its file changes.",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Recording:
    """A recording as it is named on the command line, with what is known of it."""

    sound: str
    text: str | None
    text_file: Path | None
    labels: Path | None
    phone_set: str | None
    lexicon: Path | None
    language: str | None
    by_ear: bool

    @property
    def files(self) -> tuple[object, ...]:
        """What is read from disk."""
        return (self.sound, self.text_file, self.labels, self.phone_set, self.lexicon)


def recording(command: Command) -> Command:
    """SOUND and what goes with it, given to the command as one :class:`Recording`."""
    names = [field.name for field in fields(Recording)]

    @wraps(command)
    def bundled(**given: Any) -> Any:
        named = Recording(**{name: given.pop(name) for name in names})
        return command(recording=named, **given)

    return _recording(bundled)


as_json = click.option("--json", "as_json", is_flag=True, help="Answer for a program to read.")
