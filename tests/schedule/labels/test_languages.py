"""What ``say`` labels in any language is read back from a file as it was."""

from pathlib import Path

import pytest

from lipwright import pipeline
from lipwright.phones import SILENCE, PhoneTrack
from lipwright.phones.languages import languages
from lipwright.schedule.labels.notation import normalised
from lipwright.schedule.labels.rows import Row
from lipwright.speech import Speech
from lipwright.timeline import Interval, Tier
from tests.phones.languages.test_classes import TABLE


@pytest.mark.parametrize("language", languages())
@pytest.mark.parametrize("phone_set", ["ipa", ""])
def test_labels_of_a_language_are_known_as_ipa(language: str, phone_set: str) -> None:
    labels = [*TABLE[language], SILENCE]
    rows = [Row(label, float(k), k + 1.0, "a line") for k, label in enumerate(labels)]
    read, name = normalised(rows, phone_set, "a file")
    assert name == "ipa"
    assert [row.label for row in read] == labels


@pytest.mark.parametrize("suffix", [".TextGrid", ".ctm", ".json"])
@pytest.mark.parametrize(
    ("phone_set", "labels"),
    [
        ("pinyin", "n i h ao"),  # all of them IPA as well
        ("pinyin", "sh ao"),  # and these are ARPAbet
        ("pinyin", "zh iii z ii sh i j ê"),
        ("sampa", "m a p"),
        ("ipa", "m er ʃ"),
        ("arpabet", "sh ao n"),
    ],
)
def test_a_phone_set_comes_back_with_its_labels(
    tmp_path: Path, phone_set: str, labels: str, suffix: str
) -> None:
    tier = Tier(tuple(Interval(each, n, n + 1.0) for n, each in enumerate(labels.split())))
    path = tmp_path / f"a{suffix}"
    pipeline.save_labels(Speech(PhoneTrack(tier, phone_set)), path)
    path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    read = pipeline.from_labels(path).phones
    assert (read.phone_set, list(read.tier.labels)) == (phone_set, labels.split())


def test_labels_of_mandarin_are_animated_with_its_set(tmp_path: Path) -> None:
    path = tmp_path / "a.TextGrid"
    tier = Tier.of(("sil", 0.0, 0.2), ("n", 0.2, 0.3), ("ü", 0.3, 0.6), ("sil", 0.6, 0.8))
    pipeline.save_labels(Speech(PhoneTrack(tier, "pinyin")), path)
    made = pipeline.animate(pipeline.from_labels(path)).animation
    assert made.report["set"] == "mandarin"
    assert not made.report["stand_ins"]
