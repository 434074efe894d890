"""Words: what is spoken of a text, and how joined words share their phones."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipwright.errors import TextError
from lipwright.schedule.say.words import TimedPhone, prepare, time_words


@pytest.mark.parametrize(
    ("text", "spoken"),
    [
        ("  Hello \t there ", "Hello there"),
        ("One.\n\n\nTwo", "One.\n\nTwo"),
        ("One\ntwo", "One two"),
        ("e\u0301te\u0301", "été"),
        ("ＨＥＬＬＯ ﬁne", "HELLO fine"),
        ("\ufeffsoft\u00adly 👨‍👩‍👧 \x1b", "softly"),
        ("می\u200cخواهم", "می\u200cخواهم"),
        ("50 °C", "50 °C"),
        ("\ud800x", "x"),
    ],
)
def test_what_is_spoken_of_a_text(text: str, spoken: str) -> None:
    assert prepare(text).spoken == spoken


def test_words_are_found_at_their_starts() -> None:
    utterance = prepare('He said: "so—is it?"')
    assert utterance.words == ("He", "said", "so", "is", "it")
    assert [utterance.spoken[start:].lstrip('"')[0] for start in utterance.starts] == list("Hssii")


def test_words_spoken_as_one_share_the_phones_by_their_letters() -> None:
    utterance = prepare("of the best")
    phones = [TimedPhone(label, n / 10, (n + 1) / 10, 0) for n, label in enumerate("ʌvðə")]
    phones += [TimedPhone("b", 0.4, 0.5, 7)]
    tier = time_words(utterance, phones)
    assert [(word.label, word.start, word.end) for word in tier] == [
        ("of", 0.0, 0.2),
        ("the", 0.2, 0.4),
        ("best", 0.4, 0.5),
    ]


def test_more_words_than_phones_share_the_time() -> None:
    tier = time_words(prepare("a an"), [TimedPhone("ə", 0.0, 0.3, 0)])
    assert [(word.label, round(word.start, 6), round(word.end, 6)) for word in tier] == [
        ("a", 0.0, 0.1),
        ("an", 0.1, 0.3),
    ]


def test_a_sign_that_is_not_spoken_is_no_word() -> None:
    phones = [TimedPhone("a", 0, 1, 0), TimedPhone("b", 1, 2, 4)]
    assert time_words(prepare("a - b"), phones).labels == ("a", "b")


@given(st.text())
def test_any_text_is_prepared_or_refused(text: str) -> None:
    try:
        utterance = prepare(text)
    except TextError:
        return
    utterance.spoken.encode()
    assert len(utterance.words) == len(utterance.starts)
    assert list(utterance.starts) == sorted(set(utterance.starts))
    assert all(word for word in utterance.words)


@given(
    st.lists(st.sampled_from(["of", "the", "a", "&", "-", "world"]), min_size=1).filter(
        lambda words: any(word.isalpha() for word in words)
    ),
    st.lists(st.integers(0, 40), min_size=1, max_size=30),
)
def test_words_are_in_order_wherever_the_voice_says_they_are(
    words: list[str], positions: list[int]
) -> None:
    phones = [TimedPhone("a", n, n + 1, position) for n, position in enumerate(positions)]
    tier = time_words(prepare(" ".join(words)), phones)
    assert tier.start == 0
    assert tier.end == len(positions)
