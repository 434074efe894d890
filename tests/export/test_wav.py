"""WAV: the sound of the line, or a word on why there is none."""

from pathlib import Path

import numpy as np
import pytest

from lipwright.errors import InputError
from lipwright.export import encode
from lipwright.sound_files import read_sound
from tests.export.performances import performance


def test_the_sound_comes_back(tmp_path: Path) -> None:
    made = performance()
    assert made.speech.sound is not None
    (tmp_path / "a.wav").write_bytes(encode(made, ".wav"))
    read = read_sound(tmp_path / "a.wav")
    assert read.rate == made.speech.sound.rate
    np.testing.assert_allclose(read.samples, made.speech.sound.samples, atol=1e-4)


def test_without_a_sound_it_says_what_to_do() -> None:
    with pytest.raises(InputError, match=r"no sound to write as WAV.*Give the recording, or leave"):
        encode(performance(silent=True), ".wav")
