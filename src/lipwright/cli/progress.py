"""Progress on standard error: only on a terminal, only for what takes over a second."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

PATIENCE = 1.0


class _Bar:
    """A bar that appears only when a job has taken a while."""

    def __init__(self, what: str) -> None:
        self.what = what
        self.began = time.monotonic()
        self.shown: tuple[Progress, TaskID] | None = None

    def update(self, share: float) -> None:
        if self.shown is None:
            if time.monotonic() - self.began < PATIENCE:
                return
            self.shown = self._start()
        progress, task = self.shown
        progress.update(task, completed=share)

    def _start(self) -> tuple[Progress, TaskID]:
        from rich.console import Console  # over 50 ms to import: only when it is shown
        from rich.progress import Progress

        progress = Progress(console=Console(stderr=True), transient=True)
        progress.start()
        return progress, progress.add_task(self.what, total=1.0)

    def close(self) -> None:
        if self.shown is not None:
            self.shown[0].stop()


@contextmanager
def progress(what: str) -> Iterator[Callable[[float], None] | None]:
    """Give a function to call with the share that is done, or None off a terminal."""
    if not sys.stderr.isatty():
        yield None
        return
    bar = _Bar(what)
    try:
        yield bar.update
    finally:
        bar.close()
