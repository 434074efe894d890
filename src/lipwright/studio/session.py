"""A session: everything that is open in one studio, with no network in it.

Every change is put into the journal before anybody hears of it. A journal that is played
again gives the same states, byte for byte.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from pathlib import Path

from lipwright.character import BUILT_IN
from lipwright.engines.bigram import BigramEngine
from lipwright.engines.bigram.edits import find
from lipwright.engines.bigram.model import BigramSet, Pair
from lipwright.errors import InputError
from lipwright.studio.actors import Actor
from lipwright.studio.applying import applied, describe
from lipwright.studio.cast import cast
from lipwright.studio.changes import AddLine, AnyChange, LineData, Target
from lipwright.studio.desk import Desk, Place
from lipwright.studio.drafts import (
    Did,
    Draft,
    Opened,
    Record,
    Redid,
    Reread,
    Undid,
    Wrote,
)
from lipwright.studio.history import Steps
from lipwright.studio.line_views import edited_pairs
from lipwright.studio.lines import Sounds, tier_of
from lipwright.studio.messages import DraftInfo, History
from lipwright.studio.motion import Motion, Motions
from lipwright.studio.needs import Needs
from lipwright.studio.opening import Given, Sorted, first_state, make_lines
from lipwright.studio.state import State


class Session:
    """What is open.

    Parameters
    ----------
    given : Given
        What was named.
    found : Sorted
        The same by kind.
    draft : Draft
        Where changes are kept.
    folder : Path
        Where new files come to lie.
    files : dict of (document, line) to bytes
        Contents of the files that were opened.
    paths : dict of (document, line) to str
        And where they lie.
    told : function
        Called with what is worked on, where that takes long.
    """

    def __init__(
        self,
        given: Given,
        found: Sorted,
        draft: Draft,
        folder: Path,
        files: dict[Place, bytes],
        paths: dict[Place, str],
        told: Callable[[str], None] = lambda _: None,
    ) -> None:
        self.given, self.found, self.draft, self.folder = given, found, draft, folder
        self._files, self._paths = files, paths
        self.sounds = Sounds(draft)
        self.motions = Motions(self.sounds)
        name = found.character or "head"
        self.actor = Actor(name, name)
        self.actors = {name: self.actor}
        self.kept: dict[str, BigramEngine] = {}
        self.examples: dict[str, LineData] = {}
        self.needs = Needs()
        self.counted: Mapping[Pair, float] | None = None
        self.revision = 0
        self._left: list[Record] = draft.read()
        self.left: Opened | None = None
        self.id = ""
        if self._left and isinstance(self._left[0], Opened):
            self._look_at(self._left[0])
        if self.left is None:
            self._open(make_lines(given, found, self.sounds, told))
            self.begin()

    # --- opening ---

    def _look_at(self, opened: Opened) -> None:
        """Play what was left, to see whether anything of it was not saved."""
        self.left = opened
        self._replay()
        state, steps = self.state, self.steps
        self._left_steps, self._left_summary = (
            steps.undo_steps,
            "; ".join(steps.names_of_done()[:3]),
        )
        worth = self.desk.dirty(state) or list(state.lines) != list(steps.first.lines)
        if worth and steps.undo_steps:
            self.id = opened.session
            self._open(list(opened.lines))
        else:
            self._left, self.left = [], None

    def _open(self, lines: list[LineData], files: dict[Place, bytes] | None = None) -> None:
        files = self._files if files is None else files
        contents = {place[0]: content for place, content in files.items() if not place[1]}
        bare = first_state(self.found, {str(name): data for name, data in contents.items()})
        first = State(bare.own, bare.overrides, {line.id: line for line in lines})
        self.parts = self.actor.parts(first.own.of.phone_set, self.found.overrides)
        self.steps = Steps(first)
        self._lines_made = len(lines)
        self.desk = Desk(self.folder, first, self._paths, files, self.found.character)
        self.opened = self.cast = cast(first, self.parts, self.given.preset)
        self.touched()

    def begin(self) -> None:
        """Begin a journal of our own; what an earlier studio left is moved aside."""
        files = {"/".join(place): data.decode("utf-8") for place, data in self._files.items()}
        self.id = self.draft.begin(files, tuple(self.state.lines.values())).session
        self._left, self.left = [], None

    @property
    def offer(self) -> DraftInfo | None:
        """What an earlier studio left and nobody has decided about."""
        if self.left is None:
            return None
        from datetime import UTC, datetime

        when = datetime.fromtimestamp(self.draft.path.stat().st_mtime, UTC)
        return DraftInfo(self._left_steps, when.isoformat(timespec="seconds"), self._left_summary)

    def take_draft(self) -> None:
        """Go on where the earlier studio ended."""
        if self.left is None:
            raise InputError("no draft is left to decide about")
        self.id = self.left.session
        self._replay()
        self.draft.resume(self._left)
        self._left, self.left = [], None
        self.revision += 1

    def drop_draft(self) -> None:
        """Begin anew; what was left is moved aside."""
        if self.left is None:
            raise InputError("no draft is left to decide about")
        self.begin()
        self.revision += 1

    def _replay(self) -> None:
        assert self.left is not None
        files: dict[Place, bytes] = {}
        for name, text in self.left.files.items():
            document, _, line = name.partition("/")
            files[(document, line)] = text.encode()  # type: ignore[index]
        self._open(list(self.left.lines), files)
        for record in self._left[1:]:
            try:
                self._play(record)
            except InputError:
                break  # made by another version: what came before it still stands
        self.recast()

    def _play(self, record: Record) -> None:
        match record:
            case Did(change=change, merge=merge):
                self._do(change, merge)
            case Undid(steps=steps):
                self.steps.undo(steps)
            case Redid(steps=steps):
                self.steps.redo(steps)
            case Wrote(document=document, line=line, path=path, content=content):
                self.desk.wrote((document, line), self.state, path, content.encode())
            case Reread(document=document, line=line, content=content, keep=keep):
                self._reread((document, line), content.encode(), keep=keep)

    # --- now ---

    @property
    def state(self) -> State:
        """What is open now."""
        return self.steps.now

    @property
    def history(self) -> History:
        """What can be taken back and done again."""
        steps = self.steps
        return History(steps.undo_name, steps.redo_name, steps.undo_steps, steps.redo_steps)

    def line(self, name: str) -> LineData:
        """Return a line, or an example.

        Raises
        ------
        InputError
            If there is none of that name.
        """
        line = self.state.lines.get(name) or self.examples.get(name)
        if line is None:
            raise InputError(f"no line {name!r}", expected="one that is open")
        return line

    def motion(self, name: str) -> Motion:
        """Return how a line moves now."""
        line = self.line(name)
        return self.motions.of(self.cast.engine, line, self.actor, line.edits)

    def lost(self, line: LineData) -> int:
        """Return how many edits of a line do not find their phone."""
        if not line.edits:
            return 0
        return len(find(line.edits, tier_of(line.phones).intervals, tier_of(line.words))[1])

    def need(self) -> Mapping[Pair, float]:
        """Return how often each pair is needed: by what was counted last, else the open lines."""
        if self.counted is not None:
            return self.counted
        return self.needs.shares(self.cast.of, self.state.lines)

    def edits_by_pair(self) -> tuple[Counter[Pair], Counter[Pair]]:
        """Return how many edits lie in each pair, and in how many lines."""
        edits: Counter[Pair] = Counter()
        lines: Counter[Pair] = Counter()
        for name, line in self.state.lines.items():
            if line.edits:
                solved = self.motion(name).solved
                found = edited_pairs(solved) if solved else Counter()
                edits += found
                lines += Counter(dict.fromkeys(found, 1))
        return edits, lines

    # --- changes ---

    def _check_decided(self) -> None:
        if self.left is not None:
            raise InputError(
                f"an earlier studio left {self._left_steps} changes that were not saved",
                cure="take them, or drop them, first",
            )

    def edit(self, change: AnyChange, merge: str = "") -> None:
        """Do a change.

        Raises
        ------
        InputError
            If it makes no sense; then nothing has changed.
        """
        self._check_decided()
        after = applied(self.state, change, self._beneath)
        made = cast(after, self.parts, self.given.preset, self.cast)
        self.draft.append(Did(change, merge))
        self._step(after, change, merge)
        self.cast = made
        self.touched()

    def _do(self, change: AnyChange, merge: str) -> None:
        self._step(applied(self.state, change, self._beneath), change, merge)

    def _step(self, after: State, change: AnyChange, merge: str) -> None:
        known = self.state.lines
        self.steps.do(after, describe(change), merge)
        if isinstance(change, AddLine) and change.line.id not in known:
            self._lines_made += 1
            self.desk.begin_line(change.line.id, after)

    def next_line(self) -> str:
        """Return a name that no line has or had."""
        return f"{self._lines_made + 1}"

    def _beneath(self) -> BigramSet:
        """The set that overrides lie on: it is made only where a change asks for it."""
        if self.cast.state is not self.state:
            self.recast()
        return self.cast.under

    def undo(self, steps: int) -> None:
        """Take back steps."""
        self._check_decided()
        gone = min(steps, self.steps.undo_steps)
        if gone > 0:
            self.draft.append(Undid(gone))
            self.steps.undo(gone)
            self.recast()

    def redo(self, steps: int) -> None:
        """Do steps again."""
        self._check_decided()
        gone = min(steps, self.steps.redo_steps)
        if gone > 0:
            self.draft.append(Redid(gone))
            self.steps.redo(gone)
            self.recast()

    def recast(self) -> None:
        """Make the engine of what is open now."""
        if self.cast.state is not self.state:
            self.cast = cast(self.state, self.parts, self.given.preset, self.cast)
        self.touched()

    def touched(self) -> None:
        """Count that something is different."""
        self.revision += 1

    @property
    def target(self) -> Target:
        """Where a page draws until it is told otherwise: the set, where it is the user's own."""
        is_own = ("set", "") in self._files and not self.found.overrides
        return "set" if is_own and not self.found.character else "overrides"

    @property
    def engines(self) -> tuple[str, ...]:
        """The engines that a line can be held beside."""
        return ("bigram", "motion", "neural")

    @property
    def models(self) -> tuple[str, ...]:
        """Characters beside the built-in ones: the one that was opened, those that were sent."""
        named = [self.found.character] if self.found.character not in ("", *BUILT_IN) else []
        folder = self.draft.folder / "models"
        return (*named, *sorted(path.name for path in folder.glob("*")))

    def actor_of(self, name: str) -> Actor:
        """Return a character: a built-in one, the one that was opened, or one that was sent.

        Raises
        ------
        InputError
            If there is no such character, or it cannot move a mouth.
        """
        known = (*BUILT_IN, *self.models)
        if name not in known:
            raise InputError(f"no character {name!r}", expected=", ".join(known))
        if name not in self.actors:
            sent = self.draft.folder / "models" / name
            is_sent = name not in BUILT_IN and name != self.found.character
            self.actors[name] = Actor(name, str(sent) if is_sent else name)
        return self.actors[name]

    def choose(self, actor: Actor) -> None:
        """Let another character speak; what it changes of the set comes with it."""
        parts = actor.parts(self.state.own.of.phone_set, self.found.overrides)
        made = cast(self.state, parts, self.given.preset)
        self.opened = cast(self.steps.first, parts, self.given.preset)
        self.actor, self.parts, self.cast = actor, parts, made
        self.touched()

    def save(self, place: Place, name: str, seen: str) -> str | None:
        """Write a document; return its path, or None where its file is another by now."""
        self._check_decided()
        written = self.desk.save(place, self.state, name, seen)
        if written is None:
            return None
        path, content = written
        self.draft.append(Wrote(place[0], place[1], path, content.decode("utf-8")))
        return path

    def reread(self, place: Place, *, keep: bool) -> None:
        """Take a document as it is on disk, with our changes over it where they are kept."""
        self._check_decided()
        content = self.desk.content_on_disk(place, self.state)
        self._reread(place, content, keep=keep)
        self.draft.append(Reread(place[0], place[1], content.decode("utf-8"), keep))
        self.recast()

    def _reread(self, place: Place, content: bytes, *, keep: bool) -> None:
        after = self.desk.reread(place, self.state, content, keep=keep)
        cast(after, self.parts, self.given.preset)
        self.steps.do(after, "take in what is on disk")

    def close(self) -> None:
        """End: a draft stays only where something was not saved."""
        unchanged = list(self.state.lines) == list(self.steps.first.lines)
        if self.left is None and unchanged and not self.desk.dirty(self.state):
            self.draft.close()
