"""Languages that come with a paragraph of everyday speech, to speak, count and test with.

Each is a text in ``data/languages``, named by the code of its voice; lines that begin
with ``#`` are not part of it. The first of them names the language.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

from lipwright.errors import InputError
from lipwright.files import decode_text, read_bytes
from lipwright.phones.sets import DATA

_FOLDER = DATA.parent / "languages"
_OTHER_NAMES = {"zh": "cmn", "no": "nb", "jp": "ja"}


def languages() -> tuple[str, ...]:
    """Return the codes of the languages that have a paragraph: ``"af"``, ``"ar"`` and so on."""
    return tuple(sorted(path.stem for path in _FOLDER.glob("*.txt")))


def language_name(code: str) -> str:
    """Return what a language is called in English.

    Raises
    ------
    InputError
        If it has no paragraph.

    Examples
    --------
    >>> language_name("pt-br"), language_name("zh")
    ('Portuguese', 'Mandarin')
    """
    return _lines(_file(code))[0].removeprefix("#").split(",")[0].strip()


def sample_text(code: str) -> str:
    """Return a paragraph of everyday speech in a language, a sentence per line.

    Parameters
    ----------
    code : str
        As the voices are named; a region (``"pt-br"``) has its language's paragraph.

    Raises
    ------
    InputError
        If there is no paragraph in that language.

    Examples
    --------
    >>> sample_text("de").splitlines()[0]
    'Am Samstag geht Johanna früh zum Markt an der alten Brücke.'
    """
    return "\n".join(line for line in _lines(_file(code)) if not line.startswith("#"))


def _file(code: str) -> Path:
    spelled = code.strip().lower().replace("_", "-").split("+")[0]
    base = spelled.split("-")[0]
    for name in (spelled, base, _OTHER_NAMES.get(base, base)):
        if name in languages():
            return _FOLDER / f"{name}.txt"
    raise InputError(
        f"no paragraph in the language {code!r}",
        expected=f"one of {' '.join(languages())}",
        cure="give a text of your own",
    )


@cache
def _lines(path: Path) -> tuple[str, ...]:
    return tuple(decode_text(read_bytes(path), str(path)).splitlines())
