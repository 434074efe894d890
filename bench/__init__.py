"""Measures that print figures: never part of the test run.

``make bench`` runs them all, each in a process of its own; ``python -m bench.stages`` runs
one. Each prints one JSON object per line: the median of several runs, and their spread.
"""

import os

# One thread: the matrices are small, and threads that wait for each other blur the figures.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
