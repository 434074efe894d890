"""Paths by cost alone: the cheapest of all, then others; the line's phones; long lines."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from itertools import pairwise, product
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lipwright.engines.motion.database import Database
from lipwright.engines.motion.search import PATHS, several
from tests.engines.motion.small import database

# The package has a function of the module's name.
module = sys.modules[several.__module__]
words = st.lists(st.text("abc", min_size=1, max_size=5), min_size=1, max_size=3)
lines = st.text("abc", min_size=1, max_size=4)


def wanted_in(held: Database, line: str) -> np.ndarray:
    return np.array([held.labels.index(one) if one in held.labels else 0 for one in line])


def asked(held: Database, line: str, paths: int, seed: int = 3) -> np.ndarray:
    """What the search finds for a line of made-up sound and lengths."""
    wanted, lengths, classes, sound = arguments(held, line, seed)
    return several(held, wanted, lengths, classes, sound, paths)


def arguments(held: Database, line: str, seed: int = 3) -> tuple[np.ndarray, ...]:
    rng = np.random.default_rng(seed)
    sound = rng.normal(size=(len(line), held.unit_sound.shape[1])).astype(np.float32)
    lengths = rng.uniform(0.05, 0.2, len(line))
    return wanted_in(held, line), lengths, np.arange(len(held.labels)), sound


def phones_of(held: Database, line: str) -> list[Any]:
    """The units that each phone of a line may have, with what each costs by itself."""
    wanted, lengths, classes, sound = arguments(held, line)
    how = {"unusual": module.UNUSUAL, "unsure": False}
    return [
        module._phone(held, wanted.tolist(), place, float(lengths[place]), classes, sound, **how)
        for place in range(len(line))
    ]


def cheapest_of_all(held: Database, line: str) -> float:
    """The least cost of any path."""
    phones = phones_of(held, line)
    return min(cost_of(held, phones, path) for path in product(*(p.units for p in phones)))


def cost_of(held: Database, phones: list[Any], path: Sequence[int]) -> float:
    """What one path costs, added up from its own parts."""
    total = 0.0
    for phone, unit in zip(phones, path, strict=True):
        total += float(phone.cost[phone.units.tolist().index(unit)])
    for left, right in pairwise(path):
        total += float(module._seams(held, np.array([left]), np.array([right]))[0, 0])
    return total


@settings(max_examples=60, deadline=None)
@given(words=words, line=lines)
def test_one_path_is_the_cheapest_of_all(words: list[str], line: str) -> None:
    held = database(*words)
    path = asked(held, line, 1)[0].tolist()
    assert cost_of(held, phones_of(held, line), path) == pytest.approx(
        cheapest_of_all(held, line), abs=1e-4
    )


def test_several_paths_speak_the_line_with_other_units() -> None:
    held = database(*(["abcab"] * 20))
    found = asked(held, "abca", PATHS)
    assert found.shape == (PATHS, 4)
    assert (held.label[found] == wanted_in(held, "abca")).all()
    for phone in found.T:
        assert len(set(phone.tolist())) > PATHS / 2  # used units cost more


def test_what_was_recorded_so_is_found() -> None:
    held = database("abcacb", "bacabc", "cabbac")
    spans = held.spans[6:12]
    lengths = np.diff(spans)[:, 0] / held.rate
    classes = np.arange(len(held.labels))
    found = several(held, held.label[6:12], lengths, classes, held.unit_sound[6:12], 1)
    assert found[0].tolist() == list(range(6, 12))


def test_a_long_line_is_cut_and_still_spoken(monkeypatch: pytest.MonkeyPatch) -> None:
    held = database("abcacb", "bacabc", "cabbac")
    line = "abcabc" * 10
    whole = asked(held, line, 2)
    monkeypatch.setattr(module, "LONGEST", 7)
    cut = asked(held, line, 2)
    assert cut.shape == whole.shape
    assert (held.label[cut] == held.label[whole]).all()


@pytest.mark.parametrize("unsure", [False, True])
def test_units_that_are_left_out_without_their_sound_could_not_be_chosen(
    monkeypatch: pytest.MonkeyPatch, *, unsure: bool
) -> None:
    held = database(*(["abcabcbac"] * 100))
    wanted, lengths, classes, sound = arguments(held, "abcacbba")
    monkeypatch.setattr(module, "KEPT", 15)
    found = several(held, wanted, lengths, classes, sound, unsure=unsure)

    def everywhere(
        held: Database, units: np.ndarray, cost: np.ndarray, sound: np.ndarray, weight: float
    ) -> tuple[np.ndarray, np.ndarray]:
        away = held.unit_sound[units] - sound
        return units, cost + weight * np.sqrt((away**2).mean(axis=1))

    monkeypatch.setattr(module, "_heard", everywhere)
    assert (several(held, wanted, lengths, classes, sound, unsure=unsure) == found).all()


def test_of_a_frequent_phone_stretches_all_over_the_database_are_read(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    held = database(*(["ab"] * 500))
    monkeypatch.setattr(module, "LOOKED_AT", 64)
    monkeypatch.setattr(module, "STRETCHES", 8)
    units = module._having(held, 0)
    assert len(units) == 64
    assert (held.label[units] == 0).all()
    assert np.flatnonzero(np.diff(units) != 2).tolist() == list(range(7, 63, 8))
    assert units[-1] > 800
