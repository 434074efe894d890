"""Each label of 41 languages against ``classes.tsv``, in which a phonetician's answer stands.

A row names a language, the classes, whether they show all that is seen of the sound
(``exact``) or only stand in, and the labels (spelled as ``say`` gives them). Correct a
row first where it is wrong, then the chart (``data/articulation/ipa.json``) or what a
voice's label means (``data/phones/espeak-to-ipa.json``).
"""

from pathlib import Path

import pytest

from lipwright.phones import PhoneTrack, load_reduction
from lipwright.phones.ipa import nearest
from lipwright.phones.languages import language_name, languages, sample_text
from lipwright.schedule.say import say
from lipwright.speech import Speech

Row = tuple[str, str]
VOICES = {"en": "en-us"}


def by_hand() -> dict[str, dict[str, Row]]:
    """The table: language → label → classes and fit."""
    table: dict[str, dict[str, Row]] = {}
    for line in Path(__file__).with_name("classes.tsv").read_text("utf-8").splitlines():
        if line.startswith("#"):
            continue
        language, classes, fit, labels = line.split("\t")
        for label in labels.split():
            assert label not in table.setdefault(language, {}), f"{language} {label} stands twice"
            table[language][label] = (classes, fit)
    return table


TABLE = by_hand()


@pytest.mark.parametrize("language", TABLE)
def test_each_label_has_the_class_that_was_found_by_hand(language: str) -> None:
    found = {}
    for label in TABLE[language]:
        answer = nearest(label)
        assert answer is not None, label
        classes = " ".join(piece.label for piece in answer.pieces)
        found[label] = (classes, "exact" if answer.exact else "stand-in")
    assert found == TABLE[language]


def test_the_table_holds_every_language_that_has_a_paragraph() -> None:
    assert tuple(TABLE) == languages()
    assert len(languages()) >= 30


IN_IPA = tuple(code for code in TABLE if code != "cmn")
"""Mandarin is spoken in the sounds of pinyin: ``tests/schedule/mandarin``."""


@pytest.fixture(scope="module")
def spoken() -> dict[str, Speech]:
    return {code: say(sample_text(code), voice=VOICES.get(code, code)) for code in IN_IPA}


@pytest.mark.parametrize("language", IN_IPA)
def test_a_paragraph_is_spoken_whole(language: str, spoken: dict[str, Speech]) -> None:
    speech = spoken[language]
    assert {phone.label for phone in speech.phones} - {"sil"} == set(TABLE[language])
    assert speech.notes == ()
    assert 20 < speech.duration < 60
    assert 5 <= len(sample_text(language).splitlines()) <= 8
    if language != "ja":  # its words are cut by the voice
        assert len(speech.words) == sum(
            any(map(str.isalpha, word)) for word in sample_text(language).split()
        )


@pytest.mark.parametrize("language", IN_IPA)
def test_the_report_counts_what_is_exact(language: str, spoken: dict[str, Speech]) -> None:
    track = spoken[language].phones
    rows, report = load_reduction("ipa").rows(track)
    stand_ins = {label for label, (_, fit) in TABLE[language].items() if fit == "stand-in"}
    labels = [phone.label for phone in track if phone.label != "sil"]
    assert set(report.stand_ins) == stand_ins
    expected = sum(label not in stand_ins for label in labels) / len(labels)
    assert report.share_exact == pytest.approx(expected)
    assert sum(report.seconds.values()) == pytest.approx(
        sum(p.duration for p in track if p.label != "sil")
    )
    assert load_reduction("ipa").share_exact(track) == report.share_exact
    assert report.share_exact > 0.8
    assert rows[-1][2] == track.tier.end


def test_shares_of_nothing_and_of_known_times() -> None:
    from lipwright.timeline import Tier

    reduction = load_reduction("ipa")
    assert reduction.share_exact(PhoneTrack(Tier.of(("sil", 0, 1)), "ipa")) == 1.0
    track = PhoneTrack(Tier.of(("sil", 0, 1), ("m", 1, 2), ("y", 2, 5), ("m", 5, 6)), "ipa")
    report = reduction.rows(track)[1]
    assert report.share_exact == pytest.approx(2 / 3)
    assert report.share_exact_of_time == pytest.approx(2 / 5)


def test_names_and_regions() -> None:
    assert [language_name(code) for code in ("de", "fr-fr", "zh")] == [
        "German",
        "French",
        "Mandarin",
    ]
    assert sample_text("pt_BR") == sample_text("pt")
