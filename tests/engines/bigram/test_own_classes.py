"""A user splits a class: ``bmp`` into ``bp`` and ``m``, and is told which bigrams are new."""

import json
from pathlib import Path

import pytest

from lipwright import pipeline
from lipwright.engines.bigram import load_set
from lipwright.engines.bigram.coverage import coverage
from lipwright.engines.bigram.set_file import DATA
from lipwright.errors import LabelError
from lipwright.phones import PhoneTrack
from lipwright.phones.sets import DATA as PHONES
from lipwright.speech import Speech
from lipwright.timeline import Tier

MAP = PhoneTrack(Tier.of(("m", 0, 0.1), ("ae", 0.1, 0.3), ("p", 0.3, 0.4)))


def split(folder: Path) -> tuple[Path, Path]:
    """Write a phone set, a reduction and a set in which m is a class of its own."""
    phones = json.loads((PHONES / "common.json").read_text())
    phones["name"] = "mine"
    phones["phones"] = [p for p in phones["phones"] if p["label"] != "bmp"]
    phones["phones"] += [{"label": "bp", "example": "[p]ut"}, {"label": "m", "example": "[m]at"}]
    (folder / "mine.json").write_text(json.dumps(phones))
    reduction = json.loads((PHONES / "arpabet-to-common.json").read_text())
    reduction["target"] = "mine"
    reduction["map"] |= {"p": "bp", "b": "bp", "m": "m"}
    (folder / "arpabet-to-mine.json").write_text(json.dumps(reduction))
    text = (DATA / "english.json").read_text().replace('"bmp"', '"bp"')
    (folder / "set.json").write_text(text.replace('"common"', '"mine.json"', 1))
    return folder / "set.json", folder / "arpabet-to-mine.json"


def test_new_pairs_are_told_and_the_line_still_speaks(tmp_path: Path) -> None:
    path, reduction = split(tmp_path)
    found = coverage(load_set(str(path)))
    # 22 neighbours before it, 22 after it, and m with itself.
    assert len(found.missing) == 45
    assert all("m" in pair for pair in found.missing)
    assert found.bare == ("m",)
    needed = coverage(load_set(str(path)), [MAP], str(reduction))
    assert set(needed.missing) == {("sil", "m"), ("m", "ah")}
    performance = pipeline.animate(Speech(MAP), bigram_set=path, reduction=reduction)
    assert performance.animation.report["stand_ins"] == ["sil-m", "m-ah"]
    assert performance.animation.control("PBM").max() > 0.9


def test_a_reduction_for_other_labels_is_refused(tmp_path: Path) -> None:
    path, reduction = split(tmp_path)
    with pytest.raises(LabelError, match=r"reduces 'arpabet' to 'mine'; expected 'ipa' to 'mine'"):
        pipeline.animate(Speech(PhoneTrack(MAP.tier, "ipa")), bigram_set=path, reduction=reduction)
    with pytest.raises(LabelError, match="'mine'; expected 'arpabet' to 'common'"):
        pipeline.animate(Speech(MAP), reduction=reduction)
