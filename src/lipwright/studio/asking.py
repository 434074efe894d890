"""Requests and their answers: what each message of a page does to a session.

What takes long is a :class:`Job`: its work touches nothing of the session and may run in a
thread; what comes of it is put in afterwards, by whoever runs the session.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import msgspec

from lipwright.errors import InputError, LipwrightError
from lipwright.studio import messages
from lipwright.studio.changes import AddLine
from lipwright.studio.line_views import why_view
from lipwright.studio.lines import line_of
from lipwright.studio.messages import Answer, Failed, Made, PoseView, Request, Saved
from lipwright.studio.needs import coverage_view, lines_of_session, spoken
from lipwright.studio.page_views import Board, Watcher
from lipwright.studio.session import Session
from lipwright.studio.speaking import example_line, heard, said

Progress = Callable[[float], None]
EXAMPLES = 64


@dataclass(frozen=True, slots=True)
class Job:
    """Work that takes long.

    Parameters
    ----------
    what : str
        In words, for the page.
    work : function
        Does it; it is given a function to be called with the share that is done.
    done : function
        Puts what came of it into the session, and returns what to say.
    """

    what: str
    work: Callable[[Progress], Any]
    done: Callable[[Any], Reply]


@dataclass(frozen=True, slots=True)
class Reply:
    """What a request leads to.

    Parameters
    ----------
    own : tuple of Answer
        For the page that asked.
    everyone : tuple of Answer
        For every page, the asking one included.
    changed : bool
        Whether every page is due to hear what became different.
    job : Job, optional
    """

    own: tuple[Answer, ...] = ()
    everyone: tuple[Answer, ...] = ()
    changed: bool = False
    job: Job | None = None


@dataclass(slots=True)
class Studio:
    """A session and what its pages ask of it.

    Parameters
    ----------
    session : Session
    """

    session: Session
    board: Board = field(init=False)

    def __post_init__(self) -> None:
        self.board = Board(self.session)

    def ask(self, watcher: Watcher, request: Request) -> Reply:
        """Return what a request leads to; what cannot be done changes nothing."""
        try:
            return self._ask(watcher, request)
        except LipwrightError as error:
            return Reply((Failed(error=str(error)),))

    def finish(self, job: Job, result: Any) -> Reply:
        """Put what came of a job into the session."""
        if isinstance(result, LipwrightError):
            return Reply((Failed(error=str(result)),))
        try:
            return job.done(result)
        except LipwrightError as error:
            return Reply((Failed(error=str(error)),))

    def _ask(self, watcher: Watcher, request: Request) -> Reply:
        session = self.session
        match request:
            case messages.Start(session=name):
                return self._start(name)
            case messages.EditRequest(change=change, merge=merge):
                session.edit(change, merge)
                return Reply(changed=True)
            case messages.Undo(steps=steps):
                session.undo(steps)
                return Reply(changed=True)
            case messages.Redo(steps=steps):
                session.redo(steps)
                return Reply(changed=True)
            case messages.Draft(take=take):
                session.take_draft() if take else session.drop_draft()
                return Reply(everyone=(self.board.hello(),), changed=True)
            case messages.Watch():
                watcher.watch(request)
                return Reply(tuple(watcher.all_news()))
            case messages.TryPose(weights=weights):
                return Reply((PoseView(channels=session.actor.pose(weights)),))
            case messages.Why():
                return self._why(request)
            case messages.Preview() | messages.Save() | messages.Reread():
                return self._file(request)
            case _:
                return Reply(job=self._job(request))

    def _start(self, name: str) -> Reply:
        if self.session.left is not None and name == self.session.id:
            self.session.take_draft()
            return Reply((self.board.hello(),), changed=True)
        return Reply((self.board.hello(),))

    def _why(self, request: messages.Why) -> Reply:
        line, motion = self.session.line(request.line), self.session.motion(request.line)
        assert motion.engine is not None
        assert motion.solved is not None
        view = why_view(motion.engine, motion.solved, line, request.control, request.time)
        return Reply((view,))

    def _file(self, request: messages.Preview | messages.Save | messages.Reread) -> Reply:
        session, place = self.session, (request.document, request.line)
        match request:
            case messages.Preview(name=name):
                return Reply((session.desk.preview(place, session.state, name),))
            case messages.Reread(keep=keep):
                session.reread(place, keep=keep)
                return Reply(everyone=(self.board.hello(),), changed=True)
            case messages.Save(name=name, digest=seen):
                path = session.save(place, name, seen)
                if path is None:
                    return Reply((session.desk.preview(place, session.state, name),))
                files = session.desk.infos(session.state)
                saved = Saved(document=place[0], line=place[1], path=path, files=files)
                return Reply(everyone=(saved,), changed=True)

    # --- what takes long ---

    def _job(self, request: Request) -> Job:
        match request:
            case messages.Say():
                return Job(
                    "speaking", lambda _: said(request), self._add_line(request.text, request.line)
                )
            case messages.Hear():
                sounds = self.session.sounds
                sound = sounds.load(request.sound)
                title = request.title or request.text
                done = self._add_line(title, request.line)
                return Job("listening", lambda told: heard(request, sound, told), done)
            case messages.Example(pair=pair):
                return self._example(pair)
            case messages.CoverageRequest():
                return self._coverage(request)
            case messages.ChooseCharacter(name=name):
                return self._character(name)
        raise InputError(f"nothing to do for {type(request).__name__}")

    def _add_line(self, title: str, name: str) -> Callable[[Any], Reply]:
        """Return what makes a new line of speech, or puts it in the place of one."""
        if name:
            self.session.line(name)

        def done(speech: Any) -> Reply:
            session = self.session
            line = line_of(speech, session.sounds, name or session.next_line(), title)
            if name:
                line = msgspec.structs.replace(line, edits=session.line(name).edits)
            session.edit(AddLine(line))
            return Reply((Made(line=line.id),), changed=True)

        return done

    def _example(self, pair: tuple[str, str]) -> Job:
        session = self.session
        bigram = session.cast.of.bigrams.get(pair)
        word = bigram.word if bigram else ""
        of = session.cast.of

        def done(found: Any) -> Reply:
            view, speech = found
            session.examples[view.line] = line_of(speech, session.sounds, view.line, view.word)
            while len(session.examples) > EXAMPLES:
                session.examples.pop(next(iter(session.examples)))
            return Reply((view,))

        return Job("speaking", lambda _: example_line(of, pair, word), done)

    def _coverage(self, request: messages.CoverageRequest) -> Job:
        session = self.session
        of, lines = session.cast.of, lines_of_session(session)

        def work(told: Progress) -> Any:
            return spoken(of, request, lines, told)

        def done(found: Any) -> Reply:
            counted = {need.pair: need.share for need in found.needs()}
            session.counted = counted if request.every or request.text else None
            edits = session.edits_by_pair()
            return Reply((coverage_view(found, request, edits, self.board.cells()),), changed=True)

        return Job("counting pairs", work, done)

    def _character(self, name: str) -> Job:
        session, poses = self.session, self.session.state.own.of.rules.names
        actor = session.actor_of(name)

        def done(view: Any) -> Reply:
            session.choose(actor)
            return Reply(everyone=(view,), changed=True)

        return Job("fitting the character", lambda _: actor.view("a", poses), done)
