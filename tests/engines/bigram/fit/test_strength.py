"""How far phones may leave the base: little for a speaker like it, far for one unlike it."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from lipwright.engines.bigram import BigramEngine, load_set
from lipwright.engines.bigram.fit import FaceTake, fit_set, strength
from lipwright.engines.bigram.fit.drawing import draw_pair
from lipwright.engines.bigram.fit.levels import Problem
from lipwright.engines.bigram.fit.prior import PHONE, levels_of, prior
from lipwright.engines.bigram.fit.strength import with_strength
from lipwright.engines.bigram.fit.stretches import LEVELS, Pairs, stretches
from lipwright.engines.bigram.model import BigramSet
from lipwright.phones import PhoneTrack, load_phone_set
from lipwright.timeline import Interval, Tier
from tests.engines.bigram.fit.test_fitting import drawn, line, take

BASE = load_set("english")
LABELS = load_phone_set("common").labels
PAIRS = Pairs(LABELS if "sil" in LABELS else (*LABELS, "sil"))
POSES = ("open", "W")


def like_the_base(noise: float = 0.0, gain: float = 1.0) -> BigramSet:
    """A speaker who moves as the base does, more or less, and no pair quite as it is there."""
    rng = np.random.default_rng(11)
    levels = {pose: gain * levels_of(BASE, PAIRS, pose) for pose in POSES}
    bigrams = dict(BASE.bigrams)
    for pair in bigrams:
        key = PAIRS.key(*pair)
        new = {
            pose: np.clip(of[key : key + LEVELS] + rng.normal(0, noise, LEVELS), 0, 1)
            for pose, of in levels.items()
        }
        bigrams[pair] = draw_pair(BASE, pair, new, "like")
    rules = drawn(1).rules
    return replace(BASE, name="like", rules=rules, bigrams=bigrams)


def spoken(text: str) -> PhoneTrack:
    """Phones of a few sounds, evenly."""
    phones = [Interval("sil", 0.0, 0.4)]
    for label in text.split():
        end = phones[-1].end
        phones.append(Interval(label, end, end + 0.14))
    end = phones[-1].end
    return PhoneTrack(Tier((*phones, Interval("sil", end, end + 0.4))))


def chosen(of: BigramSet, pose: str = "open") -> float:
    """How strongly phones are pulled in a fit to a speaker."""
    engine, rng = BigramEngine(of), np.random.default_rng(5)
    takes = [take(engine, line(rng)) for _ in range(12)]
    above = [name for name in BASE.rules.names if name not in POSES]
    cut = stretches(takes, BASE, PAIRS, above)
    column = POSES.index(pose)
    problem = Problem(cut, [stretch.frames[:, column] for stretch in cut], (), 0.05)
    keys = np.unique(np.concatenate([stretch.keys for stretch in cut]) // LEVELS)
    used = (LEVELS * keys[:, None] + np.arange(LEVELS)).ravel()
    found = with_strength(problem, prior(BASE, PAIRS, pose), used, levels_of(BASE, PAIRS, pose))
    return float(found.strength[1])


@pytest.mark.parametrize("pose", POSES)
def test_phones_are_freer_where_the_base_foresees_nothing(pose: str) -> None:
    assert chosen(drawn(1), pose) < PHONE


def off(make: Callable[[], BigramSet], original: BigramSet) -> float:
    """How far a set is from its speaker where z stands in words that no take has."""
    found = make()
    errors = []
    for text in ("iy s iy", "w s w", "l s ae", "ao s iy"):
        one, other = (take(BigramEngine(of), spoken(text)) for of in (original, found))
        errors.append(one.values - other.values)
    return float(np.sqrt(np.mean(np.square(np.concatenate(errors)))))


def test_words_never_seen_are_foreseen_better_than_at_either_end(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """All z between aa: their context must not be taken for z's own, nor z for the base's."""
    original = like_the_base(0.06, 0.6)
    engine = BigramEngine(original)
    words = ("aa s aa", "l iy", "w aa l", "iy w", "ae l iy w", "ao l", "aa w iy", "l ae w")
    takes = [take(engine, spoken(text), text) for text in words for _ in range(3)]
    chosen = off(lambda: fit_set(takes, BASE)[0], original)
    for extreme in (0.001, 100.0):
        monkeypatch.setattr(strength, "STRENGTHS", (extreme,))
        assert chosen < 0.95 * off(lambda: fit_set(takes, BASE)[0], original)


def test_too_few_words_try_nothing() -> None:
    engine = BigramEngine(like_the_base())
    takes = [take(engine, spoken("l iy"))]
    made = fit_set(takes, BASE)[0]
    assert made.bigrams["l", "ih"].source == made.name


def test_words_say_what_is_left_out_together() -> None:
    track = spoken("l iy w aa")
    words = Tier.of(("lee", 0.4, 0.68), ("wa", 0.68, 0.96))
    values = np.zeros((40, 1)) + 0.2
    one = FaceTake("one", ("open",), values, 30.0, 0.0, track, words)
    (cut,) = stretches([one], BASE, PAIRS, [])
    times = (np.arange(40) + 0.5) / 30
    assert set(cut.said[(times > 0.4) & (times < 0.68)]) == {0}
    assert set(cut.said[(times > 0.68) & (times < 0.96)]) == {1}
    assert set(cut.said[times < 0.4]) == {-1}
    (paired,) = stretches([replace(one, words=Tier())], BASE, PAIRS, [])
    pair = PAIRS.key("w", "aa") // LEVELS
    assert paired.said[np.searchsorted(times, 0.82)] == pair
