"""The Mandarin set: the English one and the pairs of ü; sets that build on others."""

import json
from pathlib import Path
from typing import Any

import pytest
from tools.english.__main__ import english
from tools.mandarin.__main__ import mandarin

from lipwright.engines.bigram import load_set
from lipwright.engines.bigram.classes import reduction_for
from lipwright.engines.bigram.coverage import coverage
from lipwright.engines.bigram.set_file import DATA, read_set, set_bytes
from lipwright.errors import SetError
from lipwright.phones import load_phone_set

SET = load_set("mandarin")
ENGLISH = load_set("english")


def level(pair: tuple[str, str], pose: str) -> float:
    keys = SET.bigrams[pair].curves.get(pose)
    return float(keys.values.max()) if keys is not None else 0.0


def test_43_pairs_among_sounds_and_2_with_silence_are_new() -> None:
    new = set(SET.bigrams) - set(ENGLISH.bigrams)
    assert len(new) == 45
    assert all("yu" in pair for pair in new)
    assert len([pair for pair in new if "sil" not in pair]) == 43
    assert coverage(SET).missing == ()
    for pair, bigram in ENGLISH.bigrams.items():
        assert SET.bigrams[pair] is bigram


def test_the_file_is_what_the_tool_makes() -> None:
    assert (DATA / "mandarin.json").read_bytes() == set_bytes(mandarin(), base=english())


def test_curves_are_an_artists_few_keys() -> None:
    new = [bigram for pair, bigram in SET.bigrams.items() if "yu" in pair]
    counts = [len(keys) for bigram in new for keys in bigram.curves.values()]
    assert max(counts) <= 8


def test_ü_is_rounded_as_u_with_a_smaller_opening() -> None:
    yu, u = ("sil", "yu"), ("sil", "w")
    assert 0.7 < level(yu, "W") < level(u, "W")
    assert level(yu, "open") < level(u, "open")
    assert level(yu, "wide") == level(yu, "tBack") == 0
    # The lips of 去 are round before the vowel, those of 女 on the way.
    assert SET.bigrams["z", "yu"].curves["W"].at([0.25])[0] > 0.3
    assert level(("z", "yu"), "wide") == 0


@pytest.mark.parametrize(
    ("phone_set", "label", "classes"),
    [
        ("pinyin", "ü", "yu"),
        ("pinyin", "TH", "th"),
        ("ipa", "y", "yu"),
        ("ipa", "yː", "yu"),
        ("ipa", "ˈʏ", "yu"),
        ("ipa", "øː", "yu"),
        ("ipa", "ɥ", "yu"),
        ("ipa", "u", "w"),
        ("ipa", "tʃ", "sh"),
        ("sampa", "y", "yu"),
        ("sampa", "2:", "yu"),
        ("arpabet", "UW1", "w"),
        ("common", "aa", "aa"),
    ],
)
def test_labels_of_every_set_find_their_classes(phone_set: str, label: str, classes: str) -> None:
    pieces, exact = reduction_for(SET, phone_set).of(label)
    assert exact
    assert " ".join(piece.label for piece in pieces) == classes


def test_without_yu_the_lips_of_u_stand_in() -> None:
    assert reduction_for(ENGLISH, "ipa").of("y")[0][0].label == "w"
    assert reduction_for(ENGLISH, "pinyin").of("ü")[0][0].label == "w"


def test_the_digest_covers_the_base_as_well(tmp_path: Path) -> None:
    (tmp_path / "base.json").write_bytes((DATA / "english.json").read_bytes())
    own = based(tmp_path, base="base.json")
    before = read_set(own).digest
    changed = (tmp_path / "base.json").read_text("utf-8").replace('"limit": 25', '"limit": 24')
    (tmp_path / "base.json").write_text(changed, "utf-8")
    assert read_set(own).digest != before
    assert read_set(own).rules.poses[5].limit == 24


def based(folder: Path, **fields: Any) -> Path:
    document = {
        "format": "lipwright/bigram-set",
        "version": 1,
        "name": "mine",
        "base": "english",
        "bigrams": [{"pair": ["ah", "aa"], "curves": {"open": [[0, 0], [0.5, 1], [1, 0]]}}],
        **fields,
    }
    path = folder / "mine.json"
    path.write_text(json.dumps({k: v for k, v in document.items() if v is not None}), "utf-8")
    return path


def test_a_set_of_ones_own_names_only_what_differs(tmp_path: Path) -> None:
    own = read_set(based(tmp_path))
    assert own.bigrams["ah", "aa"].source == "mine"
    assert own.bigrams["aa", "ah"].source == "english"
    assert own.rules == ENGLISH.rules
    assert set(own.presets) == set(ENGLISH.presets)


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"base": None}, "no rules; expected 'rules', or a 'base' that has them"),
        ({"base": "klingon"}, "no bigram set 'klingon'"),
        ({"base": "mine.json"}, "the base 'mine.json' builds on this set"),
        ({"base": "mandarin"}, "'common' lacks yu, which the base 'mandarin' has"),
    ],
)
def test_a_base_that_cannot_be_is_refused(
    fields: dict[str, Any], words: str, tmp_path: Path
) -> None:
    with pytest.raises(SetError, match=words) as refused:
        read_set(based(tmp_path, **fields))
    assert "mine.json" in str(refused.value)


def test_the_classes_are_the_common_ones_and_yu() -> None:
    common, own = load_phone_set("common"), load_phone_set("mandarin")
    assert own.extends == "common"
    assert set(own.labels) - set(common.labels) == {"yu"}
    assert all(own.example(label) == common.example(label) for label in common.labels)
