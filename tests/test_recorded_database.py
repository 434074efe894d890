"""Motion databases as takes: shapes and poses are fitted, what makes no face is refused."""

import json
from pathlib import Path

import numpy as np
import pytest

from lipwright.cli import main
from lipwright.engines.bigram import load_set
from lipwright.engines.motion.building import build
from lipwright.engines.motion.preparing import prepare
from lipwright.engines.motion.take import Take
from lipwright.errors import InputError
from lipwright.phones import PhoneTrack
from lipwright.pipeline import fit_set
from lipwright.recorded import Recorded
from lipwright.recorded import fit_set as fitted
from lipwright.recorded_database import database_takes
from lipwright.timeline import Tier

TRACK = PhoneTrack(
    Tier.of(("sil", 0, 0.6), ("M", 0.6, 0.9), ("AA", 0.9, 1.3), ("sil", 1.3, 1.8)), "arpabet"
)


def values(channels: int) -> np.ndarray:
    """A mouth that opens for aa; the other channels hardly move."""
    times = (np.arange(45) + 0.5) / 25
    moved = np.zeros((45, channels), np.float32)
    moved[:, 0] = np.clip(1 - np.abs(times - 1.1) / 0.25, 0, 1) * 0.5
    moved[:, 1:] = 0.01 * np.sin(9 * times)[:, None] ** 2
    return moved


def database(folder: Path, channels: tuple[str, ...]) -> Path:
    """Two takes of the same."""
    takes = [
        Take(name, channels, values(len(channels)), 25.0, 0.0, TRACK, Tier(), None)
        for name in ("one", "two")
    ]
    build(folder, [prepare(take) for take in takes])
    return folder


def test_takes_come_back_with_their_clock_and_phones(tmp_path: Path) -> None:
    one, two = database_takes(database(tmp_path / "db", ("jawOpen", "mouthPucker")))
    assert (one.name, two.name) == ("one", "two")
    assert (one.rate, one.start, one.values.shape) == (25.0, 0.0, (45, 2))
    assert [phone.label for phone in one.phones] == ["sil", "m", "aa", "sil"]
    assert np.allclose([phone.start for phone in one.phones], [0, 0.6, 0.9, 1.3])


def test_a_database_gives_what_its_takes_give(tmp_path: Path) -> None:
    channels = ("jawOpen", "mouthPucker")
    made, report = fit_set(database(tmp_path / "db", channels))
    takes = [Recorded(name, channels, values(2), 25.0, 0.0, TRACK) for name in ("one", "two")]
    other, _ = fitted(takes)
    assert made.bigrams == other.bigrams
    assert (report.takes, report.measured) == (2, 3)


def test_poses_are_fitted_as_they_are(tmp_path: Path) -> None:
    made, report = fit_set(database(tmp_path / "db", ("open", "W", "tRoof")))
    assert set(report.fitted) == {"open", "W", "tRoof"}
    assert 0.25 < made.bigrams["bmp", "aa"].curves["open"].at(0.75) < 0.6
    assert made.bigrams["bmp", "aa"].curves["PBM"] == load_set("english").bigrams[
        "bmp", "aa"
    ].curves["PBM"]  # fmt: skip


def test_too_few_markers_and_words_are_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    markers = database(tmp_path / "markers", ("chin.x", "chin.y", "chin.z"))
    with pytest.raises(InputError, match="1 markers; expected 8 or more"):
        database_takes(markers)
    shapes = database(tmp_path / "db", ("jawOpen", "mouthPucker"))
    with pytest.raises(InputError, match="Leave them out"):
        database_takes(shapes, "text.csv")
    output = tmp_path / "mine.json"
    assert main(["set", "fit", str(markers), "-o", str(output)]) == 1
    error = capsys.readouterr().err
    assert "markers" in error
    assert error.count("\n") == 1
    assert main(["set", "fit", str(shapes), "-o", str(output), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["takes"] == 2
