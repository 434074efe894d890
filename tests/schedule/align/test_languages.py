"""Alignment in other languages: on speech whose times the synthesiser knows."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from lipwright.errors import LabelError, LipwrightError, MissingExtraError, SoundError, TextError
from lipwright.phones import load_reduction
from lipwright.schedule import languages
from lipwright.schedule.align import Pronounced, align, align_words
from lipwright.schedule.languages import read_text
from lipwright.schedule.say import espeak, say
from lipwright.sound import Sound
from lipwright.speech import Speech

LINES = {
    "de": "Zwölf Kinder spielten 1998 fröhlich im Hof, bis es plötzlich zu regnen begann.",
    "fr": "L'eau de la rivière était froide, n'est-ce pas ? Les enfants ont 12 ans…",
    "it": "Gli studenti leggono un libro sulla storia dell'arte italiana.",
    "ar": "قَرَأتُ كِتَابًا جَمِيلًا عَن تَارِيخِ العَرَبِ.",
    "cmn": "我妹妹喜欢在晚上看书。",
    "hi": "कल सुबह हम सब लोग नदी के किनारे घूमने गए थे।",
}


@cache
def spoken(language: str) -> Speech:
    return say(LINES[language], voice=language)


def sound_of(speech: Speech) -> Sound:
    assert speech.sound is not None
    return speech.sound


@cache
def found(language: str) -> Speech:
    return align(sound_of(spoken(language)), LINES[language], language=language)


def sounding(speech: Speech) -> list[tuple[str, float]]:
    return [(phone.label, phone.start) for phone in speech.phones if phone.label != "sil"]


@pytest.mark.parametrize("language", LINES)
def test_phones_lie_where_they_were_spoken(language: str) -> None:
    ours, own = sounding(found(language)), sounding(spoken(language))
    assert [label for label, _ in ours] == [label for label, _ in own]
    apart = np.abs(np.subtract([start for _, start in ours], [start for _, start in own]))
    assert np.median(apart) < 0.012
    assert np.mean(apart < 0.05) > 0.9


def test_a_fricative_that_noise_hides_is_no_pause() -> None:
    text = "老师让学生们把黑板擦干净，我妹妹喜欢在晚上看书。"
    said = say(text, voice="cmn")
    clean = sound_of(said).samples
    loud = np.sqrt(np.mean(np.square(clean)))
    noise = 0.1 * loud * np.random.default_rng(7).standard_normal(len(clean))
    noisy = Sound((clean + noise).astype(np.float32), sound_of(said).rate)
    ours, own = sounding(align(noisy, text, language="cmn")), sounding(said)
    assert [label for label, _ in ours] == [label for label, _ in own]
    apart = [a - b for (label, a), (_, b) in zip(ours, own, strict=True) if label == "sh"]
    assert len(apart) == 4
    assert max(map(abs, apart)) < 0.03


@pytest.mark.parametrize("language", LINES)
def test_words_stay_as_they_are_written(language: str) -> None:
    ours, own = found(language), spoken(language)
    assert ours.words.labels == own.words.labels
    apart = np.subtract([word.start for word in ours.words], [word.start for word in own.words])
    assert np.abs(apart).max() < 0.12


def test_numbers_quotes_hyphens_and_elisions_are_words_of_their_own() -> None:
    text = "« L'homme », dit-elle… c'est-à-dire 75 % !"
    words = [word.word for word in read_text(text, "fr").words]
    assert words == ["L'homme", "dit-elle", "c'est-à-dire", "75", "%"]


@pytest.mark.parametrize("language", ["de", "ar"])
def test_phones_cover_the_sound_without_gaps(language: str) -> None:
    aligned = found(language)
    tier = aligned.phones.tier
    assert aligned.phones.phone_set == "ipa"
    assert aligned.language == language
    assert aligned.source == "align"
    assert (tier.start, tier.end) == (0.0, sound_of(spoken(language)).duration)
    assert all(a.end == b.start for a, b in zip(tier, tier.intervals[1:], strict=False))
    rows, _ = load_reduction("ipa", "common").rows(aligned.phones)
    assert rows[-1][2] == tier.end


def test_right_words_are_sure_and_wrong_ones_are_not() -> None:
    for language in ("de", "fr", "it", "hi"):
        assert (found(language).confidence or 0) > 0.6, language
        assert found(language).notes == ()
    wrong = align(sound_of(spoken("de")), "Der alte Fischer zog sein Netz ein.", language="de")
    assert (wrong.confidence or 0) < 0.3
    assert any("the words may not be what is spoken" in note for note in wrong.notes)


def test_the_same_sound_gives_the_same_times() -> None:
    again = align(sound_of(spoken("it")), LINES["it"], language="it")
    assert again.phones == found("it").phones
    assert again.words == found("it").words


def test_english_goes_its_own_way() -> None:
    sound = sound_of(say("Where is the harbour?"))
    plain = align(sound, "Where is the harbour?")
    assert plain.phones.phone_set == "arpabet"
    for name in ("en", "en_US"):
        assert align(sound, "Where is the harbour?", language=name).phones == plain.phones
    assert align(sound, "Where is the harbour?", language="en-gb").phones.phone_set == "ipa"


def test_a_long_sound_goes_piece_by_piece() -> None:
    line = LINES["it"]
    one = sound_of(spoken("it"))
    count = int(50 / one.duration) + 1
    sound = Sound(np.tile(one.samples, count), one.rate)
    aligned = align(sound, " ".join([line] * count), language="it")
    firsts = [word.start for word in aligned.words if word.label == "Gli"]
    assert np.diff(firsts) == pytest.approx(one.duration, abs=0.05)


def test_a_long_text_is_read_in_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    text = "Eins zwei. " * 20 + "… " * 20 + "drei " * 60 + "\n\n\n" + "Vier"
    whole = read_text(text, "de").words
    monkeypatch.setattr(languages, "_PART", 50)
    assert [word.word for word in read_text(text, "de").words] == [word.word for word in whole]


def test_a_region_without_a_voice_is_read_as_its_language() -> None:
    read = read_text("Guten Tag", "de-AT")
    assert read.language == "de"
    assert read.notes == ("there is no voice 'de-AT': read as 'de'",)


def test_any_pronouncer_may_give_its_words() -> None:
    words = [
        Pronounced("Zug", ((("C", ("t", "s")), ("U", ("uw",)), ("K", ("k",))),)),
        Pronounced("um", ((("U", ("uh",)), ("M", ("m",))), (("O", ("ow",)), ("M", ("m",))))),
    ]
    sound = sound_of(say("Zug um", voice="de"))
    aligned = align_words(sound, words, text="Zug um", language="de", phone_set="letters")
    assert aligned.phones.phone_set == "letters"
    assert [label for label, _ in sounding(aligned)] in [list("CUKUM"), list("CUKOM")]
    assert aligned.words.labels == ("Zug", "um")


NOISE = Sound(np.random.default_rng(1).normal(0, 0.1, 4000).astype(np.float32), 16000)
# language, sound, text: words of the error
BAD: dict[str, tuple[str, Sound | None, str, type[LipwrightError], str]] = {
    "unknown language": ("xyz", None, "Hallo", TextError, "no language 'xyz'"),
    "a voice of Festival": ("festival", None, "Hallo", TextError, "no language 'festival'"),
    "another script": ("de", None, "Привет мир", TextError, "--language ru"),
    "mixed scripts": ("ru", None, "Привет 漢字", TextError, "does not read Chinese"),
    "kanji": ("ja", None, "これは漢字です", TextError, "kana"),
    "nothing": ("de", None, " … !", TextError, "nothing to say"),
    "silence": ("de", Sound(np.zeros(16000, np.float32), 16000), "Hallo", SoundError, "silent"),
    "too short": ("fr", NOISE, "une phrase beaucoup trop longue", SoundError, "too short for 5"),
}


@pytest.mark.parametrize("name", BAD)
def test_what_cannot_be_aligned_is_refused(name: str) -> None:
    language, sound, text, error, words = BAD[name]
    with pytest.raises(error, match=words):
        align(sound or sound_of(spoken("de")), text, language=language)


def test_a_lexicon_is_for_english() -> None:
    with pytest.raises(TextError, match="a lexicon, which is for English"):
        align(NOISE, "Hallo", language="de", lexicon={"hallo": "HH AH L OW"})


@pytest.mark.parametrize("sounds", [("q",), ()])
def test_words_that_the_model_cannot_look_for_are_refused(sounds: tuple[str, ...]) -> None:
    words = [Pronounced("x", ((("k", sounds),),))]
    with pytest.raises(LabelError, match="pronunciation of 'x'"):
        align_words(NOISE, words, text="x", language="de")
    with pytest.raises(TextError, match="no words"):
        align_words(NOISE, [], text="", language="de")


def test_the_extra_is_named_where_it_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    def gone(*_: object, **__: object) -> None:
        raise MissingExtraError.of("speech from text", "tts")

    monkeypatch.setattr(espeak, "speak", gone)
    with pytest.raises(MissingExtraError, match=r"pip install 'lipwright\[tts\]'"):
        align(sound_of(spoken("de")), "Hallo", language="de")


def test_digital_silence_around_speech_does_not_make_it_doubtful() -> None:
    sound = sound_of(spoken("de"))
    padded = replace(sound, samples=np.pad(sound.samples, 2 * sound.rate))
    assert (align(padded, LINES["de"], language="de").confidence or 0) > 0.5
