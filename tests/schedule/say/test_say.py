"""Saying a text: what a user notices of sound, phones and words."""

import itertools

import numpy as np
import pytest

from lipwright.errors import InputError, TextError
from lipwright.phones import SILENCE, load_phone_set, load_reduction
from lipwright.schedule.say import say, voices

LINE = "Peter Piper picked a peck of pickled peppers."

# One plain sentence in each of twelve languages, with its number of words.
SENTENCES = {
    "en-us": ("The judge measured my fine youthful teeth.", 7),
    "en-gb": ("Her father bought the four boats over there.", 8),
    "de": ("Zwölf hübsche Köche prüften das süße Gemüse.", 7),
    "fr-fr": ("Un bon vin blanc, peut-être une fleur bleue.", 8),
    "es": ("El perro pequeño llovió agua y jugó.", 7),
    "it": ("Gli gnocchi della zia sono già pronti.", 7),
    "pl": ("Cześć, źródło szczęścia jest wszędzie.", 5),
    "ru": ("Мы ищем ещё один жёлтый цветок.", 6),
    "ar": ("صباح الخير يا صديقي العزيز", 5),
    "hi": ("मेरा घर ठंडी नदी के पास है", 7),
    "tr": ("Şu küçük ağaç çok ışıklı görünüyor.", 6),
    "sv": ("Sju sjuka flickor köpte gröna skjortor.", 6),
}


def test_the_phones_cover_the_sound_without_gaps_and_begin_and_end_in_silence() -> None:
    speech = say(LINE)
    phones = speech.phones.tier
    assert speech.sound is not None
    assert phones.start == 0
    assert phones.end == speech.sound.duration
    assert all(a.end == b.start for a, b in itertools.pairwise(phones))
    assert phones[0].label == phones[-1].label == SILENCE
    assert phones[0].duration > 0.1
    assert phones[-1].duration > 0.1


def test_the_words_come_in_order_as_the_user_wrote_them() -> None:
    speech = say(LINE)
    assert speech.words.labels == (
        *("Peter", "Piper", "picked", "a", "peck", "of", "pickled", "peppers"),
    )
    starts = {phone.start for phone in speech.phones}
    ends = {phone.end for phone in speech.phones}
    assert all(word.start in starts and word.end in ends for word in speech.words)


def test_a_word_holds_its_own_phones() -> None:
    speech = say("Shoes, mama, fish.")
    held = [
        {phone.label for phone in speech.phones if phone.middle in word} for word in speech.words
    ]
    assert "ʃ" in held[0]
    assert "m" in held[1]
    assert "f" in held[2]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("It costs $5.50 in 1999.", ["It", "costs", "$5.50", "in", "1999"]),
        ("one of the best", ["one", "of", "the", "best"]),
        ("to be in that is it was a dream", ["to", "be", "in", "that", "is"]),
        ("“Don’t!” she said—no.", ["Don’t", "she", "said", "no"]),
        ("ZOË's café 🙂 is naïve", ["ZOË's", "café", "is", "naïve"]),
        ("10% & more", ["10%", "&", "more"]),
        ("a\x00b\x07 c", ["ab", "c"]),
        ("--help", ["help"]),
        ("<b>bold</b>", ["b>bold</b"]),
    ],
)
def test_numbers_signs_and_joined_words_stay_one_word_each(text: str, words: list[str]) -> None:
    assert list(say(text).words.labels)[: len(words)] == words


def test_a_stop_holds_its_closure() -> None:
    speech = say("Peter Piper kept a cheap tape.")
    assert speech.sound is not None
    samples, rate = speech.sound.samples, speech.sound.rate
    stops = [phone for phone in speech.phones if phone.label in ("p", "k", "t", "tʃ")]
    assert len(stops) > 8
    for stop in stops:
        part = np.abs(samples[round(stop.start * rate) : round(stop.end * rate)])
        closed = part[round(0.008 * rate) : round(0.03 * rate)]
        assert closed.max() < 0.2 * part.max(), f"{stop} begins with its burst"
        assert stop.duration > 0.05
    vowels = [phone for phone in speech.phones if phone.label in ("iː", "eɪ", "ɛ", "aɪ")]
    for vowel in vowels:
        end = samples[round((vowel.end - 0.012) * rate) : round(vowel.end * rate)]
        assert np.abs(end).max() > 0.02, f"{vowel} ends in silence"


def test_a_stop_that_the_voice_gives_no_time_keeps_its_closure() -> None:
    stops = [phone for phone in say("Lan đi đến đó", voice="vi").phones if phone.label == "ɗ"]
    assert len(stops) == 3
    assert all(0.01 < stop.duration < 0.1 for stop in stops)


def test_the_same_text_gives_the_same_bytes() -> None:
    first, second = say(LINE), say(LINE)
    assert first.sound is not None
    assert second.sound is not None
    assert first.sound.samples.tobytes() == second.sound.samples.tobytes()
    assert first.phones == second.phones
    assert first.words == second.words


@pytest.mark.parametrize("voice", SENTENCES)
def test_every_label_of_a_language_has_a_class(voice: str) -> None:
    text, count = SENTENCES[voice]
    speech = say(text, voice=voice)
    rows, _ = load_reduction("ipa").rows(speech.phones)
    assert len(rows) >= len(speech.phones)
    assert {label for label, _, _ in rows} <= set(load_phone_set("common").labels)
    assert len(speech.words) == count
    assert speech.language == voice
    assert not speech.notes


def test_rate_and_pitch_are_heard() -> None:
    usual, slow, high = say(LINE), say(LINE, rate=100), say(LINE, pitch=90)
    assert slow.duration > 1.3 * usual.duration
    assert usual.sound is not None
    assert high.sound is not None
    assert usual.sound.samples.tobytes() != high.sound.samples.tobytes()


@pytest.mark.parametrize("voice", ["en-us", "de", "cmn"])
def test_the_fastest_rate_keeps_every_phone_in_its_place(voice: str) -> None:
    text = "Ni hao! " * 20 if voice == "cmn" else f"{LINE} " * 5
    fast = say(text, voice=voice, rate=450)
    slow = say(text, voice=voice, rate=300)
    assert len(fast.words) == len(slow.words)
    assert fast.duration < 0.8 * slow.duration
    assert all(phone.duration > 0 for phone in fast.phones)


def test_scripts_without_spaces_get_their_words_from_the_voice() -> None:
    speech = say("你好，世界。", voice="cmn")
    assert "".join(speech.words.labels) == "你好世界"
    assert len(speech.words) > 1


@pytest.mark.parametrize(
    ("text", "voice", "words"),
    [
        ("", "en-us", "nothing to say"),
        (" \n\t", "en-us", "nothing to say"),
        ("?!…", "en-us", "nothing to say"),
        ("🙂🙂", "en-us", "nothing to say"),
        ("\x00\x07", "en-us", "nothing to say"),
        ("Say 你好 now", "en-us", "'你好': .* 'en-us' does not read Chinese .*--voice cmn"),
        ("Привет", "de", "'Привет': .*Cyrillic.*--voice ru"),
        ("東京 です", "ja", "'東京': .*kanji.*kana"),
        ("hello", "klingon-opera", "no voice 'klingon-opera'; expected a voice such as"),
        ("hello", "", "no voice ''"),
        ("hello", "en-us+nobody", "'en-us' has no variant 'nobody'"),
        ("x" * 100_001, "en-us", "100,001 characters; expected at most 100,000"),
    ],
)
def test_a_text_that_cannot_be_said_is_refused(text: str, voice: str, words: str) -> None:
    with pytest.raises(TextError, match=words):
        say(text, voice=voice)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"rate": 10}, "rate 10; expected 80 to 450 words per minute"),
        ({"rate": float("nan")}, "rate nan"),
        ({"pitch": 100}, "pitch 100; expected 0 to 99"),
        (
            {"voice": "en-us+fast", "rate": 430},
            "rate 430 with the voice 'en-us\\+fast': .*; expected fewer words per minute",
        ),
        ({"engine": "flute"}, "no speech engine 'flute'; expected espeak or festival"),
    ],
)
def test_settings_out_of_range_are_refused(options: dict[str, float | str], words: str) -> None:
    with pytest.raises(InputError, match=words):
        say("hello", **options)  # type: ignore[arg-type]


def test_a_word_too_long_for_the_voice_is_noted() -> None:
    assert "only the beginning of 'xxx" in say("x" * 200).notes[0]


@pytest.mark.parametrize(
    ("asked", "language", "noted"),
    [
        ("en-GB", "en-gb", False),
        ("fr_FR", "fr-fr", False),
        ("de-AT", "de", True),
        ("en-AU", "en-gb", True),
        ("zh", "cmn", False),
        ("en-us+f3", "en-us", False),
        ("English (America)", "en-us", False),
    ],
)
def test_voices_go_by_the_names_people_type(asked: str, language: str, noted: bool) -> None:
    speech = say("a", voice=asked)
    assert speech.language == language
    assert bool(speech.notes) is noted


def test_the_languages_are_listed() -> None:
    listed = voices()
    assert len(listed) > 100
    assert {"en-us", "en-gb", "fr-fr", "cmn", "ja"} <= {voice.language for voice in listed}
