"""Fitting a mapping to a rig: which channels it has, what is missing, what stands in.

Of the known vocabularies, the one of whose names the rig has the largest share is taken.
A control is made by its row; where the rig lacks a channel of it, by another row of the
vocabulary that it has whole; else by what is there. Where what opens the mouth is lacking
and the rig has a jaw joint, the joint stands in. A control that is itself the name of one
of the rig's channels moves that channel.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from lipwright.animation import Animation
from lipwright.character.joints import jaw_channel, mapped_joints
from lipwright.character.mapping import JointChannel, Mapping, Row
from lipwright.character.names import match_names, some
from lipwright.character.rig import Rig
from lipwright.character.vocabulary import jaw_alone, vocabularies
from lipwright.errors import CharacterError
from lipwright.performance import JointTurn

EXACT, PARTLY, STAND_IN, MISSING = "exact", "partly", "stand-in", "missing"


@dataclass(frozen=True, slots=True)
class FittedControl:
    """How one control is made on a rig.

    Parameters
    ----------
    control : str
        Its name.
    weights : dict of str to float
        The weight of each morph target.
    status : str
        ``"exact"``; ``"partly"``, where some of its channels are not there;
        ``"stand-in"``, made of something else; or ``"missing"``.
    missing : tuple of str
        The channels that its row asks for and the rig has not.
    note : str
        What the mapping says about it.
    """

    control: str
    weights: Row
    status: str
    missing: tuple[str, ...] = ()
    note: str = ""


@dataclass(frozen=True, slots=True)
class Fitting:
    """A mapping as it fits a rig.

    Parameters
    ----------
    vocabulary : str
        The name of the vocabulary, or nothing where none fits.
    found, asked : int
        How many of the vocabulary's channels the rig has, and how many it uses.
    controls : dict of str to FittedControl
        How each control is made.
    gains : dict of str to float
        What a control is multiplied by, 1 where none is given.
    limits : dict of str to tuple of float
        The least and greatest value of a morph target, 0 and 1 where none are given.
    targets : tuple of str
        All morph targets of the rig.
    joints : dict of str to JointTurn
        Channels that turn a joint.
    given : frozenset of str
        Controls whose gain or row is the user's own.
    """

    vocabulary: str
    found: int
    asked: int
    controls: dict[str, FittedControl]
    gains: Row = field(default_factory=dict)
    limits: dict[str, tuple[float, float]] = field(default_factory=dict)
    targets: tuple[str, ...] = ()
    joints: dict[str, JointTurn] = field(default_factory=dict)
    given: frozenset[str] = frozenset()

    def weights_of(self, control: str) -> Row:
        """Return the morph targets that a control moves, with its gain; none if it cannot."""
        if control in self.controls:
            gain = self.gains.get(control, 1.0)
            weights = self.controls[control].weights
            return {target: weight * gain for target, weight in weights.items()}
        direct = match_names(self.targets, {control: ()})
        return dict.fromkeys(direct.get(control, ()), self.gains.get(control, 1.0))

    def drive(self, animation: Animation) -> Animation:
        """Return the values of the rig's morph targets over time.

        Parameters
        ----------
        animation : Animation
            Of the set's controls.

        Returns
        -------
        Animation
            Its controls are the morph targets that the mapping moves.

        Raises
        ------
        CharacterError
            If none of the controls moves anything.
        """
        rows = [self.weights_of(control) for control in animation.controls]
        targets = tuple(dict.fromkeys(target for row in rows for target in row))
        if not targets:
            raise CharacterError(
                f"none of the controls ({some(animation.controls)}) moves anything",
                expected=f"one of the rig's {len(self.targets)} morph targets "
                f"({some(self.targets)})",
                cure="write a mapping for it: see 'lipwright character inspect'",
            )
        matrix = np.array([[row.get(target, 0.0) for target in targets] for row in rows])
        limits = np.array([self._limits(target) for target in targets])
        values = np.clip(animation.values @ matrix, limits[:, 0], limits[:, 1])
        return replace(animation, controls=targets, values=values.astype(np.float32), keys={})

    def values(self, weights: Row) -> Row:
        """Return the value of each channel, within its limits, at weights of the controls."""
        total = _sum(
            {target: weight * amount for target, weight in self.weights_of(control).items()}
            for control, amount in weights.items()
        )
        return {
            target: min(max(value, self._limits(target)[0]), self._limits(target)[1])
            for target, value in total.items()
        }

    def _limits(self, channel: str) -> tuple[float, float]:
        return self.limits.get(channel, (0.0, 1.0))

    def to_mapping(self, name: str) -> Mapping:
        """Return it as a mapping in the rig's own names, to be written and edited."""
        joints = {
            channel: JointChannel(turn.name, turn.axis, turn.degrees)
            for channel, turn in self.joints.items()
        }
        return Mapping(
            name,
            {control: fitted.weights for control, fitted in self.controls.items()},
            gains={control: self.gains.get(control, 1.0) for control in self.controls},
            limits=self.limits,
            notes={c: fitted.note for c, fitted in self.controls.items() if fitted.note},
            joints=joints,
        )


def fit(rig: Rig, mapping: Mapping | None = None, where: str = "mapping") -> Fitting:
    """Fit a rig to the vocabulary that it speaks, or to a user's mapping.

    Parameters
    ----------
    rig : Rig
        The rig.
    mapping : Mapping, optional
        A user's mapping: its rows, gains and limits go before the vocabulary's.
    where : str
        The mapping's name in errors.

    Raises
    ------
    CharacterError
        If the user's mapping names channels that the rig has not.
    """
    found = _fit_vocabulary(rig)
    if mapping is None:
        return found
    joints = {**jaw_channel(rig), **mapped_joints(rig, mapping, where)}
    names = _find(rig, mapping, own=True) | {channel: {channel: 1.0} for channel in joints}
    unknown = [channel for channel in mapping.channels if channel not in names]
    unknown += [channel for channel in mapping.limits if channel not in names]
    if unknown:
        raise _unknown(unknown, rig, where)
    own = {control: _fit_control(control, mapping, names) for control in mapping.controls}
    controls = {**found.controls, **own}
    return replace(
        found,
        controls=controls,
        gains={**found.gains, **mapping.gains},
        limits={**found.limits, **_limits(mapping, names)},
        joints=_used(joints, controls),
        given=frozenset((*mapping.gains, *mapping.controls)),
    )


def _fit_vocabulary(rig: Rig) -> Fitting:
    best = Fitting("", 0, 0, {}, targets=rig.targets)
    jaw = jaw_channel(rig)
    for vocabulary in vocabularies():
        names = _find(rig, vocabulary)
        asked, found = len(vocabulary.channels), len(names)
        stood_in = _stand_in(vocabulary, names, jaw)
        controls = {
            c: _fit_control(c, vocabulary, names | stood_in, stood_in) for c in vocabulary.controls
        }
        opens = controls["open"].status != MISSING
        if opens and found * max(best.asked, 1) > best.found * asked:
            limits = _limits(vocabulary, names)
            joints = _used(jaw, controls)
            best = Fitting(
                vocabulary.name, found, asked, controls, vocabulary.gains, limits, rig.targets,
                joints,
            )  # fmt: skip
    return best if best.controls or not jaw else _fit_jaw(rig, jaw)


def _fit_jaw(rig: Rig, jaw: dict[str, JointTurn]) -> Fitting:
    """Let a jaw speak alone; what it cannot do in full stands in."""
    alone = jaw_alone()
    names = {"jaw": dict.fromkeys(jaw, 1.0)}
    controls = {control: _fit_control(control, alone, names, names) for control in alone.controls}
    return Fitting(alone.name, 1, 1, controls, targets=rig.targets, joints=jaw)


def _stand_in(
    vocabulary: Mapping, names: dict[str, Row], jaw: dict[str, JointTurn]
) -> dict[str, Row]:
    """Return what stands in for the channel that opens, if the rig lacks it and has a jaw."""
    opening = vocabulary.controls["open"]
    main = max(opening, key=lambda channel: opening[channel])
    return {main: dict.fromkeys(jaw, 1.0)} if jaw and main not in names else {}


def _used(joints: dict[str, JointTurn], controls: dict[str, FittedControl]) -> dict[str, JointTurn]:
    used = {channel for fitted in controls.values() for channel in fitted.weights}
    return {channel: turn for channel, turn in joints.items() if channel in used}


def _find(rig: Rig, mapping: Mapping, *, own: bool = False) -> dict[str, Row]:
    """Return, for each channel of the mapping that the rig has, the morph targets behind it.

    Of a VRM expression and a morph target of one name, a vocabulary means the expression,
    which may move several meshes; a user's own mapping means the morph target.
    """
    known = {name: mapping.names.get(name, ()) for name in (*mapping.channels, *mapping.limits)}
    by_expression = match_names(tuple(rig.expressions), known)
    exactly = {name: (name,) for name in known if name in rig.targets}
    by_target = {**match_names(rig.targets, known), **exactly}
    found = {}
    for name in known:
        if name in by_expression and not (own and name in exactly):
            found[name] = _sum(rig.expressions[e] for e in by_expression[name])
        elif name in by_target:
            found[name] = dict.fromkeys(by_target[name], 1.0)
    return found


def _fit_control(
    control: str, mapping: Mapping, names: dict[str, Row], stood_in: dict[str, Row] | None = None
) -> FittedControl:
    wanted = mapping.controls[control]
    note = mapping.notes.get(control, "")
    missing = tuple(channel for channel in wanted if channel not in names)
    row = _best_row([wanted, *mapping.otherwise.get(control, ())], names)
    weights = _sum(
        {target: weight * row[channel] for target, weight in names[channel].items()}
        for channel in row
        if channel in names
    )
    main = max(row, key=lambda channel: abs(row[channel]), default="")
    if not weights:
        status = MISSING
    elif row is not wanted or main in (stood_in or {}):
        status = STAND_IN
        note = note or _instead(wanted, row, names)
    else:
        status = PARTLY if missing else EXACT
    return FittedControl(control, weights, status, missing, note)


def _instead(wanted: Row, row: Row, names: dict[str, Row]) -> str:
    """Say what stands in for what."""
    used = [channel for target in row for channel in names.get(target, ())]
    lost = [channel for channel in wanted if channel not in row or channel not in used]
    return f"{some(used, 3)} instead of {some(lost or list(wanted), 3)}"


def _best_row(rows: Sequence[Row], names: dict[str, Row]) -> Row:
    """Take the first row if the rig has half of it; else the first that it has whole."""
    if _share(rows[0], names) >= 0.5:
        return rows[0]
    whole = (row for row in rows if _share(row, names) == 1)
    return next(whole, None) or max(rows, key=lambda row: _share(row, names))


def _share(row: Row, names: dict[str, Row]) -> float:
    """Return how much of a row a rig has, by weight, 0..1."""
    total = sum(map(abs, row.values()))
    lacking = sum(abs(weight) for channel, weight in row.items() if channel not in names)
    return (total - lacking) / total if total else 0.0


def _sum(rows: Iterable[Row]) -> Row:
    total: Row = {}
    for row in rows:
        for target, weight in row.items():
            total[target] = total.get(target, 0.0) + weight
    return total


def _limits(mapping: Mapping, names: dict[str, Row]) -> dict[str, tuple[float, float]]:
    return {
        target: limits
        for channel, limits in mapping.limits.items()
        for target in names.get(channel, ())
    }


def _unknown(unknown: Sequence[str], rig: Rig, where: str) -> CharacterError:
    first = unknown[0]
    near = difflib.get_close_matches(first, rig.targets, 3, 0.5)
    return CharacterError(
        f"the model has no channel {', '.join(map(repr, dict.fromkeys(unknown)))}",
        where=where,
        expected=f"one of {some(rig.targets)}",
        cure=f"did you mean {' or '.join(map(repr, near))}?" if near else "",
    )
