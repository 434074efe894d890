"""How each speech sound looks on a crab, which has no lips.

What speaks: a lower plate that drops (``mouth_open``), the rim of the mouth (``mouth_OO``,
``smile``, ``frown``, ``bare_teeth``, ``bite``), two mandibles that go sideways
(``mandibles_in``, ``mandibles_out``) and a tongue; the eyes
rise a little (``stalks_up``) where the voice opens. Levels are of these poses, 0..1.

A viewer reads sounds on it by analogy, so each keeps what a listener expects to see (p b m
shut the mouth, /uw/ is round, /iy/ broad) and adds what only a crab can do: it speaks from
side to side rather than up and down. Open vowels throw the mandibles apart, /r/ scowls, and
the teeth are never shy. Levels are an animator's choice; nothing was measured.
"""

from __future__ import annotations

from tools.sounds import CONSONANT_AT, Sound, diphthong, vowel

SNAP_AT = (0.26, 0.60)
"""Mandibles meet early in their sound: they are light, and a pinch should be seen."""


def consonant(jaw: float, rounding: float, spreading: float, **levels: float) -> Sound:
    """Return a consonant whose plate and rim follow its neighbours by these shares."""
    ahead = {
        "mouth_open": jaw,
        "mouth_OO": rounding,
        "smile": spreading,
        "mandibles_out": spreading,
        "frown": 0.5 * rounding,
    }
    behind = {pose: 0.7 * share for pose, share in ahead.items()}
    return Sound("consonant", levels, at=CONSONANT_AT, lets_through=ahead, keeps=behind)


SOUNDS: dict[str, Sound] = {
    # Vowels: the plate drops with openness, as a jaw does; the mandibles swing apart with it,
    # so that an open vowel is a broad gesture and not only a deep one.
    "ah": vowel(mouth_open=0.45, mandibles_out=0.45, stalks_up=0.12),
    "aa": vowel(mouth_open=0.88, mandibles_out=0.70, stalks_up=0.40),
    # Round and open: a trumpet.
    "ao": vowel(mouth_open=0.58, mouth_OO=0.52, stalks_up=0.25),
    "eh": vowel(mouth_open=0.50, smile=0.38, mandibles_out=0.55, stalks_up=0.20),
    # The sound of a bad mood: corners down, tongue drawn back.
    "er": vowel(mouth_open=0.30, frown=0.85, tongue_back=0.45),
    # A grin: broad, the teeth shown, the plate nearly shut.
    "ih": vowel(mouth_open=0.06, smile=0.80, bare_teeth=0.55, mandibles_out=0.30),
    "w": vowel(mouth_open=0.10, mouth_OO=0.96),
    # Diphthongs: from … to …, drawn large, since the rim is all there is to show them.
    "ow": diphthong(
        {"mouth_open": 0.55, "mouth_OO": 0.48, "stalks_up": 0.25},
        {"mouth_open": 0.12, "mouth_OO": 0.88},
    ),
    "aw": diphthong(
        {"mouth_open": 0.80, "mandibles_out": 0.65, "stalks_up": 0.35},
        {"mouth_open": 0.18, "mouth_OO": 0.72},
    ),
    "oy": diphthong(
        {"mouth_open": 0.45, "mouth_OO": 0.76, "stalks_up": 0.20},
        {"mouth_open": 0.18, "smile": 0.70, "bare_teeth": 0.35},
    ),
    "ay": diphthong(
        {"mouth_open": 0.80, "mandibles_out": 0.70, "stalks_up": 0.35},
        {"mouth_open": 0.22, "smile": 0.66, "bare_teeth": 0.30},
    ),
    # Consonants: what they let through of plate, rounding and spreading, then their own.
    # h is breath: the mandibles stand off and the vowel shows.
    "h": consonant(0.70, 0.80, 0.70, mouth_open=0.14, mandibles_out=0.35),
    # r is a growl, half round: corners down.
    "r": consonant(0.25, 0.55, 0.15, mouth_open=0.10, mouth_OO=0.34, frown=0.66, tongue_back=0.40),
    # l shows the tip of the tongue at the upper teeth: the plate must leave a view of it.
    "l": consonant(0.45, 0.35, 0.45, mouth_open=0.44, tongue_up=0.95),
    # s and z: two rows of teeth with air between.
    "z": consonant(0.08, 0.30, 0.40, mouth_open=0.05, bare_teeth=0.88, smile=0.18),
    # sh: teeth in a funnel that is pushed forward.
    "sh": consonant(0.10, 0.40, 0.10, mouth_open=0.06, mouth_OO=0.42, bare_teeth=0.72),
    # th: the tongue comes out, shamelessly.
    "th": consonant(0.20, 0.25, 0.40, mouth_open=0.34, tongue_out=0.95),
    # t, d, n: the tongue's tip again, quicker and less open than l, some teeth.
    "d": consonant(0.30, 0.45, 0.50, mouth_open=0.20, bare_teeth=0.22, tongue_up=0.85),
    # k, g: the tongue's back against the roof, behind a slack plate.
    "kg": consonant(0.45, 0.50, 0.55, mouth_open=0.32, mandibles_out=0.22, tongue_back=0.92),
    # Closures. f, v: the plate's edge goes in behind the upper teeth. p, b, m: the mandibles
    # snap together before the mouth, which shuts behind them. On the way there and back
    # something of a neighbour's rounding, smile or scowl may show.
    "f": Sound(
        "closure",
        {"bite": 1.0, "mouth_open": 0.04},
        at=(0.30, 0.58),
        lets_through={"smile": 0.30, "mouth_OO": 0.20},
        keeps={"smile": 0.20, "mouth_OO": 0.12},
    ),
    "bmp": Sound(
        "closure",
        {"mandibles_in": 1.0},
        at=SNAP_AT,
        lets_through={"mouth_OO": 0.35, "smile": 0.25, "frown": 0.30},
        keeps={"mouth_OO": 0.25, "smile": 0.20, "frown": 0.20},
    ),
    "sil": Sound("silence", {}),
}

CLOSING = {"bmp": "mandibles_in", "f": "bite"}
TONGUE = ("tongue_back", "tongue_up", "tongue_out")

PRIORITY = (
    "stalks_up", "mouth_open", "mandibles_out", "smile", "frown", "mouth_OO", "bare_teeth", *TONGUE,
    "bite", "mandibles_in",
)  # fmt: skip
"""From the pose that always gives way to the one that never does."""

CONFLICTS = (
    # Nothing may hold the mouth open behind mandibles that have met: above half of the
    # pinch the plate is shut, the teeth are covered, the tongue is in.
    ("mouth_open", "mandibles_in", 0.5),
    ("bare_teeth", "mandibles_in", 0.5),
    ("tongue_out", "mandibles_in", 0.4),
    ("tongue_up", "mandibles_in", 0.9),
    # Mandibles cannot be together and apart.
    ("mandibles_out", "mandibles_in", 0.5),
    # A smile or a funnel is too broad or too long for them to meet before it.
    ("smile", "mandibles_in", 0.8),
    ("mouth_OO", "mandibles_in", 0.9),
    # The plate's edge is behind the upper teeth only while the plate is up.
    ("mouth_open", "bite", 0.6),
    ("bare_teeth", "bite", 0.6),
    ("tongue_out", "bite", 0.5),
    ("mouth_OO", "bite", 0.8),
    # The corners go one way at a time.
    ("smile", "mouth_OO", 1.0),
    ("smile", "frown", 1.0),
    # A tongue that is out is not up.
    ("tongue_up", "tongue_out", 1.0),
)
"""Pairs of poses that exclude each other, and the level of the stronger that ends the other."""
