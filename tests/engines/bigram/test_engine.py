"""The engine as its users meet it: lines in, animation out; stand-ins, why, coverage."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lipwright import pipeline
from lipwright.curves import Keys
from lipwright.engines.bigram import BigramEngine, load_set
from lipwright.engines.bigram.coverage import coverage
from lipwright.engines.bigram.model import BigramSet
from lipwright.engines.bigram.set_file import DATA
from lipwright.engines.bigram.stand_in import stand_in
from lipwright.engines.bigram.why import why
from lipwright.errors import InputError, LabelError
from lipwright.phones import PhoneTrack
from lipwright.sound import Sound
from lipwright.speech import Speech
from lipwright.timeline import Tier

SET = load_set("english")
PIPER = PhoneTrack(
    Tier.of(("P", 0.1, 0.2), ("AY1", 0.2, 0.36), ("P", 0.36, 0.45), ("ER0", 0.45, 0.7))
)


def lacking(*pairs: tuple[str, str]) -> BigramSet:
    return replace(SET, bigrams={k: v for k, v in SET.bigrams.items() if k not in pairs})


def test_frames_lie_on_the_sounds_clock_and_cover_it() -> None:
    sound = Sound(np.zeros(24000, dtype=np.float32), 16000)
    animation = BigramEngine(SET).animate(Speech(PIPER, sound=sound), 25.0)
    assert animation.start * 25 == pytest.approx(round(animation.start * 25))
    assert animation.start <= 0.0
    assert animation.times[-1] >= sound.duration
    assert np.all(animation.values[[0, -1]] == 0)


def test_speech_without_silence_opens_before_it_and_closes_after() -> None:
    track = PhoneTrack(Tier.of(("aa", 0.0, 0.5)))
    animation = BigramEngine(SET).animate(Speech(track))
    assert animation.start < 0
    assert animation.at([-0.02])[0, 0] > 0.02
    assert animation.at([0.54])[0, 0] > 0.02


@pytest.mark.parametrize("tier", [Tier(), Tier.of(("sil", 0, 2))])
def test_nothing_said_is_a_mouth_at_rest(tier: Tier) -> None:
    animation = BigramEngine(SET).animate(Speech(PhoneTrack(tier)))
    assert len(animation) >= 1
    assert not animation.values.any()


def test_the_same_line_gives_the_same_bytes() -> None:
    first, again = (BigramEngine(SET).animate(Speech(PIPER)).to_bytes() for _ in range(2))
    assert first == again


def test_small_gaps_are_closed_and_larger_ones_are_silence() -> None:
    def piper(gap: float) -> PhoneTrack:
        return PhoneTrack(Tier.of(("aa", 0, 0.3), ("iy", 0.3 + gap, 0.6)))

    engine = BigramEngine(SET)
    assert engine.solve(piper(0.009)).spans.labels == ("sil", "aa", "ih", "sil")
    assert engine.solve(piper(0.009)).spans.boundary[1] == pytest.approx(0.3045)
    assert engine.solve(piper(0.011)).spans.labels == ("sil", "aa", "sil", "ih", "sil")


def test_unknown_phones_are_named_all_at_once() -> None:
    track = PhoneTrack(Tier.of(("xx", 0, 0.1), ("aa", 0.1, 0.2), ("qq", 0.2, 0.3)))
    with pytest.raises(LabelError, match=r"'qq', 'xx'"):
        BigramEngine(SET).animate(Speech(track))


@pytest.mark.parametrize("rate", [0, -5, float("nan"), 1e9])
def test_rates_that_make_no_sense_are_refused(rate: float) -> None:
    with pytest.raises(InputError, match="frames per second"):
        BigramEngine(SET).animate(Speech(PIPER), rate)


def test_a_missing_pair_is_built_from_single_phones_and_named() -> None:
    whole = BigramEngine(SET).animate(Speech(PIPER))
    animation = BigramEngine(lacking(("bmp", "ay"))).animate(Speech(PIPER))
    assert animation.report["stand_ins"] == ["bmp-ay"]
    assert whole.report["stand_ins"] == []
    assert animation.at([0.15])[0, animation.controls.index("PBM")] > 0.9
    assert animation.control("open").max() > 0.1


def test_a_whole_line_of_stand_ins_still_speaks() -> None:
    animation = BigramEngine(replace(SET, bigrams={})).animate(Speech(PIPER), 60)
    assert len(animation.report["stand_ins"]) == 5
    for middle in (0.15, 0.405):
        assert animation.at([middle])[0, animation.controls.index("PBM")] > 0.9


def test_a_stand_in_is_the_greater_of_two_single_curves() -> None:
    singles = {
        "aa": {"open": Keys.of([(-0.5, 0), (0.5, 0.8), (1.5, 0)])},
        "ih": {"open": Keys.of([(-0.5, 0), (0.5, 0.2), (1.5, 0)])},
    }
    made = stand_in(replace(SET, singles=singles), ("aa", "ih"))
    keys = made.curves["open"]
    # aa: 0.8 at its middle, half of that at the boundary; ih: 0.2 at its middle.
    assert keys.at([0, 0.25, 0.5, 0.75, 1]) == pytest.approx([0, 0.8, 0.4, 0.2, 0])
    assert made.source == "stand-in"


def test_why_names_the_bigram_the_keys_and_each_stage() -> None:
    engine = BigramEngine(SET)
    solved = engine.solve(PIPER)
    animation = engine.animate(Speech(PIPER))
    time = float(animation.times[np.argmax(animation.control("open"))])
    found = why(engine, solved, "open", time)
    assert found.value == pytest.approx(float(animation.control("open").max()), abs=1e-6)
    assert found.origins[0].pair in ("bmp-ay", "ay-bmp")
    assert found.origins[0].source == "english"
    drawn = SET.bigrams["bmp", "ay"].curves["open"].pairs()
    drawn += SET.bigrams["ay", "bmp"].curves["open"].pairs()
    assert set(found.origins[0].keys) <= set(drawn)
    stages = [reason.stage for reason in found.reasons]
    assert stages == sorted(stages, key=["smoothed", "constrained", "limited", "softened"].index)
    values = [found.origins[0].value, *(reason.after for reason in found.reasons)]
    assert values[-1] == pytest.approx(found.value)
    for before, reason in zip(values, found.reasons, strict=False):
        assert reason.before == pytest.approx(before, abs=1e-6)


def test_why_says_that_a_closure_bounds_the_mouth() -> None:
    engine = BigramEngine(SET)
    solved = engine.solve(PIPER)
    texts = [why(engine, solved, "open", t).text() for t in np.arange(0.2, 0.45, 0.005)]
    assert any("PBM is at" in text and "threshold 0.5" in text for text in texts)


def test_why_knows_an_override_from_the_set() -> None:
    changed = replace(SET.bigrams["bmp", "ay"], source="gnome")
    engine = BigramEngine(replace(SET, bigrams={**SET.bigrams, ("bmp", "ay"): changed}))
    found = why(engine, engine.solve(PIPER), "open", 0.25)
    assert {origin.source for origin in found.origins if origin.pair == "bmp-ay"} == {"gnome"}


def test_why_refuses_a_control_that_does_not_exist() -> None:
    engine = BigramEngine(SET)
    with pytest.raises(InputError, match="no control 'smile'"):
        why(engine, engine.solve(PIPER), "smile", 0.2)


def test_coverage_counts_what_lines_need() -> None:
    found = coverage(lacking(("bmp", "ay")), [PIPER, PIPER])
    assert found.needed["bmp", "ay"] == 2
    assert found.missing == (("bmp", "ay"),)
    assert found.share == pytest.approx(0.8)
    assert coverage(SET).share == 1
    assert len(coverage(SET).needed) == 483


def test_coverage_names_phones_without_a_single_curve() -> None:
    bare = replace(lacking(("bmp", "ay")), singles={})
    assert coverage(bare, [PIPER]).bare == ("ay", "bmp")


def test_a_set_that_is_edited_is_read_again(tmp_path: Path) -> None:
    """An animator saves the set and runs the same session again."""
    path = tmp_path / "mine.json"
    text = (DATA / "english.json").read_text()
    levels = []
    for limit in (15, 2):
        path.write_text(re.sub(r'"cut", "limit": \d+', f'"cut", "limit": {limit}', text))
        performance = pipeline.animate(Speech(PIPER), bigram_set=path)
        levels.append(performance.animation.keys["open"].values.max())
    assert levels[1] < levels[0]
