"""Each stage on lines whose result can be worked out by hand."""

from collections.abc import Mapping, Sequence

import numpy as np
import pytest

from lipwright.curves import Keys
from lipwright.engines.bigram.engine import BigramEngine, Solved
from lipwright.engines.bigram.model import (
    PUBLISHED,
    Bigram,
    BigramSet,
    Conflict,
    Pose,
    Rules,
    Settings,
)
from lipwright.errors import SetError
from lipwright.phones import PhoneTrack
from lipwright.timeline import Tier

LINE = PhoneTrack(Tier.of(("aa", 0, 1), ("bmp", 1, 2), ("ih", 2, 3)), "common")
TENT: list[tuple[float, float]] = [(0, 0), (0.5, 1), (1, 0)]


Drawn = Sequence[tuple[float, float]]


def engine(
    curves: Mapping[tuple[str, str], Mapping[str, Drawn]],
    *poses: Pose,
    conflicts: tuple[Conflict, ...] = (),
    settings: Settings | None = None,
) -> BigramEngine:
    bigrams = {
        pair: Bigram(pair, {name: Keys.of(list(keys)) for name, keys in drawn.items()})
        for pair, drawn in curves.items()
    }
    rules = Rules(poses, conflicts, settings or Settings(spline="linear"))
    return BigramEngine(BigramSet("hand", "common", rules, bigrams))


def at(solved: Solved, of: BigramEngine, stage: str, pose: str, times: list[float]) -> np.ndarray:
    assert solved.stages is not None
    line = solved.stages.axis.own(getattr(solved.stages, stage), of.plan.names.index(pose))
    return np.interp(times, *line)


def test_placed_curves_are_pinned_at_the_boundary() -> None:
    track = PhoneTrack(
        Tier.of(("sil", 0, 1), ("aa", 1, 1.2), ("ih", 1.2, 3), ("sil", 3, 4)), "common"
    )
    keys = [(0.25, 0), (0.5, 1), (0.75, 0)]
    for settings, peak in ((Settings(spline="linear"), 1.2), (PUBLISHED, 2.0)):
        made = engine(
            {("aa", "ih"): {"open": keys}}, Pose("open", 1, limit=1000), settings=settings
        )
        solved = made.solve(track)
        assert at(solved, made, "stitched", "open", [peak]) == pytest.approx([1])


def test_stitched_is_the_greatest_of_both_neighbours() -> None:
    made = engine(
        {("aa", "bmp"): {"open": TENT}, ("bmp", "ih"): {"open": [(0, 0), (0.5, 0.5), (1, 0)]}},
        Pose("open", 1, window=0, limit=100),
    )
    solved = made.solve(LINE)
    # 1 at 1 s falling to 0 at 2 s; 0 at 1 s rising to 0.5 at 2 s: they cross at 5/3 s.
    assert at(solved, made, "stitched", "open", [1, 1.5, 5 / 3, 2]) == pytest.approx(
        [1, 0.5, 1 / 3, 0.5]
    )


def test_valleys_between_near_maxima_are_lifted_to_the_chord() -> None:
    curves = {("aa", "bmp"): {"open": TENT}, ("bmp", "ih"): {"open": TENT}}
    for window, expected in ((1.01, 1.0), (0.99, 0.5)):
        made = engine(curves, Pose("open", 1, window=window, limit=100))
        assert at(made.solve(LINE), made, "smoothed", "open", [1.5]) == pytest.approx([expected])


def test_lifting_keeps_what_is_above_the_chord_and_replacing_does_not() -> None:
    keys = [(0, 0), (0.5, 1), (0.7, 0.95), (0.75, 0), (1, 0)]
    curves = {("aa", "bmp"): {"open": keys}, ("bmp", "ih"): {"open": [(0, 0), (0.5, 0.2), (1, 0)]}}
    for valleys, expected in (("lift", 0.95), ("replace", 1 - 0.8 * 0.4)):
        settings = Settings(spline="linear", valleys=valleys)  # type: ignore[arg-type]
        made = engine(curves, Pose("open", 1, window=2, limit=100), settings=settings)
        found = at(made.solve(LINE), made, "smoothed", "open", [1.4, 1.75])
        assert found == pytest.approx([expected, 1 - 0.8 * 0.75], abs=1e-6)


def test_a_chord_does_not_bridge_a_closure() -> None:
    curves: dict[tuple[str, str], dict[str, Drawn]] = {
        ("aa", "bmp"): {"open": TENT, "PBM": [(0.5, 0), (0.75, 1), (1, 0)]},
        ("bmp", "ih"): {"open": TENT, "PBM": [(0, 0), (0.25, 1), (0.5, 0)]},
    }
    poses = (Pose("open", 1, window=2, limit=100), Pose("PBM", 2, meets="widen", limit=100))
    conflicts = (Conflict(("open", "PBM"), 0.5),)
    for chords, expected in (("stop", 0.5), ("cross", 1.0)):
        settings = Settings(spline="linear", chords=chords)  # type: ignore[arg-type]
        made = engine(curves, *poses, conflicts=conflicts, settings=settings)
        assert at(made.solve(LINE), made, "smoothed", "open", [1.5]) == pytest.approx([expected])


def test_the_ramp_leaves_a_vowel_alone_and_the_published_sum_caps_it() -> None:
    curves = {("aa", "ih"): {"open": TENT}, ("aa", "bmp"): {"open": TENT}}
    poses = (Pose("open", 1, limit=1000), Pose("PBM", 2, limit=1000))
    conflicts = (Conflict(("open", "PBM"), 0.5),)
    for settings, expected in ((Settings(spline="linear"), 1.0), (PUBLISHED, 0.5)):
        made = engine(curves, *poses, conflicts=conflicts, settings=settings)
        assert at(made.solve(LINE), made, "constrained", "open", [1.0]) == pytest.approx([expected])


def test_a_cut_pose_loses_what_is_too_fast_and_a_widening_one_starts_early() -> None:
    curves = {("aa", "bmp"): {"a": TENT, "b": TENT}}
    made = engine(curves, Pose("a", 1, limit=0.5), Pose("b", 2, meets="widen", limit=0.5))
    solved = made.solve(LINE)
    assert at(solved, made, "limited", "a", [0, 1, 2]) == pytest.approx([0, 0.5, 0])
    assert at(solved, made, "limited", "b", [-1, 0, 1, 2, 3]) == pytest.approx([0, 0.5, 1, 0.5, 0])


def test_silence_beyond_its_reach_stays_at_rest() -> None:
    track = PhoneTrack(Tier.of(("sil", 0, 5), ("aa", 5, 6), ("sil", 6, 9)), "common")
    made = engine({("sil", "aa"): {"open": TENT}}, Pose("open", 1, limit=100))
    found = at(made.solve(track), made, "stitched", "open", [4.75, 4.79, 4.9])
    assert found == pytest.approx([0, 0, 0.5])


@pytest.mark.parametrize(
    ("poses", "words"),
    [
        ((Pose("a", 1, meets="widen"), Pose("b", 2, meets="widen")), "both widen"),
        ((Pose("a", 1), Pose("b", 1)), "both have priority 1"),
    ],
)
def test_rules_that_cannot_be_kept_are_refused(poses: tuple[Pose, ...], words: str) -> None:
    with pytest.raises(SetError, match=words):
        Rules(poses, (Conflict(("a", "b"), 0.5),))
    assert Rules(poses, (Conflict(("a", "b"), 2.0),)).bounds() == ()
