"""How a line moves: the engine's result for one version of it, kept while nothing changes."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter
from typing import Any

from lipwright.animation import Animation
from lipwright.engines.bigram import BigramEngine, Edit
from lipwright.engines.bigram.engine import Solved
from lipwright.speech import Speech
from lipwright.studio.actors import Actor
from lipwright.studio.changes import LineData
from lipwright.studio.lines import Sounds, speech_of
from lipwright.studio.messages import MotionView, Stage, StageName
from lipwright.studio.packing import Window, frames_in, stage_curves

RATE = 60.0
KEPT = 12


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """A line animated.

    Parameters
    ----------
    animation : Animation
    channels : Animation
        Of the character's rig.
    speech : Speech
    engine : BigramEngine, optional
    solved : Solved, optional
        With its stages, where the bigram engine made it.
    notes : tuple of str
    milliseconds : float
        What it took.
    """

    animation: Animation
    channels: Animation
    speech: Speech
    engine: BigramEngine | None = None
    solved: Solved | None = None
    notes: tuple[str, ...] = ()
    milliseconds: float = 0.0


class Motions:
    """Motions of late, so that two pages, or a page and a question, do not make them twice.

    Parameters
    ----------
    sounds : Sounds
    """

    def __init__(self, sounds: Sounds) -> None:
        self._sounds = sounds
        self._kept: OrderedDict[tuple[int, ...], tuple[tuple[Any, ...], Motion]] = OrderedDict()
        self._speech: OrderedDict[int, tuple[LineData, Speech]] = OrderedDict()

    def speech(self, line: LineData) -> Speech:
        """Return a line as engines take it."""
        known = self._speech.get(id(line))
        if known is None:
            known = self._speech[id(line)] = (line, speech_of(line, self._sounds))
            while len(self._speech) > KEPT:
                self._speech.popitem(last=False)
        return known[1]

    def of(
        self, engine: BigramEngine, line: LineData, actor: Actor, edits: tuple[Edit, ...]
    ) -> Motion:
        """Return a line animated by the bigram engine."""
        return self.get(
            (engine, line, actor, edits), lambda: self._made(engine, line, actor, edits)
        )

    def get(self, key: tuple[Any, ...], make: Callable[[], Motion]) -> Motion:
        """Return what is kept for these very objects, or make it."""
        place = tuple(map(id, key))
        if place not in self._kept:
            # The objects are kept with it: while they are, nothing else has their place.
            self._kept[place] = (key, make())
            while len(self._kept) > KEPT:
                self._kept.popitem(last=False)
        self._kept.move_to_end(place)
        return self._kept[place][1]

    def _made(
        self, engine: BigramEngine, line: LineData, actor: Actor, edits: tuple[Edit, ...]
    ) -> Motion:
        begun = perf_counter()
        speech = self.speech(line)
        solved = engine.solve(speech.phones, speech.words, edits)
        animation = engine.animate_solved(solved, speech, RATE)
        channels = actor.channels(animation)
        took = 1e3 * (perf_counter() - begun)
        return Motion(animation, channels, speech, engine, solved, (), took)


def motion_view(
    motion: Motion,
    revision: int,
    line: str,
    version: str,
    stages: tuple[StageName, ...],
    window: Window | None,
    character: str,
) -> MotionView:
    """Return a motion as the page takes it."""
    curves: tuple[Stage, ...] = ()
    if motion.engine is not None and motion.solved is not None:
        engine, solved = motion.engine, motion.solved
        curves = tuple(stage_curves(engine, solved, name, window) for name in stages)
    return MotionView(
        revision=revision,
        line=line,
        version="b" if version == "b" else "a",
        controls=frames_in(motion.animation, window),
        channels=frames_in(motion.channels, window),
        stages=curves,
        character=character,
        notes=motion.notes,
        milliseconds=round(motion.milliseconds, 3),
    )
