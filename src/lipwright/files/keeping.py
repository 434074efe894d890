"""What was made from files, kept until one of them changes."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Generic, Protocol, TypeVar

from lipwright.files.reading import Version, file_version


class FromFiles(Protocol):
    """Something that knows the files it was read from, in the state they were in."""

    @property
    def files(self) -> tuple[tuple[str, Version | None], ...]:
        """Paths, each with its version before it was read."""


T = TypeVar("T", bound=FromFiles)


class Kept(Generic[T]):
    """A few things that were made from files; each is made anew when a file of it changes.

    Parameters
    ----------
    most : int
        How many are kept; the one made first goes first.
    """

    def __init__(self, most: int) -> None:
        self._most = most
        self._made: dict[Hashable, T] = {}

    def get(self, key: Hashable, make: Callable[[], T]) -> T:
        """Return what is kept under a key, or make it; what fails is not kept."""
        known = self._made.get(key)
        if known is not None and all(file_version(path) == was for path, was in known.files):
            return known
        self._made.pop(key, None)
        made = make()
        while len(self._made) >= self._most:
            self._made.pop(next(iter(self._made)), None)
        self._made[key] = made
        return made
