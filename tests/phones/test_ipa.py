"""Any IPA label has a class by how it is articulated."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipwright.phones import load_phone_set, load_reduction
from lipwright.phones.ipa import nearest_class


def classes(label: str) -> str:
    found = nearest_class(label)
    assert found is not None, label
    return " ".join(piece.label for piece in found[0])


@pytest.mark.parametrize(
    ("labels", "expected"),
    [
        ("p b m pʰ ɓ ʘ ʙ m̥", "bmp"),
        ("f v ɱ ɸ β ʋ", "f"),
        ("t d n ŋ ʈ ɖ ɳ ɲ ɾ r tʼ ǀ", "d"),
        ("k ɡ g kʼ c q ɢ x ɣ χ ʁ", "kg"),
        ("s z s̪ zʲ", "z"),
        ("ʃ ʒ tʃ t͡ʃ ʧ dʒ tɕ ʈʂ ʂ ʐ ɕ ʑ j ç", "sh"),
        ("θ ð", "th"),
        ("l ɫ ɬ ʎ ɭ", "l"),
        ("ɹ ɻ", "r"),
        ("h ɦ ħ ʕ ʔ", "h"),
        ("w ʍ ɥ u uː ʊ ʉ y yː ø ʏ ɯᵝ", "w"),
        ("i iː ɪ ɨ ɯ ĩ", "ih"),
        ("e ɛ eɪ ɛː ẽ ei", "eh"),
        ("æ ə ʌ ɐ ɘ", "ah"),
        ("a ɑ ɑː ã a˥˩", "aa"),
        ("ɔ ɒ œ ɔ̃", "ao"),
        ("o oː oʊ əʊ ou", "ow"),
        ("ɚ ɜː ɝ ə˞", "er"),
        ("aɪ ai ae ʌɪ", "ay"),
        ("aʊ au ao æʊ", "aw"),
        ("ɔɪ oi ɔi", "oy"),
    ],
)
def test_sounds_go_to_the_class_that_looks_like_them(labels: str, expected: str) -> None:
    assert {label: classes(label) for label in labels.split()} == dict.fromkeys(
        labels.split(), expected
    )


def test_every_class_of_speech_is_reached() -> None:
    reached = {
        piece.label
        for label in load_phone_set("ipa").labels
        for piece in (nearest_class(label) or ((), False))[0]
    }
    assert reached == set(load_phone_set("common").labels)


def test_every_label_of_the_set_has_a_class() -> None:
    assert [label for label in load_phone_set("ipa").labels if nearest_class(label) is None] == []


@pytest.mark.parametrize(
    ("label", "expected"),
    [
        *(("ɑːɹ", "aa r"), ("aɪɚ", "ay er"), ("əl", "ah l"), ("n̩", "ah d"), ("ts", "d z")),
        *(("pf", "bmp f"), ("k͡p", "kg bmp"), ("iə", "ih ah"), ("ui", "w ih"), ("uai", "w ay")),
    ],
)
def test_a_label_of_two_sounds_becomes_two(label: str, expected: str) -> None:
    assert classes(label) == expected


def test_the_vowel_takes_the_larger_share() -> None:
    found = nearest_class("ɑːɹ")
    assert found is not None
    vowel, consonant = found[0]
    assert vowel.share > consonant.share


@pytest.mark.parametrize(
    ("label", "exact"),
    [("p", True), ("ˈɑː", True), ("t̪", True), ("y", False), ("x", False), ("ø", False)],
)
def test_stand_ins_are_told_from_exact_ones(label: str, exact: bool) -> None:
    found = nearest_class(label)
    assert found is not None
    assert found[1] is exact


@pytest.mark.parametrize("label", ["", "?", "foo!", "Ж", "ʲ", "ː", "12", "♥", "日"])
def test_what_is_no_ipa_has_no_class(label: str) -> None:
    assert nearest_class(label) is None


@given(st.text(max_size=8))
def test_any_label_is_answered(label: str) -> None:
    found = nearest_class(label)
    if found is not None:
        assert {piece.label for piece in found[0]} <= set(load_phone_set("common").labels)
        assert all(piece.share > 0 for piece in found[0])


def test_english_goes_the_same_way_as_in_arpabet() -> None:
    by_letters = load_reduction("ipa", "arpabet").table
    to_common, ipa = load_reduction("arpabet").table, load_reduction("ipa").table
    # A glottal stop is a t to a dictionary and nothing to the eye; ɒ is rounded in Britain.
    apart = {"ʔ", "ɒ", "ɒː", "x", "r"}
    for label in by_letters.keys() - apart:
        through = [to_common[piece.label][0].label for piece in by_letters[label]]
        assert through == [piece.label for piece in ipa[label]], label
