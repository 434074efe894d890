"""Every error of the package, as one tree.

::

    LipwrightError
    ├── InputError (ValueError)          the input is at fault
    │   ├── SoundError                   a sound file that cannot be read or used
    │   ├── TextError                    words that cannot be spoken or aligned
    │   ├── LabelError                   phone or word times that make no sense
    │   ├── FileFormatError              a file that breaks its own format
    │   ├── SetError                     a bigram set that cannot work
    │   └── CharacterError               a character or its mapping
    ├── OutputError (OSError)            a result that cannot be written
    └── MissingExtraError (ImportError)  a part of Lipwright that is not installed

Each message is one line that says where, what was found, what was expected, and
what to do about it, in this order. ``except lipwright.LipwrightError`` catches all;
each also derives from the built-in that a caller would think of first.
"""

from __future__ import annotations

from collections.abc import Iterable


class LipwrightError(Exception):
    """Base of all errors that Lipwright raises on purpose.

    Parameters
    ----------
    found : str
        What is wrong, in plain words.
    where : str, optional
        The path, line, or place inside a file.
    expected : str, optional
        What would have been right.
    cure : str, optional
        What the user can do about it.

    Examples
    --------
    >>> print(LipwrightError("3 samples", where="a.wav", expected="0.1 s of sound"))
    a.wav: 3 samples; expected 0.1 s of sound
    """

    def __init__(self, found: str, *, where: str = "", expected: str = "", cure: str = "") -> None:
        self.found = found
        self.where = where
        self.expected = expected
        self.cure = cure
        message = f"{where}: {found}" if where else found
        if expected:
            message += f"; expected {expected}"
        if cure:
            message += f". {cure[0].upper()}{cure[1:]}"
        super().__init__(" ".join(message.split()))

    def at(self, where: str) -> LipwrightError:
        """Return the same error with a place put before the one it has."""
        place = f"{where}: {self.where}" if self.where else where
        return type(self)(self.found, where=place, expected=self.expected, cure=self.cure)


class InputError(LipwrightError, ValueError):
    """The input is at fault."""


class SoundError(InputError):
    """A sound file that cannot be read, or holds nothing to work with."""


class TextError(InputError):
    """Words that cannot be spoken or aligned."""


class LabelError(InputError):
    """Phone or word times that make no sense."""


class FileFormatError(InputError):
    """A file that breaks its own format, or is of a version yet unknown."""


class SetError(InputError):
    """A bigram set that cannot work, or a part of it that does not exist."""


class CharacterError(InputError):
    """A character or mapping that cannot be used."""


class OutputError(LipwrightError, OSError):
    """A result that cannot be written."""


class MissingExtraError(LipwrightError, ImportError):
    """A part of Lipwright that is not installed."""

    @classmethod
    def of(cls, what: str, extra: str) -> MissingExtraError:
        """Name the ``pip install`` line that brings what is missing."""
        return cls(
            f"{what} needs a part that is not installed",
            cure=f"type: pip install 'lipwright[{extra}]'",
        )


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return the cure for a name that is nearly a known one; nothing where none is near.

    Examples
    --------
    >>> did_you_mean("opn", ["open", "wide"])
    "did you mean 'open'?"
    """
    from difflib import get_close_matches  # only who makes a mistake pays for it

    near = get_close_matches(name, list(known), 3, 0.5)
    return f"did you mean {' or '.join(map(repr, near))}?" if near else ""
