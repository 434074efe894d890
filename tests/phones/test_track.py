"""Tracks of phones: spelled as their set spells them."""

import pytest

from lipwright.errors import LabelError
from lipwright.phones import PhoneTrack
from lipwright.timeline import Interval, Tier


def test_labels_take_their_sets_own_spelling_and_keep_the_rest() -> None:
    track = PhoneTrack(
        Tier((Interval("HH", 0.0, 0.1, 0.9), Interval("AH0", 0.1, 0.2), Interval("sil", 0.2, 1.0)))
    )
    assert track.normalised().tier == Tier(
        (Interval("hh", 0.0, 0.1, 0.9), Interval("ah", 0.1, 0.2), Interval("sil", 0.2, 1.0))
    )
    assert len(track) == 3
    assert [phone.label for phone in track] == ["HH", "AH0", "sil"]


def test_all_unknown_labels_are_named_at_once() -> None:
    track = PhoneTrack(Tier.of(("xx", 0, 1), ("aa", 1, 2), ("yy", 2, 3), ("xx", 3, 4)))
    with pytest.raises(LabelError, match="'xx', 'yy': not phones of 'arpabet'; expected labels"):
        track.normalised()
