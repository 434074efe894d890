"""Like motions put together (Cao et al. 2004, section 5.3): k-means, and what merging keeps.

Units of like motion become one node: the motion nearest to the cluster's mean, the
labels and the sounds of all of them, and their edges. The fragments are compared at the
same number of points each, whatever they last.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

PASSES = 50
_BLOCK = 1 << 22


def kmeans(
    vectors: NDArray[np.float32], clusters: int, seed: int = 0
) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
    """Put vectors into clusters: k-means from k-means++ seeds, the same every time.

    Parameters
    ----------
    vectors : (n, D) float32
    clusters : int
        At least 1. Where fewer vectors differ from each other, there are fewer.
    seed : int

    Returns
    -------
    cluster : (n,) int32
        Which cluster each vector is in; every number from 0 occurs.
    means : (k, D) float32
    """
    means = _seeds(vectors, min(clusters, len(vectors)), np.random.default_rng(seed))
    cluster, far = _nearest(vectors, means)
    for _ in range(PASSES):
        means = _means(vectors, cluster, far, len(means))
        before = cluster
        cluster, far = _nearest(vectors, means)
        if np.array_equal(before, cluster):
            break
    used, cluster = np.unique(cluster, return_inverse=True)
    return cluster.astype(np.int32), means[used]


def _seeds(
    vectors: NDArray[np.float32], number: int, rng: np.random.Generator
) -> NDArray[np.float32]:
    """Draw each next seed with a chance that grows with the squared distance to the others."""
    chosen = [int(rng.integers(len(vectors)))]
    squares = np.einsum("nd,nd->n", vectors, vectors)
    far = np.full(len(vectors), np.inf)
    while len(chosen) < number:
        seed = chosen[-1]
        distance = squares + squares[seed] - 2.0 * (vectors @ vectors[seed])
        far = np.minimum(far, np.maximum(distance, 0.0))
        far[seed] = 0.0
        summed = np.cumsum(far, dtype=np.float64)
        if not summed[-1] > 0:  # all that is left equals a seed
            break
        drawn = int(np.searchsorted(summed, rng.random() * summed[-1], side="right"))
        chosen.append(min(drawn, len(vectors) - 1))
    return vectors[chosen]


def _nearest(
    vectors: NDArray[np.float32], means: NDArray[np.float32]
) -> tuple[NDArray[np.int64], NDArray[np.float32]]:
    """The nearest mean of each vector (the first of equals), and its squared distance."""
    squares = np.einsum("kd,kd->k", means, means)
    cluster = np.empty(len(vectors), np.int64)
    far = np.empty(len(vectors), np.float32)
    step = max(1, _BLOCK // len(means))
    for at in range(0, len(vectors), step):
        block = vectors[at : at + step]
        distance = squares - 2.0 * (block @ means.T)
        cluster[at : at + step] = distance.argmin(axis=1)
        own = np.einsum("nd,nd->n", block, block)
        far[at : at + step] = distance.min(axis=1) + own
    return cluster, far


def _means(
    vectors: NDArray[np.float32],
    cluster: NDArray[np.int64],
    far: NDArray[np.float32],
    number: int,
) -> NDArray[np.float32]:
    """Mean of each cluster; an empty one is given the vector farthest from its own mean."""
    order = np.argsort(cluster, kind="stable")
    counts = np.bincount(cluster, minlength=number)
    first = np.concatenate(([0], np.cumsum(counts)))[:-1]
    filled = counts > 0
    sums = np.zeros((number, vectors.shape[1]))
    sums[filled] = np.add.reduceat(vectors[order], first[filled], axis=0, dtype=np.float64)
    means = sums / np.maximum(counts, 1)[:, None]
    empty = np.flatnonzero(~filled)
    if len(empty):
        means[empty] = vectors[np.argsort(-far, kind="stable")[: len(empty)]]
    return means.astype(np.float32)


def merged(
    vectors: NDArray[np.float32],
    clusters: int,
    label: NDArray[np.int16],
    take: NDArray[np.int32],
    labels: int,
    seed: int = 0,
) -> dict[str, NDArray[Any]]:
    """Cluster units and return the arrays of the merged graph.

    Parameters
    ----------
    vectors : (U, D) float32
        Motion of each unit at the same number of points.
    clusters : int
    label : (U,) int16
    take : (U,) int32
    labels : int
        How many labels there are.
    seed : int

    Returns
    -------
    dict
        ``cluster`` (U,): node of each unit. ``representative`` (M,): the unit whose motion
        is nearest to the node's mean. ``member`` with ``member_first`` (M + 1,): the units
        of each node. ``node`` with ``node_first`` (labels + 1,): the nodes that have each
        label. ``after`` with ``after_first``, ``before`` with ``before_first`` (M + 1,):
        the nodes at the other ends of a node's edges, ascending.
    """
    cluster, means = kmeans(vectors, clusters, seed)
    number = len(means)
    away = ((vectors - means[cluster]) ** 2).sum(axis=1)
    # The first of a cluster in order of distance, then of units.
    nearest = np.lexsort((away, cluster))
    first = np.searchsorted(cluster[nearest], np.arange(number))
    follows = np.flatnonzero(take[1:] == take[:-1])
    edges = np.unique(np.stack((cluster[follows], cluster[follows + 1]), axis=1), axis=0)
    back = edges[np.lexsort((edges[:, 0], edges[:, 1]))]
    has = np.unique(np.stack((label.astype(np.int32), cluster), axis=1), axis=0)
    member = np.argsort(cluster, kind="stable")
    return {
        "cluster": cluster,
        "representative": nearest[first].astype(np.int32),
        "member": member.astype(np.int32),
        "member_first": _offsets(cluster[member], number),
        "node": has[:, 1].astype(np.int32),
        "node_first": _offsets(has[:, 0], labels),
        "after": edges[:, 1].astype(np.int32),
        "after_first": _offsets(edges[:, 0], number),
        "before": back[:, 0].astype(np.int32),
        "before_first": _offsets(back[:, 1], number),
    }


def _offsets(sorted_keys: NDArray[Any], number: int) -> NDArray[np.int64]:
    """Where each key's entries begin, and where the last key's end."""
    return np.searchsorted(sorted_keys, np.arange(number + 1)).astype(np.int64)
