"""Animation: its lossless file keeps everything, and a broken one is refused with its place."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from lipwright.animation import Animation
from lipwright.curves import Keys
from lipwright.errors import FileFormatError, InputError, LabelError
from lipwright.phones import PhoneTrack
from lipwright.timeline import Interval, Tier

names = st.lists(st.text(st.characters(exclude_categories=["Cs"])), max_size=5, unique=True)
finite = st.floats(allow_nan=False, allow_infinity=False)


@st.composite
def animations(draw: st.DrawFn) -> Animation:
    controls = tuple(draw(names))
    shape = (draw(st.integers(0, 6)), len(controls))
    weights = st.floats(width=32, allow_nan=False, allow_infinity=False)
    marks = sorted(draw(st.sets(finite, max_size=6)))
    labels = draw(st.lists(st.text(st.characters(exclude_categories=["Cs"])), min_size=6))
    confidence = draw(st.none() | st.floats(0, 1))
    tier = Tier(
        tuple(
            Interval(label, start, end, confidence)
            for label, start, end in zip(labels, marks, marks[1:], strict=False)
        )
    )
    return Animation(
        controls,
        draw(hnp.arrays(np.float32, shape, elements=weights)),
        draw(st.floats(1e-300, 1e300)),
        draw(finite),
        {name: Keys.of([(t, draw(finite)) for t in marks]) for name in controls[:2]},
        PhoneTrack(tier, "ipa"),
        tier,
        "bigram",
        {"stand-ins": labels, "settings": {"window": draw(finite)}},
    )


@given(animations())
def test_the_file_keeps_everything_to_the_last_bit(animation: Animation) -> None:
    read = Animation.from_bytes(animation.to_bytes())
    assert read.values.tobytes() == animation.values.tobytes()
    assert read.values.shape == animation.values.shape
    for name in ("controls", "rate", "start", "keys", "phones", "words", "engine", "report"):
        assert getattr(read, name) == getattr(animation, name), name
    assert read.to_bytes() == animation.to_bytes()


def example() -> Animation:
    return Animation(
        ("open", "PBM"),
        np.array([[0.0, 1.0], [0.5, -0.0], [0.25, 0.1]], dtype=np.float32),
        25.0,
        -0.2,
        phones=PhoneTrack(Tier.of(("aa", 0.0, 0.1))),
    )


def test_the_file_has_a_line_for_each_frame_and_phone() -> None:
    written = example().to_bytes().decode()
    assert "\n  [0, 1],\n  [0.5, -0.0],\n  [0.25, 0.1]\n" in written
    assert '\n  ["aa", 0, 0.1]\n' in written
    assert json.loads(written)["format"] == "lipwright/animation"


def test_frames_lie_on_the_clock_of_the_sound() -> None:
    animation = example()
    np.testing.assert_allclose(animation.times, [-0.2, -0.16, -0.12])
    assert animation.duration == pytest.approx(0.12)
    assert len(animation) == 3
    np.testing.assert_allclose(animation.at([-0.18, 9.0]), [[0.25, 0.5], [0.25, 0.1]])


def test_a_control_is_found_by_its_name() -> None:
    np.testing.assert_array_equal(
        example().control("open"), np.array([0, 0.5, 0.25], dtype=np.float32)
    )
    with pytest.raises(InputError, match="no control 'jaw'; expected one of open, PBM"):
        example().control("jaw")


def test_save_writes_json_and_names_the_way_to_other_formats(tmp_path: Path) -> None:
    example().save(tmp_path / "ä b.json")
    assert Animation.load(tmp_path / "ä b.json").to_bytes() == example().to_bytes()
    with pytest.raises(InputError, match=r"'.glb' is not the lossless format.*lipwright\.save"):
        example().save(tmp_path / "a.glb")
    assert not (tmp_path / "a.glb").exists()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"controls": ("a",)}, r"frames of shape \(3, 2\) for 1 controls"),
        ({"controls": ("a", "a")}, "stands twice"),
        ({"rate": 0.0}, "0.0 frames per second"),
        ({"rate": float("nan")}, "nan frames per second"),
        ({"start": float("inf")}, "from inf s"),
        ({"values": np.full((1, 2), np.nan, np.float32)}, "'open' is not finite in frame 0"),
    ],
)
def test_an_animation_that_cannot_play_is_refused(change: dict[str, Any], words: str) -> None:
    fields = {"controls": ("open", "PBM"), "values": np.zeros((3, 2), np.float32), "rate": 25.0}
    with pytest.raises(InputError, match=words):
        Animation(**{**fields, **change})


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"frames": [[0]]}, r"a\.json, frame 0: 1 values; expected 2, one for each control"),
        ({"frames": [[0, "x"]]}, r"a\.json, at frames\[0\]\[1\]"),
        ({"frame": []}, "unknown field `frame`"),
        ({"frames": [[0, 1e39]]}, r"a\.json: 'PBM' is not finite in frame 0"),
        ({"frames": [[0, 10**400]]}, r"a\.json, at frames\[0\]\[1\]"),
        ({"rate": -1}, r"-1\.0 frames per second"),
        ({"version": 2}, r"lipwright/animation version 2; .*It was written by a newer Lipwright"),
        ({"version": "1"}, "version '1'"),
        ({"format": "lipwright/set"}, "a file of format 'lipwright/set'"),
        ({"phones": [["aa", 0]]}, r"the row \['aa', 0\.0\]; expected \[label, start, end\]"),
        ({"phones": [["aa", 1, 0]]}, "'aa' runs from 1 to 0 s"),
        ({"words": [["a", 0, 2], ["b", 1, 3]]}, r"a\.json, interval 2: 'b' at 1 s overlaps 'a'"),
        ({"keys": {"open": [[0, 0], [0, 1]]}}, "does not come after"),
        ({"controls": ["open", "open"]}, "stands twice"),
    ],
)
def test_a_broken_file_names_its_place(change: dict[str, Any], words: str, tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    path.write_text(json.dumps({**json.loads(example().to_bytes()), **change}))
    with pytest.raises(FileFormatError, match=words):
        Animation.load(path)


def test_an_animation_without_controls_has_no_columns() -> None:
    empty = Animation((), np.zeros((2, 0), np.float32), 30.0)
    assert empty.at([0.0]).shape == (1, 0)
    assert Animation.from_bytes(empty.to_bytes()).values.shape == (2, 0)


def test_label_errors_are_format_errors_of_the_file() -> None:
    with pytest.raises(FileFormatError) as caught:
        Animation.from_bytes(example().to_bytes().replace(b'"aa", 0, 0.1', b'"aa", 1, 0.1'))
    assert not isinstance(caught.value, LabelError)
