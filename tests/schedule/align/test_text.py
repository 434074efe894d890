"""What people write, and what is then expected to be said."""

import pytest

from lipwright.errors import TextError
from lipwright.schedule.align.text import tokens

SPOKEN = [
    ("$5", "five dollars"),
    ("$1", "one dollar"),
    ("$5.25", "five dollars and twenty five cents"),
    ("$5.25", "five twenty five"),
    ("£3.50", "three pounds fifty pence"),
    ("€20", "twenty euros"),
    ("$5 million", "five million dollars"),
    ("$3m", "three million dollars"),
    ("50%", "fifty percent"),
    ("3.14", "three point one four"),
    ("0.5", "point five"),
    ("-5", "minus five"),
    ("-5", "negative five"),
    ("1,234", "one thousand two hundred thirty four"),
    ("1st", "first"),
    ("22nd", "twenty second"),
    ("1984", "nineteen eighty four"),
    ("2026", "twenty twenty six"),
    ("2005", "two thousand five"),
    ("1905", "nineteen oh five"),
    ("1980s", "nineteen eighties"),
    ("’80s", "eighties"),
    ("007", "oh oh seven"),
    ("2026-11-21", "november twenty first twenty twenty six"),
    ("11/21/2026", "november twenty first twenty twenty six"),
    ("21/11/2026", "the twenty first of november twenty twenty six"),
    ("Nov 21", "november twenty first"),
    ("November 3rd", "november third"),
    ("3:45 pm", "three forty five p m"),
    ("3:05", "three oh five"),
    ("3:00", "three o'clock"),
    ("5pm", "five p m"),
    ("1/2", "a half"),
    ("3/4", "three quarters"),
    ("10-20", "ten to twenty"),
    ("5km", "five kilometers"),
    ("20°C", "twenty degrees celsius"),
    ("#1", "number one"),
    ("2.0.1", "two point zero point one"),
    ("½", "one half"),
    ("Dr.", "doctor"),
    ("Mrs", "missus"),
    ("St.", "street"),
    ("e.g.", "for example"),
    ("i.e.", "that is"),
    ("vs.", "versus"),
    ("BBC", "b b c"),
    ("U.S.A.", "u s a"),
    ("CDs", "c d's"),
    ("R&D", "r and d"),
    ("and/or", "and or"),
    ("twenty-two", "twenty two"),
    ("don’t", "don't"),
    ("rock ’n’ roll", "rock 'n' roll"),
    ("café", "café"),
    ("R2D2", "r two d two"),
]


def ways(text: str) -> set[str]:
    """All ways to say a text."""
    found = {""}
    for token in tokens(text):
        found = {f"{a} {' '.join(form)}".strip() for a in found for form in token.forms}
    return found


@pytest.mark.parametrize(("written", "said"), SPOKEN)
def test_what_is_written_may_be_said_as_people_say_it(written: str, said: str) -> None:
    assert said in ways(written)


def test_labels_stay_as_the_user_wrote_them() -> None:
    text = "Dr. Who, 42, owes “$5” (or €3.50)… doesn’t he? — No! U.S. dogs’ 50%."
    labels = [token.label for token in tokens(text)]
    assert labels[:6] == ["Dr.", "Who", "42", "owes", "$5", "or"]
    assert labels[6:] == ["€3.50", "doesn’t", "he", "No", "U.S.", "dogs’", "50%"]


@pytest.mark.parametrize("text", ["", "  \n", "?!…", "\x00\x01", "😀 🎉", "- -- '"])
def test_a_text_without_words_is_refused(text: str) -> None:
    with pytest.raises(TextError, match=r"empty|no words"):
        tokens(text)


def test_a_text_in_another_script_is_refused_by_name() -> None:
    with pytest.raises(TextError, match="мир: not in the Latin script"):
        tokens("hello мир")


def test_control_characters_and_pictures_are_dropped() -> None:
    assert [t.label for t in tokens("he\u200bllo\x07 wor\u00adld 😀")] == ["hello", "world"]


def test_a_text_in_capitals_is_read_as_words() -> None:
    assert ways("COME IN") == {"come in"}
