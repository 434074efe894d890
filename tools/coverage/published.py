"""The figures of Xu et al. 2013, section 3.1.1: Table 2, and the text around Figure 2."""

from __future__ import annotations

TABLE = (
    ("ah", "d", 4.62), ("d", "ih", 3.44), ("ih", "d", 2.68), ("d", "d", 2.64),
    ("d", "ah", 2.40), ("eh", "d", 1.83), ("d", "w", 1.66), ("ah", "r", 1.58),
    ("ih", "w", 1.50), ("d", "z", 1.43), ("ih", "z", 1.37), ("ih", "kg", 1.32),
    ("aa", "d", 1.27), ("z", "ih", 1.22), ("r", "ih", 1.21), ("th", "ah", 1.19),
    ("z", "d", 1.16), ("kg", "ah", 1.15), ("ah", "l", 1.10), ("z", "ah", 1.04),
    ("ah", "bmp", 0.98),
)  # fmt: skip
"""First and second phone, and percent of all pairs; the most frequent first."""

KINDS = 441
NEVER = 104
FIRST = 283
FIRST_SHARE = 0.991
