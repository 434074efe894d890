"""How the crab's set is drawn: chitin is lighter than flesh; shapes come late and snap."""

from __future__ import annotations

from tools.crab.knowledge import CLOSING, SOUNDS, TONGUE
from tools.drawing import Hand

SHUT = 0.24

HAND = Hand(
    sounds=SOUNDS,
    closing=CLOSING,
    poses=(
        "mouth_open",
        "mouth_OO",
        "smile",
        "frown",
        "bare_teeth",
        "bite",
        "mandibles_in",
        "mandibles_out",
        *TONGUE,
        "stalks_up",
    ),
    onset={
        "stalks_up": 0.0,
        "mouth_open": 0.10,
        "mouth_OO": 0.10,
        "mandibles_out": 0.04,
        "smile": 0.25,
        "frown": 0.15,
    },
    offset={
        "stalks_up": 1.0,
        "mouth_open": 0.70,
        "mouth_OO": 0.78,
        "mandibles_out": 0.90,
        "smile": 0.94,
        "frown": 0.90,
    },
    # The mandibles set out first and come home last: overlapping action.
    lead={
        "stalks_up": 0.90,
        "mouth_open": 0.50,
        "mouth_OO": 0.75,
        "mandibles_out": 0.80,
        "smile": 0.55,
        "frown": 0.60,
    },
    linger={
        "stalks_up": 0.90,
        "mouth_open": 0.42,
        "mouth_OO": 0.75,
        "mandibles_out": 0.70,
        "smile": 0.50,
        "frown": 0.55,
    },
    closed={"mouth_open": SHUT, "mandibles_out": SHUT, "bare_teeth": SHUT},
    later={"mouth_OO": 0.16, "smile": 0.10},
    rivals=(("mouth_OO", "smile"), ("mouth_OO", "mandibles_out"), ("frown", "smile")),
    spread=0.2,
)
