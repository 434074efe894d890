"""Texts of any size: cut at sentences, spoken in order, what cannot be read left out."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipwright.errors import TextError
from lipwright.schedule.parts import Part, Spoken, parts

STORY = 'One came. "Two!" she said. Three… went home?\n\nFour stayed. '


def texts(text: str, size: int, *, each_line: bool = False) -> list[str]:
    return [part.text for part in parts([text], each_line=each_line, size=size)]


def test_a_short_text_is_one_part() -> None:
    assert texts(STORY, 3000) == [STORY.strip()]


def test_parts_end_where_sentences_do() -> None:
    assert texts(STORY, 40) == [
        'One came. "Two!" she said. Three…',
        "went home?\n\nFour stayed.",
    ]
    assert texts("一二三。四五六！七八九。", 5) == ["一二三。", "四五六！", "七八九。"]
    assert texts("never an end to it", 10) == ["never an", "end to it"]
    assert texts("x" * 25, 10) == ["x" * 10, "x" * 10, "x" * 5]


def test_each_line_may_be_an_utterance() -> None:
    script = "Halt!\nWho goes there\n\n  A friend\n"
    assert texts(script, 3000, each_line=True) == ["Halt!\n\nWho goes there\n\nA friend"]
    assert texts(script, 12, each_line=True)[0] == "Halt!"


def test_a_part_knows_its_line() -> None:
    found = list(parts(["One.\nTwo.\n", "\n\nThree.\nFour."], "a.txt", size=6))
    assert [(part.text, part.line) for part in found] == [
        ("One.", 1), ("Two.", 2), ("Three.", 5), ("Four.", 6),
    ]  # fmt: skip
    assert found[2].where == "a.txt, line 5"


@given(st.text("ab. \n!\"'", max_size=200), st.integers(1, 40), st.integers(1, 40))
def test_no_letter_is_lost_however_a_text_is_read(text: str, size: int, block: int) -> None:
    blocks = [text[start : start + block] for start in range(0, len(text), block)]
    found = "".join(part.text for part in parts(blocks, size=size))
    assert [c for c in found if c.isalnum()] == [c for c in text if c.isalnum()]


def test_parts_are_spoken_in_order_and_without_their_sound() -> None:
    done: list[int] = []
    words = ["One.", "Two or three.", "Four.", "Five."]
    spoken = Spoken([Part(text) for text in words], report=done.append, workers=3)
    found = list(spoken)
    assert [speech.words.labels[0] for speech in found] == ["One", "Two", "Four", "Five"]
    assert all(speech.sound is None and len(speech.phones) for speech in found)
    assert done == [4, 17, 22, 27]


def test_sentences_that_cannot_be_read_are_left_out_and_named() -> None:
    text = Part("The old word was λόγος. Then it was another. A пирог is a pie.", "a.txt", 7)
    spoken = Spoken([text])
    (speech,) = spoken
    assert speech.words.labels == ("Then", "it", "was", "another")
    assert len(spoken.left_out) == 2
    assert spoken.left_out[1].startswith("a.txt, line 7: 'пирог'")


@pytest.mark.parametrize(
    ("text", "voice", "words"),
    [
        ("Слово. Ещё слово.", "en-us", "a.txt, line 3: .*Cyrillic"),
        ("One. Two.", "atlantean", "no voice 'atlantean'"),
    ],
)
def test_a_text_for_another_voice_is_refused(text: str, voice: str, words: str) -> None:
    with pytest.raises(TextError, match=words):
        list(Spoken([Part(text, "a.txt", 3)] * 3, voice))
