"""Guessed pronunciations: in the dictionary's own phones, one child for all."""

import subprocess

import pytest

from lipwright.errors import TextError
from lipwright.phones import load_phone_set
from lipwright.schedule.pronounce import pronounce
from lipwright.schedule.say import espeak


def test_words_come_in_the_phones_of_the_dictionary() -> None:
    words = ["lipwright", "Zoë", "art", "fire", "little", "button", "rock'n'roll", "loch", "GPU"]
    found = pronounce(words)
    assert list(found) == words
    assert found["art"] == ("aa", "r", "t")
    assert found["fire"] == ("f", "ay", "er")
    assert found["little"] == ("l", "ih", "t", "ah", "l")
    assert found["button"] == ("b", "ah", "t", "ah", "n")
    known = set(load_phone_set("arpabet").labels) - {"ax", "sil"}
    assert {phone for phones in found.values() for phone in phones} <= known


@pytest.mark.parametrize(
    ("language", "word", "phones"),
    [
        ("ru", "рыба", ("r", "ih", "b", "aa")),  # its voice writes ы as y, which is ü in the IPA
        ("ru", "hello", ("hh", "ah", "l", "ow")),  # and this word in English
        ("de", "rot", ("g", "ow", "t")),
        ("de_AT", "rot", ("g", "ow", "t")),
        ("de-AT", "Jobs", ("jh", "aa", "b", "z")),
        ("hi", "चाय", ("ch", "aa", "y")),
    ],
)
def test_labels_mean_what_they_mean_in_their_language(
    language: str, word: str, phones: tuple[str, ...]
) -> None:
    assert pronounce([word], language) == {word: phones}


def test_what_cannot_be_read_is_left_out() -> None:
    assert list(pronounce(["", "---", "日本", "мир", "x\0y", "yes"])) == ["x\0y", "yes"]


def test_nothing_is_asked_for_no_words(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(subprocess, "Popen", None)
    assert pronounce([]) == {}


def test_one_child_serves_many_words(monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[str] = []
    real = espeak.pronounce

    def counted(words: list[str], voice: str) -> list[list[str]]:
        calls.append(voice)
        return real(words, voice)

    monkeypatch.setattr(espeak, "pronounce", counted)
    assert len(pronounce([f"word{n}" for n in range(300)])) == 300
    assert len(calls) == 1


def test_a_word_sounds_the_same_alone_and_among_others() -> None:
    many = pronounce(["hello", "world", "Wojciech"])
    assert pronounce(["Wojciech"]) == {"Wojciech": many["Wojciech"]}


def test_an_unknown_language_is_refused() -> None:
    with pytest.raises(TextError, match="no voice 'xyz'"):
        pronounce(["hello"], "xyz")
