"""What espeak-ng's labels mean in a language."""

import pytest

from lipwright.phones import load_reduction
from lipwright.schedule.say import say
from lipwright.schedule.say.spelling import _read, plain_label


@pytest.mark.parametrize(
    ("language", "labels", "expected"),
    [
        ("", "ˈɑː tS r. th y -", "ɑː tʃ r th y "),
        ("cmn", "th tɕh ts.h s. i. o- onɡ χ", "tʰ tɕʰ tʂʰ ʂ ɨ ɤ ʊŋ x"),
        ("de", "r ˈɾ ɜ ˈɔø yː", "ʁ ʁ ɐ ɔɪ yː"),
        ("ru", "y ˈy ɭ ˈo tʃʲ", "ɨ ɨ ɫ o̞ tʃʲ"),
        ("hi", "c cʰ ɟ r.", "tʃ tʃʰ dʒ ɽ"),
        ("ko", "q- q p- t- ɐ", "k͈ k͈ p͈ t͈ a"),
        ("vi", "y ˈyə əː ə", "ɯ ɯə ɤː ə"),
        ("fr-be", "ə- y", "ø̞ y"),
        ("es-419", "β ˈo", "b̞ o̞"),
        ("en-us", "ˈoʊ ɹ ɜː ə y", "oʊ ɹ ɜː ə y"),
    ],
)
def test_labels_are_ipa_in_their_language(language: str, labels: str, expected: str) -> None:
    assert " ".join(plain_label(label, language) for label in labels.split()) == expected


def test_english_is_left_as_it_is() -> None:
    assert not any("en" in names.split() for names in _read().languages)


def test_a_foreign_word_is_spelled_in_its_own_language() -> None:
    labels = [phone.label for phone in say("Это jazz и rock", voice="ru").phones]
    assert "ɹ" in labels
    german = say("Herr Turner surft", voice="de")
    reduced, _ = load_reduction("ipa").rows(german.phones)
    assert {"kg", "ah"} <= {label for label, _, _ in reduced}


def test_every_row_says_what_a_label_means_with_an_example() -> None:
    for names, rows in _read().languages.items():
        assert len({row.label for row in rows}) == len(rows), names
        assert all(row.example for row in rows)
        assert all(load_reduction("ipa").of(row.ipa) for row in rows if len(row.ipa.strip("͈")) > 0)
