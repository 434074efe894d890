"""Any IPA label has a class by how it is articulated."""

import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipwright.phones import load_phone_set, load_reduction
from lipwright.phones.ipa import nearest, nearest_class
from lipwright.phones.sets import DATA


def classes(label: str) -> str:
    found = nearest_class(label)
    assert found is not None, label
    return " ".join(piece.label for piece in found[0])


@pytest.mark.parametrize(
    ("labels", "expected"),
    [
        ("p b m pʰ bʱ pʼ p͈ ɓ ʘ ʙ m̥ b̞", "bmp"),
        ("f v ɱ ɸ β ʋ", "f"),
        ("t d n ŋ ʈ ɖ ɳ ɲ ɾ ɽ r tʼ tʰ tˤ t͈ dʱ ɗ r̩ ǀ ǃ", "d"),
        ("k ɡ g kʼ c q ɢ x ɣ χ ʁ ʀ ç", "kg"),
        ("s z s̪ zʲ", "z"),
        ("ʃ ʒ tʃ t͡ʃ ʧ dʒ tɕ tɕʰ ʈʂ ʂ ʐ ɕ ʑ ɧ r̝ r̝̊ j ʝ", "sh"),
        ("θ ð", "th"),
        ("l ɫ ɬ ʎ ɭ", "l"),
        ("ɹ ɻ", "r"),
        ("h ɦ ħ ʕ ʔ", "h"),
        ("w ʍ ɥ u uː ʊ ʉ y yː ʏ ɯᵝ", "w"),
        ("i iː ɪ ɨ ɯ ĩ", "ih"),
        ("e ɛ e̞ eɪ ɛː ẽ ei", "eh"),
        ("æ ə ʌ ɐ ɘ ɤ", "ah"),
        ("a ɑ ɑː ã a˥˩", "aa"),
        ("ɔ ɒ œ ɔ̃ o̞ ø̞", "ao"),
        ("o oː oʊ əʊ ou ø ɵ", "ow"),
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
        *(
            ("pf", "bmp f"),
            ("k͡p", "kg bmp"),
            ("iə", "ih ah"),
            ("ui", "w ih"),
            ("uai", "w ay"),
            ("kʷ", "kg w"),
        ),
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
    [
        *((each, True) for each in ("p", "ˈɑː", "t̪", "tʰ", "r", "x", "ʁ", "ħ", "ts", "pf", "ʂ")),
        *((each, True) for each in ("ɯ", "ɔ̃", "ai", "q", "c", "ɵ", "r̩", "kʼ")),
        *((each, False) for each in ("y", "ø", "œ", "ɯᵝ", "ç", "ɕ", "tɕ", "ʎ", "ɸ", "b̞", "ɤ", "ɥ")),
    ],
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


def test_the_distance_of_each_label_is_told() -> None:
    near = {label: nearest(label) for label in ("p", "x", "y", "ts", "tɕ")}
    found = {label: round(each.distance, 2) for label, each in near.items() if each is not None}
    assert found == {"p": 0, "x": 0.2, "y": 0.6, "ts": 0, "tɕ": 0.4}


def test_every_letter_of_the_chart_has_its_features_and_an_example() -> None:
    path = DATA.parent / "articulation" / "ipa.json"
    read = json.loads(path.read_text("utf-8"))
    letters = read["vowels"] + read["consonants"]
    assert all(len(each["example"]) > 2 for each in letters)
    assert len({each["ipa"] for each in letters}) == len(letters) > 100
    # One segment per line, so that a correction is one line of a diff.
    assert sum(
        line.startswith('    {"ipa": ') for line in path.read_text("utf-8").splitlines()
    ) == len(letters)


def set_of_classes(folder: Path, *phones: dict[str, object]) -> str:
    """A set like the common one, some classes replaced or added."""
    own = {str(phone["label"]): phone for phone in phones}
    common = [{"label": label} for label in load_phone_set("common").labels if label not in own]
    path = folder / "own.json"
    document = {"format": "lipwright/phone-set", "version": 1, "name": "own"}
    path.write_text(json.dumps({**document, "phones": [*phones, *common]}), encoding="utf-8")
    return str(path)


def test_a_set_with_a_class_of_its_own_gets_the_sounds_that_are_nearest_to_it(
    tmp_path: Path,
) -> None:
    target = set_of_classes(tmp_path, {"label": "yu", "ipa": ["y", "ʏ", "ɥ"]})
    reduction = load_reduction("ipa", target)
    found = {label: reduction.of(label) for label in ("y", "yː", "ɥ", "ʏ", "u", "p", "tɕ")}
    assert {label: pieces[0].label for label, (pieces, _) in found.items()} == {
        **dict.fromkeys(("y", "yː", "ɥ", "ʏ"), "yu"),
        "u": "w",
        "p": "bmp",
        "tɕ": "sh",
    }
    assert [found[label][1] for label in ("y", "yː", "ɥ", "tɕ")] == [True, True, True, False]


def test_a_set_may_split_a_class(tmp_path: Path) -> None:
    target = set_of_classes(
        tmp_path, {"label": "bmp", "ipa": ["p", "b"]}, {"label": "m", "ipa": ["m"]}
    )
    reduction = load_reduction("ipa", target)
    assert [reduction.of(label)[0][0].label for label in ("p", "pʰ", "m", "m̥")] == [
        *("bmp", "bmp", "m", "m"),
    ]
