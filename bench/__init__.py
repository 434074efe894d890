"""Measures that print figures: never part of the test run.

``make bench`` runs them all, each in a process of its own; ``python -m bench.stages`` runs
one. Each prints one JSON object per line: the median of several runs, and their spread.
"""
