"""Overrides of a character: layered, refused where they conflict, and told by ``why``."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lipwright.engines.bigram import BigramEngine, load_set, read_overrides, with_character
from lipwright.engines.bigram.model import BigramSet
from lipwright.engines.bigram.why import Explanation, why
from lipwright.errors import InputError
from lipwright.phones import PhoneTrack
from lipwright.timeline import Tier
from tests.character_files import write_overrides

SET = load_set("english")
PIPER = PhoneTrack(
    Tier.of(("P", 0.1, 0.2), ("AY1", 0.2, 0.36), ("P", 0.36, 0.45), ("ER0", 0.45, 0.7))
)


def drawn(level: float, pose: str = "wide", *pair: str) -> dict[str, Any]:
    return {"pair": pair or ("bmp", "ay"), "curves": {pose: [[0, 0], [0.6, level], [1, 0]]}}


def changed(*parts: Any, base: BigramSet = SET, **settings: Any) -> BigramSet:
    return with_character(base, "Troll", "troll.json", parts, settings)


def test_later_files_and_parts_win(tmp_path: Path) -> None:
    one = write_overrides(
        tmp_path / "one.json", bigrams=[drawn(0.1), drawn(0.1, "wide", "l", "ow")]
    )
    two = write_overrides(tmp_path / "two.json", bigrams=[drawn(0.2)])
    found = changed(str(one), str(two))
    assert found.bigrams["bmp", "ay"].curves["wide"].values.max() == 0.2
    assert found.bigrams["bmp", "ay"].source == "two"
    assert found.bigrams["l", "ow"].source == "one"
    assert changed(str(two), str(one)).bigrams["bmp", "ay"].source == "one"
    assert changed(str(two), {"bigrams": [drawn(0.3)]}).bigrams["bmp", "ay"].source == "Troll"
    assert [layer.name for layer in found.layers] == ["one", "two"]
    assert found.beneath is SET


def test_layers_of_characters_add_up() -> None:
    base = with_character(SET, "Gnome", "gnome.json", [{"gains": {"wide": 0.5}}], {})
    top = changed({"gains": {"wide": 0.5}}, base=base, poses={"open": {"limit": 5}})
    level = SET.bigrams["kg", "ih"].curves["wide"].values.max()
    assert top.bigrams["kg", "ih"].curves["wide"].values.max() == pytest.approx(level / 4)
    assert top.rules.pose("open").limit == 5
    assert top.rules.pose("open").softness == SET.rules.pose("open").softness
    assert top.beneath is SET


def test_settings_change_what_they_name() -> None:
    conflicts = [{"poses": ["PBM", "open"], "threshold": 0.9}]
    found = changed(poses={"W": {"window": 0.3}}, conflicts=conflicts, padding=0.4).rules
    thresholds = {frozenset(c.poses): c.threshold for c in found.conflicts}
    assert thresholds == {frozenset(("open", "PBM")): 0.9, frozenset(("open", "FV")): 0.5}
    assert (found.pose("W").window, found.settings.padding) == (0.3, 0.4)
    assert found.settings.spline == SET.rules.settings.spline


def test_what_says_nothing_leaves_the_set_as_it_is() -> None:
    assert changed({"bigrams": []}, {}, poses={}) is SET
    assert changed() is SET


BAD: list[tuple[list[Any], dict[str, Any], str, str]] = [
    ([{"bigrams": [drawn(0.1)]}] * 2, {}, "bmp-ay is said twice", "overrides[0], in overrides[1]"),
    ([{"bigrams": [drawn(0.1)] * 2}], {}, "bmp-ay is said twice", "Keep one"),
    ([{"gains": {"open": 1}}, {"gains": {"open": 2}}], {}, "the gain of open", "1 in overrides[0]"),
    (
        [{"poses": {"PBM": {"meets": "cut"}}}],
        {"poses": {"PBM": {"meets": "widen"}}},
        "'meets' of the pose PBM is said twice: cut in overrides, widen in settings",
        "Keep one of the two",
    ),
    (
        [{"conflicts": [{"poses": ["open", "PBM"], "threshold": 0.4}]}],
        {"conflicts": [{"poses": ["PBM", "open"], "threshold": 0.5}]},
        "threshold of PBM and open is said twice",
        "0.4 in overrides, 0.5 in settings",
    ),
    ([{"settings": {"padding": 0.1}}], {"padding": 0.3}, "'padding' is said twice", "0.3"),
    ([{"gains": {"opn": 1}}], {}, "unknown pose 'opn'", "Did you mean 'open'?"),
    ([{"poses": {"PMB": {"limit": 3}}}], {}, "unknown pose 'PMB'", "Did you mean 'PBM'?"),
    ([], {"poses": {"open": {"limits": 3}}}, "unknown field 'limits'", "Did you mean 'limit'"),
    ([], {"poses": {"open": {"name": "x"}}}, "unknown field 'name'", "one of priority"),
    ([], {"poses": {"open": {"limit": 0}}}, "limit 0", "settings"),
    ([], {"poses": {"open": {"limit": "fast"}}}, "float", "pose 'open'"),
    ([], {"poses": {"open": {"meets": "never"}}}, "never", "pose 'open'"),
    ([], {"pose": {}}, "unknown setting 'pose'", "Did you mean 'poses'?"),
    ([], {"warp": "sideways"}, "sideways", "settings"),
    ([], {"conflicts": [{"poses": ["open", "PMB"], "threshold": 1}]}, "'PMB'", "conflicts"),
    ([], {"conflicts": [{"poses": ["FV", "PBM"], "threshold": 1}]}, "both widen", "'cut'"),
    ([], {"conflicts": [{"poses": ["open", "PBM"], "threshold": 0}]}, "threshold 0", "above 0"),
    ([{"bigrams": [drawn(0.1, "wide", "bm", "ay")]}], {}, "'bm' is not a phone", "mean 'bmp'"),
    ([{"bigrams": [drawn(0.1, "smiel")]}], {}, "unknown pose 'smiel'", "bmp-ay"),
    ([{"bigrams": [drawn(2)]}], {}, "weights from 0 to 2", "bmp-ay"),
    ([{"bigrms": []}], {}, "bigrms", "overrides"),
    ([{"version": 2}], {}, "version 2", "newer Lipwright"),
    ([{"format": "lipwright/mapping"}], {}, "lipwright/mapping", "lipwright/bigram-overrides"),
]


@pytest.mark.parametrize(("parts", "settings", "found", "more"), BAD)
def test_broken_and_conflicting_overrides_are_refused_with_their_place(
    parts: list[Any], settings: dict[str, Any], found: str, more: str
) -> None:
    with pytest.raises(InputError) as caught:
        changed(*parts, **settings)
    message = str(caught.value)
    assert message.startswith("troll.json")
    assert found in message
    assert more in message
    assert "\n" not in message


def test_a_broken_override_file_is_told_with_who_names_it(tmp_path: Path) -> None:
    path = write_overrides(tmp_path / "jaw.json", gains={"jaw": 1})
    with pytest.raises(InputError, match=r"troll\.json, overrides: .*jaw\.json: .*'jaw'"):
        changed(str(path))


def explained(of: BigramSet, control: str, time: float) -> Explanation:
    engine = BigramEngine(of)
    return why(engine, engine.solve(PIPER), control, time)


def test_why_shows_when_an_override_spoke_and_what_the_set_would_say() -> None:
    plain = explained(SET, "open", 0.3)
    assert (plain.alone, plain.origins[0].override) == (None, "")
    found = explained(changed({"bigrams": [drawn(0.9, "open")]}), "open", 0.3)
    first = found.origins[0]
    assert (first.pair, first.source) == ("bmp-ay", "Troll")
    assert first.override == "character Troll, troll.json, overrides"
    own = {origin.pair: origin.value for origin in plain.origins}
    assert first.own == pytest.approx(own["bmp-ay"])
    assert found.alone == pytest.approx(plain.value)
    assert "character Troll, troll.json, overrides; english itself: " in found.text()
    assert f"without overrides: {plain.value:.3f}" in found.text()
    others = [origin for origin in found.origins if origin.pair != "bmp-ay"]
    assert [origin.override for origin in others] == [""] * len(others)


def test_why_shows_a_curve_that_an_override_left_out() -> None:
    found = explained(changed({"bigrams": [drawn(0.9, "wide")]}), "open", 0.25)
    left = next(origin for origin in found.origins if origin.pair == "bmp-ay")
    assert (left.value, left.keys, left.source) == (0, (), "Troll")
    assert left.own is not None
    assert left.own > 0.1
    assert found.alone is not None
    assert found.alone > found.value + 0.1
    new = explained(changed({"bigrams": [drawn(0.9, "wide")]}), "wide", 0.3)
    assert "english itself: no curve" in new.text()


def test_why_names_gains_and_limits_and_thresholds(tmp_path: Path) -> None:
    path = write_overrides(tmp_path / "shy.json", gains={"open": 0.5})
    found = explained(changed(str(path), poses={"open": {"limit": 3}}), "open", 0.28)
    assert found.origins[0].override == f"times 0.5 by overrides shy of Troll, {path}"
    limited = explained(changed(poses={"open": {"limit": 3}}), "open", 0.28)
    texts = " ".join(reason.text for reason in limited.reasons)
    assert "3 per second (character Troll, troll.json, settings; english itself says 15)" in texts
    conflicts = [{"poses": ["open", "PBM"], "threshold": 0.2}]
    bounded = explained(changed(conflicts=conflicts), "open", 0.21)
    assert "threshold 0.2, character Troll" in " ".join(reason.text for reason in bounded.reasons)


def test_a_stand_in_made_of_an_overridden_phone_is_told() -> None:
    lacks = {"phones": {"ay": {"wide": [[0, 0], [0.5, 1], [1, 0]]}}}
    bigrams = {pair: b for pair, b in SET.bigrams.items() if pair != ("bmp", "ay")}
    found = explained(changed(lacks, base=replace(SET, bigrams=bigrams)), "wide", 0.28)
    mine = next(origin for origin in found.origins if origin.pair == "bmp-ay")
    assert (mine.source, mine.override) == ("stand-in", "character Troll, troll.json, overrides")


def test_the_users_overrides_go_on_top(tmp_path: Path) -> None:
    path = write_overrides(tmp_path / "mine.json", bigrams=[drawn(0.7)])
    found = read_overrides(path, changed({"bigrams": [drawn(0.3)]}))
    origin = explained(found, "wide", 0.3).origins[0]
    assert origin.override == f"overrides mine, {path}"
    assert np.isclose(found.bigrams["bmp", "ay"].curves["wide"].values.max(), 0.7)
