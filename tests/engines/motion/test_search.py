"""The searches against exhaustive search on small databases, and against each other."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lipwright.engines.motion.database import Database, Settings
from lipwright.engines.motion.graph import Graph, MergedGraph, UnitGraph, graph_of
from lipwright.engines.motion.search import (
    Costs,
    Path,
    Search,
    find,
    greedy,
    label_indices,
    optimal,
    path_of,
    pq,
    tiles,
    wanted_sound,
)
from lipwright.engines.motion.search.layered import best_nodes
from lipwright.engines.motion.search.steps import cheapest_jumps
from lipwright.engines.motion.search.tiles import bounds
from lipwright.errors import InputError
from tests.engines.motion.small import database

words = st.lists(st.text("abc", min_size=1, max_size=5), min_size=1, max_size=3)
lines = st.text("abc", min_size=1, max_size=5)
CLUSTERED = Settings(clusters=4, motion_points=4)


def indices(of: Database, line: str) -> np.ndarray:
    """Labels of a line; what the database lacks is its first label."""
    return np.array([of.labels.index(one) if one in of.labels else 0 for one in line])


def costs(graph: Graph, count: int, seed: int = 7, unusual: float = 8.0) -> Costs:
    rng = np.random.default_rng(seed)
    width = graph.database.unit_sound.shape[1]
    sound = rng.normal(size=(count, width)).astype(np.float32)
    return Costs(graph, sound, unusual_weight=unusual)


def every_path(graph: Graph, wanted: Sequence[int], measured: Costs) -> list[tuple[int, float]]:
    """Jumps and cost of every path there is, each added up from its own parts."""
    nodes = np.unique(np.concatenate([graph.having(label) for label in wanted]))
    sound = [measured.sound(phone, nodes).tolist() for phone in range(len(wanted))]
    seam = [measured.joinings(nodes, np.full(len(nodes), node)).tolist() for node in nodes]
    linked = [set(graph.after(node).tolist()) for node in nodes.tolist()]
    places = [np.searchsorted(nodes, graph.having(label)).tolist() for label in wanted]
    found = []
    for path in product(*places):
        pairs = list(pairwise(path))
        jumps = sum(int(nodes[b]) not in linked[a] for a, b in pairs)
        cost = sum(sound[phone][place] for phone, place in enumerate(path))
        found.append((jumps, cost + sum(seam[b][a] for a, b in pairs)))
    return found


def best(found: list[tuple[int, float]]) -> tuple[int, float]:
    fewest = min(jumps for jumps, _ in found)
    return fewest, min(cost for jumps, cost in found if jumps == fewest)


def fewest_tiles(line: str, words: Sequence[str]) -> int:
    """Definition 2, literally: the fewest substrings of words that make the line."""
    if not line:
        return 0
    return min(
        1 + fewest_tiles(line[length:], words)
        for length in range(1, len(line) + 1)
        if any(line[:length] in word for word in words)
    )


def speaks(path: Path, graph: Graph, wanted: np.ndarray) -> bool:
    pairs = zip(path.nodes.tolist(), wanted.tolist(), strict=True)
    return all(node in graph.having(label) for node, label in pairs)


@settings(max_examples=120, deadline=None)
@given(words=words, line=lines)
def test_optimal_is_the_best_of_all_paths(words: list[str], line: str) -> None:
    graph = UnitGraph(database(*words))
    wanted = indices(graph.database, line)
    measured = costs(graph, len(line))
    expected = best(every_path(graph, wanted.tolist(), measured))
    path = optimal(graph, wanted, measured)
    assert path.jumps == expected[0]
    assert path.cost == pytest.approx(expected[1], abs=1e-6)
    assert speaks(path, graph, wanted)


@contextmanager
def few_candidates(most: int, looked_at: int, kept: int) -> Iterator[None]:
    """A tile of more candidates than ``most`` gets few of them."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(tiles, "MOST", most)
        patched.setattr(tiles, "LOOKED_AT", looked_at)
        patched.setattr(tiles, "KEPT", kept)
        yield


@settings(max_examples=80, deadline=None)
@given(
    words=st.lists(st.text("abcd", min_size=1, max_size=30), min_size=1, max_size=12),
    line=st.text("abcd", min_size=1, max_size=40),
    most=st.integers(1, 6),
    looked_at=st.integers(1, 6),
    kept=st.integers(1, 3),
)
def test_with_few_candidates_jumps_are_fewest_and_the_cost_is_no_more_than_greedys(
    words: list[str], line: str, most: int, looked_at: int, kept: int
) -> None:
    graph = UnitGraph(database(*words))
    wanted = indices(graph.database, line)
    measured = costs(graph, len(line))
    exact = optimal(graph, wanted, measured)
    assert exact.complete
    with few_candidates(most, looked_at, kept):
        path = optimal(graph, wanted, measured)
        again = optimal(graph, wanted, measured)
    assert path.jumps == exact.jumps
    assert speaks(path, graph, wanted)
    assert exact.cost - 1e-6 <= path.cost <= greedy(graph, wanted, measured).cost + 1e-6
    assert not path.complete or path.cost == pytest.approx(exact.cost, abs=1e-6)
    assert path.units.tolist() == again.units.tolist()


@pytest.mark.parametrize("seed", range(12))
def test_with_few_candidates_the_cost_is_within_a_twentieth_of_the_least(seed: int) -> None:
    rng = np.random.default_rng(seed)
    held = database(*("".join(rng.choice([*"abcdef"], 30)) for _ in range(60)))
    graph = UnitGraph(held)
    wanted = rng.integers(0, len(held.labels), 40)
    measured = costs(graph, len(wanted), seed)
    exact = optimal(graph, wanted, measured)
    with few_candidates(16, 16, 4):
        path = optimal(graph, wanted, measured)
    assert not path.complete
    assert exact.cost - 1e-6 <= path.cost <= 1.05 * exact.cost


@settings(max_examples=80, deadline=None)
@given(words=words, line=lines)
def test_optimal_is_the_best_of_all_paths_of_merged_nodes(words: list[str], line: str) -> None:
    graph = graph_of(database(*words, settings=CLUSTERED))
    assert isinstance(graph, MergedGraph)
    wanted = indices(graph.database, line)
    measured = costs(graph, len(line))
    expected = best(every_path(graph, wanted.tolist(), measured))
    path = optimal(graph, wanted, measured)
    assert path.jumps == expected[0]
    assert path.cost == pytest.approx(expected[1], abs=1e-6)
    found = greedy(graph, wanted, measured)
    assert found.jumps == expected[0]
    assert speaks(found, graph, wanted)


@settings(max_examples=200, deadline=None)
@given(words=words, line=lines)
def test_greedy_needs_the_fewest_tiles(words: list[str], line: str) -> None:
    """Theorem 1."""
    graph = UnitGraph(database(*words))
    wanted = indices(graph.database, line)
    path = greedy(graph, wanted, costs(graph, len(line)))
    spoken = "".join(graph.database.labels[label] for label in wanted)
    assert path.jumps + 1 == fewest_tiles(spoken, words)
    assert speaks(path, graph, wanted)


@settings(max_examples=60, deadline=None)
@given(
    words=st.lists(st.text("abcd", min_size=1, max_size=30), min_size=1, max_size=12),
    line=st.text("abcd", min_size=1, max_size=40),
)
def test_on_longer_lines_all_agree(words: list[str], line: str) -> None:
    graph = UnitGraph(database(*words))
    wanted = indices(graph.database, line)
    measured = costs(graph, len(line))
    path = optimal(graph, wanted, measured)
    layered = path_of(graph, best_nodes(graph, wanted.tolist(), measured), measured)
    matched = greedy(graph, wanted, measured)
    assert path.jumps == layered.jumps == matched.jumps
    assert path.cost == pytest.approx(layered.cost, abs=1e-6)
    assert path.cost <= matched.cost + 1e-6


@settings(max_examples=60, deadline=None)
@given(words=words, line=lines, merged=st.booleans())
def test_a_window_as_long_as_the_line_is_optimal(words: list[str], line: str, merged: bool) -> None:
    graph = graph_of(database(*words, settings=CLUSTERED if merged else None))
    wanted = indices(graph.database, line)
    measured = costs(graph, len(line))
    whole = pq(len(line))(graph, wanted, measured)
    path = optimal(graph, wanted, measured)
    assert whole.jumps == path.jumps
    assert whole.cost == pytest.approx(path.cost, abs=1e-6)
    assert whole.complete


@pytest.mark.parametrize("search", [greedy, optimal, pq(3), pq(3, 2), pq(2, seconds=1e-9)])
@pytest.mark.parametrize("merged", [False, True])
def test_every_search_speaks_what_is_wanted(search: Search, merged: bool) -> None:
    held = database("abcab", "bca", "cc", settings=CLUSTERED if merged else None)
    graph = graph_of(held)
    wanted = indices(held, "abccabca")
    path = search(graph, wanted, costs(graph, len(wanted)))
    assert speaks(path, graph, wanted)
    assert path.units.tolist() == graph.units(path.nodes).tolist()
    assert path.jumps >= optimal(graph, wanted, costs(graph, len(wanted))).jumps


def test_short_windows_jump_more_than_need_be() -> None:
    """The paper: PQ-Matching cannot reach the fewest jumps with short windows."""
    held = database("ab", "bcde", "acd", "e")
    graph = UnitGraph(held)
    wanted = indices(held, "abcde")
    # The sound of the phones that lead astray: short windows follow it.
    lure = np.array(held.unit_sound[[6, 1, 3, 4, 5]])
    measured = Costs(graph, lure)
    assert optimal(graph, wanted, measured).jumps == 1
    assert pq(5)(graph, wanted, measured).jumps == 1
    assert pq(1)(graph, wanted, measured).jumps > 1


def test_a_cap_ends_the_search_with_a_whole_path() -> None:
    held = database(*(["abcd"] * 40))
    graph = UnitGraph(held)
    wanted = indices(held, "dcbadcba")
    path = pq(8, seconds=1e-6)(graph, wanted, costs(graph, 8))
    assert not path.complete
    assert speaks(path, graph, wanted)


def test_a_sentence_of_the_database_comes_back_whole() -> None:
    held = database("abcabcabcabcabcabcabcabcaa", "bcabcabcabcab", "cba")
    graph = UnitGraph(held)
    wanted = held.label[:26]
    measured = Costs(graph, np.array(held.unit_sound[:26]))
    for search in (greedy, optimal):
        path = search(graph, wanted, measured)
        assert path.units.tolist() == list(range(26))
        assert path.jumps == 0
        assert path.cost == pytest.approx(0.0, abs=1e-6)


def test_greedy_takes_the_match_that_sounds_nearest() -> None:
    held = database(*(["ab"] * 20))
    graph = UnitGraph(held)
    for unit in (0, 14, 38):
        sound = np.array(held.unit_sound[unit : unit + 2])
        path = greedy(graph, np.array([0, 1]), Costs(graph, sound))
        assert path.units.tolist() == [unit, unit + 1]


def test_of_units_that_sound_alike_the_more_usual_is_taken() -> None:
    held = database(*(["a"] * 20))
    sound = np.array(held.unit_sound[:1]) + 100.0  # as far from all of them
    path = greedy(UnitGraph(held), np.array([0]), Costs(UnitGraph(held), sound))
    assert held.unusual[path.units[0]] == held.unusual.min()


def test_of_many_matches_some_spread_over_all_are_compared() -> None:
    held = database(*(["ab"] * 500))
    graph = UnitGraph(held)
    found = {
        int(
            greedy(graph, np.array([0]), Costs(graph, np.array(held.unit_sound[u : u + 1]))).units[
                0
            ]
        )
        for u in range(0, 1000, 2)
    }
    assert 30 <= len(found) <= 64
    assert max(found) > 900


def test_the_slack_of_tile_borders() -> None:
    held = database("abcd", "cdef")
    graph = UnitGraph(held)
    assert bounds(graph, indices(held, "abcdef").tolist()) == ([0, 2, 6], [0, 4, 6])


def test_a_line_without_phones_is_a_path_without_units() -> None:
    for held in (database("ab"), database("ab", settings=CLUSTERED)):
        graph = graph_of(held)
        for search in (greedy, optimal, pq(3)):
            path = search(graph, np.zeros(0, np.int64), Costs(graph))
            assert (len(path.units), path.jumps, path.cost) == (0, 0, 0.0)


def test_a_missing_phone_gets_one_of_its_class() -> None:
    held = database("aab", "ac")
    like = {"a": "vowel", "b": "stop", "c": "stop", "p": "stop", "q": "click"}
    wanted, stand_ins = label_indices(held, ["p", "a", "q", "p"], like.__getitem__)
    assert [held.labels[label] for label in wanted] == ["b", "a", "a", "b"]
    told = [(one.place, one.wanted, one.used, one.alike) for one in stand_ins]
    assert told == [(0, "p", "b", True), (2, "q", "a", False), (3, "p", "b", True)]
    graph = UnitGraph(held)
    path = find(optimal, graph, ["p", "a"], Costs(graph), like.__getitem__)
    assert [one.used for one in path.stand_ins] == ["b"]


def test_without_classes_a_missing_phone_gets_the_most_frequent() -> None:
    held = database("aab")
    assert label_indices(held, ["z"])[1][0].used == "a"


def test_a_node_sounds_as_well_as_its_best_unit() -> None:
    held = database("aaaa", "aaa", settings=Settings(clusters=2, motion_points=4))
    graph = MergedGraph(held)
    measured = costs(graph, 1, unusual=0.0)
    each = measured.unit_sounds(np.zeros(7, np.int64), np.arange(7))
    for node in range(2):
        members = np.flatnonzero(graph.merged.cluster == node)
        assert measured.sound(0, np.array([node]))[0] == each[members].min()


@pytest.mark.parametrize("spread", [0.1, 3.0])
def test_the_cheapest_jumps_are_those_that_trying_all_finds(spread: float) -> None:
    held = database(*(["abc"] * 150))
    measured = Costs(UnitGraph(held))
    left, right = held.by_label[:300].astype(np.int64), held.by_label[300:].astype(np.int64)
    so_far = spread * np.random.default_rng(1).random(300)
    best, source = cheapest_jumps(measured, left, so_far, right)
    every = so_far[:, None] + measured.joining(left, right)
    assert best == pytest.approx(every.min(axis=0), abs=1e-9)
    assert every[source, np.arange(len(right))] == pytest.approx(best, abs=1e-9)


def test_neighbours_in_a_take_join_without_a_seam() -> None:
    graph = UnitGraph(database("abcab"))
    measured = Costs(graph)
    units = np.arange(5)
    assert np.diagonal(measured.joining(units, units), 1) == pytest.approx(np.zeros(4), abs=1e-6)
    pairwise = [measured.joinings(units, np.full(5, unit)) for unit in units]
    assert np.stack(pairwise, axis=1) == pytest.approx(measured.joining(units, units), abs=1e-6)


def test_wanted_sound_is_measured_as_the_units_are() -> None:
    held = database("abca", "cb")
    spans = held.spans[:4] / held.rate + 3.0
    features = held.features[: held.take_first[1]]
    sound = wanted_sound(held, features, held.rate, 3.0, spans)
    assert sound == pytest.approx(held.unit_sound[:4], abs=1e-5)


@pytest.mark.parametrize(
    ("work", "words"),
    [
        (lambda g: greedy(g, np.array([0, 9]), Costs(g)), "label 9; expected 0 to 1"),
        (lambda g: optimal(g, np.array([-1]), Costs(g)), "label -1; expected 0 to 1"),
        (lambda g: pq(0), "h = 0, advance = 1"),
        (lambda g: pq(2, 3), "h = 2, advance = 3"),
        (lambda g: pq(2, seconds=0), "0 s; expected more than 0 s"),
        (lambda g: Costs(g, np.zeros((2, 5), np.float32)), "expected 27 numbers"),
        (lambda g: MergedGraph(g.database), "not clustered"),
        (
            lambda g: wanted_sound(
                g.database, np.zeros((0, 9), np.float32), 25, 0, np.zeros((1, 2))
            ),
            "expected rows of 9",
        ),
    ],
)
def test_what_makes_no_sense_is_refused(work, words: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(InputError, match=words):
        work(UnitGraph(database("ab")))
