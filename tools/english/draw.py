"""How the English set is drawn: when each of FaceFX's poses comes, and how long it stays."""

from __future__ import annotations

from tools.drawing import Hand
from tools.english.knowledge import CLOSING, SOUNDS, TONGUE

HAND = Hand(
    sounds=SOUNDS,
    closing=CLOSING,
    poses=("open", "W", "ShCh", "PBM", "FV", "wide", *TONGUE),
    onset={"open": 0.05, "W": 0.05, "ShCh": 0.15, "wide": 0.30},
    offset={"open": 0.68, "W": 0.70, "ShCh": 0.88, "wide": 0.92},
    lead={"open": 0.60, "W": 0.85, "ShCh": 0.70, "wide": 0.60},
    # Rounding stays longest, unless the lips must spread.
    linger={"open": 0.50, "W": 0.90, "ShCh": 0.50, "wide": 0.50},
    closed={"open": 0.30},
    # Lips come forward more slowly than the jaw drops.
    later={"W": 0.28},
    rivals=(("W", "wide"),),
    spread=0.2,
)
