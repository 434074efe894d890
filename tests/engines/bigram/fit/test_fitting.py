"""A set is sampled through the engine and fitted back; what no take shows falls back."""

from dataclasses import replace
from functools import cache

import msgspec
import numpy as np
import pytest

from lipwright.engines.bigram import BigramEngine, load_set
from lipwright.engines.bigram.fit import FaceTake, FitReport, fit_set
from lipwright.engines.bigram.fit.drawing import draw_pair
from lipwright.engines.bigram.model import BigramSet, Rules
from lipwright.engines.bigram.set_file import set_bytes
from lipwright.errors import InputError, LabelError
from lipwright.phones import PhoneTrack
from lipwright.timeline import Interval, Tier

POSES = ("open", "W")
SPOKEN = ("aa", "iy", "w", "s", "l", "p")
CLASSES = ("aa", "ih", "w", "z", "l", "bmp")
SOFT = 0.05


def drawn(seed: int) -> BigramSet:
    """The English set with random levels of two poses, slow enough for every limit."""
    base, rng = load_set("english"), np.random.default_rng(seed)
    middle = {label: rng.uniform(0.1, 0.6, 2) for label in (*CLASSES, "sil")}
    middle["sil"] = np.zeros(2)
    bigrams = dict(base.bigrams)
    for one in (*CLASSES, "sil"):
        for other in (*CLASSES, "sil"):
            if (one, other) != ("sil", "sil"):
                between = 0.5 * (middle[one] + middle[other]) + rng.uniform(-0.1, 0.1, 2)
                levels = np.clip([middle[one], between, middle[other]], 0, 1).T
                new = dict(zip(POSES, levels, strict=True))
                bigrams[one, other] = draw_pair(base, (one, other), new, "drawn")
    poses = tuple(
        msgspec.structs.replace(pose, softness=SOFT, window=0.0) if pose.name in POSES else pose
        for pose in base.rules.poses
    )
    rules = Rules(poses, base.rules.conflicts, base.rules.settings)
    return replace(base, name="drawn", rules=rules, bigrams=bigrams)


def line(rng: np.random.Generator, without: tuple[str, str] = ("", "")) -> PhoneTrack:
    """Random phones between silences; never the pair that is left out."""
    time, phones, before = 0.4, [Interval("sil", 0.0, 0.4)], ""
    while len(phones) < 16:
        label = str(rng.choice(SPOKEN))
        if label == before or (before, label) == without:
            continue
        length = float(rng.uniform(0.1, 0.22))
        phones.append(Interval(label, time, time + length))
        time, before = time + length, label
    return PhoneTrack(Tier((*phones, Interval("sil", time, time + 0.4))))


def take(engine: BigramEngine, phones: PhoneTrack, name: str = "take") -> FaceTake:
    """What a camera of 30 frames per second sees of a line."""
    rate, start = 30.0, 0.1
    count = int((phones.tier.end - start) * rate)
    values = engine.sample(engine.solve(phones), start + 0.5 / rate, count, rate)
    columns = [engine.rules.names.index(pose) for pose in POSES]
    return FaceTake(name, POSES, values[:, columns], rate, start, phones)


@cache
def fitted() -> tuple[BigramSet, BigramSet, FitReport]:
    """The original, the set fitted to 20 lines of it, and the report."""
    original, rng = drawn(1), np.random.default_rng(2)
    engine = BigramEngine(original)
    takes = [take(engine, line(rng, ("aa", "l"))) for _ in range(20)]
    return original, *fit_set(takes, load_set("english"), "mine")


def middles(of: BigramSet, pair: tuple[str, str], pose: str) -> np.ndarray:
    keys = of.bigrams[pair].curves.get(pose)
    return np.zeros(3) if keys is None else keys.at([0.25, 0.5, 0.75])


def test_fitted_curves_are_close_to_those_that_made_the_takes() -> None:
    original, found, report = fitted()
    off = [
        middles(original, (one, other), pose) - middles(found, (one, other), pose)
        for one in CLASSES
        for other in CLASSES
        for pose in POSES
        # Where lips close the engine bounds what is opened: that level nobody sees.
        if one != other and "bmp" not in (one, other) and (one, other) != ("aa", "l")
    ]
    assert np.sqrt(np.mean(np.square(off))) < 0.05
    assert max(report.fitted.values()) < 0.02


def test_lines_never_seen_move_alike() -> None:
    original, found, _ = fitted()
    phones = line(np.random.default_rng(99), ("aa", "l"))
    one, other = take(BigramEngine(original), phones), take(BigramEngine(found), phones)
    for column in range(len(POSES)):
        assert np.corrcoef(one.values[:, column], other.values[:, column])[0, 1] > 0.98
    assert np.abs(one.values - other.values).mean() < 0.02


def test_pairs_without_evidence_are_their_phones() -> None:
    original, found, report = fitted()
    level = middles(found, ("aa", "l"), "open")
    others = [middles(found, ("aa", label), "open")[0] for label in ("ih", "w", "z")]
    assert level[0] == pytest.approx(np.mean(others), abs=0.06)
    assert level[0] == pytest.approx(middles(original, ("aa", "z"), "open")[0], abs=0.08)
    assert report.from_phones > 100


def test_what_no_take_shows_stays_as_it_was() -> None:
    _, found, report = fitted()
    base = load_set("english")
    assert found.bigrams["sh", "er"] is base.bigrams["sh", "er"]
    assert found.singles["sh"] is base.singles["sh"]
    assert report.measured + report.from_phones + report.kept == len(found.bigrams) == 483
    for pose in ("PBM", "tRoof"):
        assert pose in report.base_poses
        assert found.bigrams["z", "aa"].curves.get(pose) == base.bigrams["z", "aa"].curves.get(pose)
    assert found.bigrams["aa", "bmp"].curves["PBM"] == base.bigrams["aa", "bmp"].curves["PBM"]


def test_softness_is_found_and_curves_have_few_keys() -> None:
    _, found, _ = fitted()
    assert found.rules.pose("open").softness == pytest.approx(SOFT, abs=0.021)
    assert found.rules.pose("PBM") == load_set("english").rules.pose("PBM")
    for bigram in found.bigrams.values():
        if bigram.source == "mine":
            assert all(len(bigram.curves.get(pose, ())) <= 5 for pose in POSES)


def test_the_same_takes_give_the_same_bytes() -> None:
    engine, base = BigramEngine(drawn(3)), load_set("english")
    takes = [take(engine, line(np.random.default_rng(seed))) for seed in range(4)]
    shown: list[float] = []
    first = set_bytes(fit_set(takes, base, progress=shown.append)[0])
    assert set_bytes(fit_set(takes, base)[0]) == first
    assert shown == sorted(shown)
    assert shown[-1] == 1.0


def test_a_wild_take_among_many_changes_little() -> None:
    original, base = drawn(4), load_set("english")
    engine = BigramEngine(original)
    takes = [take(engine, line(np.random.default_rng(seed))) for seed in range(12)]
    wild = replace(
        takes[0],
        values=np.where(np.arange(len(takes[0].values))[:, None] % 40 < 3, 1, takes[0].values),
    )
    made = fit_set([wild, *takes[1:]], base)[0]
    assert (
        np.abs(middles(made, ("aa", "z"), "open") - middles(original, ("aa", "z"), "open")).max()
        < 0.12
    )


TRACK = PhoneTrack(Tier.of(("sil", 0, 0.3), ("aa", 0.3, 0.6), ("sil", 0.6, 1.0)))
STILL = np.zeros((30, 1))
MOVED = STILL + 0.3


@pytest.mark.parametrize(
    ("takes", "words"),
    [
        ([], "no takes; expected one or more"),
        ([("opne", MOVED, TRACK)], "unknown pose 'opne'.*Did you mean 'open'"),
        ([("open", STILL, TRACK)], "no pose ever moves"),
        ([("PBM", MOVED, TRACK)], "only the poses PBM; expected one that is not a closure"),
        ([("open", MOVED, TRACK), ("W", MOVED, TRACK)], "the poses W; expected those of take"),
        ([("open", MOVED, PhoneTrack(Tier()))], "take: no phones"),
        ([("open", MOVED, PhoneTrack(Tier.of(("sil", 0, 1))))], "take: no phones"),
        ([("open", MOVED[:3], TRACK)], "3 frames; expected 4 or more"),
        ([("open", MOVED * np.nan, TRACK)], "a weight is not finite"),
        ([("open", np.zeros((30, 2)), TRACK)], "a column for each of 1 poses"),
        ([("open", MOVED, PhoneTrack(TRACK.tier.shifted(9)))], "Check the takes' times"),
    ],
)  # fmt: skip
def test_bad_takes(takes: list[tuple[str, np.ndarray, PhoneTrack]], words: str) -> None:
    with pytest.raises(InputError, match=words):
        fit_set(
            [FaceTake("take", (pose,), values, 30.0, 0.0, track) for pose, values, track in takes],
            load_set("english"),
        )


def test_unknown_phones_name_the_take() -> None:
    track = PhoneTrack(Tier.of(("sil", 0, 0.3), ("qq", 0.3, 0.6)))
    with pytest.raises(LabelError, match=r"take7.*'qq'"):
        fit_set([FaceTake("take7", ("open",), MOVED, 30.0, 0.0, track)], load_set("english"))


def test_a_rate_that_cannot_be() -> None:
    with pytest.raises(InputError, match="0 frames per second"):
        FaceTake("take", ("open",), MOVED, 0.0, 0.0, TRACK)


def test_long_takes_are_cut_without_a_trace() -> None:
    """A take of over a hundred frames gives what its two halves would."""
    engine, rng = BigramEngine(drawn(5)), np.random.default_rng(6)
    whole = take(engine, line(rng))
    middle = len(whole.values) // 2
    halves = [
        replace(whole, values=whole.values[:middle]),
        replace(whole, values=whole.values[middle:], start=whole.start + middle / whole.rate),
    ]
    base = load_set("english")
    one, two = fit_set([whole], base)[0], fit_set(halves, base)[0]
    for pair in (("aa", "z"), ("w", "ih")):
        off = middles(one, pair, "open") - middles(two, pair, "open")
        assert np.abs(off).max() < 0.05
