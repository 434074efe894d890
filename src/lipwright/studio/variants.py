"""The second version of a line, to be held beside the first.

Before and after, two sets, two presets, two characters, two engines.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from time import perf_counter
from typing import TYPE_CHECKING

from lipwright.casting import engine_for
from lipwright.engines.bigram import BigramEngine
from lipwright.errors import InputError
from lipwright.studio.actors import Actor
from lipwright.studio.changes import LineData
from lipwright.studio.lines import speech_of
from lipwright.studio.messages import Variant
from lipwright.studio.motion import RATE, Motion

if TYPE_CHECKING:
    from lipwright.studio.session import Session


@dataclass(frozen=True, slots=True, eq=False)
class Other:
    """A second version: how it moves, and on whom."""

    motion: Motion
    actor: Actor


def variant_of(session: Session, wanted: Variant, name: str) -> Other:
    """Return a line in another version.

    Raises
    ------
    InputError
        If there is no such set, preset, character or engine.
    """
    line, actor = session.line(name), session.actor
    match wanted.kind:
        case "now":
            return _bigram(session, session.cast.engine, line, actor)
        case "opened":
            was = session.steps.first.lines.get(name, line)
            return _bigram(session, session.opened.engine, was, actor)
        case "unedited":
            return Other(session.motions.of(session.cast.engine, line, actor, ()), actor)
        case "set":
            engine = engine_for(wanted.value or None, character=actor.spec)
            return _bigram(session, engine, line, actor)
        case "preset":
            return _bigram(session, _preset(session, wanted.value), line, actor)
        case "character":
            return _on_another(session, line, wanted.value)
        case _:
            return Other(_by_engine(session, line, wanted.value), actor)


def _bigram(session: Session, engine: BigramEngine, line: LineData, actor: Actor) -> Other:
    """A line by another engine; edits of poses that its set has not are left out, and told."""
    names = engine.rules.names
    strange = dict.fromkeys(edit.pose for edit in line.edits if edit.pose not in names)
    if not strange:
        return Other(session.motions.of(engine, line, actor, line.edits), actor)
    key = (engine, line, actor, _KNOWN)

    def made() -> Motion:
        known = tuple(edit for edit in line.edits if edit.pose in names)
        motion = session.motions.of(engine, line, actor, known)
        note = f"edits of {', '.join(strange)} are left out: {engine.of.name} has no such pose"
        return replace(motion, notes=(*motion.notes, note))

    return Other(session.motions.get(key, made), actor)


_KNOWN = object()


def _preset(session: Session, name: str) -> BigramEngine:
    of = session.cast.of
    kept = session.kept.get("preset")
    if kept is None or kept.of is not of or kept.preset != name:
        kept = session.kept["preset"] = BigramEngine(of, name)
    return kept


def _on_another(session: Session, line: LineData, name: str) -> Other:
    actor = session.actor_of(name)
    own = actor.character.bigram_set
    engine = engine_for(None, character=actor.spec) if own else session.cast.engine
    return _bigram(session, engine, line, actor)


def _by_engine(session: Session, line: LineData, name: str) -> Motion:
    if name not in session.engines:
        raise InputError(f"no engine {name!r}", expected=" or ".join(session.engines))
    if name == "bigram":
        return session.motions.of(session.cast.engine, line, session.actor, line.edits)
    key = (line, session.actor, _NAMES[name])
    return session.motions.get(key, lambda: _performed(session, line, name))


_NAMES = {name: object() for name in ("motion", "neural")}


def _performed(session: Session, line: LineData, name: str) -> Motion:
    from lipwright import pipeline

    begun = perf_counter()
    speech = speech_of(line, session.sounds)
    performance = pipeline.animate(
        speech,
        engine=name,
        character=session.actor.spec,
        rate=RATE,
        model=session.given.model or None if name == "neural" else None,
        controls="poses" if name == "motion" else None,
    )
    shown = performance.animation
    if performance.curves is not None:
        shown = performance.curves()
    channels = session.actor.channels(shown)
    took = 1e3 * (perf_counter() - begun)
    notes = performance.speech.notes[len(speech.notes) :]
    return Motion(replace(shown), channels, speech, None, None, notes, took)
