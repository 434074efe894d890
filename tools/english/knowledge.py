"""What is known of English speech sounds, as far as a face shows it.

Each class of the Common Phoneme Set has one or two *targets* (two for diphthongs: where
the vowel begins and where it goes). A target is the level of each pose in that sound when
nothing disturbs it. Consonants besides say how far they let their neighbours show through:
the lips of a /t/ are free to take the shape of the vowel beside it, those of a /p/ are not.

Levels are of the nine FaceFX poses, 0..1, relative to what the pose shows at 1. They follow
what is common knowledge of the sounds of English: height of vowels (jaw and lips), rounding
and spreading of the lips, place of articulation of the tongue, labial and labiodental
closure. What recorded faces say of whole classes (how far open on average, how narrow, how
early) has moved them: s, z and l part the lips farther than was thought, r, w and th less;
between vowels the jaw goes back up; lips spread less than they round; a mouth that speaks is
narrower than one at rest.
Levels chosen anew on one half of the words serve the other half nearly as well as its own
do (``bench/held_out``). No recorded face was copied: no curve here is anybody's trajectory.
"""

from __future__ import annotations

from tools.sounds import CONSONANT_AT, Sound, diphthong, vowel


def consonant(jaw: float, rounding: float, spreading: float, **levels: float) -> Sound:
    """Return a consonant whose lips and jaw follow its neighbours by these shares."""
    ahead = {"open": jaw, "W": rounding, "wide": spreading}
    behind = {"open": 0.8 * jaw, "W": 0.55 * rounding, "wide": 0.8 * spreading}
    return Sound("consonant", levels, at=CONSONANT_AT, lets_through=ahead, keeps=behind)


SOUNDS: dict[str, Sound] = {
    # Vowels. 'open' falls with vowel height; 'W' is rounding, 'wide' is spreading. The class
    # 'ah' holds the open vowel of "cat" and every schwa: it opens less than 'eh'.
    "ah": vowel(open=0.38, W=0.06, wide=0.04),
    "aa": vowel(open=0.64),
    "ao": vowel(open=0.30, W=0.64),
    "eh": vowel(open=0.54, wide=0.28),
    "er": vowel(open=0.26, W=0.18, ShCh=0.32, tBack=0.25),
    "ih": vowel(open=0.31, wide=0.30),
    "w": vowel((0.40, 0.66), open=0.10, W=0.92, tBack=0.30),
    # Diphthongs: from … to … In running speech 'ay' does not reach its /ih/.
    "ow": diphthong({"open": 0.30, "W": 0.44}, {"open": 0.18, "W": 0.80}),
    "aw": diphthong({"open": 0.50, "wide": 0.30}, {"open": 0.18, "W": 0.40}),
    "oy": diphthong({"open": 0.38, "W": 0.64}, {"open": 0.34, "wide": 0.28}),
    "ay": diphthong({"open": 0.54, "W": 0.12}, {"open": 0.50, "W": 0.04, "wide": 0.08}),
    # Consonants: jaw, rounding and spreading that they let through, then their own shape.
    # In s and z the teeth meet and the lips part; behind d, l and k the jaw stays loose.
    # A mouth at rest is broader than one that speaks: where lips are free they are still
    # drawn in a little (W about 0.1).
    "h": consonant(0.70, 0.80, 0.80, open=0.04),
    "r": consonant(0.30, 0.60, 0.20, open=0.03, W=0.56, ShCh=0.12, tBack=0.20),
    "l": consonant(0.45, 0.45, 0.45, open=0.48, W=0.04, tRoof=0.80),
    "z": consonant(0.15, 0.40, 0.40, open=0.29, W=0.05, wide=0.28, tRoof=0.35),
    "sh": consonant(0.15, 0.50, 0.10, open=0.15, W=0.16, ShCh=0.92, tRoof=0.30),
    "th": consonant(0.20, 0.35, 0.40, open=0.06, W=0.20, tTeeth=0.95),
    "d": consonant(0.30, 0.50, 0.50, open=0.14, W=0.05, tRoof=0.82),
    "kg": consonant(0.45, 0.55, 0.55, open=0.12, W=0.04, tBack=0.78),
    # Closures: what must be seen. The jaw may ride along, the lips may not; pressed lips
    # draw the corners in.
    "f": Sound(
        "closure",
        {"FV": 1.0, "open": 0.05, "W": 0.12},
        at=(0.30, 0.56),
        lets_through={"W": 0.30, "wide": 0.25},
        keeps={"W": 0.15, "wide": 0.20},
    ),
    "bmp": Sound(
        "closure",
        {"PBM": 1.0, "W": 0.36},
        at=(0.30, 0.56),
        lets_through={"W": 0.45, "wide": 0.30},
        keeps={"W": 0.35, "wide": 0.25},
    ),
    "sil": Sound("silence", {}),
}

CLOSING = {"bmp": "PBM", "f": "FV"}
TONGUE = ("tBack", "tRoof", "tTeeth")

#: A word for each pair where English has a common one; the brackets of phone examples
#: are not needed: the pair says where to look.
WORDS: dict[tuple[str, str], str] = {
    ("f", "ah"): "fat", ("l", "ow"): "low", ("bmp", "ah"): "map", ("ah", "bmp"): "cup",
    ("w", "ih"): "we", ("sh", "w"): "shoe", ("sh", "ih"): "she", ("th", "ah"): "the",
    ("d", "w"): "do", ("d", "ih"): "tea", ("kg", "ow"): "go", ("kg", "w"): "cool",
    ("kg", "ah"): "cat", ("h", "aw"): "how", ("h", "w"): "who", ("h", "ih"): "he",
    ("h", "eh"): "head", ("bmp", "oy"): "boy", ("bmp", "ay"): "buy", ("bmp", "ih"): "be",
    ("bmp", "w"): "boot", ("bmp", "eh"): "pet", ("bmp", "er"): "purr", ("bmp", "l"): "play",
    ("bmp", "r"): "pray", ("f", "ih"): "feel", ("f", "ao"): "four", ("f", "er"): "fur",
    ("f", "ay"): "five", ("f", "l"): "fly", ("f", "r"): "free", ("ah", "d"): "add",
    ("ih", "d"): "eat", ("eh", "d"): "aid", ("aa", "d"): "odd", ("ao", "l"): "all",
    ("aw", "d"): "out", ("ay", "d"): "eyed", ("oy", "l"): "oil", ("ow", "d"): "ode",
    ("er", "d"): "heard", ("w", "d"): "food", ("ih", "z"): "is", ("z", "ih"): "see",
    ("z", "d"): "stay", ("d", "z"): "bits", ("d", "d"): "and", ("d", "r"): "tree",
    ("kg", "r"): "cry", ("kg", "l"): "clay", ("z", "l"): "slow", ("z", "w"): "sweet",
    ("z", "bmp"): "spy", ("z", "kg"): "sky", ("l", "ih"): "lead", ("l", "ay"): "lie",
    ("r", "eh"): "red", ("r", "ow"): "row", ("r", "ay"): "rye", ("r", "w"): "rue",
    ("th", "ih"): "these", ("th", "r"): "three", ("ih", "th"): "teeth", ("w", "aa"): "want",
    ("w", "er"): "were", ("w", "ah"): "one", ("w", "eh"): "wet", ("w", "ay"): "why",
    ("kg", "d"): "act", ("l", "f"): "self", ("ah", "f"): "laugh", ("ih", "f"): "leaf",
    ("eh", "bmp"): "ape", ("ih", "bmp"): "deep", ("ow", "bmp"): "hope", ("w", "bmp"): "hoop",
    ("aa", "bmp"): "top", ("d", "kg"): "think", ("ih", "kg"): "seek", ("ah", "kg"): "back",
    ("ah", "r"): "around", ("aa", "r"): "car", ("ao", "r"): "more", ("eh", "r"): "air",
    ("ih", "r"): "ear", ("ah", "l"): "pal", ("eh", "l"): "sell", ("ih", "l"): "feel",
    ("sh", "aa"): "shop", ("sh", "ow"): "show", ("sh", "er"): "shirt", ("d", "ow"): "no",
    ("d", "ay"): "tie", ("d", "aw"): "down", ("d", "oy"): "toy", ("d", "ao"): "dog",
    ("z", "ow"): "so", ("z", "eh"): "said", ("z", "ah"): "sat", ("z", "er"): "sir",
    ("h", "ah"): "hat", ("h", "aa"): "hot", ("h", "er"): "her", ("h", "ow"): "home",
}  # fmt: skip
