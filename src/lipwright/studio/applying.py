"""What a change does to what is open: a pure function from one state to the next.

Nothing here reads files or computes motion. A change that makes no sense is refused with
a clear error, and the state stays as it is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import msgspec

from lipwright.curves import Keys
from lipwright.engines.bigram.model import (
    Bigram,
    BigramSet,
    Conflict,
    Curves,
    Pair,
    Pose,
    Rules,
    Settings,
    check_curve,
)
from lipwright.engines.bigram.set_file import check_label
from lipwright.engines.bigram.stand_in import stand_in
from lipwright.errors import InputError, SetError, did_you_mean
from lipwright.files import convert
from lipwright.phones import SILENCE, load_phone_set
from lipwright.studio import changes
from lipwright.studio.changes import AnyChange, Key, LineData, PairName, Target
from lipwright.studio.line_changes import with_boundary, with_edit, without_edit
from lipwright.studio.state import State

DIGITS = 4
Beneath = Callable[[], BigramSet]


def applied(state: State, change: AnyChange, beneath: Beneath) -> State:
    """Return the state after a change.

    Parameters
    ----------
    state : State
    change : Change
    beneath : function
        Returns the set with the character's layers, which the overrides lie on.

    Raises
    ------
    InputError
        If the change makes no sense here.
    """
    match change:
        case changes.AddLine(line=line):
            return replace(state, lines={**state.lines, line.id: line})
        case changes.RemoveLine(line=name):
            _line(state, name)
            return replace(state, lines={k: v for k, v in state.lines.items() if k != name})
        case changes.MoveBoundary(line=name, phone=phone, time=time):
            return _with_line(state, with_boundary(_line(state, name), phone, time))
        case changes.PutEdit(line=name, edit=edit):
            _check_pose(state.own.of, edit.pose)
            return _with_line(state, with_edit(_line(state, name), edit))
        case changes.RemoveEdit(line=name, edit=edit):
            return _with_line(state, without_edit(_line(state, name), edit))
        case changes.SetRule():
            return _with_rule(state, change)
        case changes.DrawPhone():
            return _with_phone(state, change)
        case _:
            return _with_pair(state, change, beneath)


def describe(change: AnyChange) -> str:
    """Return a change in a few words, for the undo button."""
    match change:
        case changes.DrawCurve(pair=pair, pose=pose, keys=None):
            return f"take {pose} out of {'-'.join(pair)}"
        case changes.DrawCurve(pair=pair, pose=pose):
            return f"draw {pose} of {'-'.join(pair)}"
        case changes.DrawPair(pair=pair):
            return f"draw {'-'.join(pair)}"
        case changes.ClearPair(pair=pair, target=target):
            return f"clear {'-'.join(pair)} in the {target}"
        case changes.MoveMark(pair=pair):
            return f"move the mark of {'-'.join(pair)}"
        case changes.NameWord(pair=pair):
            return f"name the word of {'-'.join(pair)}"
        case changes.DrawPhone(phone=phone, pose=pose):
            return f"draw {pose} of the phone {phone}"
        case changes.SetRule(names=names, field=field, kind=kind):
            return f"set {' '.join(filter(None, [*names, field or kind]))}"
        case changes.AddLine(line=line):
            return f"add the line {line.title!r}"
        case changes.RemoveLine():
            return "remove a line"
        case changes.MoveBoundary():
            return "move a boundary"
        case changes.PutEdit(edit=edit):
            return f"edit {edit.name}"
        case changes.RemoveEdit(edit=edit):
            return f"remove the edit of {edit.name}"


def _line(state: State, name: str) -> LineData:
    if name not in state.lines:
        raise InputError(f"no line {name!r}", expected="one that is open")
    return state.lines[name]


def _with_line(state: State, line: LineData) -> State:
    return replace(state, lines={**state.lines, line.id: line})


def _check_pose(of: BigramSet, pose: str) -> None:
    names = of.rules.names
    if pose not in names:
        raise SetError(
            f"unknown pose {pose!r}",
            expected=f"one of {', '.join(names)}",
            cure=did_you_mean(pose, names),
        )


def tidy(keys: tuple[Key, ...], where: str) -> Keys:
    """Return keys as a file would hold them: four decimals, and no two of one time."""
    rounded = [(round(time, DIGITS) + 0.0, round(value, DIGITS) + 0.0) for time, value in keys]
    try:
        return Keys.of(rounded)
    except InputError as error:
        raise error.at(where) from None


# --- pairs ---


def _with_pair(state: State, change: Any, beneath: Beneath) -> State:
    pair: PairName = change.pair
    classes = load_phone_set(state.own.of.phone_set)
    for label in pair:
        check_label(label, classes)
    if pair == (SILENCE, SILENCE):
        raise SetError("silence after silence is no pair")
    if isinstance(change, changes.ClearPair):
        return _cleared(state, change.target, pair)
    known = _as_drawn(state, change.target, pair, beneath)
    return _put(state, change.target, _redrawn(known, change, state.own.of))


def _as_drawn(state: State, target: Target, pair: Pair, beneath: Beneath) -> Bigram:
    """What drawing in a target begins with: what it says, else what is seen beneath it."""
    if target == "overrides":
        under = state.overrides.bigrams.get(pair)
        of = state.own.of if under is not None else beneath()
    else:
        under, of = None, state.own.of
    return under or of.bigrams.get(pair) or stand_in(of, pair)


def _redrawn(known: Bigram, change: Any, of: BigramSet) -> Bigram:
    where = f"bigram {'-'.join(known.pair)}"
    match change:
        case changes.DrawCurve(pose=pose, keys=keys):
            _check_pose(of, pose)
            curves = dict(known.curves)
            curves.pop(pose, None) if keys is None else curves.__setitem__(
                pose, tidy(keys, f"{where}, pose {pose!r}")
            )
            return replace(known, curves=_ordered(curves, of))
        case changes.DrawPair(curves=drawn, boundary=boundary, word=word):
            for pose in drawn:
                _check_pose(of, pose)
            curves = {p: tidy(keys, f"{where}, pose {p!r}") for p, keys in drawn.items()}
            return replace(
                known,
                curves=_ordered(curves, of),
                boundary=known.boundary if boundary is None else round(boundary, DIGITS),
                word=known.word if word is None else word,
            )
        case changes.MoveMark(boundary=boundary):
            return replace(known, boundary=round(boundary, DIGITS))
        case _:
            return replace(known, word=change.word)


def _ordered(curves: Mapping[str, Keys], of: BigramSet) -> Curves:
    return {pose: curves[pose] for pose in of.rules.names if pose in curves}


def _put(state: State, target: Target, drawn: Bigram) -> State:
    pair = drawn.pair
    labels = load_phone_set(state.own.of.phone_set).labels
    if target == "overrides":
        over = state.overrides
        drawn = replace(drawn, source=over.name)
        placed = _inserted(over.bigrams, drawn, labels)
        return replace(state, overrides=replace(over, bigrams=placed))
    own = state.own
    drawn = replace(drawn, source=own.document.name)
    of = replace(own.of, bigrams={**own.of.bigrams, pair: drawn})
    placed = _inserted(own.bigrams, drawn, labels)
    return replace(state, own=replace(own, of=of, bigrams=placed))


def _inserted(
    bigrams: Mapping[Pair, Bigram], new: Bigram, labels: tuple[str, ...]
) -> dict[Pair, Bigram]:
    """Put a pair where it stood, or behind the one before it in the phone set's order."""
    if new.pair in bigrams:
        return {**bigrams, new.pair: new}

    def rank(pair: Pair) -> int:
        return labels.index(pair[0]) * len(labels) + labels.index(pair[1])

    before = max((p for p in bigrams if rank(p) < rank(new.pair)), key=rank, default=None)
    placed: dict[Pair, Bigram] = {} if before is not None else {new.pair: new}
    for pair, one in bigrams.items():
        placed[pair] = one
        if pair == before:
            placed[new.pair] = new
    return placed


def _cleared(state: State, target: Target, pair: Pair) -> State:
    if target == "overrides":
        left = {p: one for p, one in state.overrides.bigrams.items() if p != pair}
        return replace(state, overrides=replace(state.overrides, bigrams=left))
    own = state.own
    left = {p: one for p, one in own.bigrams.items() if p != pair}
    all_pairs = {p: one for p, one in own.of.bigrams.items() if p != pair}
    if own.base is not None and pair in own.base.bigrams:
        all_pairs = {**own.of.bigrams, pair: own.base.bigrams[pair]}
    of = replace(own.of, bigrams=all_pairs)
    return replace(state, own=replace(own, of=of, bigrams=left))


# --- single phones ---


def _with_phone(state: State, change: changes.DrawPhone) -> State:
    own, label = state.own, change.phone
    check_label(label, load_phone_set(own.of.phone_set))
    _check_pose(own.of, change.pose)
    over = change.target == "overrides"
    said = state.overrides.singles if over else own.phones
    curves = dict(said.get(label) or own.of.singles.get(label, {}))
    curves.pop(change.pose, None)
    if change.keys is not None:
        where = f"phone {label!r}, pose {change.pose!r}"
        curves[change.pose] = tidy(change.keys, where)
        check_curve(curves[change.pose], where, -1.0, 2.0)
    drawn = {**said, label: _ordered(curves, own.of)}
    if over:
        return replace(state, overrides=replace(state.overrides, singles=drawn))
    of = replace(own.of, singles={**own.of.singles, label: drawn[label]})
    return replace(state, own=replace(own, of=of, phones=drawn))


# --- rules ---


def _with_rule(state: State, change: changes.SetRule) -> State:
    if isinstance(change.value, float):
        change = msgspec.structs.replace(change, value=round(change.value, DIGITS))
    if change.target == "set":
        return _with_set_rule(state, change)
    over = state.overrides
    match change:
        case changes.SetRule(kind="gain", names=(pose,), value=value):
            _check_pose(state.own.of, pose)
            return replace(state, overrides=replace(over, gains=_said(over.gains, pose, value)))
        case changes.SetRule(kind="pose", names=(pose,), field=field, value=value):
            _check_pose(state.own.of, pose)
            fields = _said(over.poses.get(pose, {}), field, value)
            poses = _said(over.poses, pose, fields or None)
            return replace(state, overrides=replace(over, poses=poses))
        case changes.SetRule(kind="setting", field=field, value=value):
            return replace(
                state, overrides=replace(over, settings=_said(over.settings, field, value))
            )
        case changes.SetRule(kind="threshold", names=(one, other), value=value):
            kept = tuple(c for c in over.conflicts if set(c.poses) != {one, other})
            new = () if value is None else (_conflict(one, other, value),)
            return replace(state, overrides=replace(over, conflicts=kept + new))
    raise SetError(f"a {change.kind} of {' '.join(change.names) or 'nothing'}")


def _said(known: Mapping[str, Any], name: str, value: Any) -> dict[str, Any]:
    """Say something of a name, in its place; None unsays it."""
    if value is None:
        return {k: v for k, v in known.items() if k != name}
    return {**known, name: value}


def _conflict(one: str, other: str, value: Any) -> Conflict:
    return convert({"poses": [one, other], "threshold": value}, Conflict, "threshold")


def _with_set_rule(state: State, change: changes.SetRule) -> State:
    own = state.own
    rules, value = own.of.rules, change.value
    if value is None:
        raise SetError(
            f"no value for {change.field or change.kind}", expected="one: a set says all of them"
        )
    match change:
        case changes.SetRule(kind="pose", names=(name,), field=field):
            _check_pose(own.of, name)
            poses = tuple(
                _changed(pose, field, value, Pose) if pose.name == name else pose
                for pose in rules.poses
            )
            rules = Rules(poses, rules.conflicts, rules.settings)
        case changes.SetRule(kind="setting", field=field):
            settings = _changed(rules.settings, field, value, Settings)
            rules = Rules(rules.poses, rules.conflicts, settings)
        case changes.SetRule(kind="threshold", names=(one, other)):
            listed = {frozenset(c.poses): c for c in rules.conflicts}
            listed[frozenset((one, other))] = _conflict(one, other, value)
            rules = Rules(rules.poses, tuple(listed.values()), rules.settings)
        case _:
            raise SetError("a gain in a set", cure="set it in the overrides: a set is drawn")
    return replace(state, own=replace(own, of=replace(own.of, rules=rules)))


def _changed(of: Any, field: str, value: Any, kind: type[Any]) -> Any:
    fields = msgspec.structs.asdict(of)
    if field not in fields or field == "name":
        raise SetError(f"unknown setting {field!r}", expected=f"one of {', '.join(fields)}")
    return convert({**fields, field: value}, kind, field)
