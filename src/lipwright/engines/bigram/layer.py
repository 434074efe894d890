"""What one override file, or one character, changes of a bigram set: for those who ask why.

The set that comes of it is made in :mod:`~lipwright.engines.bigram.overrides`; this is
the record of who said what.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True, slots=True)
class Layer:
    """What one layer changes of the set beneath it.

    Parameters
    ----------
    name : str
        The override's own name.
    where : str
        Its file, and for one inside a character file the place in it.
    character : str
        The character that brought it; nothing where the user gave it.
    pairs : frozenset of pair
        The bigrams that it draws anew.
    phones : frozenset of str
        The classes whose single-phone curves it draws anew.
    gains : mapping of str to float
        What each pose's curves are multiplied by.
    poses : mapping of str to mapping
        For each pose, the numbers that it changes: ``{"open": {"limit": 8}}``.
    thresholds : mapping of frozenset of str to float
        Of two poses that exclude each other.
    settings : mapping
        The settings that it changes.
    """

    name: str
    where: str = ""
    character: str = ""
    pairs: frozenset[tuple[str, str]] = frozenset()
    phones: frozenset[str] = frozenset()
    gains: Mapping[str, float] = field(default_factory=dict)
    poses: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    thresholds: Mapping[frozenset[str], float] = field(default_factory=dict)
    settings: Mapping[str, Any] = field(default_factory=dict)

    @property
    def has_rules(self) -> bool:
        """Whether it changes how the stages work."""
        return bool(self.poses or self.thresholds or self.settings)

    @property
    def title(self) -> str:
        """Who and where, in words."""
        own = self.character in ("", self.name)
        who = self.name if own else f"{self.name} of {self.character}"
        kind = "character" if own and self.character else "overrides"
        return f"{kind} {who}, {self.where}"

    def summary(self) -> str:
        """Return what it changes, in words."""
        parts = []
        if self.pairs:
            parts.append(_listed(sorted("-".join(pair) for pair in self.pairs)))
        if self.phones:
            parts.append(f"single curves of {_listed(sorted(self.phones))}")
        parts += [f"{pose} times {gain:g}" for pose, gain in self.gains.items()]
        for pose, fields in self.poses.items():
            changes = ", ".join(f"{name} {_plain(value)}" for name, value in fields.items())
            parts.append(f"{pose}: {changes}")
        for poses, threshold in self.thresholds.items():
            parts.append(f"{' against '.join(sorted(poses))} from {threshold:g}")
        parts += [f"{name} {_plain(value)}" for name, value in self.settings.items()]
        return "; ".join(parts)


def _listed(names: list[str], most: int = 8) -> str:
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more


def _plain(value: object) -> str:
    return f"{value:g}" if isinstance(value, int | float) else str(value)
