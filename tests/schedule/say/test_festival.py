"""Festival: the program it is given, the report it gives, and what it cannot do."""

import re
import shutil
import wave
from pathlib import Path

import numpy as np
import pytest

from lipwright.errors import InputError, LipwrightError, MissingExtraError, TextError
from lipwright.schedule.say import festival, say
from lipwright.schedule.say.words import prepare

REPORT = """\
token Hello
token -
token $5
token the
token the
phone pau 0.050000001 0
phone hh 0.125 1
phone ax 0.15000001 1
phone axr 0.19499999 1
phone pau 0.25 0
phone f 0.31 3
phone dh 0.4 4
phone dh 0.5 5
phone pau 0.55 0
"""


def test_the_report_becomes_phones_on_whole_samples() -> None:
    spoken = "Hello - $5 the the"
    phones = festival.parse_report(REPORT, spoken, rate=1000, end=560)
    assert " ".join(phone.label for phone in phones) == "sil hh ax er sil f dh dh sil"
    assert phones[1].start == 0.05
    assert phones[-1].end == 0.56
    assert [phone.position for phone in phones if phone.label != "sil"] == [0, 0, 0, 8, 11, 15]


def test_phones_that_are_not_arpabet_are_refused() -> None:
    with pytest.raises(LipwrightError, match=r"unknown phones: 'rr'.*such as slt"):
        festival.parse_report("token a\nphone rr 0.1 1\n", "a", rate=1000, end=100)


def test_the_text_is_data_and_never_code() -> None:
    text = 'a" ) (quit) \\'
    program = festival.build_program(text, "slt", stretch=1, sound=Path("w"), out=Path("o"))
    strings = re.findall(r'"(?:[^"\\]|\\.)*"', program)
    assert '"a\\" ) (quit) \\\\"' in strings
    assert "(quit)" not in re.sub(r'"(?:[^"\\]|\\.)*"', "", program)


def test_a_name_in_the_text_is_not_taken_for_a_place_in_the_program() -> None:
    program = festival.build_program("@OUT@", "slt", stretch=1, sound=Path("w"), out=Path("o"))
    assert '(Utterance Text "@OUT@")' in program


@pytest.mark.parametrize(
    ("text", "spoken"),
    [
        ("Zoë’s café—naïve…", "Zoe's cafe-naive..."),
        ("“Dvořák” costs £5", '"Dvorak" costs £5'),
        ("½ × 3", "12  3"),
    ],
)
def test_letters_are_made_plain(text: str, spoken: str) -> None:
    plain = festival.plain_utterance(prepare(text))
    assert plain.spoken == spoken
    assert plain.words == prepare(text).words


def test_without_festival_the_package_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    with pytest.raises(MissingExtraError, match="apt-get install festival festvox-us-slt-hts"):
        say("hello", voice="festival")
    assert festival.installed_voices() == []


@pytest.mark.parametrize(
    ("text", "options", "words"),
    [
        ("привет", {"voice": "festival"}, "Cyrillic"),
        ("a" * 5001, {"engine": "festival"}, "at most 5,000 for Festival"),
        ("hello", {"voice": "festival:no/such"}, "no Festival voice 'no/such'"),
    ],
)
def test_what_festival_cannot_say_is_refused(
    text: str, options: dict[str, str], words: str
) -> None:
    with pytest.raises(TextError, match=words):
        say(text, **options)  # type: ignore[arg-type]


def test_pitch_is_espeaks_alone() -> None:
    with pytest.raises(InputError, match="Leave --pitch out"):
        say("hello", voice="festival", pitch=50)


def pretend(monkeypatch: pytest.MonkeyPatch, report: str | None, complaint: str = "") -> None:
    """Stand in for the program: it writes this report and a second of sound."""

    def run(program: str, folder: Path) -> str:
        if report is not None:
            (folder / "a.txt").write_text(report, "latin-1")
            with wave.open(str(folder / "a.wav"), "wb") as file:
                file.setnchannels(1)
                file.setsampwidth(2)
                file.setframerate(1000)
                file.writeframes(np.zeros(560, "<i2").tobytes())
        return complaint

    monkeypatch.setattr(festival, "_run", run)


def test_a_speech_of_festival_has_arpabet_words_and_silence_around(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    pretend(monkeypatch, REPORT)
    speech = say("Hello – $5 the the", voice="festival")
    assert speech.phones.phone_set == "arpabet"
    assert speech.words.labels == ("Hello", "$5", "the", "the")
    assert speech.phones.tier[0].duration == pytest.approx(0.2)
    assert speech.phones.tier.end == speech.duration
    assert speech.phones.tier[-1].duration == pytest.approx(0.2)


def test_a_voice_that_it_lacks_is_named_with_those_it_has(monkeypatch: pytest.MonkeyPatch) -> None:
    pretend(monkeypatch, "voice kal_diphone\nvoice cmu_us_slt_arctic_hts\n")
    with pytest.raises(TextError, match="'bdl'; expected one of kal_diphone, cmu_us_slt"):
        say("hello", voice="festival:bdl")


def test_a_failure_tells_festivals_last_word(monkeypatch: pytest.MonkeyPatch) -> None:
    pretend(monkeypatch, None, "SIOD ERROR: no such thing")
    with pytest.raises(LipwrightError, match="Festival failed: SIOD ERROR"):
        say("hello", voice="festival")


if shutil.which("festival") is not None and festival.installed_voices():

    def test_festival_itself_speaks() -> None:
        speech = say('He paid $5: "the the"?', voice="festival")
        assert speech.words.labels == ("He", "paid", "$5", "the", "the")
        assert {"p", "ey", "d", "f", "ay", "v"} <= set(speech.phones.tier.labels)
        assert (
            say("He paid.", voice="festival", rate=100).duration
            > 1.2 * say("He paid.", voice="festival").duration
        )
