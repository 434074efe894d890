"""Phone sets: the labels of one notation, each with an example word."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path

import msgspec

from lipwright.errors import LabelError
from lipwright.files import convert, file_version, read_document

SILENCE = "sil"
DATA = Path(__file__).parent.parent / "data" / "phones"


class Phone(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One label of a set, with a word in which it sounds: ``"aa"``, ``"f[a]ther"``.

    A set of classes may name the IPA segments that show a class (``"yu"``: ``["y", "ʏ"]``);
    other labels then go to it where it is nearest.
    """

    label: str
    example: str = ""
    ipa: tuple[str, ...] = ()


class _Document(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    version: int
    name: str
    phones: list[Phone]
    about: str = ""
    aliases: dict[str, str] = {}
    stress: bool = False
    case: bool = False
    extends: str = ""


@dataclass(frozen=True, slots=True)
class PhoneSet:
    """The labels of one notation.

    Parameters
    ----------
    name : str
        ``"arpabet"``, ``"common"``, …
    phones : tuple of Phone
        In the order in which tables show them.
    aliases : dict of str to str
        Other spellings of a label (``"hv"`` → ``"hh"``).
    stress : bool
        Whether a digit at the end of a label is a stress mark, to be dropped.
    case : bool
        Whether upper and lower case differ.
    extends : str
        The set that this one adds labels to: what reduces to that one reduces to this.
    """

    name: str
    phones: tuple[Phone, ...]
    about: str = ""
    aliases: dict[str, str] = field(default_factory=dict)
    stress: bool = False
    case: bool = False
    extends: str = ""
    labels: tuple[str, ...] = field(init=False)
    """The labels, in the order of the file."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "labels", tuple(phone.label for phone in self.phones))

    def example(self, label: str) -> str:
        """Return the example word of a label, or nothing."""
        return next((phone.example for phone in self.phones if phone.label == label), "")

    def normalise(self, label: str) -> str:
        """Return the set's own spelling of a label.

        Raises
        ------
        LabelError
            If the set has no such label.

        Examples
        --------
        >>> load_phone_set("arpabet").normalise("AH0")
        'ah'
        """
        spelled = label.strip()
        if not self.case:
            spelled = spelled.lower()
        if self.stress:
            spelled = re.sub(r"(?<=\D)[0-9]$", "", spelled)
        spelled = self.aliases.get(spelled, spelled)
        if spelled not in self.labels:
            raise LabelError(
                f"{label!r} is not a phone of {self.name!r}",
                expected=f"one of {' '.join(self.labels)}",
            )
        return spelled


def load_phone_set(name: str) -> PhoneSet:
    """Return a phone set by its name, or from a path ending in ``.json``.

    Such a file is read anew when it changes.
    """
    return _load(name, file_version(name) if name.endswith(".json") else None)


@lru_cache(maxsize=64)
def _load(name: str, version: object) -> PhoneSet:
    path = Path(name) if name.endswith(".json") else DATA / f"{name}.json"
    if not name.endswith(".json") and not path.exists():
        raise LabelError(
            f"no phone set {name!r}", expected=f"one of {', '.join(phone_set_names())}"
        )
    document = read_document(path, format="lipwright/phone-set", version=1)
    read = convert(document, _Document, str(path))
    labels = [phone.label for phone in read.phones]
    twice = {label for label in labels if labels.count(label) > 1}
    if twice:
        raise LabelError(f"{', '.join(sorted(twice))} stands twice", where=str(path))
    return PhoneSet(
        read.name,
        tuple(read.phones),
        read.about,
        read.aliases,
        read.stress,
        read.case,
        read.extends,
    )


def phone_set_names() -> tuple[str, ...]:
    """Return the names of the phone sets that come with Lipwright."""
    return tuple(sorted(p.stem for p in DATA.glob("*.json") if "-to-" not in p.stem))
