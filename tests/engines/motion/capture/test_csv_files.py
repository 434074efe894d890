"""Tables of blendshapes: each format's time, what is mended, what is refused."""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest

from lipwright.engines.motion.capture import Motion, check_length, read_motion
from lipwright.errors import FileFormatError, InputError

Written = Callable[[str], Path]


@pytest.fixture
def written(tmp_path: Path) -> Written:
    def write(text: str) -> Path:
        path = tmp_path / "take.csv"
        path.write_text(text, "utf-8")
        return path

    return write


def table(header: str, times: Sequence[object], *columns: Sequence[float]) -> str:
    rows = [
        ",".join([str(time), *(f"{column[k]:.4f}" for column in columns)])
        for k, time in enumerate(times)
    ]
    return "\n".join([header, *rows]) + "\n"


RAMP = [k / 10 for k in range(10)]


def test_a_rows_value_holds_in_the_middle_of_its_frame(written: Written) -> None:
    text = table("time,jawOpen", [f"{k * 0.04:.4f}" for k in range(10)], RAMP)
    motion = read_motion(written(text))
    assert (motion.rate, motion.start, motion.kind) == (25, 0, "blendshapes")
    assert motion.channels == ("jawOpen",)
    np.testing.assert_allclose(motion.values[:, 0], RAMP, atol=1e-6)
    np.testing.assert_allclose(motion.times, 0.02 + 0.04 * np.arange(10))
    assert motion.notes == ()


def test_instants_are_read_as_middles_where_one_says_so(written: Written) -> None:
    path = written(table("time,jawOpen", [f"{k * 0.04:.4f}" for k in range(10)], RAMP))
    np.testing.assert_allclose(
        read_motion(path, time_is="middle").times, 0.04 * np.arange(10), atol=1e-12
    )


@pytest.mark.parametrize(
    ("name", "step", "rate"),
    [
        ("time", "{:.4f}", 30),
        ("Time (s)", "{:.3f}", 30),
        ("timestamp", "{:.6f}", 59.94),
        ("seconds", "{:.5f}", 120),
    ],
)
def test_rates_are_found_through_rounding(
    written: Written, name: str, step: str, rate: float
) -> None:
    times = [step.format(k / rate) for k in range(200)]
    motion = read_motion(written(table(f"{name},jawOpen", times, np.linspace(0, 1, 200).tolist())))
    assert motion.rate == rate
    assert len(motion.values) == 200


@pytest.mark.parametrize("name", ["time_ms", "time [ms]", "time"])
def test_milliseconds(written: Written, name: str) -> None:
    motion = read_motion(written(table(f"{name},jawOpen", [40 * k for k in range(10)], RAMP)))
    assert motion.rate == 25
    assert any("milliseconds" in note for note in motion.notes) == (name == "time")


def test_frames_need_a_rate(written: Written) -> None:
    path = written(table("Frame,jawOpen", list(range(101, 111)), RAMP))
    motion = read_motion(path, rate=30)
    assert (motion.rate, motion.start, len(motion.values)) == (30, 0, 10)
    with pytest.raises(FileFormatError, match=r"only the column 'Frame'.*Timecode"):
        read_motion(path)


def test_rows_without_any_time_follow_one_another(written: Written) -> None:
    path = written("jawOpen,mouthClose\n" + "".join(f"{v},0\n" for v in RAMP))
    assert read_motion(path, rate=60).duration == pytest.approx(10 / 60)
    with pytest.raises(FileFormatError, match="no times"):
        read_motion(path)


def link_face(frames: Sequence[float], rate: int, start: int) -> str:
    """A table as Live Link Face writes it."""
    names = "EyeBlinkLeft,JawOpen,MouthSmileLeft,HeadYaw"
    lines = [f"Timecode,BlendShapeCount,{names}"]
    for frame in frames:
        second, part = divmod(start * rate + frame, rate)
        hours, rest = divmod(int(second) % 86400, 3600)
        clock = f"{hours:02}:{rest // 60:02}:{rest % 60:02}:{part:06.3f}"
        lines.append(f"{clock},61,0.1,{frame / 1000:.6f},0.5,-0.2")
    return "\n".join(lines)


@pytest.mark.parametrize("rate", [30, 60])
@pytest.mark.parametrize("start", [52000, 86399])
def test_live_link_face(written: Written, rate: int, start: int) -> None:
    motion = read_motion(written(link_face([k + 0.207 for k in range(200)], rate, start)))
    assert (motion.rate, motion.start, len(motion.values)) == (rate, 0, 200)
    assert motion.channels == ("jawOpen", "mouthSmileLeft")
    assert motion.values[150, 0] == pytest.approx(0.150207, abs=1e-6)
    assert "not learnt from: EyeBlinkLeft, HeadYaw" in motion.notes


def test_dropped_frames_are_filled_and_told(written: Written) -> None:
    kept = [k for k in range(200) if k not in (20, 21, 22, 90)]
    motion = read_motion(written(link_face(kept, 60, 52000)))
    assert len(motion.values) == 200
    np.testing.assert_allclose(motion.values[:, 0], np.arange(200) / 1000, atol=1e-6)
    assert any("4 frames (2.0%) missing, at most 0.05 s: filled" in note for note in motion.notes)


def test_rows_of_a_face_that_was_lost_count_as_dropped(written: Written) -> None:
    text = link_face(list(range(120)), 60, 0).splitlines()
    text[50] = text[50].partition(",")[0] + ",0,,,,"
    motion = read_motion(written("\n".join(text)))
    assert len(motion.values) == 120
    assert any("1 frames" in note for note in motion.notes)


def test_uneven_rows_are_drawn_even(written: Written) -> None:
    rng = np.random.default_rng(3)
    times = np.arange(300) / 30 + rng.uniform(-0.015, 0.015, 300)
    times[0] = 0
    values = 0.5 + 0.4 * np.sin(times)
    motion = read_motion(
        written(table("time,jawOpen", [f"{t:.5f}" for t in times], values.tolist()))
    )
    assert any("unevenly" in note for note in motion.notes)
    np.testing.assert_allclose(motion.rate, 30, rtol=0.01)
    at = motion.times - 0.5 / motion.rate
    np.testing.assert_allclose(motion.values[:, 0], 0.5 + 0.4 * np.sin(at), atol=2e-3)


def test_names_in_any_spelling_and_other_columns(written: Written) -> None:
    header = "time,head.jaw_open,mouthSmile_L,MouthSmile_R,browInnerUp,lipWidth"
    motion = read_motion(
        written(table(header, [k / 25 for k in range(10)], RAMP, RAMP, RAMP, RAMP, RAMP))
    )
    assert motion.channels == ("jawOpen", "mouthSmileLeft", "mouthSmileRight")
    assert "not learnt from: browInnerUp, lipWidth" in motion.notes


def test_a_rigs_own_names_are_all_learnt_but_head_and_eyes(written: Written) -> None:
    header = "time,claw,headYaw,Mandible"
    motion = read_motion(written(table(header, [k / 25 for k in range(10)], RAMP, RAMP, RAMP)))
    assert motion.channels == ("claw", "Mandible")


def test_values_out_of_range_are_told(written: Written) -> None:
    times = [k / 25 for k in range(10)]
    motion = read_motion(written(table("time,jawOpen", times, [1.3 * v for v in RAMP])))
    assert motion.notes == ("beyond 0..1, kept: jawOpen 0 to 1.17",)
    motion = read_motion(written(table("time,jawOpen", times, [100 * v for v in RAMP])))
    assert motion.notes == ("values are read as per cent",)
    assert motion.values.max() == pytest.approx(0.9)


def test_semicolons_with_decimal_commas(written: Written) -> None:
    rows = [f"{k * 0.04:.2f};{v:.1f}".replace(".", ",") for k, v in enumerate(RAMP)]
    motion = read_motion(written("\n".join(["time;jawOpen", *rows])))
    np.testing.assert_allclose(motion.values[:, 0], RAMP, atol=1e-6)


HEAD = "time,jawOpen,mouthClose"
ROWS = [f"{k * 0.04:.2f},0.1,0.2" for k in range(8)]


def changed(row: int, text: str) -> str:
    return "\n".join([HEAD, *(text if k == row else one for k, one in enumerate(ROWS))])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "is empty"),
        ("\n\n", "is empty"),
        ("a\0b", "is not text"),
        ("0.00,0.1\n0.04,0.2\n", "line 1: no line of column names"),
        (HEAD, "0 frames; expected 4 or more"),
        ("\n".join([HEAD, *ROWS[:3]]), "3 frames; expected 4 or more"),
        (changed(3, "0.12,NaN,0.2"), "line 5, column 'jawOpen': 'NaN'; expected a finite number"),
        (changed(3, "0.12,0.1,lost"), "line 5, column 'mouthClose': 'lost'"),
        (changed(3, "0.12,,0.2"), "line 5, column 'jawOpen': an empty cell"),
        (changed(3, "0.12,inf,0.2"), "line 5, column 'jawOpen': 'inf'"),
        (changed(3, "x,0.1,0.2"), "line 5, column 'time': 'x'"),
        (changed(3, "0.12,0.1"), "line 5: 2 cells; expected 3"),
        (changed(3, "0.12,0.1,0.2,0.3"), "line 5: 4 cells; expected 3"),
        (changed(3, "0.02,0.1,0.2"), "line 5, column 'time': 0.02 s comes after 0.08 s"),
        (changed(7, "2.00,0.1,0.2"), "line 9, column 'time': 1.72 s without a frame"),
        ("\n".join([HEAD, *(f"{k},0,0" for k in range(8))]), "1000 frames per second|ms|seconds"),
        ("\n".join(["time,jawOpen,JawOpen", *ROWS]), "'jawOpen' and 'JawOpen' both mean jawOpen"),
        ("\n".join(["time,jawOpen,jawOpen", *ROWS]), "the column 'jawOpen' twice"),
        ("\n".join(["time,headYaw,eyeBlinkLeft", *ROWS]), "no channel of a mouth among 2 columns"),
        ("\n".join(["Timecode,jawOpen,x", *ROWS]), "'0.00'; expected a timecode HH:MM:SS:FF.fff"),
        ("\n".join([HEAD, *(f"{k * 0.3:.1f},0,0" for k in range(8))]), "3.333 frames per second"),
    ],
)
def test_bad_tables(written: Written, text: str, words: str) -> None:
    with pytest.raises(FileFormatError, match=words) as caught:
        read_motion(written(text))
    assert "take.csv" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_files_that_are_not_there_or_of_another_kind(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        read_motion(tmp_path / "none.csv")
    with pytest.raises(InputError, match=r"'\.fbx'; expected motion in \.csv or \.c3d"):
        read_motion(tmp_path / "take.fbx")


@pytest.mark.parametrize(("start", "sound"), [(0.0, 2.0), (0.0, 2.15), (0.1, 2.2)])
def test_lengths_that_agree(start: float, sound: float) -> None:
    check_length(Motion(("jawOpen",), np.zeros((50, 1), np.float32), 25, start), sound)


@pytest.mark.parametrize(("start", "sound"), [(0.0, 2.3), (0.0, 1.5), (0.5, 2.5)])
def test_lengths_that_disagree(start: float, sound: float) -> None:
    motion = Motion(("jawOpen",), np.zeros((50, 1), np.float32), 25, start, where="a.csv")
    with pytest.raises(InputError, match=r"a\.csv: motion from .* beside .* s of sound"):
        check_length(motion, sound)
