"""Phone sets are guessed, silences recognised, TIMIT's closures made whole; rounding is closed."""

import pytest

from lipwright.errors import LabelError
from lipwright.schedule.labels import notation, timing
from lipwright.schedule.labels.rows import Row


def rows(text: str, step: float = 0.1) -> list[Row]:
    return [
        Row(label, index * step, (index + 1) * step, f"line {index + 1}")
        for index, label in enumerate(text.split())
    ]


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("HH AH0 L OW1", "arpabet"),
        ("hh ax-h l ow", "arpabet"),
        ("h# sh iy hv ae dcl d pau", "arpabet"),
        ("h ə l əʊ", "ipa"),
        ("h ə ˈl oʊ t͡ʃ ɑːɹ", "ipa"),
        ("h @ l @U", "sampa"),
        ("m { n tS", "sampa"),
        ("j 9 t S", "sampa"),
        ("d i:", "sampa"),
        ("m ai n ts u", "ipa"),
        ("n i h ao sh i j ê", "pinyin"),
        ("z ii zh iii l ü HH AH L OW", "pinyin"),
        ("q i ch u a ng", "pinyin"),
    ],
)
def test_the_phone_set_is_guessed(text: str, name: str) -> None:
    spelled, found = notation.normalised(rows(text), "", "a.lab")
    assert found == name
    assert all(row.label for row in spelled)


def test_a_phone_set_that_is_named_is_not_guessed() -> None:
    assert notation.normalised(rows("p s"), "sampa", "a.lab")[1] == "sampa"
    with pytest.raises(LabelError, match=r"a\.lab: 'ae': not phones of 'sampa'"):
        notation.normalised(rows("p ae s"), "sampa", "a.lab")


@pytest.mark.parametrize("label", ["", "sil", "SIL", "sp", "pau", "<eps>", "_", "#", "<p:>", "spn"])
def test_every_spelling_of_silence(label: str) -> None:
    row = Row(label, 0.0, 1.0, "line 1")
    assert notation.normalised([row], "", "a.lab")[0][0].label == "sil"


def test_many_unknown_labels_are_counted() -> None:
    text = " ".join(f"?{index}" for index in range(20))
    with pytest.raises(LabelError, match=r"'\?0', .*'\?11' and 8 more: not phones of"):
        notation.normalised(rows(text), "", "a.lab")


@pytest.mark.parametrize("words", ["hello there friend", "she had your dark suit"])
def test_words_are_no_phones_though_ipa_has_their_letters(words: str) -> None:
    assert not notation.fits_a_phone_set(words.split())
    with pytest.raises(LabelError, match="These look like words"):
        notation.normalised(rows(words), "", "a.lab")


@pytest.mark.parametrize(
    ("text", "folded"),
    [
        ("bcl b iy", "b:2 iy:1"),
        ("dcl jh tcl ch", "jh:2 ch:2"),
        ("s kcl t", "s:1 k:1 t:1"),
        ("ae tcl", "ae:1 t:1"),
        ("kcl tcl t", "k:1 t:2"),
        ("q aa s", "aa:2 s:1"),
        ("ae q s", "ae:2 s:1"),
        ("h# q h#", "sil:1 sil:1 sil:1"),
        ("s epi l", "s:2 l:1"),
        ("q tcl t", "sil:1 t:2"),
        ("BCL B", "b:2"),
    ],
)
def test_a_closure_and_its_release_are_one_stop(text: str, folded: str) -> None:
    made, _ = notation.normalised(rows(text), "", "a.phn")
    assert " ".join(f"{row.label}:{round((row.end - row.start) / 0.1)}" for row in made) == folded
    assert made[-1].end == rows(text)[-1].end


@pytest.mark.parametrize("overlap", [0.001, 0.01])
def test_rounding_is_closed_in_the_middle(overlap: float) -> None:
    made = timing.tier(
        [Row("p", 0.0, 0.1 + overlap, "line 1"), Row("aa", 0.1, 0.3, "line 2")], "a.lab"
    )
    assert made[0].end == made[1].start == pytest.approx(0.1 + overlap / 2)


def test_more_than_rounding_is_an_error_that_names_both() -> None:
    overlapping = [Row("p", 0.0, 0.1, "line 1"), Row("aa", 0.089, 0.3, "line 2")]
    with pytest.raises(LabelError, match=r"a\.lab, line 2: 'aa' .* overlaps 'p'"):
        timing.tier(overlapping, "a.lab")


def test_gaps_stay_and_silence_without_time_goes() -> None:
    made = timing.tier(
        [
            Row("p", 0.0, 0.1, "line 1"),
            Row("sil", 0.1, 0.1, "line 2"),
            Row("aa", 0.5, 0.6, "line 3"),
        ],
        "a.lab",
    )
    assert [(i.label, i.start) for i in made] == [("p", 0.0), ("aa", 0.5)]
