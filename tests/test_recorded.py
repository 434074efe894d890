"""Folders of recorded faces: what is read, what is refused, and the command that fits a set."""

import json
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from lipwright.character.unmixing import evening
from lipwright.cli import main
from lipwright.engines.bigram import load_set
from lipwright.errors import InputError
from lipwright.phones import PhoneTrack
from lipwright.recorded import Recorded, fit_set, read_takes, straightened
from lipwright.timeline import Tier

LABELS = "0 6000000 sil\n6000000 9000000 m\n9000000 13000000 aa\n13000000 18000000 sil\n"


def table(folder: Path, name: str = "one", step: float = 0.04) -> Path:
    """A mouth that opens for aa, with the phones beside it."""
    times = np.arange(45) * step
    opens = np.clip(1 - np.abs(times + 0.02 - 1.1) / 0.25, 0, 1) * 0.5 + 0.1
    rows = [f"{t:.3f},{v:.4f},0" for t, v in zip(times, opens, strict=True)]
    path = folder / f"{name}.csv"
    path.write_text("\n".join(["time,jawOpen,mouthPucker", *rows]) + "\n")
    path.with_suffix(".lab").write_text(LABELS)
    return path


def test_a_table_is_read_with_its_clock(tmp_path: Path) -> None:
    table(tmp_path)
    (take,) = read_takes(tmp_path)
    assert take.channels == ("jawOpen", "mouthPucker")
    assert take.values.shape == (45, 2)
    assert (take.rate, take.start) == (25.0, 0.0)
    assert take.phones.tier.labels == ("sil", "m", "aa", "sil")


def test_the_command_fits_a_set_that_speaks(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("one", "two"):
        table(tmp_path, name)
    output = tmp_path / "set" / "mine.json"
    output.parent.mkdir()
    assert main(["set", "fit", str(tmp_path), "-o", str(output), "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert (report["takes"], report["measured"]) == (2, 3)
    found = load_set(str(output))
    assert found.name == "mine"
    opens = found.bigrams["bmp", "aa"].curves["open"]
    # In the middle of aa, in proportion to what was recorded; the closure stays closed.
    assert 0.3 < opens.at(0.75) < 0.95
    assert opens.at(0.25) < 0.15
    assert found.bigrams["bmp", "aa"].curves["PBM"].values.max() > 0.9
    assert main(["set", "fit", str(tmp_path), "-o", str(output), "--as-scored"]) == 0
    assert "pairs     3 from takes" in capsys.readouterr().out


def test_a_face_is_taken_from_its_own_rest() -> None:
    """Lips that a tracker sees apart at rest are at rest."""
    track = PhoneTrack(Tier.of(("sil", 0, 0.6), ("m", 0.6, 0.9), ("aa", 0.9, 1.3), ("sil", 1.3, 2)))
    moved = np.zeros((50, 1))
    moved[24:32] = 0.5
    sets = [
        fit_set([Recorded("a", ("jawOpen",), moved + rest, 25.0, 0.0, track)])[0]
        for rest in (0.0, 0.2)
    ]
    one, other = (of.bigrams["bmp", "aa"].curves["open"] for of in sets)
    assert np.allclose(one.values, other.values, atol=1e-3)


def test_only_weak_shapes_are_brought_up() -> None:
    values = np.tile(np.linspace(0, 1, 101)[:, None], (1, 3)) * [0.9, 0.1, 0.001]
    high = (values * evening(values)).max(axis=0)
    assert high[0] == 0.9
    assert high[1] == pytest.approx(0.3, abs=0.01)
    assert high[2] == pytest.approx(0.004)


def test_small_scores_of_the_lips_are_raised_and_those_of_the_jaw_are_not() -> None:
    values = np.tile(np.linspace(-1, 1, 201)[:, None], (1, 2)) * 0.4
    (found,) = straightened([values], ("jawOpen", "mouthPucker"))
    assert np.allclose(found[:, 0], values[:, 0])
    assert found[120, 1] > 1.5 * values[120, 1] > 0
    assert np.allclose(found[:, 1], -found[::-1, 1])
    assert found[-1, 1] == pytest.approx(0.4, rel=0.02)


def without_time(folder: Path) -> None:
    table(folder).write_text("jawOpen\n1\n")


def one_bad_cell(folder: Path) -> None:
    path = table(folder)
    path.write_text(path.read_text().replace("0.080,0.1000,0", "0.080,wide,0"))


def short(folder: Path) -> None:
    table(folder).write_text("time,jawOpen\n0,0\n0.04,0\n")


def without_labels(folder: Path) -> None:
    table(folder).with_suffix(".lab").unlink()


def without_sound(folder: Path) -> None:
    without_labels(folder)
    (folder / "text.csv").write_text("take,text\none,ma\n")


def without_mouth(folder: Path) -> None:
    path = table(folder)
    text = path.read_text().replace("jawOpen,mouthPucker", "headYaw,eyeBlinkLeft")
    path.write_text(text)


def other_channels(folder: Path) -> None:
    table(folder)
    path = table(folder, "two")
    path.write_text(path.read_text().replace("mouthPucker", "mouthFunnel"))


def silent(folder: Path) -> None:
    table(folder).with_suffix(".lab").write_text("0 18000000 sil\n")


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda folder: None, "no recorded motion; expected files NAME.csv or NAME.c3d"),
        (without_time, "one.csv, line 1: no times; expected a column 'time'"),
        (one_bad_cell, "one.csv, line 4, column 'jawOpen': 'wide'; expected a finite number"),
        (short, "2 frames; expected 4 or more"),
        (without_labels, "one.csv: has no sound; expected sound and words, or labels"),
        (without_sound, "one.csv: has no sound; expected sound and words, or labels"),
        (without_mouth, "one.csv, line 1: no channel of a mouth among 2 columns"),
        (other_channels, "two: has other channels; expected those of one"),
        (silent, "one.lab: no phones but silence"),
    ],
)
def test_what_cannot_be_fitted(
    make: Callable[[Path], None],
    words: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    make(tmp_path)
    text = tmp_path / "text.csv"
    options = ["--text", str(text)] if text.exists() else []
    output = tmp_path / "out" / "set.json"
    output.parent.mkdir()
    assert main(["set", "fit", str(tmp_path), "-o", str(output), *options]) == 1
    error = capsys.readouterr().err
    assert re.search(re.escape(words), error), error
    assert error.count("\n") == 1
    assert not output.exists()


def test_an_output_of_another_kind(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table(tmp_path)
    assert main(["set", "fit", str(tmp_path), "-o", str(tmp_path / "set.csv")]) == 1
    assert "expected a name that ends in .json" in capsys.readouterr().err


def test_no_takes_at_all() -> None:
    with pytest.raises(InputError, match="no takes"):
        fit_set([])


def test_texts_without_their_column(tmp_path: Path) -> None:
    table(tmp_path)
    (tmp_path / "text.csv").write_text("take,colour\none,ma\n")
    with pytest.raises(InputError, match="expected 'name' and 'text'"):
        read_takes(tmp_path, text=tmp_path / "text.csv")
