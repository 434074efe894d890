"""What Cao et al. 2004 print: Tables 1 to 4."""

TAKES, UNITS, MINUTES = 246, 7256, 53
"""Sentences, animes and minutes of their database."""

CLUSTERED: dict[int, tuple[float, float]] = {
    0: (53.87, 0.015),
    1000: (14.30, 0.016),
    500: (18.20, 0.015),
    200: (13.05, 0.016),
}
"""Table 1: for each number of clusters the seconds of PQ-Matching(4) and of GreedyMatching."""

Row = tuple[float, int, float]

SEARCHES: dict[int, dict[str, Row]] = {
    22: {
        "greedy": (0.02, 5, 0.11),
        "pq(3)": (0.75, 7, 0.08),
        "pq(4)": (6.30, 5, 0.08),
        "pq(5)": (39.61, 5, 0.08),
        "pq(6)": (106.45, 5, 0.08),
    },
    38: {
        "greedy": (0.02, 13, 0.12),
        "pq(3)": (2.39, 14, 0.12),
        "pq(4)": (18.95, 14, 0.12),
        "pq(5)": (649.31, 13, 0.12),
    },
    37: {
        "greedy": (0.02, 14, 0.11),
        "pq(3)": (3.30, 16, 0.09),
        "pq(4)": (51.19, 15, 0.11),
        "pq(5)": (580.20, 15, 0.10),
    },
}
"""Tables 2, 3 and 4 by the number of phones: seconds, jumps and RMS distance of each search."""
