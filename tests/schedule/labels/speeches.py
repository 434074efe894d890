"""One short speech, "pa, 1984": what the formats are asked to keep."""

from lipwright.phones import PhoneTrack
from lipwright.speech import Speech
from lipwright.timeline import Interval, Tier

PHONES = Tier(
    (
        Interval("sil", 0.0, 0.2, 1.0),
        Interval("p", 0.2, 0.28125, 0.5),
        Interval("aa", 0.28125, 0.5, 0.75),
        Interval("sil", 0.5, 0.7, 1.0),
        Interval("ey", 0.7, 0.9, 0.25),
        Interval("t", 0.9, 1.0, 0.5),
    )
)
WORDS = Tier.of(("pa", 0.2, 0.5), ("1984", 0.7, 1.0))
SPEECH = Speech(
    PhoneTrack(PHONES),
    WORDS,
    text="Pa, 1984",
    language="en-us",
    source="say",
    confidence=0.5,
    notes=("a note",),
)


def plain(tier: Tier) -> list[tuple[str, float, float]]:
    """Return a tier's rows without confidences, to the microsecond."""
    return [(i.label, round(i.start, 6), round(i.end, 6)) for i in tier]
