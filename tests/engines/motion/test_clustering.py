"""Like motions come together; merged nodes keep labels, sounds and edges."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from lipwright.engines.motion.clustering import kmeans
from lipwright.engines.motion.database import Settings
from lipwright.engines.motion.graph import MergedGraph
from lipwright.engines.motion.units import at_points
from tests.engines.motion.small import database


def test_heaps_are_found_and_every_run_finds_the_same() -> None:
    rng = np.random.default_rng(4)
    centres = 10 * rng.normal(size=(8, 5))
    of = rng.integers(0, 8, 400)
    vectors = (centres[of] + 0.1 * rng.normal(size=(400, 5))).astype(np.float32)
    cluster, means = kmeans(vectors, 8)
    assert len(means) == 8
    assert len({(a, b) for a, b in zip(of.tolist(), cluster.tolist(), strict=True)}) == 8
    again, _ = kmeans(vectors, 8)
    assert (cluster == again).all()


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 999), count=st.integers(1, 60), clusters=st.integers(1, 70))
def test_every_vector_is_in_the_cluster_of_the_nearest_mean(
    seed: int, count: int, clusters: int
) -> None:
    rng = np.random.default_rng(seed)
    vectors = rng.integers(0, 4, (count, 2)).astype(np.float32)
    cluster, means = kmeans(vectors, clusters, seed)
    away = ((vectors[:, None] - means) ** 2).sum(axis=2)
    own = away[np.arange(count), cluster]
    assert (own <= away.min(axis=1) + 1e-4).all()
    assert np.unique(cluster).tolist() == list(range(len(means)))
    assert len(means) <= min(clusters, len(np.unique(vectors, axis=0)))


def test_a_node_keeps_labels_sounds_and_edges_of_its_units() -> None:
    words = ("abcabca", "bcab", "ca", "abab")
    held = database(*words, settings=Settings(clusters=5, motion_points=4))
    graph = MergedGraph(held)
    cluster = graph.merged.cluster
    nodes = np.arange(cluster.max() + 1)
    assert len(nodes) == 5
    for label in range(3):
        expected = np.unique(cluster[held.label == label])
        assert graph.having(label).tolist() == expected.tolist()
    follow = np.flatnonzero(held.take[1:] == held.take[:-1])
    edges = {(int(cluster[u]), int(cluster[u + 1])) for u in follow}
    assert {(n, int(m)) for n in nodes.tolist() for m in graph.after(n)} == edges
    sources, places = graph.before(nodes)
    assert set(zip(sources.tolist(), places.tolist(), strict=True)) == edges
    units, first = graph.sounds(nodes)
    for node, members in zip(nodes, np.split(units, first[1:]), strict=True):
        assert sorted(members.tolist()) == np.flatnonzero(cluster == node).tolist()


def test_a_node_has_the_motion_nearest_to_its_mean() -> None:
    settings = Settings(clusters=4, motion_points=4)
    held = database("abcabca", "bcab", "ca", settings=settings)
    graph = MergedGraph(held)
    # Spans count frames of the whole database; no point lies outside its take here.
    vectors = at_points(held.frames, held.spans, 4).reshape(len(held.label), -1)
    for node in range(4):
        members = np.flatnonzero(graph.merged.cluster == node)
        away = np.linalg.norm(vectors[members] - vectors[members].mean(axis=0), axis=1)
        chosen = int(graph.units(np.array([node]))[0])
        assert chosen in members
        assert away[members.tolist().index(chosen)] <= away.min() + 1e-3
