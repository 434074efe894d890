"""Where pronunciations come from, and what is said when there are none."""

from pathlib import Path

import pytest

from lipwright.errors import FileFormatError, LabelError, MissingExtraError, TextError
from lipwright.schedule import pronounce as pronounce_module
from lipwright.schedule.align.lexicon import look_up, pronounced, read_lexicon
from lipwright.schedule.align.text import tokens


@pytest.mark.parametrize(
    ("word", "sounds"),
    [
        ("peter", "p iy t er"),
        ("a", "ah"),
        ("a", "ey"),
        ("f", "eh f"),
        ("zebra", "z iy b r ah"),
        ("'tis", "t ih z"),
        ("o'clock", "ah k l aa k"),
        ("'n'", "ah n"),
        ("café", "k ae f ey"),
        ("naïve", "n ay iy v"),
        ("'quoted'", "k w ow t ih d"),
        ("zebra's", "z iy b r ah z"),
        ("giraffes'", "jh er ae f s"),
    ],
)
def test_words_of_the_dictionary(word: str, sounds: str) -> None:
    assert tuple(sounds.split()) in look_up(word)


def test_an_unknown_word_has_no_dictionary_entry() -> None:
    assert look_up("blorptangle") == ()


def test_the_users_file_comes_first(tmp_path: Path) -> None:
    path = tmp_path / "mine.dict"
    path.write_text(
        ";;; mine\n# and more\nBlorp  B L AO1 R P\nblorp(2) B L ER P\nthe  Z IY0\n",
        encoding="utf-8",
    )
    spoken, guessed = pronounced(tokens("The blorp"), path)
    assert spoken[0].forms == (((("z", "iy"),),),)
    assert spoken[1].forms == (((("b", "l", "ao", "r", "p"), ("b", "l", "er", "p")),),)
    assert guessed == ()


def test_a_mapping_serves_as_well() -> None:
    assert read_lexicon({"Blorp": "B L AO1 R P"}) == {"blorp": (("b", "l", "ao", "r", "p"),)}
    with pytest.raises(LabelError, match="pronunciation of 'blorp': unknown phones Q"):
        read_lexicon({"blorp": "B Q"})


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("blorp B QQ", "line 2: unknown phones QQ; expected phones among"),
        ("blorp", "line 2: a word"),
    ],
)
def test_a_bad_line_is_named(tmp_path: Path, line: str, message: str) -> None:
    path = tmp_path / "bad.dict"
    path.write_text(f"good G UH D\n{line}\n", encoding="utf-8")
    with pytest.raises(FileFormatError, match=message):
        read_lexicon(path)


def test_unknown_words_are_guessed_and_named() -> None:
    spoken, guessed = pronounced(tokens("a blorptangle"))
    assert guessed == ("blorptangle",)
    assert spoken[1].forms[0][0][0][:2] == ("b", "l")


def test_without_the_extra_all_unknown_words_are_named_at_once(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def missing(words: object) -> dict[str, tuple[str, ...]]:
        raise MissingExtraError.of("a guess", "tts")

    monkeypatch.setattr(pronounce_module, "pronounce", missing)
    with pytest.raises(TextError, match=r"for blorp, zwirf.*lipwright\[tts\].*--lexicon FILE"):
        pronounced(tokens("the blorp saw a zwirf and the blorp"))
    spoken, _ = pronounced(tokens("the XQZ"))
    assert len(spoken[1].forms) == 1  # spelled
