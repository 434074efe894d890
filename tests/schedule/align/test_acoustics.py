"""What sounds of other languages are looked for as: a table that holds for all of IPA."""

import json

import pytest

from lipwright.errors import LabelError
from lipwright.phones import load_phone_set
from lipwright.phones.sets import DATA
from lipwright.schedule.align.acoustics import sounds_like, ways_of
from lipwright.schedule.align.model import load_model


def chart() -> list[str]:
    """Every letter whose articulation the project knows, and every label of the IPA set."""
    table = json.loads((DATA.parent / "articulation" / "ipa.json").read_text("utf-8"))
    labels = [label for label in load_phone_set("ipa").labels if label != "sil"]
    spellings = [name for name in load_phone_set("ipa").aliases if name.isalpha() and name != "pau"]
    letters = [row["ipa"] for kind in ("vowels", "consonants") for row in table[kind]]
    return [*letters, *labels, *spellings]


def test_every_label_sounds_like_phones_of_the_model() -> None:
    speech = {phone for phone in load_model().phones if phone.isalpha() and phone != "sil"}
    for label in chart():
        ways = sounds_like(label)
        assert ways, label
        assert all(way and set(way) <= speech for way in ways), label
        assert len(set(ways)) == len(ways), label


@pytest.mark.parametrize(
    ("label", "language", "first"),
    [
        ("p", "", "p"),
        ("iː", "", "iy"),
        ("ts", "", "t s"),
        ("t͡s", "", "t s"),
        ("ʦ", "lb", "t s"),
        ("g", "", "g"),
        ("tɕʰ", "", "ch"),
        ("tɕh", "cmn", "ch"),
        ("y", "fr", "uw"),
        ("y", "ru", "ih"),  # how the Russian voice writes its ы
        ("ɔ̃", "fr", "ow"),
        ("ɡʲ", "", "g"),
        ("iou", "cmn", "iy ow"),
        ("aa", "et", "aa"),
        ("ss", "it", "s"),
        ("n̩", "de", "ah n"),
        ("ç", "de", "hh"),
    ],
)
def test_what_a_label_sounds_like_first(label: str, language: str, first: str) -> None:
    assert sounds_like(label, language)[0] == tuple(first.split())


@pytest.mark.parametrize("label", ["", "漢", "ж", "7", "ʰ"])
def test_what_is_no_sound_is_refused(label: str) -> None:
    with pytest.raises(LabelError, match="no sound is known"):
        sounds_like(label)


def test_a_word_departs_from_its_best_way_one_sound_at_a_time() -> None:
    first, *others = ways_of(["x", "aː", "x"])
    assert first == (("x", ("hh",)), ("aː", ("aa",)), ("x", ("hh",)))
    assert (("x", ("k",)), ("aː", ("aa",)), ("x", ("k",))) in others
    assert all(way[0] == way[2] for way in others)


def test_a_trill_takes_no_burst_from_the_stop_before_it() -> None:
    heard = {tuple(phone for _, phones in way for phone in phones) for way in ways_of(["t", "r"])}
    assert ("t", "er", "r") in heard
    assert not any(way[:2] in (("t", "d"), ("d", "d")) for way in heard)
    assert ways_of(["a", "r"])[0][1] == ("r", ("d", "er"))
    assert ways_of(["t", "d"])[0] == (("t", ("t",)), ("d", ("d",)))


def test_long_words_have_few_ways() -> None:
    assert 1 < len(ways_of(list("ɾʁɲʔʕeɛoʊɑ") * 9)) <= 6


def test_a_vowel_that_speakers_leave_out_may_be_left_out() -> None:
    labels = {tuple(label for label, _ in way) for way in ways_of(["d", "ə"], "fr")}
    assert labels == {("d", "ə"), ("d",)}
    assert {tuple(label for label, _ in way) for way in ways_of(["ə"], "fr-be")} == {("ə",)}
    assert {tuple(label for label, _ in way) for way in ways_of(["d", "ə"], "sv")} == {("d", "ə")}
