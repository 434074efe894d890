"""A paragraph of each language, to try its sounds on."""

from __future__ import annotations

from pathlib import Path

from lipwright.errors import InputError

_DATA = Path(__file__).parent.parent / "data" / "languages"


def languages() -> tuple[str, ...]:
    """Return the codes of the languages that have a paragraph."""
    return tuple(sorted(path.stem for path in _DATA.glob("*.txt")))


def sample_text(code: str) -> str:
    """Return the paragraph of a language.

    Raises
    ------
    InputError
        If there is none for it.
    """
    if code not in languages():
        raise InputError(f"no language {code!r}", expected=f"one of {', '.join(languages())}")
    return (_DATA / f"{code}.txt").read_text(encoding="utf-8")
