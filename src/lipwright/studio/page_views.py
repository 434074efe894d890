"""What one page is sent: everything at first, then what became different of what it watches."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Any

import msgspec

from lipwright import __version__
from lipwright.character import BUILT_IN
from lipwright.engines.bigram.model import Pair, Settings
from lipwright.engines.bigram.set_file import built_in_sets, check_label
from lipwright.phones import load_phone_set
from lipwright.phones.languages import languages
from lipwright.studio.line_views import line_name, line_part, line_view
from lipwright.studio.messages import (
    Answer,
    Cell,
    Changed,
    Hello,
    LineName,
    LineView,
    PeaksView,
    Watch,
    Watched,
)
from lipwright.studio.motion import motion_view
from lipwright.studio.packing import peaks
from lipwright.studio.session import Session
from lipwright.studio.set_views import (
    Matrix,
    Seen,
    bigram_view,
    classes_of,
    phone_view,
    poses_of,
    rules_of,
)
from lipwright.studio.variants import variant_of


class Board:
    """What all pages of a session know: so that only what differs is sent.

    Parameters
    ----------
    session : Session
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self._matrix = Matrix()
        self._changed: tuple[Cell, ...] = ()
        self._rest: dict[str, Any] = {}
        self.news()

    def cells(self) -> dict[Pair, Cell]:
        """Return the matrix as it is now."""
        self._changed += self._update()
        return self._matrix.cells

    def _update(self) -> tuple[Cell, ...]:
        session = self._session
        seen = Seen(session.need(), session.edits_by_pair()[0])
        return self._matrix.update(session.cast, session.opened, seen)

    def hello(self) -> Hello:
        """Return all that is open."""
        session = self._session
        own = session.state.own
        now = self._parts()
        return Hello(
            version=__version__,
            session=session.id,
            revision=session.revision,
            set_name=own.document.name,
            set_about=own.document.about,
            preset=session.given.preset,
            presets=tuple(dict.fromkeys(("default", "published", *own.of.presets))),
            target=session.target,
            spline=session.cast.engine.rules.settings.spline,
            classes=classes_of(own.of),
            cells=tuple(self.cells().values()),
            history=session.history,
            character=session.actor.view("a", own.of.rules.names),
            characters=(*BUILT_IN, *session.models),
            sets=built_in_sets(),
            voices=_voices(),
            engines=session.engines,
            draft=session.offer,
            **now,
        )

    def _parts(self) -> dict[str, Any]:
        session = self._session
        return {
            "rules": rules_of(session.cast, session.opened),
            "poses": poses_of(session.cast.engine.rules),
            "lines": tuple(_names(session)),
            "files": session.desk.infos(session.state),
        }

    def news(self) -> Changed:
        """Return what became different since this was last asked."""
        self._changed += self._update()
        cells, self._changed = self._changed, ()
        parts = self._parts()
        different = {k: v for k, v in parts.items() if self._rest.get(k) != v}
        self._rest = parts
        return Changed(
            revision=self._session.revision,
            history=self._session.history,
            cells=cells,
            **different,
        )


def _names(session: Session) -> Iterator[LineName]:
    for line in session.state.lines.values():
        yield line_name(line, session.lost(line))


@cache
def _voices() -> tuple[str, ...]:
    return ("en-us", *(code for code in languages() if code != "en-us"))


class Watcher:
    """What one page watches, and what it was sent of it.

    Parameters
    ----------
    session : Session
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self._watch = Watch()
        self._sent: dict[str, Any] = {}
        self._shown: LineView | None = None

    def watch(self, wanted: Watch) -> None:
        """Watch something else.

        Raises
        ------
        InputError
            If there is no such pair, phone or line; then the page watches what it did.
        """
        classes = load_phone_set(self._session.state.own.of.phone_set)
        for label in (*(wanted.pair or ()), *filter(None, [wanted.phone])):
            check_label(label, classes)
        if wanted.line:
            self._session.line(wanted.line)
        if wanted.other is not None and wanted.line:
            variant_of(self._session, wanted.other, wanted.line)
        self._watch = msgspec.structs.replace(wanted, id=0)
        self._sent = {name: one for name, one in self._sent.items() if name.startswith("peaks")}
        self._shown = None

    def all_news(self) -> Iterator[Answer]:
        """Yield what became different of what is watched, and that this is all."""
        revision = self._session.revision
        yield from self.news()
        yield Watched(revision=revision)

    def news(self) -> Iterator[Answer]:
        """Yield what became different of what is watched."""
        watch, session = self._watch, self._session
        if watch.line and (watch.line in session.state.lines or watch.line in session.examples):
            yield from self._line(watch)
        if watch.pair is not None:
            yield from self._if_new("pair", bigram_view(session.cast, watch.pair, 0))
        if watch.phone:
            yield from self._if_new("phone", phone_view(session.cast, watch.phone, 0))

    def _if_new(self, name: str, view: Any) -> Iterator[Answer]:
        if self._sent.get(name) != view:
            self._sent[name] = view
            yield msgspec.structs.replace(view, revision=self._session.revision)

    def _line(self, watch: Watch) -> Iterator[Answer]:
        session = self._session
        line, motion = session.line(watch.line), session.motion(watch.line)
        if self._differs("line", line, session.cast.of.rules.settings):
            yield self._line_or_part(line_view(line, motion, session.revision))
        if line.sound and self._differs(f"peaks {line.id}", line.sound.key):
            values, rate = peaks(session.sounds.load(line.sound.key))
            address = f"sounds/{line.sound.key}.wav"
            yield PeaksView(line=line.id, sound=address, peaks=values, per_second=rate)
        window = (watch.start, watch.end) if watch.end > watch.start else None
        seen = (watch.stages, window)
        if self._differs("a", motion, session.actor) or self._sent.get("a seen") != seen:
            self._sent["a seen"] = seen
            yield motion_view(motion, session.revision, line.id, "a", *seen, session.actor.name)
        if watch.other is not None:
            yield from self._other(watch, window)

    def _line_or_part(self, view: LineView) -> Answer:
        known, self._shown = self._shown, view
        return (line_part(known, view) if known is not None else None) or view

    def _other(self, watch: Watch, window: tuple[float, float] | None) -> Iterator[Answer]:
        assert watch.other is not None
        session = self._session
        variant = variant_of(session, watch.other, watch.line)
        if self._differs("b character", variant.actor):
            yield variant.actor.view("b", session.state.own.of.rules.names)
        if self._differs("b", variant.motion):
            yield motion_view(
                variant.motion,
                session.revision,
                watch.line,
                "b",
                watch.stages,
                window,
                variant.actor.name,
            )

    def _differs(self, name: str, *now: object) -> bool:
        """Whether these are other objects than those of the last time; small ones by value."""
        was = self._sent.get(name)
        self._sent[name] = now
        return was is None or not all(
            a is b or (isinstance(a, str | Settings) and a == b)
            for a, b in zip(was, now, strict=True)
        )
