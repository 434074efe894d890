"""C3D files: what is read, what is mended, what is refused."""

import struct
import sys
from collections.abc import Callable
from pathlib import Path

import ezc3d
import numpy as np
import pytest

from lipwright.engines.motion.capture import read_motion
from lipwright.errors import FileFormatError, MissingExtraError
from tests.engines.motion.capture.made import Floats, write_c3d

LABELS = ("chin", "nose", "browL", "browR", "lip")
FRAMES = 40


@pytest.fixture
def points() -> Floats:
    return np.random.default_rng(0).normal(scale=0.1, size=(FRAMES, len(LABELS), 3))


@pytest.mark.parametrize(
    ("unit", "scale"), [("mm", 1e3), ("m", 1.0), ("cm", 1e2), ("MM", 1e3), ("in", 1 / 0.0254)]
)
def test_places_are_metres(tmp_path: Path, points: Floats, unit: str, scale: float) -> None:
    motion = read_motion(write_c3d(tmp_path / "a.c3d", points, LABELS, unit=unit, scale=scale))
    np.testing.assert_allclose(motion.points, points, atol=1e-6)
    assert motion.channels[:4] == ("chin.x", "chin.y", "chin.z", "nose.x")
    assert (motion.labels, motion.rate, motion.start) == (LABELS, 120, 0)
    assert (motion.kind, motion.notes) == ("markers", ())


def test_no_unit_means_millimetres_and_is_told(tmp_path: Path, points: Floats) -> None:
    motion = read_motion(write_c3d(tmp_path / "a.c3d", points, LABELS, unit=""))
    np.testing.assert_allclose(motion.points, points, atol=1e-6)
    assert motion.notes == ("names no unit: millimetres are assumed",)


def test_what_was_not_seen_is_nan(tmp_path: Path, points: Floats) -> None:
    points[3, 0] = np.nan
    points[4, 1] = 0
    motion = read_motion(write_c3d(tmp_path / "a.c3d", points, LABELS))
    lost = np.isnan(motion.points).any(axis=2)
    assert np.argwhere(lost).tolist() == [[3, 0], [4, 1]]


def test_a_residual_of_minus_one_means_not_seen(tmp_path: Path, points: Floats) -> None:
    path = write_c3d(tmp_path / "a.c3d", points, LABELS)
    file = ezc3d.c3d(str(path))
    residuals = np.zeros((1, len(LABELS), FRAMES))
    residuals[0, 2, 7] = -1
    file["data"]["meta_points"]["residuals"] = residuals
    file.write(str(path))
    assert np.argwhere(np.isnan(read_motion(path).points[:, :, 0])).tolist() == [[7, 2]]


def test_markers_without_a_label_are_left_out(tmp_path: Path, points: Floats) -> None:
    more = np.concatenate([points, points], axis=1)
    labels = (*LABELS, "", "*17", "unlabelled 3", "U_4", "Uname*5")
    motion = read_motion(write_c3d(tmp_path / "a.c3d", more, labels))
    assert motion.labels == (*LABELS, "U_4")
    assert motion.notes == ("4 markers without a label left out",)


def test_a_subject_before_all_labels_is_dropped(tmp_path: Path, points: Floats) -> None:
    labels = [f"Anna:{label}" for label in LABELS]
    assert read_motion(write_c3d(tmp_path / "a.c3d", points, labels)).labels == LABELS


def test_pieces_of_one_marker_are_joined(tmp_path: Path, points: Floats) -> None:
    both = np.concatenate([points, points[:, :1]], axis=1)
    both[20:, 0], both[:22, -1] = np.nan, np.nan
    motion = read_motion(write_c3d(tmp_path / "a.c3d", both, (*LABELS, "chin")))
    assert motion.notes == ("pieces of 'chin' joined",)
    assert np.flatnonzero(np.isnan(motion.points[:, 0, 0])).tolist() == [20, 21]
    with pytest.raises(FileFormatError, match="two markers 'chin', both seen in frame 1"):
        read_motion(write_c3d(tmp_path / "b.c3d", np.concatenate([points] * 2, axis=1), LABELS * 2))


def test_more_labels_than_one_list_holds(tmp_path: Path) -> None:
    many = np.random.default_rng(0).normal(size=(5, 300, 3))
    labels = [f"m{i}" for i in range(300)]
    motion = read_motion(write_c3d(tmp_path / "a.c3d", many, labels))
    assert motion.labels == tuple(labels)


def bent(path: Path, change: Callable[[bytearray], object]) -> Path:
    """A file with some bytes changed."""
    data = bytearray(path.read_bytes())
    change(data)
    path.write_bytes(data)
    return path


def test_over_65535_frames_is_refused_however_it_was_written(tmp_path: Path) -> None:
    long = np.zeros((70_000, 4, 3)) + np.arange(1, 5)[:, None]
    path = write_c3d(tmp_path / "long.c3d", long, LABELS[:4])
    with pytest.raises(FileFormatError, match=r"65535 frames; expected fewer.*in parts"):
        read_motion(path)


@pytest.mark.parametrize(
    ("group", "name", "value"),
    [
        ("POINT", "LONG_FRAMES", [70_000]),
        ("TRIAL", "ACTUAL_END_FIELD", [4464, 1]),
    ],
)
def test_more_frames_than_the_header_can_say(
    tmp_path: Path, points: Floats, group: str, name: str, value: list[int]
) -> None:
    path = write_c3d(tmp_path / "a.c3d", points, LABELS)
    file = ezc3d.c3d(str(path))
    file.add_parameter(group, name, value)
    if group == "TRIAL":
        file.add_parameter(group, "ACTUAL_START_FIELD", [1, 0])
    file.write(str(path))
    with pytest.raises(FileFormatError, match="70000 frames"):
        read_motion(path)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda data: data.clear(), "is empty"),
        (lambda data: data.__setitem__(slice(None), b"hello " * 500), "is no C3D file"),
        (lambda data: data.__delitem__(slice(300, None)), "is no C3D file"),
        (lambda data: data.__delitem__(slice(700, None)), "the file was cut"),
        (lambda data: data.__delitem__(slice(-600, None)), "the file was cut"),
        (lambda data: data.__setitem__(slice(2, 4), struct.pack("<H", 0)), "no markers"),
        (lambda data: data.__setitem__(slice(8, 10), struct.pack("<H", 0)), "frames 1 to 0"),
        (lambda data: data.__setitem__(slice(8, 10), struct.pack("<H", 65535)), "65535 frames"),
    ],
)
def test_broken_files(
    tmp_path: Path, points: Floats, change: Callable[[bytearray], object], words: str
) -> None:
    path = bent(write_c3d(tmp_path / "a.c3d", points, LABELS), change)
    with pytest.raises(FileFormatError, match=words) as caught:
        read_motion(path)
    assert "a.c3d" in str(caught.value)


@pytest.mark.parametrize(
    ("labels", "unit", "words"),
    [
        (LABELS, "furlong", "the unit 'furlong'; expected one of mm"),
        (("", "a", "b", "", "c"), "mm", "3 labelled markers; expected 4 or more"),
    ],
)
def test_files_that_say_too_little(
    tmp_path: Path, points: Floats, labels: tuple[str, ...], unit: str, words: str
) -> None:
    path = write_c3d(tmp_path / "a.c3d", points, labels, unit=unit)
    with pytest.raises(FileFormatError, match=words):
        read_motion(path)


def test_too_few_frames(tmp_path: Path, points: Floats) -> None:
    with pytest.raises(FileFormatError, match="2 frames; expected 4 or more"):
        read_motion(write_c3d(tmp_path / "a.c3d", points[:2], LABELS))


@pytest.mark.parametrize("rate", [0.0, -5.0])
def test_a_rate_that_is_none(tmp_path: Path, points: Floats, rate: float) -> None:
    right, wrong = struct.pack("<f", 120), struct.pack("<f", rate)
    path = bent(
        write_c3d(tmp_path / "a.c3d", points, LABELS),
        lambda data: data.__setitem__(slice(None), data.replace(right, wrong)),
    )
    with pytest.raises(FileFormatError, match="frames per second"):
        read_motion(path)


def test_without_the_extra_its_line_is_named(
    tmp_path: Path, points: Floats, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = write_c3d(tmp_path / "a.c3d", points, LABELS)
    monkeypatch.setitem(sys.modules, "ezc3d", None)
    with pytest.raises(MissingExtraError, match=r"pip install 'lipwright\[mocap\]'"):
        read_motion(path)
