"""All that was open, step by step: undo and redo without limit.

States are immutable and share what did not change, so that a step costs little.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Generic, TypeVar

T = TypeVar("T")


@dataclass(slots=True)
class Steps(Generic[T]):
    """States in order, and which of them is now.

    Parameters
    ----------
    first : T
        What was opened.
    """

    first: T
    _states: list[T] = field(init=False)
    _names: list[str] = field(init=False)
    _now: int = 0
    _merge: str = ""

    def __post_init__(self) -> None:
        self._states = [self.first]
        self._names = [""]

    @property
    def now(self) -> T:
        """The state that is open."""
        return self._states[self._now]

    @property
    def undo_name(self) -> str:
        """What undo would take back; nothing where there is nothing."""
        return self._names[self._now]

    @property
    def redo_name(self) -> str:
        """What redo would do again."""
        return self._names[self._now + 1] if self.redo_steps else ""

    @property
    def undo_steps(self) -> int:
        """How many steps can be taken back."""
        return self._now

    @property
    def redo_steps(self) -> int:
        """How many steps can be done again."""
        return len(self._states) - 1 - self._now

    def do(self, state: T, name: str, merge: str = "") -> None:
        """Go on to a state; what was undone is forgotten.

        Parameters
        ----------
        state : T
        name : str
            What was done, in words.
        merge : str
            A name for what belongs together: a step with the last one's name takes its place.
        """
        del self._states[self._now + 1 :], self._names[self._now + 1 :]
        if merge and merge == self._merge and self._now:
            self._states[self._now], self._names[self._now] = state, name
            return
        self._states.append(state)
        self._names.append(name)
        self._now += 1
        self._merge = merge

    def undo(self, steps: int = 1) -> int:
        """Go back; return by how many steps."""
        gone = min(max(steps, 0), self.undo_steps)
        self._now -= gone
        self._merge = "" if gone else self._merge
        return gone

    def redo(self, steps: int = 1) -> int:
        """Go forward again; return by how many steps."""
        gone = min(max(steps, 0), self.redo_steps)
        self._now += gone
        self._merge = "" if gone else self._merge
        return gone

    def names_of_done(self) -> list[str]:
        """Return what was done and not taken back, the last first."""
        return self._names[self._now : 0 : -1]
